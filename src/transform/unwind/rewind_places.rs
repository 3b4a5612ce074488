//! This module finds where rotary axes go back in a cut, and where they can do it instead.

use crate::machine::{AxisKind, JointValues, KinematicChain, MachineAxis, ProgramPose, solve_program_poses};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{FeedUnit, LengthUnit, Program, StatementId};
use nalgebra::Point3;

/// A step of a rotary axis above this is a rewind: the other way round is shorter.
const REWIND_STEP_DEG: f64 = 180.0 + 1e-9;

/// How much a value may be beyond a limit by rounding, in degrees.
const LIMIT_SLACK_DEG: f64 = 1e-9;

/// A rewind in a cut.
pub(super) struct RewindPlace {
    /// The statement that ends the motion on which the axis would go back.
    pub statement: StatementId,
    /// The motion before which the axis goes back instead.
    pub before: MotionPlace,
    /// How it goes back there, or why it cannot.
    pub turn: Result<RewindTurn, &'static str>,
}

/// A motion before which statements may be put in.
#[derive(Debug, Clone)]
pub(super) struct MotionPlace {
    pub number: usize,
    pub motion: Motion,
}

/// A rotary axis that goes back while the tool stands at a pose.
#[derive(Debug, Clone, Copy)]
pub(super) struct RewindTurn {
    /// The number of the rotary axis, 0 or 1.
    pub rotary: usize,
    /// The values before it goes back.
    pub joints: JointValues,
    /// The tip, mm.
    pub tip: Point3<f64>,
    /// By how much the axis turns, in degrees: a full turn.
    pub by: f64,
}

/// Lists the rewinds in cuts of a program. `is_meant` tells which motions the step means.
pub(super) fn list_rewinds(
    program: &Program,
    chain: &KinematicChain,
    file: LengthUnit,
    mut is_meant: impl FnMut(&Motion) -> bool,
) -> Vec<RewindPlace> {
    let poses = solve_program_poses(program, chain, file);
    let motions: Vec<Motion> = program.motions().collect();
    let mut found = Vec::new();
    for (number, motion) in motions.iter().enumerate() {
        let meant = is_meant(motion);
        let pair = number.checked_sub(1).and_then(|before| poses.get(before)).zip(poses.get(number));
        let Some((before, pose)) =
            pair.filter(|_| meant && !motion.rapid && motion.path != MotionPath::Start)
        else {
            continue;
        };
        let Some(joints) = pose.motion_from(before, chain) else { continue };
        for (rotary, step) in joints.rotary_steps().into_iter().enumerate() {
            if step.abs() > REWIND_STEP_DEG {
                let by = 360.0 * step.signum();
                let (place, turn) = find_place(chain, (&motions, &poses), number, (rotary, by));
                let at = MotionPlace { number: place, motion: motions.get(place).unwrap_or(motion).clone() };
                found.push(RewindPlace { statement: motion.last_statement(), before: at, turn });
            }
        }
    }
    // Two rewinds before one motion are made one after the other, in two rounds.
    found.dedup_by_key(|place| place.before.number);
    found
}

/// Returns the motion before which an axis can go back by a turn with both values inside its limits: the motion of the
/// rewind, or the next one.
fn find_place(
    chain: &KinematicChain,
    (motions, poses): (&[Motion], &[ProgramPose]),
    number: usize,
    (rotary, by): (usize, f64),
) -> (usize, Result<RewindTurn, &'static str>) {
    let axis = chain.axes().iter().filter(|axis| axis.kind == AxisKind::Rotary).nth(rotary);
    let inside = |value: f64| axis.is_none_or(|axis| allows_value(axis, value));
    let value = |pose: &ProgramPose| pose.chosen?.joints.rotaries.get(rotary).copied();
    // At the pose before, the values are those before the axis has gone back; at the own one, those behind.
    let before = number.checked_sub(1).and_then(|before| poses.get(before));
    let own = poses.get(number);
    let is_before = before.and_then(value).is_some_and(|value| inside(value + by));
    let is_behind = own.and_then(value).is_some_and(|value| inside(value - by));
    let (place, pose, undo) = match (is_before, is_behind) {
        (true, _) => (number, before, 0.0),
        (false, true) => (number + 1, own, by),
        _ => return (number, Err("both sides of it have no value in common between the limits")),
    };
    let usable = motions.get(place).filter(|motion| !motion.rapid && motion.path != MotionPath::Start);
    let (Some(motion), Some(pose)) = (usable, pose) else {
        return (number, Err("the cut ends behind it"));
    };
    if motion.hole.is_some() {
        return (number, Err("it is in a drilling cycle"));
    }
    if motion.feed.is_some_and(|feed| feed.unit_or_default() == FeedUnit::InverseTime) {
        return (
            number,
            Err("the feed is the time of a whole motion, so the way back to the cut would have none"),
        );
    }
    let Some(chosen) = pose.chosen else { return (number, Err(super::UNSOLVED)) };
    let mut joints = chosen.joints;
    if let Some(value) = joints.rotaries.get_mut(rotary) {
        *value -= undo;
    }
    (place, Ok(RewindTurn { rotary, joints, tip: pose.tip, by }))
}

fn allows_value(axis: &MachineAxis, value: f64) -> bool {
    axis.limits.is_none_or(|[low, high]| (low - LIMIT_SLACK_DEG..=high + LIMIT_SLACK_DEG).contains(&value))
}
