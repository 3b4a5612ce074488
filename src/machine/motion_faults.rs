//! This module looks for motions that a machine cannot make, or not as they are programmed.

use super::joint_motion::{AxisInterpolation, JointMotion};
use super::kinematic_chain::KinematicChain;
use super::machine_axis::AxisKind;
use super::program_poses::{ProgramPose, solve_program_poses};
use crate::engagement::FOLLOWED_HEIGHT_MM;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program, StatementId};

/// The angle from the pole in degrees within which a motion passes it near.
const NEAR_POLE_DEG: f64 = 5.0;

/// The step of the first rotary axis in degrees from which a motion near the pole is told whatever its speed.
const WIDE_STEP_DEG: f64 = 45.0;

/// A step of a rotary axis above this is a rewind: the other way round is shorter.
const REWIND_STEP_DEG: f64 = 180.0 + 1e-9;

/// How much slower than programmed a motion must be to be told: feeds are written with few digits.
const FEED_SLACK: f64 = 1.0 + 1e-6;

/// What is wrong with a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MotionFaultKind {
    /// The machine cannot give the tool this axis.
    Unreachable,
    /// An axis is beyond its limit.
    BeyondLimit {
        /// The axis, as a place in [`KinematicChain::axes`].
        axis: usize,
        /// Where it would have to be, and the limit, in mm or degrees.
        value: f64,
        /// The limit.
        limit: f64,
    },
    /// The tool passes near the direction of the first rotary axis, which has to turn far.
    NearPole {
        /// The least angle to the pole at the ends, in degrees.
        angle: f64,
        /// The step of the first rotary axis, in degrees.
        step: f64,
        /// The speed that the programmed feed asks of it, in deg/min; `None` at rapid.
        speed: Option<f64>,
    },
    /// The second rotary axis changes to the other side of the pole.
    Flip {
        /// The steps of both rotary axes, in degrees.
        steps: [f64; 2],
    },
    /// A rotary axis goes back by a turn, because its limit is near.
    Rewind {
        /// The axis, as a place in [`KinematicChain::axes`].
        axis: usize,
        /// Its step, in degrees.
        step: f64,
        /// Whether it happens at feed.
        is_at_feed: bool,
    },
    /// The tip leaves its line, because all axes run evenly.
    TipError {
        /// The largest distance, in mm.
        sag: f64,
    },
    /// The tool axis leaves the shortest turn, because the rotary axes run evenly.
    AxisSwing {
        /// The largest angle between both, in degrees.
        swing: f64,
        /// How far a point [`FOLLOWED_HEIGHT_MM`] above the tip is beside it, in mm.
        distance: f64,
    },
    /// An axis cannot follow the programmed feed.
    TooFast {
        /// The axis, as a place in [`KinematicChain::axes`].
        axis: usize,
        /// The programmed feed in mm/min.
        feed: f64,
        /// The largest feed that it follows, in mm/min.
        most: f64,
    },
}

/// A motion with what is wrong with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionFault {
    /// The statement that ends the motion.
    pub statement: StatementId,
    /// What is wrong.
    pub kind: MotionFaultKind,
}

/// The machine as faults are looked for on it.
#[derive(Debug, Clone, Copy)]
pub struct FaultSearch<'c> {
    /// The axes.
    pub chain: &'c KinematicChain,
    /// How the machine goes from pose to pose.
    pub interpolation: AxisInterpolation,
    /// How far the tip may be from its line, in mm.
    pub tip_tolerance: f64,
}

