//! Leads, links and rapids around passes: they move with the ends of their passes, and never below them.

use super::findings::MotionFindings;
use super::lead_conflict::LeadConflict;
use super::pass_writer::PassWriter;
use super::vertical_passes::{UPRIGHT, is_cutting};
use crate::diagnostic::Failure;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{Program, Record};
use crate::transform::StepContext;
use crate::write::ProgramEditor;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;
use std::ops::Range;

/// A pass whose ends have moved; mm.
#[derive(Debug, Clone)]
pub(super) struct MovedPass {
    /// Its motions.
    pub motions: Range<usize>,
    /// Where it starts now.
    pub start: Point3<f64>,
    /// Where it ends now.
    pub end: Point3<f64>,
}

/// What is known about the motions around passes.
pub(super) struct PassSurroundings<'a> {
    pub motions: &'a [Motion],
    /// Length of the file's unit, mm.
    pub mm_per_unit: f64,
    /// How much higher (mm, along the axis) everything around passes goes: the ball's radius where tips become centres.
    pub lift_mm: f64,
    /// Which motions cannot end elsewhere: FROM and GOHOME.
    pub fixed: Vec<bool>,
    /// Which motions cut, but are not meant.
    pub excluded: Vec<bool>,
}

impl<'a> PassSurroundings<'a> {
    pub fn new(
        program: &Program,
        motions: &'a [Motion],
        meant: &[bool],
        mm_per_unit: f64,
        lift: f64,
    ) -> Self {
        let fixed = |motion: &Motion| {
            let record = program.statement(motion.last_statement()).record();
            matches!(record, Record::From(_) | Record::GoHome(_))
        };
        let excluded = |(motion, meant): (&Motion, &bool)| {
            let way = motion.to.point - motion.from.point;
            let upright = (way - motion.to.axis * way.dot(&motion.to.axis)).norm() * mm_per_unit <= UPRIGHT;
            !*meant && is_cutting(motion) && (motion.class_is_told || !upright)
        };
        Self {
            motions,
            mm_per_unit,
            lift_mm: lift,
            fixed: motions.iter().map(fixed).collect(),
            excluded: motions.iter().zip(meant).map(excluded).collect(),
        }
    }

    fn has_flag(&self, list: &[bool], index: usize) -> bool {
        list.get(index).copied().unwrap_or(false)
    }

    fn is_immovable(&self, index: usize) -> bool {
        self.has_flag(&self.fixed, index) || self.has_flag(&self.excluded, index)
    }

    fn end_point_mm(&self, index: usize) -> Option<Point3<f64>> {
        self.motions.get(index).map(|motion| motion.to.point * self.mm_per_unit)
    }

    fn tool_axis(&self, index: usize) -> Vector3<f64> {
        self.motions.get(index).map_or_else(Vector3::z, |motion| motion.to.axis)
    }

    fn operation_index(&self, index: usize) -> Option<usize> {
        self.motions.get(index).map(|motion| motion.operation)
    }

    /// Whether the motion before a pass can bring the tool to its new start, and the one after it take it from its end.
    fn check_pass_ends(&self, pass: &MovedPass) -> Result<(), LeadConflict> {
        let own = self.operation_index(pass.motions.start);
        let Some(before) = pass.motions.start.checked_sub(1) else {
            return Err(LeadConflict::Fixed(pass.motions.start));
        };
        // An end that stays where it was needs nobody to move.
        let same =
            |new: Point3<f64>, old: Option<Point3<f64>>| old.is_some_and(|old| (new - old).norm() <= 1e-6);
        let last = pass.motions.end.checked_sub(1).and_then(|last| self.end_point_mm(last));
        let after = pass.motions.end;
        if !same(pass.end, last) && self.operation_index(after) == own && self.has_flag(&self.excluded, after)
        {
            return Err(LeadConflict::Excluded(after));
        }
        if same(pass.start, self.end_point_mm(before)) {
            return Ok(());
        }
        if self.operation_index(before) != own || self.has_flag(&self.fixed, before) {
            return Err(LeadConflict::Fixed(before));
        }
        if self.has_flag(&self.excluded, before) {
            return Err(LeadConflict::Excluded(before));
        }
        let rapid = self
            .motions
            .get(before)
            .is_some_and(|motion| motion.rapid || matches!(motion.path, MotionPath::Start));
        let way = pass.start - self.end_point_mm(before).unwrap_or(pass.start);
        let up = self.tool_axis(before);
        let across = (way - up * way.dot(&up)).norm();
        if rapid && (way.dot(&up) < -1e-6 || across > 1e-6) {
            return Err(LeadConflict::Rapid(before));
        }
        Ok(())
    }
}

