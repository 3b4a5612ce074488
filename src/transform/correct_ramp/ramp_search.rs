//! This module finds ramps in the motions of a program.
//!
//! A ramp is a run of descending feed motions after which the tool continues to cut at the level that it has
//! reached. Where the file marks its motions, only those marked as engaging count. Otherwise an operation
//! must mostly cut level, because on surfaces any descent may be a cut.

use super::ramp::{NOTHING, Ramp, RampArc, RampStep};
use crate::program::MotionClass;
use crate::program::geometry::{MotionPath, Pose};
use crate::program::motion::Motion;
use crate::program::record::{SpindleUnit, ToolWord};
use nalgebra::{Point3, Rotation3, Vector2, Vector3};
use std::ops::Range;

/// Heights that differ by less than this (mm) are the same level.
pub(super) const LEVEL: f64 = 1e-3;

/// A motion descends if it goes down by more than this (mm). It is half of the fourth decimal, and chords of
/// a gentle helix fall little more.
const FALLS: f64 = 5e-5;

/// A descent of less than this (mm) is the rounding of a level.
const LEAST_HEIGHT: f64 = 0.01;

/// The least fraction of level path (`OperationSurvey`) that an unmarked operation needs, so that its
/// descents count as ramps.
const LEAST_LEVEL_FRACTION: f64 = 0.8;

/// Axes whose components differ by less than this are the same axis.
const SAME_AXIS: f64 = 1e-6;

/// A ramp found in a program.
#[derive(Debug, Clone)]
pub(super) struct FoundRamp {
    /// Its motions.
    pub motions: Range<usize>,
    /// Its operation.
    pub operation: usize,
    /// The rotation from the program's frame into the tool's frame.
    pub frame: Rotation3<f64>,
    /// The ramp, in mm.
    pub ramp: Ramp,
    /// Whether cutting continues at the level of its end.
    pub has_level: bool,
    /// The directions in which cutting continues, with the first pass first.
    pub passes: Vec<Vector2<f64>>,
}

/// Finds the ramps among motions. `mm_per_unit` is the length of one unit of the file. `begin` is the height
/// above its end from which a descent may be in material, where that is known.
pub(super) fn find_ramps(motions: &[Motion], mm_per_unit: f64, begin: Option<f64>) -> Vec<FoundRamp> {
    let operations = survey_operations(motions, mm_per_unit);
    let mut found = Vec::new();
    let mut index = 0;
    while let Some(motion) = motions.get(index) {
        let may = |motion: &Motion| {
            is_candidate(motion, mm_per_unit)
                && operations.get(motion.operation).is_some_and(|operation| operation.can_have_ramps(motion))
        };
        if !may(motion) {
            index += 1;
            continue;
        }
        let run = motions.get(index..).unwrap_or_default();
        let goes_on = |next: &Motion| {
            may(next)
                && next.operation == motion.operation
                && next.class_is_stated == motion.class_is_stated
                && has_same_axis(next, motion)
        };
        let count = run.iter().take_while(|next| goes_on(next)).count().max(1);
        let end = index + count;
        found.extend(find_ramp_in_run(motions, index..end, mm_per_unit, begin));
        index = end;
    }
    found
}

/// Reads a run of descending motions as a ramp. Returns `None` if it is none.
fn find_ramp_in_run(
    motions: &[Motion],
    mut run: Range<usize>,
    mm_per_unit: f64,
    begin: Option<f64>,
) -> Option<FoundRamp> {
    let all = motions.get(run.clone())?;
    let first = all.first()?;
    let frame = tool_frame_rotation(first.from.axis)?;
    let mut ramp = Ramp {
        start: to_tool_frame_mm(first.from, &frame, mm_per_unit),
        steps: all.iter().flat_map(|motion| read_steps(motion, &frame, mm_per_unit)).collect(),
    };
    // A straight descent before the slope is the approach, as long as it stays above the material.
    let end = ramp.end_point().z;
    let above = |z: f64| begin.is_none_or(|begin| z - end >= begin - LEVEL);
    let lead = ramp
        .steps_with_starts()
        .take_while(|(from, step)| step.length_across_mm(*from) <= NOTHING && above(step.to.z))
        .count();
    // A straight motion is a single step, so the first steps are the first motions.
    if lead > 0 && lead < ramp.steps.len() {
        ramp.start = ramp.steps.get(lead - 1)?.to;
        ramp.steps.drain(..lead);
        run.start += lead;
    }
    let passes = find_pass_directions(motions, run.end, first, &frame, mm_per_unit);
    let has_level = !passes.is_empty();
    // A marked engage motion that leads onto a surface is no ramp either.
    let next = motions
        .get(run.end..)
        .unwrap_or_default()
        .iter()
        .find(|motion| motion.length() * mm_per_unit > NOTHING);
    let surface = next.is_some_and(|next| {
        !next.rapid && next.class == MotionClass::Cut && next.operation == first.operation
    });
    if ramp.height_mm() < LEAST_HEIGHT || !has_level && (!first.class_is_stated || surface) {
        return None;
    }
    Some(FoundRamp { operation: first.operation, motions: run, frame, ramp, has_level, passes })
}

