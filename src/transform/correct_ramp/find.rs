//! Ramps in the motions of a program.
//!
//! A ramp is a run of descending feed motions after which the tool cuts on at the level it came down to. Where the file marks its
//! motions, only those marked as engaging count; else an operation must cut level for the most part, since on surfaces any
//! descent may be a cut.

use super::ramp::{Bend, NOTHING, Ramp, Step};
use crate::program::MotionClass;
use crate::program::geometry::{Path, Pose};
use crate::program::motion::Motion;
use crate::program::record::{SpindleUnit, ToolWord};
use nalgebra::{Point3, Rotation3, Vector2, Vector3};
use std::ops::Range;

/// Heights that differ by less than this (mm) are one level.
pub(super) const LEVEL: f64 = 1e-3;

/// Least share ([`level_shares`]) of an unmarked operation, for its descents to be ramps.
const LEAST_LEVEL_SHARE: f64 = 0.5;

/// Axes whose components differ by less are one.
const SAME_AXIS: f64 = 1e-6;

/// A ramp of a program.
#[derive(Debug, Clone)]
pub(super) struct Found {
    /// Its motions.
    pub motions: Range<usize>,
    /// Its operation.
    pub operation: usize,
    /// From the program's frame into the tool's.
    pub frame: Rotation3<f64>,
    /// The ramp, in mm.
    pub ramp: Ramp,
    /// Whether cutting goes on at its end level, and where to.
    pub first_pass: Option<Vector2<f64>>,
}

/// Looks for ramps; `mm` is one unit of the file. `begin` is the height above its end from which a descent may be in material,
/// where that is known.
pub(super) fn find(motions: &[Motion], mm: f64, begin: Option<f64>) -> Vec<Found> {
    let flat = level_shares(motions, mm);
    let mut found = Vec::new();
    let mut index = 0;
    while let Some(motion) = motions.get(index) {
        let may = |motion: &Motion| {
            is_candidate(motion, mm)
                && (motion.class_is_told
                    || flat.get(motion.operation).is_some_and(|share| *share >= LEAST_LEVEL_SHARE))
        };
        if !may(motion) {
            index += 1;
            continue;
        }
        let run = motions.get(index..).unwrap_or_default();
        let goes_on = |next: &Motion| {
            may(next)
                && next.operation == motion.operation
                && next.class_is_told == motion.class_is_told
                && same_axis(next, motion)
        };
        let count = run.iter().take_while(|next| goes_on(next)).count().max(1);
        let end = index + count;
        found.extend(one(motions, index..end, mm, begin));
        index = end;
    }
    found
}

/// The ramp of a run of descending motions; `None` when it is none.
fn one(motions: &[Motion], mut run: Range<usize>, mm: f64, begin: Option<f64>) -> Option<Found> {
    let all = motions.get(run.clone())?;
    let first = all.first()?;
    let frame = to_tool(first.from.axis)?;
    let mut ramp = read(all, &frame, mm)?;
    // A straight way down before the slope begins is the approach, as far as it stays above the material.
    let end = ramp.end().z;
    let above = |z: f64| begin.is_none_or(|begin| z - end >= begin - LEVEL);
    let lead =
        ramp.walk().take_while(|(from, step)| step.across(*from) <= NOTHING && above(step.to.z)).count();
    if lead > 0 && lead < ramp.steps.len() {
        ramp.start = ramp.steps.get(lead - 1)?.to;
        ramp.steps.drain(..lead);
        run.start += lead;
    }
    let first_pass = level_after(motions, run.end, first, &frame, mm);
    if first_pass.is_none() && !first.class_is_told {
        return None;
    }
    Some(Found { operation: first.operation, motions: run, frame, ramp, first_pass })
}

/// Whether a motion may be part of a ramp: a descent at feed, with the axis at rest, that is no drilling and no turning.
fn is_candidate(motion: &Motion, mm: f64) -> bool {
    let told_otherwise = motion.class_is_told && motion.class != MotionClass::Engage;
    !motion.rapid
        && !told_otherwise
        && motion.hole.is_none()
        && motion.class != MotionClass::Drill
        && matches!(motion.path, Path::Line | Path::Arc(_))
        && (motion.from.axis - motion.to.axis).amax() <= SAME_AXIS
        && !is_turning(motion)
        && rise(motion) * mm < -LEVEL
}

/// A lathe: the spindle keeps a surface speed, or the tool is none that mills.
pub(super) fn is_turning(motion: &Motion) -> bool {
    let surface_speed = motion
        .spindle
        .as_deref()
        .is_some_and(|spindle| spindle.unit != SpindleUnit::RevolutionsPerMinute && spindle.speed.is_some());
    let data = motion.tool.as_deref().and_then(|tool| tool.data.as_ref());
    surface_speed || data.is_some_and(|data| data.word == ToolWord::TlDataOther)
}