/// New ends of motions around passes, by the motion's index; mm. `height` is the lowest that the tip may go at a place, where that is
/// known.
///
/// Straight above an end of a pass, points stay straight above it. Leads at feed move as one with their end. What lies between two
/// passes at feed moves with both, in proportion. Everything else of the operation stays where it is, but for its height. No rapid
/// ends lower than it did.
///
/// # Errors
/// [`LeadConflict`] where that would move what is not to be moved.
pub(super) fn move_surroundings(
    around: &PassSurroundings<'_>,
    passes: &[MovedPass],
    height: &dyn Fn(Point3<f64>) -> Option<f64>,
) -> Result<BTreeMap<usize, Point3<f64>>, LeadConflict> {
    let mut ends = BTreeMap::new();
    let last = around.motions.len();
    for (index, pass) in passes.iter().enumerate() {
        around.check_pass_ends(pass)?;
        let next = passes.get(index + 1);
        if index == 0 {
            move_between_passes(around, (None, Some(pass)), 0..pass.motions.start, &mut ends);
        }
        let until = next.map_or(last, |next| next.motions.start);
        move_between_passes(around, (Some(pass), next), pass.motions.end..until, &mut ends);
    }
    for (index, end) in &mut ends {
        // The start of a pass is what was computed for it.
        if passes.iter().any(|pass| pass.motions.start == index + 1) {
            continue;
        }
        let up = around.tool_axis(*index);
        let rapid = around.motions.get(*index).is_some_and(|motion| motion.rapid);
        let old =
            around.end_point_mm(*index).filter(|_| rapid).map(|old| old.coords.dot(&up) + around.lift_mm);
        let least = height(*end).into_iter().chain(old).fold(f64::NEG_INFINITY, f64::max);
        let low = least - end.coords.dot(&up);
        // Rounding of the path itself is no reason to leave it.
        if low > 1e-6 {
            *end += up * low;
        }
    }
    Ok(ends)
}

/// The motions between two passes (or before the first, or after the last).
fn move_between_passes(
    around: &PassSurroundings<'_>,
    (left, reached): (Option<&MovedPass>, Option<&MovedPass>),
    range: Range<usize>,
    ends: &mut BTreeMap<usize, Point3<f64>>,
) {
    let own = left.or(reached).and_then(|pass| around.operation_index(pass.motions.start));
    let next = reached.and_then(|pass| around.operation_index(pass.motions.start));
    if around.lift_mm > 0.0 {
        for index in range.clone().filter(|index| !around.is_immovable(*index)) {
            let operation = around.operation_index(index);
            if let Some(at) = around.end_point_mm(index).filter(|_| operation == own || operation == next) {
                ends.insert(index, at + around.tool_axis(index) * around.lift_mm);
            }
        }
    }
    let mut behind: BTreeMap<usize, bool> = BTreeMap::new();
    if let Some(left) = left {
        let old =
            left.motions.end.checked_sub(1).and_then(|last| around.end_point_mm(last)).unwrap_or(left.end);
        let mut lead = true;
        for index in range.clone() {
            let (Some(motion), Some(at)) = (around.motions.get(index), around.end_point_mm(index)) else {
                break;
            };
            lead &= !motion.rapid;
            let above = is_straight_above(at, old, around.tool_axis(index));
            if around.operation_index(index) != own || around.is_immovable(index) || !lead && !above {
                break;
            }
            ends.insert(
                index,
                shift_with_pass(at, (old, left.end), around.tool_axis(index), above, around.lift_mm),
            );
            behind.insert(index, above);
        }
    }
    let Some(ahead) = reached else { return };
    let Some(old) = ahead.motions.start.checked_sub(1).and_then(|before| around.end_point_mm(before)) else {
        return;
    };
    let mut lead = true;
    for index in range.clone().rev() {
        let (Some(motion), Some(at)) = (around.motions.get(index), around.end_point_mm(index)) else { break };
        let above = is_straight_above(at, old, around.tool_axis(index));
        if around.operation_index(index) != next || around.is_immovable(index) || !lead && !above {
            break;
        }
        let wanted = shift_with_pass(at, (old, ahead.start), around.tool_axis(index), above, around.lift_mm);
        let share = (index + 1 - range.start) as f64 / range.len() as f64;
        let link = !motion.rapid && !above && index + 1 < ahead.motions.start;
        let new = match (ends.get(&index), behind.get(&index)) {
            // A link at feed goes evenly from one end to the other; what stands straight above the end behind stays there.
            (Some(other), Some(false)) if link => other + (wanted - other) * share,
            (Some(other), Some(true)) if !above => *other,
            _ => wanted,
        };
        ends.insert(index, new);
        // The motion that leads here decides whether the point before it is part of the lead.
        lead &= !motion.rapid;
    }
}