/// Returns whether a motion may be part of a ramp. It must be a descent at feed with a constant axis, neither
/// drilling nor turning.
fn is_candidate(motion: &Motion, mm_per_unit: f64) -> bool {
    let marked_otherwise = motion.class_is_stated && motion.class != MotionClass::Engage;
    !motion.rapid
        && !marked_otherwise
        && motion.hole.is_none()
        && motion.class != MotionClass::Drill
        && !matches!(motion.path, MotionPath::Start)
        && (motion.from.axis - motion.to.axis).amax() <= SAME_AXIS
        && !is_turning(motion)
        && rise_along_axis(motion) * mm_per_unit < -FALLS
}

/// Returns whether a motion is on a lathe: the spindle keeps a surface speed, or the tool is no milling tool.
pub(super) fn is_turning(motion: &Motion) -> bool {
    let surface_speed = motion
        .spindle
        .as_deref()
        .is_some_and(|spindle| spindle.unit != SpindleUnit::RevolutionsPerMinute && spindle.speed.is_some());
    let data = motion.tool.as_deref().and_then(|tool| tool.data.as_ref());
    surface_speed || data.is_some_and(|data| data.word.is_no_mill())
}

/// Returns how far a motion goes up along the tool axis, in the file's unit.
fn rise_along_axis(motion: &Motion) -> f64 {
    (motion.to.point - motion.from.point).dot(&motion.from.axis)
}

fn has_same_axis(one: &Motion, other: &Motion) -> bool {
    (one.from.axis - other.from.axis).amax() <= SAME_AXIS
}

/// Returns the rotation that makes the tool axis vertical. For an axis that points down it is half a turn
/// about x, because no shortest rotation exists there.
pub(super) fn tool_frame_rotation(axis: Vector3<f64>) -> Option<Rotation3<f64>> {
    if (axis - Vector3::z()).amax() <= SAME_AXIS {
        return Some(Rotation3::identity());
    }
    Rotation3::rotation_between(&axis, &Vector3::z())
        .or_else(|| Some(Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)))
}

/// Returns a point in the tool's frame, in mm.
pub(super) fn to_tool_frame_mm(pose: Pose, frame: &Rotation3<f64>, mm_per_unit: f64) -> Point3<f64> {
    frame * (pose.point * mm_per_unit)
}

/// Reads motions as a ramp in the tool's frame, whatever their slope. Returns `None` if one of them is
/// neither a line nor an arc about the tool axis.
pub(super) fn read_ramp(motions: &[Motion], frame: &Rotation3<f64>, mm_per_unit: f64) -> Option<Ramp> {
    let start = to_tool_frame_mm(motions.first()?.from, frame, mm_per_unit);
    let steps: Vec<RampStep> =
        motions.iter().filter_map(|motion| read_step(motion, frame, mm_per_unit)).collect();
    (steps.len() == motions.len()).then_some(Ramp { start, steps })
}

/// Reads a motion as a step in the tool's frame. Returns `None` for an arc about another axis and for a
/// spline.
fn read_step(motion: &Motion, frame: &Rotation3<f64>, mm_per_unit: f64) -> Option<RampStep> {
    let to = to_tool_frame_mm(motion.to, frame, mm_per_unit);
    match &motion.path {
        MotionPath::Line => Some(RampStep::straight_to(to)),
        MotionPath::Arc(arc) => {
            let axis = frame * arc.axis.into_inner();
            if axis.xy().norm() > SAME_AXIS.sqrt() {
                return None;
            }
            let centre = (frame * (arc.center * mm_per_unit)).xy();
            Some(RampStep { to, bend: Some(RampArc { centre, sweep: arc.sweep * axis.z.signum() }) })
        }
        MotionPath::Start | MotionPath::Spline(_) => None,
    }
}

/// Reads a motion as steps. A curve that is no arc about the tool axis becomes chords.
fn read_steps(motion: &Motion, frame: &Rotation3<f64>, mm_per_unit: f64) -> Vec<RampStep> {
    match read_step(motion, frame, mm_per_unit) {
        Some(step) => vec![step],
        None => {
            let points = motion.path.sample_points(motion.from.point, motion.to.point);
            points.iter().skip(1).map(|point| RampStep::straight_to(frame * (point * mm_per_unit))).collect()
        }
    }
}