impl FaultSearch<'_> {
    /// Returns all faults of a program, in its order.
    pub fn find_faults(&self, program: &Program, units: LengthUnit) -> Vec<MotionFault> {
        let poses = solve_program_poses(program, self.chain, units);
        let mut found = Vec::new();
        let mut before: Option<&ProgramPose> = None;
        for (motion, pose) in program.motions().zip(&poses) {
            self.check_pose(pose, &mut found);
            let joints = before.and_then(|before| pose.motion_from(before, self.chain));
            if let (Some(joints), Some(before)) = (joints, before)
                && motion.path != MotionPath::Start
            {
                self.check_motion(&motion, [before, pose], &joints, units, &mut found);
            }
            before = Some(pose);
        }
        found
    }

    fn check_pose(&self, pose: &ProgramPose, found: &mut Vec<MotionFault>) {
        let mut add = |kind| found.push(MotionFault { statement: pose.statement, kind });
        let Some(chosen) = pose.chosen else { return add(MotionFaultKind::Unreachable) };
        let values = self.chain.order_values(&chosen.joints.linears, &chosen.joints.rotaries);
        for place in self.chain.find_axes_outside(&chosen.joints) {
            let (Some(axis), Some(value)) = (self.chain.axes().get(place), values.get(place)) else {
                continue;
            };
            let Some([low, high]) = axis.limits else { continue };
            let limit = if *value < low { low } else { high };
            add(MotionFaultKind::BeyondLimit { axis: place, value: *value, limit });
        }
    }

    fn check_motion(
        &self,
        motion: &Motion,
        [before, pose]: [&ProgramPose; 2],
        joints: &JointMotion<'_>,
        units: LengthUnit,
        found: &mut Vec<MotionFault>,
    ) {
        let mut add = |kind| found.push(MotionFault { statement: pose.statement, kind });
        let steps = joints.rotary_steps();
        let feed = programmed_feed(motion, units);
        let sides = [before, pose].map(|pose| pose.chosen.map_or(0, |chosen| chosen.side));
        if self.chain.has_pole() && sides[0] * sides[1] < 0 {
            add(MotionFaultKind::Flip { steps });
        }
        let rotaries = self.chain.axes().iter().enumerate().filter(|(_, axis)| axis.kind == AxisKind::Rotary);
        for ((axis, _), step) in rotaries.zip(steps) {
            if step.abs() > REWIND_STEP_DEG {
                add(MotionFaultKind::Rewind { axis, step, is_at_feed: !motion.rapid });
            }
        }
        let near = self.near_pole([before, pose], joints, feed);
        if let Some(near) = near {
            add(near);
        }
        if motion.rapid {
            return;
        }
        if self.interpolation == AxisInterpolation::JointLinear && motion.path == MotionPath::Line {
            let sag = joints.tip_sag_mm();
            if sag > self.tip_tolerance {
                add(MotionFaultKind::TipError { sag });
            }
        }
        // Near the pole, what is told of it is the cause.
        let is_swung = self.interpolation == AxisInterpolation::TipControlled && near.is_none();
        if is_swung && motion.path == MotionPath::Line {
            let swing = joints.axis_swing_deg();
            let distance = 2.0 * FOLLOWED_HEIGHT_MM * (swing.to_radians() / 2.0).sin();
            if distance > self.tip_tolerance {
                add(MotionFaultKind::AxisSwing { swing, distance });
            }
        }
        if let (Some(feed), None, true) = (feed, near, motion.path == MotionPath::Line) {
            let demand = joints.axis_demand(self.interpolation);
            let length = joints.tip_length_mm();
            if let Some(axis) = demand.axis.filter(|_| length > 0.0) {
                let most = 60.0 * length / demand.least_s;
                if feed > most * FEED_SLACK {
                    add(MotionFaultKind::TooFast { axis, feed, most });
                }
            }
        }
    }

    /// Returns whether a motion passes near the pole so that the first rotary axis has to turn far or too fast.
    fn near_pole(
        &self,
        poses: [&ProgramPose; 2],
        joints: &JointMotion<'_>,
        feed: Option<f64>,
    ) -> Option<MotionFaultKind> {
        if !self.chain.has_pole() {
            return None;
        }
        let angles = poses.map(|pose| self.chain.pole_angle_deg(&pose.axis).unwrap_or(90.0));
        let angle = angles[0].min(angles[1]);
        let [step, _] = joints.rotary_steps();
        if angle > NEAR_POLE_DEG || step.abs() > REWIND_STEP_DEG {
            return None;
        }
        let first = self.chain.rotary_axes().next()?;
        let length = joints.tip_length_mm();
        let speed = feed.filter(|_| length > 0.0).map(|feed| step.abs() * feed / length);
        let is_too_fast = speed.is_some_and(|speed| speed > first.max_speed * FEED_SLACK);
        (is_too_fast || step.abs() > WIDE_STEP_DEG).then_some(MotionFaultKind::NearPole {
            angle,
            step,
            speed,
        })
    }
}

/// Returns the programmed feed of a motion in mm/min; `None` at rapid and where it is not known.
fn programmed_feed(motion: &Motion, units: LengthUnit) -> Option<f64> {
    if motion.rapid {
        return None;
    }
    let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
    let feed = motion.feed?.mm_per_minute(units, rpm, Some(motion.length()));
    feed.filter(|feed| *feed > 0.0 && feed.is_finite())
}