fn is_straight_above(at: Point3<f64>, end: Point3<f64>, up: Vector3<f64>) -> bool {
    let way = at - end;
    (way - up * way.dot(&up)).norm() <= UPRIGHT
}

/// A point that goes with the end of a pass: straight above it at its own height (`lift` higher), or as one with it; never below it.
fn shift_with_pass(
    at: Point3<f64>,
    (old, new): (Point3<f64>, Point3<f64>),
    up: Vector3<f64>,
    above: bool,
    lift: f64,
) -> Point3<f64> {
    if (at - old).norm() <= UPRIGHT {
        return new;
    }
    let way = new - old;
    let wanted = if above { at + (way - up * way.dot(&up)) + up * lift } else { at + way };
    let lower = (new - wanted).dot(&up);
    // What was above the end stays above it.
    if (at - old).dot(&up) >= -UPRIGHT && lower > 0.0 { wanted + up * lower } else { wanted }
}

/// Writes the ends around passes.
#[allow(clippy::too_many_arguments)] // one call, and a struct would only rename them
pub(super) fn write_leads(
    writer: &PassWriter<'_>,
    editor: &mut ProgramEditor,
    motions: &[Motion],
    ends: &BTreeMap<usize, Point3<f64>>,
    moved: &[MovedPass],
    mm_per_unit: f64,
    original: &Program,
    context: &StepContext<'_>,
) -> Result<(), Failure> {
    let start_of = |index: usize| -> Point3<f64> {
        let before = index.checked_sub(1);
        let of_pass = moved.iter().find(|pass| pass.motions.end == index).map(|pass| pass.end);
        of_pass
            .or_else(|| before.and_then(|before| ends.get(&before).copied()))
            .or_else(|| motions.get(index).map(|motion| motion.from.point * mm_per_unit))
            .unwrap_or_else(Point3::origin)
    };
    let within = |index: usize| moved.iter().any(|pass: &MovedPass| contains(&pass.motions, index));
    let touched = ends
        .keys()
        .copied()
        .chain(ends.keys().map(|index| index + 1))
        .chain(moved.iter().map(|pass| pass.motions.end));
    let mut touched: Vec<usize> = touched.filter(|index| *index < motions.len() && !within(*index)).collect();
    touched.sort_unstable();
    touched.dedup();
    for index in touched {
        let old = motions.get(index).map_or_else(Point3::origin, |motion| motion.to.point * mm_per_unit);
        let end = ends.get(&index).copied().unwrap_or(old);
        let written = writer.move_end(editor, index, end, start_of(index))?;
        let place = MotionFindings { program: original, motions };
        written.map_err(|why| place.describe_unwritable_motion(why, index, context))?;
    }
    Ok(())
}

fn contains(range: &Range<usize>, index: usize) -> bool {
    range.contains(&index)
}