/// Returns the directions in which cutting continues at the level where a ramp ends: the direction of the
/// first pass, of the lead to it, and their opposites. The first pass is the first motion marked as a cut, or
/// else the longest of the motions that follow, because leads are short. The list is empty if nothing
/// continues at that level.
fn find_pass_directions(
    motions: &[Motion],
    end: usize,
    first: &Motion,
    frame: &Rotation3<f64>,
    mm_per_unit: f64,
) -> Vec<Vector2<f64>> {
    let rest = motions
        .get(end..)
        .unwrap_or_default()
        .iter()
        .filter(|motion| motion.length() * mm_per_unit > NOTHING);
    let level: Vec<&Motion> = rest
        .take_while(|motion| continues_at_level(motion, first, mm_per_unit))
        .take(MOST_FOLLOWING)
        .collect();
    let marked = level.iter().find(|motion| motion.class_is_stated && motion.class == MotionClass::Cut);
    let longest =
        level.iter().copied().reduce(|one, next| if next.length() > one.length() { next } else { one });
    let wanted = marked.copied().or(longest).into_iter().chain(level.first().copied());
    let ahead: Vec<Vector2<f64>> = wanted.filter_map(|motion| find_start_direction(motion, frame)).collect();
    ahead.iter().copied().chain(ahead.iter().map(|direction| -direction)).collect()
}

/// The number of motions after a ramp among which its first pass is searched. Leads and rounded corners come
/// before it.
const MOST_FOLLOWING: usize = 8;

fn continues_at_level(motion: &Motion, first: &Motion, mm_per_unit: f64) -> bool {
    !motion.rapid
        && motion.hole.is_none()
        && motion.operation == first.operation
        && has_same_axis(motion, first)
        && (motion.from.axis - motion.to.axis).amax() <= SAME_AXIS
        && is_level(motion, mm_per_unit)
        && !matches!(motion.class, MotionClass::Retract | MotionClass::Approach)
}

fn find_start_direction(motion: &Motion, frame: &Rotation3<f64>) -> Option<Vector2<f64>> {
    let tangent = match &motion.path {
        MotionPath::Line | MotionPath::Start => motion.to.point - motion.from.point,
        MotionPath::Arc(arc) => arc.tangent_at(0.0),
        MotionPath::Spline(spline) => spline.start_tangent(),
    };
    (frame * tangent).xy().try_normalize(1e-9)
}

/// Returns whether a motion stays at one level.
pub(super) fn is_level(motion: &Motion, mm_per_unit: f64) -> bool {
    let inside = motion.path.sample_points(motion.from.point, motion.to.point);
    inside
        .iter()
        .all(|point| ((point - motion.from.point).dot(&motion.from.axis) * mm_per_unit).abs() <= LEVEL)
}

/// The measurements of an operation.
#[derive(Debug, Clone, Copy)]
struct OperationSurvey {
    /// The length of its level path at feed without marks, across the axis, in mm. `level_or_rising` also
    /// counts rising path. Surfaces rise as much as they fall, while levels are left by rapids or straight
    /// up.
    level: f64,
    level_or_rising: f64,
    /// The smallest and the largest y, in mm.
    y: [f64; 2],
}

impl OperationSurvey {
    const NOTHING: Self = Self { level: 0.0, level_or_rising: 0.0, y: [f64::INFINITY, f64::NEG_INFINITY] };

    /// Returns whether a descent of the operation may be a ramp. If CUTTER gives the tool a single number,
    /// and the path keeps a single y, the tool is a lathe's: CATIA writes the nose radius like that.
    fn can_have_ramps(&self, motion: &Motion) -> bool {
        let data = motion.tool.as_deref().and_then(|tool| tool.data.as_ref());
        let nose = data.is_some_and(|data| data.word == ToolWord::Cutter && data.corner_radius.is_none());
        let [low, high] = self.y;
        if nose && high - low <= LEVEL {
            return false;
        }
        motion.class_is_stated
            || self.level >= LEAST_LEVEL_FRACTION * self.level_or_rising && self.level > 0.0
    }
}

fn survey_operations(motions: &[Motion], mm_per_unit: f64) -> Vec<OperationSurvey> {
    let mut found: Vec<OperationSurvey> = Vec::new();
    for motion in motions {
        if found.len() <= motion.operation {
            found.resize(motion.operation + 1, OperationSurvey::NOTHING);
        }
        let Some(survey) = found.get_mut(motion.operation) else { continue };
        let y = motion.to.point.y * mm_per_unit;
        let [low, high] = survey.y;
        survey.y = [low.min(y), high.max(y)];
        let up = rise_along_axis(motion);
        if motion.rapid || motion.hole.is_some() || motion.class_is_stated || up * mm_per_unit < -LEVEL {
            continue;
        }
        // Pythagoras: only the part across the axis counts, so a plunge does not make an operation level.
        let across = (motion.length().powi(2) - up * up).max(0.0).sqrt() * mm_per_unit;
        survey.level_or_rising += across;
        survey.level += if is_level(motion, mm_per_unit) { across } else { 0.0 };
    }
    found
}
