//! This module moves the leads, links and rapids around passes with the ends of their passes, and never below
//! them.

use super::findings::MotionFindings;
use super::lead_conflict::LeadConflict;
use super::pass_writer::PassWriter;
use super::vertical_passes::{STRAIGHT_DOWN, is_cutting};
use crate::diagnostic::Failure;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{Program, Record};
use crate::transform::StepContext;
use crate::write::ProgramEditor;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;
use std::ops::Range;

/// A pass whose ends have moved, in mm.
#[derive(Debug, Clone)]
pub(super) struct MovedPass {
    /// Its motions.
    pub motions: Range<usize>,
    /// Its new start.
    pub start: Point3<f64>,
    /// Its new end.
    pub end: Point3<f64>,
}

/// What is known about the motions around passes.
pub(super) struct PassSurroundings<'a> {
    pub motions: &'a [Motion],
    /// The length of the file's unit, in mm.
    pub mm_per_unit: f64,
    /// How much higher everything around passes has to be, in mm along the axis. It is the ball's radius
    /// where tips become centres.
    pub lift_mm: f64,
    /// Which motions cannot end elsewhere: FROM and GOHOME.
    pub fixed: Vec<bool>,
    /// Which motions cut, but are not meant by the step.
    pub excluded: Vec<bool>,
}

impl<'a> PassSurroundings<'a> {
    pub(super) fn new(
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
            let displacement = motion.to.point - motion.from.point;
            let upright = (displacement - motion.to.axis * displacement.dot(&motion.to.axis)).norm()
                * mm_per_unit
                <= STRAIGHT_DOWN;
            !*meant && is_cutting(motion) && (motion.class_is_stated || !upright)
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

    /// Checks that the motion before a pass can reach its new start, and that the motion after it can leave
    /// from its new end.
    fn check_pass_ends(&self, pass: &MovedPass) -> Result<(), LeadConflict> {
        let own = self.operation_index(pass.motions.start);
        let Some(before) = pass.motions.start.checked_sub(1) else {
            return Err(LeadConflict::Fixed(pass.motions.start));
        };
        // An end that does not move asks nothing of its neighbours.
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
        // A rapid may end higher along the axis, but moving it sideways or down could put it into the part.
        let displacement = pass.start - self.end_point_mm(before).unwrap_or(pass.start);
        let up = self.tool_axis(before);
        let across = (displacement - up * displacement.dot(&up)).norm();
        if rapid && (displacement.dot(&up) < -1e-6 || across > 1e-6) {
            return Err(LeadConflict::Rapid(before));
        }
        Ok(())
    }
}

/// Returns the new ends of motions around passes, in mm, by the motion's index. `height` is the lowest height
/// of the tip at a point, where that is known.
///
/// Points straight above an end of a pass stay straight above it. Leads at feed are displaced like the end of
/// their pass. A link at feed between two passes is displaced in proportion to both. Everything else of the
/// operation keeps its place and only changes its height. No rapid ends lower than before.
///
/// Returns [`LeadConflict`] if a motion would have to move that must not be moved.
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
        // The start of a pass was computed for it and must not be lifted.
        if passes.iter().any(|pass| pass.motions.start == index + 1) {
            continue;
        }
        let up = around.tool_axis(*index);
        // A rapid may pass over clamps or stock that no profile shows, so it never gets lower than it was.
        let rapid = around.motions.get(*index).is_some_and(|motion| motion.rapid);
        let old =
            around.end_point_mm(*index).filter(|_| rapid).map(|old| old.coords.dot(&up) + around.lift_mm);
        let least = height(*end).into_iter().chain(old).fold(f64::NEG_INFINITY, f64::max);
        let low = least - end.coords.dot(&up);
        // Rounding of the path itself is no reason to lift a point.
        if low > 1e-6 {
            *end += up * low;
        }
    }
    Ok(ends)
}

/// Moves the motions between two passes, before the first pass or after the last one.
fn move_between_passes(
    around: &PassSurroundings<'_>,
    (left, reached): (Option<&MovedPass>, Option<&MovedPass>),
    range: Range<usize>,
    ends: &mut BTreeMap<usize, Point3<f64>>,
) {
    let own = left.or(reached).and_then(|pass| around.operation_index(pass.motions.start));
    let next = reached.and_then(|pass| around.operation_index(pass.motions.start));
    // Where tips become centres, everything first rises by the radius. The leads below are then placed by
    // their passes, which replaces this.
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
    // The leads of the next pass are found backwards from its start, so that the nearest motions count first.
    let mut lead = true;
    for index in range.clone().rev() {
        let (Some(motion), Some(at)) = (around.motions.get(index), around.end_point_mm(index)) else { break };
        let above = is_straight_above(at, old, around.tool_axis(index));
        if around.operation_index(index) != next || around.is_immovable(index) || !lead && !above {
            break;
        }
        let wanted = shift_with_pass(at, (old, ahead.start), around.tool_axis(index), above, around.lift_mm);
        // The displacement of a link grows by motions, not by length: a step over is only a few motions long.
        let fraction = (index + 1 - range.start) as f64 / range.len() as f64;
        let link = !motion.rapid && !above && index + 1 < ahead.motions.start;
        let new = match (ends.get(&index), behind.get(&index)) {
            // A link at feed changes evenly from one displacement to the other. A point straight above the
            // end of the previous pass stays above that.
            (Some(other), Some(false)) if link => other + (wanted - other) * fraction,
            (Some(other), Some(true)) if !above => *other,
            _ => wanted,
        };
        ends.insert(index, new);
        // The motion that leads to this point decides whether the previous point is part of the lead.
        lead &= !motion.rapid;
    }
}

fn is_straight_above(at: Point3<f64>, end: Point3<f64>, up: Vector3<f64>) -> bool {
    let displacement = at - end;
    (displacement - up * displacement.dot(&up)).norm() <= STRAIGHT_DOWN
}

/// Displaces a point with the end of a pass. A point straight above the end keeps its own height (raised by
/// `lift`), any other is displaced like the end. The point never gets below the new end if it was not below
/// the old one.
fn shift_with_pass(
    at: Point3<f64>,
    (old, new): (Point3<f64>, Point3<f64>),
    up: Vector3<f64>,
    above: bool,
    lift: f64,
) -> Point3<f64> {
    if (at - old).norm() <= STRAIGHT_DOWN {
        return new;
    }
    let displacement = new - old;
    let wanted =
        if above { at + (displacement - up * displacement.dot(&up)) + up * lift } else { at + displacement };
    let lower = (new - wanted).dot(&up);
    // A point that was above the end stays above it.
    if (at - old).dot(&up) >= -STRAIGHT_DOWN && lower > 0.0 { wanted + up * lower } else { wanted }
}

/// Writes the new ends of the motions around passes.
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
    // A motion that starts where a moved one ends changes, too: its arc or its GODLTA depends on its start.
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
        let place = MotionFindings { program: original, motions };
        writer
            .move_end(editor, index, end, start_of(index))
            .map_err(|fault| place.describe_write_fault(fault, index, context))?;
    }
    Ok(())
}

fn contains(range: &Range<usize>, index: usize) -> bool {
    range.contains(&index)
}
