//! This module checks that a program with split motions still states the same path.

use super::split_statements::SplitMotion;
use crate::program::geometry::{CircularArc, MotionPath, SAME_POINT};
use crate::program::motion::Motion;
use crate::program::{Program, StatementId};
use std::collections::BTreeSet;
use std::ops::Range;

/// New coordinates have at least four decimals. This is half of the last one, and rounding errors.
const ROUNDING: f64 = 5e-5 * (1.0 + 1e-6);

/// New unit vectors have at least five decimals.
const AXIS_ROUNDING: f64 = 5e-6 * (1.0 + 1e-6);

/// A program's motions, and the statements that have problems, each of them once.
pub(super) struct ReadMotions {
    pub motions: Vec<Motion>,
    problems: Vec<StatementId>,
}

impl ReadMotions {
    pub(super) fn from_program(program: &Program) -> Self {
        let mut all = program.motions();
        let motions = all.by_ref().collect();
        let mut problems: Vec<StatementId> =
            all.take_problems().iter().map(|problem| problem.statement).collect();
        problems.sort_unstable();
        Self { motions, problems }
    }

    fn count_problems(&self, motions: &[Motion]) -> usize {
        let count = |motion: &Motion| {
            let before = self.problems.partition_point(|problem| *problem < motion.statements.first());
            let until = self.problems.partition_point(|problem| *problem <= motion.statements.last());
            until - before
        };
        motions.iter().map(count).sum()
    }
}

/// Returns the old indices of the split motions that cause a difference.
pub(super) fn find_faulty_splits(
    before: &ReadMotions,
    after: &ReadMotions,
    splits: &[SplitMotion],
    parts: &[Range<usize>],
) -> BTreeSet<usize> {
    let everything = || splits.iter().map(|split| split.motion).collect();
    if parts.last().map_or(0, |range| range.end) != after.motions.len() {
        return everything();
    }
    let mut splits_left = splits.iter().peekable();
    let mut last_split = None;
    let mut found = BTreeSet::new();
    for (index, (old, range)) in before.motions.iter().zip(parts).enumerate() {
        let new = after.motions.get(range.clone()).unwrap_or_default();
        let split = splits_left.next_if(|split| split.motion == index);
        last_split = split.map(|split| split.motion).or(last_split);
        let worse = after.count_problems(new) > before.count_problems(std::slice::from_ref(old));
        let same = match (split, new) {
            (Some(split), parts) => is_split_as_planned(old, parts, split),
            (None, [new]) => has_same_attributes(old, new) && old.to == new.to && old.path == new.path,
            _ => false,
        };
        if !same || worse {
            match last_split {
                Some(split) => found.insert(split),
                None => return everything(),
            };
        }
    }
    found
}

/// Returns whether a part has all attributes of the motion that was split.
fn has_same_attributes(old: &Motion, new: &Motion) -> bool {
    old.feed == new.feed
        && old.rapid == new.rapid
        && (old.class, old.class_is_stated) == (new.class, new.class_is_stated)
        && old.operation == new.operation
        && old.tool == new.tool
        && old.spindle == new.spindle
        && old.hole.is_some() == new.hole.is_some()
}

fn is_split_as_planned(old: &Motion, parts: &[Motion], split: &SplitMotion) -> bool {
    let ends = split.poses.iter().copied().chain([old.to]);
    let poses = parts.iter().zip(ends).all(|(part, end)| {
        (part.to.point - end.point).amax() <= ROUNDING && (part.to.axis - end.axis).amax() <= AXIS_ROUNDING
    });
    let from_end_to_end = parts.first().is_some_and(|first| first.from == old.from)
        && parts.last().is_some_and(|last| last.to == old.to)
        && parts.windows(2).all(|pair| matches!(pair, [a, b] if a.to == b.from));
    let alike = parts
        .iter()
        .all(|part| has_same_attributes(old, part) && (part.to.point - part.from.point).norm() > SAME_POINT);
    let path = match &old.path {
        MotionPath::Line => parts.iter().all(|part| part.path == MotionPath::Line),
        MotionPath::Arc(arc) => are_arc_parts(arc, parts, split),
        MotionPath::Spline(_) | MotionPath::Start => false,
    };
    poses && from_end_to_end && alike && path
}

/// Checks that the parts are arcs about the same centre and axis, each with its fraction of the sweep.
/// Rounded ends turn a spoke by their rounding divided by the radius. A plane that is read from them (CATIA)
/// turns by that angle divided by the sine of the sweep.
fn are_arc_parts(whole: &CircularArc, parts: &[Motion], split: &SplitMotion) -> bool {
    let turned = 4.0 * ROUNDING / whole.radius.max(SAME_POINT);
    parts.iter().zip(split.part_fractions()).all(|(part, (start, end))| {
        let MotionPath::Arc(arc) = &part.path else { return false };
        let sweep = whole.sweep * (end - start);
        let tilt = turned / sweep.sin().abs().max(0.01) + 1e-5;
        arc.center == whole.center
            && (arc.axis.into_inner() - whole.axis.into_inner()).norm() <= tilt
            && (arc.sweep - sweep).abs() <= turned + 1e-6
    })
}
