//! Leads, links and rapids around passes: they move with the ends of their passes, and never below them.

use super::passes::UPRIGHT;
use super::words::Place;
use super::write::Writer;
use crate::diagnostic::Diagnostic;
use crate::program::Program;
use crate::program::motion::Motion;
use crate::transform::Context;
use crate::write::Editor;
use nalgebra::{Point3, Vector3};
use std::collections::BTreeMap;
use std::ops::Range;

/// A pass whose ends have moved; mm.
#[derive(Debug, Clone)]
pub(super) struct Moved {
    /// Its motions.
    pub motions: Range<usize>,
    /// Where it starts now.
    pub start: Point3<f64>,
    /// Where it ends now.
    pub end: Point3<f64>,
}

/// New ends of motions around passes, by the motion's index; mm. `height` is the lowest that the tip may go at a place, where that is
/// known: the ends given here are not lower.
///
/// Straight above an end of a pass, points stay straight above it. Leads at feed move as one with their end. What lies between two
/// passes at feed moves with both, in proportion. Everything else stays where it is, but for its height.
pub(super) fn around(
    motions: &[Motion],
    passes: &[Moved],
    mm: f64,
    height: &dyn Fn(Point3<f64>) -> Option<f64>,
) -> BTreeMap<usize, Point3<f64>> {
    let mut ends = BTreeMap::new();
    let last = motions.len();
    for (index, pass) in passes.iter().enumerate() {
        let before = index.checked_sub(1).and_then(|before| passes.get(before));
        let next = passes.get(index + 1);
        if before.is_none() {
            gap(motions, (None, Some(pass)), 0..pass.motions.start, mm, &mut ends);
        }
        let until = next.map_or(last, |next| next.motions.start);
        gap(motions, (Some(pass), next), pass.motions.end..until, mm, &mut ends);
    }
    for (index, end) in &mut ends {
        let up = motions.get(*index).map_or_else(Vector3::z, |motion| motion.to.axis);
        if let Some(least) = height(*end) {
            let low = least - end.coords.dot(&up);
            // Rounding of the path itself is no reason to leave it.
            if low > 1e-6 {
                *end += up * low;
            }
        }
    }
    ends
}

/// The motions between two passes (or before the first, or after the last).
fn gap(
    motions: &[Motion],
    (left, reached): (Option<&Moved>, Option<&Moved>),
    range: Range<usize>,
    mm: f64,
    ends: &mut BTreeMap<usize, Point3<f64>>,
) {
    let operation = |pass: &Moved| motions.get(pass.motions.start).map(|motion| motion.operation);
    let point = |index: usize| motions.get(index).map(|motion| motion.to.point * mm);
    let axis = |index: usize| motions.get(index).map_or_else(Vector3::z, |motion| motion.to.axis);
    // The points that belong to the end behind, and those that belong to the start ahead.
    let mut behind = range.start;
    if let Some(left) = left {
        let old = left.motions.end.checked_sub(1).and_then(point).unwrap_or(left.end);
        let own = operation(left);
        let mut lead = true;
        while behind < range.end && motions.get(behind).map(|motion| motion.operation) == own {
            let (Some(motion), Some(at)) = (motions.get(behind), point(behind)) else { break };
            lead &= !motion.rapid;
            let above = is_above(at, old, axis(behind));
            if !lead && !above {
                break;
            }
            ends.insert(behind, shifted(at, old, left.end, axis(behind), above));
            behind += 1;
        }
    }
    let Some(ahead) = reached else { return };
    let own = operation(ahead);
    let Some(old) = ahead.motions.start.checked_sub(1).and_then(point).or(Some(ahead.start)) else { return };
    let mut lead = true;
    let mut index = range.end;
    while index > range.start {
        index -= 1;
        let (Some(motion), Some(at)) = (motions.get(index), point(index)) else { break };
        if Some(motion.operation) != own && index + 1 != ahead.motions.start {
            break;
        }
        let above = is_above(at, old, axis(index));
        if !lead && !above {
            break;
        }
        let wanted = shifted(at, old, ahead.start, axis(index), above);
        let share = (index + 1 - range.start) as f64 / range.len() as f64;
        let new = match ends.get(&index) {
            // A link at feed goes evenly from one end to the other.
            Some(behind) if index + 1 < ahead.motions.start => behind + (wanted - behind) * share,
            _ => wanted,
        };
        ends.insert(index, new);
        // The motion that leads here decides whether the point before it is part of the lead.
        lead &= !motion.rapid;
    }
}

fn is_above(at: Point3<f64>, end: Point3<f64>, up: Vector3<f64>) -> bool {
    let way = at - end;
    (way - up * way.dot(&up)).norm() <= UPRIGHT
}

/// A point that goes with the end of a pass: straight above it at its own height, or as one with it; never below it.
fn shifted(
    at: Point3<f64>,
    old: Point3<f64>,
    new: Point3<f64>,
    up: Vector3<f64>,
    above: bool,
) -> Point3<f64> {
    let way = new - old;
    let wanted = if above { at + (way - up * way.dot(&up)) } else { at + way };
    if (at - old).norm() <= UPRIGHT {
        return new;
    }
    let lower = (new - wanted).dot(&up);
    // What was above the end stays above it.
    if (at - old).dot(&up) >= -UPRIGHT && lower > 0.0 { wanted + up * lower } else { wanted }
}

/// Writes the ends around passes.
#[allow(clippy::too_many_arguments)] // one call, and a struct would only rename them
pub(super) fn leads_written(
    writer: &Writer<'_>,
    editor: &mut Editor,
    motions: &[Motion],
    ends: &BTreeMap<usize, Point3<f64>>,
    moved: &[Moved],
    mm: f64,
    original: &Program,
    context: &Context<'_>,
) -> Result<(), Box<Diagnostic>> {
    let start_of = |index: usize| -> Point3<f64> {
        let before = index.checked_sub(1);
        let of_pass = moved.iter().find(|pass| pass.motions.end == index).map(|pass| pass.end);
        of_pass
            .or_else(|| before.and_then(|before| ends.get(&before).copied()))
            .or_else(|| motions.get(index).map(|motion| motion.from.point * mm))
            .unwrap_or_else(Point3::origin)
    };
    let within = |index: usize| moved.iter().any(|pass: &Moved| contains(&pass.motions, index));
    let touched = ends
        .keys()
        .copied()
        .chain(ends.keys().map(|index| index + 1))
        .chain(moved.iter().map(|pass| pass.motions.end));
    let mut touched: Vec<usize> = touched.filter(|index| *index < motions.len() && !within(*index)).collect();
    touched.sort_unstable();
    touched.dedup();
    for index in touched {
        let old = motions.get(index).map_or_else(Point3::origin, |motion| motion.to.point * mm);
        let end = ends.get(&index).copied().unwrap_or(old);
        let written = writer.move_end(editor, index, end, start_of(index))?;
        let place = Place { program: original, motions };
        written.map_err(|why| place.unwritable(why, index, context))?;
    }
    Ok(())
}

fn contains(range: &Range<usize>, index: usize) -> bool {
    range.contains(&index)
}