/// How far a motion goes up along the tool axis, in the file's unit.
fn rise(motion: &Motion) -> f64 {
    (motion.to.point - motion.from.point).dot(&motion.from.axis)
}

fn same_axis(one: &Motion, other: &Motion) -> bool {
    (one.from.axis - other.from.axis).amax() <= SAME_AXIS
}

/// The rotation that stands the tool axis upright; none at all where it is. A tool upside down has no natural one: about x.
pub(super) fn to_tool(axis: Vector3<f64>) -> Option<Rotation3<f64>> {
    if (axis - Vector3::z()).amax() <= SAME_AXIS {
        return Some(Rotation3::identity());
    }
    Rotation3::rotation_between(&axis, &Vector3::z())
        .or_else(|| Some(Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)))
}

/// A point in the tool's frame, mm.
pub(super) fn placed(pose: Pose, frame: &Rotation3<f64>, mm: f64) -> Point3<f64> {
    frame * (pose.point * mm)
}

/// Motions as a ramp in the tool's frame, whatever their slope; `None` where one of them is no line or arc about the tool axis.
pub(super) fn read(motions: &[Motion], frame: &Rotation3<f64>, mm: f64) -> Option<Ramp> {
    let start = placed(motions.first()?.from, frame, mm);
    let steps: Vec<Step> = motions.iter().filter_map(|motion| step(motion, frame, mm)).collect();
    (steps.len() == motions.len()).then_some(Ramp { start, steps })
}

/// A motion as a step in the tool's frame; `None` for an arc about another axis and for a spline.
fn step(motion: &Motion, frame: &Rotation3<f64>, mm: f64) -> Option<Step> {
    let to = placed(motion.to, frame, mm);
    match &motion.path {
        Path::Line => Some(Step::straight(to)),
        Path::Arc(arc) => {
            let axis = frame * arc.axis.into_inner();
            if axis.xy().norm() > SAME_AXIS.sqrt() {
                return None;
            }
            let centre = (frame * (arc.center * mm)).xy();
            Some(Step { to, bend: Some(Bend { centre, sweep: arc.sweep * axis.z.signum() }) })
        }
        Path::Start | Path::Spline(_) => None,
    }
}

/// The direction in which cutting goes on at the level where a ramp ends; `None` when it does not.
fn level_after(
    motions: &[Motion],
    end: usize,
    first: &Motion,
    frame: &Rotation3<f64>,
    mm: f64,
) -> Option<Vector2<f64>> {
    let rest = motions.get(end..)?;
    let next = rest.iter().find(|motion| motion.length() * mm > NOTHING)?;
    let cuts = !next.rapid
        && next.hole.is_none()
        && next.operation == first.operation
        && same_axis(next, first)
        && (next.from.axis - next.to.axis).amax() <= SAME_AXIS
        && is_level(next, mm)
        && !matches!(next.class, MotionClass::Retract | MotionClass::Approach);
    if !cuts {
        return None;
    }
    let tangent = match &next.path {
        Path::Line | Path::Start => next.to.point - next.from.point,
        Path::Arc(arc) => arc.tangent(0.0),
        Path::Spline(spline) => spline.start_tangent(),
    };
    (frame * tangent).xy().try_normalize(1e-9)
}

/// Whether a motion stays at one level.
pub(super) fn is_level(motion: &Motion, mm: f64) -> bool {
    let inside = motion.path.samples(motion.from.point, motion.to.point);
    inside.iter().all(|point| ((point - motion.from.point).dot(&motion.from.axis) * mm).abs() <= LEVEL)
}

/// For each operation, the share of its path at feed across the axis that is level rather than rising: surfaces rise as much as they fall,
/// levels are left by rapids or straight up. What is marked does not count.
fn level_shares(motions: &[Motion], mm: f64) -> Vec<f64> {
    let mut lengths: Vec<[f64; 2]> = Vec::new();
    for motion in
        motions.iter().filter(|motion| !motion.rapid && motion.hole.is_none() && !motion.class_is_told)
    {
        if lengths.len() <= motion.operation {
            lengths.resize(motion.operation + 1, [0.0; 2]);
        }
        let up = rise(motion);
        if up * mm < -LEVEL {
            continue;
        }
        let across = (motion.length().powi(2) - up * up).max(0.0).sqrt();
        if let Some([level, all]) = lengths.get_mut(motion.operation) {
            *all += across;
            *level += if is_level(motion, mm) { across } else { 0.0 };
        }
    }
    lengths.iter().map(|[level, all]| if *all > 0.0 { level / all } else { 0.0 }).collect()
}
