//! This module computes the time that a machine takes for a program, motion by motion.

use super::axis_time::rest_to_rest_s;
use super::joint_motion::{AxisInterpolation, JointMotion};
use super::kinematic_chain::KinematicChain;
use super::machine_axis::MachineAxis;
use super::machine_waits::{DwellTime, MachineWait, find_machine_waits};
use super::path_time::{FeedMotion, FeedTimeParts, time_feed_motions};
use super::program_poses::{ProgramPose, solve_program_poses};
use crate::program::geometry::MotionPath;
use crate::program::motion::{ActiveTool, Motion};
use crate::program::record::{CycleDwell, Spindle};
use crate::program::{LengthUnit, Program, StatementId};
use nalgebra::Vector3;
use std::sync::Arc;

/// What the time of a program depends on, in mm, degrees and seconds.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineDynamics {
    /// The axes, where they are known.
    pub chain: Option<Arc<KinematicChain>>,
    /// How the machine goes from pose to pose.
    pub interpolation: AxisInterpolation,
    /// The acceleration along the path in mm/s2. Where it is not known, that of the axes counts.
    pub acceleration: Option<f64>,
    /// The jerk along the path in mm/s3, likewise.
    pub jerk: Option<f64>,
    /// What a corner costs: seconds by the root of the change of the velocity in mm/s.
    pub corner_constant: f64,
    /// The speed of rapids in mm/min, where the axes are not known.
    pub rapid_feed: Option<f64>,
    /// The time of a tool change in s.
    pub tool_change_s: f64,
    /// The time of a start of the spindle in s.
    pub spindle_start_s: f64,
}

/// The time of a program in s.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgramTime {
    /// The time of each motion, first points included, which take none. `None` where the feed or the rapids are not
    /// known.
    pub motions: Vec<Option<f64>>,
    /// How long the machine stands before each motion: for tool changes, starts of the spindle and dwells. A dwell at the
    /// depth of a hole belongs to the motion that goes there, and one behind the last motion to that one.
    pub standing: Vec<f64>,
    /// What the time at feed consists of.
    pub feed: FeedTimeParts,
    /// The time of rapids.
    pub rapid: f64,
    /// The number of tool changes and their time.
    pub tool_changes: usize,
    /// Their time.
    pub tool_change: f64,
    /// How often the spindle is switched on.
    pub spindle_starts: usize,
    /// The time of that.
    pub spindle_start: f64,
    /// The time that the program dwells.
    pub dwell: f64,
}

impl ProgramTime {
    /// Returns the time of everything that is known.
    pub fn total(&self) -> f64 {
        self.feed.total() + self.rapid + self.standing_s()
    }

    /// Returns the time that the machine stands.
    pub fn standing_s(&self) -> f64 {
        self.tool_change + self.spindle_start + self.dwell
    }
}

/// Computes the time of a program.
///
/// The machine stands at the start and the end, before and after rapids, stops, dwells and tool changes. Between, it
/// looks ahead with acceleration and jerk along the path and loses time at corners; see `path_time`. A motion is no
/// faster than its axes allow. At rapid every axis goes from rest to rest by itself.
pub fn time_program(program: &Program, units: LengthUnit, dynamics: &MachineDynamics) -> ProgramTime {
    let poses = dynamics.chain.as_ref().map(|chain| solve_program_poses(program, chain, units));
    let waits = find_machine_waits(program);
    let mut timer = ProgramTimer {
        dynamics,
        mm_per_unit: units.mm_per_unit(),
        units,
        waits: &waits,
        feed_motions: Vec::new(),
        places: Vec::new(),
        is_resting: true,
        tool: None,
        spindle: None,
        rpm: None,
        dwelt_hole: None,
        time: ProgramTime::default(),
    };
    let mut before: Option<&ProgramPose> = None;
    for (number, motion) in program.motions().enumerate() {
        let pose = poses.as_ref().and_then(|poses| poses.get(number));
        let joints = match (&dynamics.chain, before, pose) {
            (Some(chain), Some(before), Some(pose)) => pose.motion_from(before, chain),
            _ => None,
        };
        timer.add_motion(&motion, joints.as_ref());
        before = pose;
    }
    timer.finish_time()
}

struct ProgramTimer<'p> {
    dynamics: &'p MachineDynamics,
    mm_per_unit: f64,
    units: LengthUnit,
    waits: &'p [MachineWait],
    feed_motions: Vec<FeedMotion>,
    /// The number of the motion of each of these.
    places: Vec<usize>,
    is_resting: bool,
    tool: Option<Arc<ActiveTool>>,
    spindle: Option<Arc<Spindle>>,
    /// The spindle speed of the motion before.
    rpm: Option<f64>,
    /// The hole in which the tool has been at the depth.
    dwelt_hole: Option<usize>,
    time: ProgramTime,
}

impl ProgramTimer<'_> {
    fn add_motion(&mut self, motion: &Motion, joints: Option<&JointMotion<'_>>) {
        self.add_stops(motion);
        self.add_travel(motion, joints);
        self.add_dwell_in_hole(motion);
    }

    /// Adds the motion itself.
    fn add_travel(&mut self, motion: &Motion, joints: Option<&JointMotion<'_>>) {
        if motion.path == MotionPath::Start {
            self.is_resting = true;
            self.time.motions.push(Some(0.0));
            return;
        }
        if motion.rapid {
            let seconds = self.rapid_s(motion, joints);
            self.time.rapid += seconds.unwrap_or_default();
            self.time.motions.push(seconds);
            self.is_resting = true;
            return;
        }
        let place = self.time.motions.len();
        let found = self.feed_motion(motion, joints);
        match found {
            Some(feed_motion) if feed_motion.length > 0.0 => {
                self.feed_motions.push(feed_motion);
                self.places.push(place);
                self.is_resting = false;
                self.time.motions.push(Some(0.0));
            }
            // The tip stands, and the rotary axes turn by themselves.
            _ => {
                let turned = joints.map(|joints| joints.axis_demand(self.dynamics.interpolation).least_s);
                let seconds = found.map(|_| turned.unwrap_or(0.0));
                self.time.feed.feed += seconds.unwrap_or_default();
                self.is_resting |= seconds.is_none_or(|seconds| seconds > 0.0);
                self.time.motions.push(seconds);
            }
        }
    }

    /// Adds the time that the tool stays at the depth of a hole, behind its first motion at feed.
    fn add_dwell_in_hole(&mut self, motion: &Motion) {
        let Some((hole, cycle)) = motion.hole.as_ref().filter(|_| !motion.rapid) else { return };
        if self.dwelt_hole.replace(*hole) == Some(*hole) {
            return;
        }
        let Some(dwell) = cycle.dwell else { return };
        let seconds = match dwell {
            CycleDwell::Seconds(seconds) => seconds,
            CycleDwell::Revolutions(turns) => time_of_turns_s(turns, self.rpm),
        };
        self.time.dwell += seconds;
        self.is_resting |= seconds > 0.0;
        if let Some(standing) = self.time.standing.last_mut() {
            *standing += seconds;
        }
    }

    /// Adds what stands between the motion before and this one.
    fn add_stops(&mut self, motion: &Motion) {
        let stood = self.time.standing_s();
        self.rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
        self.add_waits(motion.last_statement());
        if !keeps_tool(self.tool.as_ref(), motion.tool.as_ref()) {
            // The first tool is in the spindle; every other one is changed.
            if self.tool.is_some() && motion.tool.is_some() {
                self.time.tool_changes += 1;
                self.time.tool_change += self.dynamics.tool_change_s;
            }
            self.is_resting = true;
            self.tool.clone_from(&motion.tool);
        }
        let turns = |spindle: Option<&Arc<Spindle>>| spindle.is_some_and(|spindle| spindle.on);
        if turns(motion.spindle.as_ref()) && !turns(self.spindle.as_ref()) {
            self.time.spindle_starts += 1;
            self.time.spindle_start += self.dynamics.spindle_start_s;
        }
        self.spindle.clone_from(&motion.spindle);
        self.time.standing.push(self.time.standing_s() - stood);
    }

    /// Adds the waits up to a statement.
    fn add_waits(&mut self, last: StatementId) {
        while let Some((wait, rest)) = self.waits.split_first()
            && wait.statement <= last
        {
            self.waits = rest;
            self.is_resting = true;
            self.time.dwell += match wait.dwell {
                Some(DwellTime::Seconds(seconds)) => seconds,
                Some(DwellTime::Revolutions(turns)) => time_of_turns_s(turns, self.rpm),
                None => 0.0,
            };
        }
    }

    fn rapid_s(&self, motion: &Motion, joints: Option<&JointMotion<'_>>) -> Option<f64> {
        if let Some(joints) = joints {
            return Some(joints.rapid_s());
        }
        let speed = self.dynamics.rapid_feed? / 60.0;
        let length = motion.length() * self.mm_per_unit;
        Some(rest_to_rest_s(length, speed, self.dynamics.acceleration, self.dynamics.jerk))
    }

    /// Returns a motion at feed, no faster than its axes allow. `None` where its feed is not known.
    fn feed_motion(&self, motion: &Motion, joints: Option<&JointMotion<'_>>) -> Option<FeedMotion> {
        let own = motion.length();
        let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
        let feed = motion.feed?.mm_per_minute(self.units, rpm, Some(own))?;
        let length = own * self.mm_per_unit;
        if length <= 0.0 {
            return Some(FeedMotion {
                length: 0.0,
                speed: 0.0,
                tangents: [Vector3::zeros(); 2],
                acceleration: None,
                jerk: None,
                is_from_rest: false,
            });
        }
        let mut speed = feed / 60.0;
        if !(speed > 0.0 && speed.is_finite() && length.is_finite()) {
            return None;
        }
        let (mut acceleration, mut jerk) = (self.dynamics.acceleration, self.dynamics.jerk);
        if let Some(joints) = joints {
            let (most, own_acceleration, own_jerk) = self.axis_limits(motion, joints, length);
            speed = speed.min(most);
            acceleration = acceleration.or(own_acceleration);
            jerk = jerk.or(own_jerk);
        }
        Some(FeedMotion {
            length,
            speed,
            tangents: find_tangents(motion),
            acceleration,
            jerk,
            is_from_rest: self.is_resting,
        })
    }

    /// Returns the speed, acceleration and jerk along the path that no axis forbids.
    fn axis_limits(
        &self,
        motion: &Motion,
        joints: &JointMotion<'_>,
        length: f64,
    ) -> (f64, Option<f64>, Option<f64>) {
        if matches!(motion.path, MotionPath::Line) {
            let least = joints.axis_demand(self.dynamics.interpolation).least_s;
            let speed = if least > 0.0 { length / least } else { f64::INFINITY };
            let needed = self.dynamics.acceleration.is_none() || self.dynamics.jerk.is_none();
            let (acceleration, jerk) = if needed { joints.path_dynamics() } else { (None, None) };
            return (speed, acceleration, jerk);
        }
        // A curve goes in every direction, so the slowest axis counts.
        let least = |value: &dyn Fn(&MachineAxis) -> Option<f64>| {
            joints.chain.linear_axes().filter_map(value).reduce(f64::min)
        };
        let speed = least(&|axis| Some(axis.max_speed / 60.0)).unwrap_or(f64::INFINITY);
        (speed, least(&|axis| Some(axis.acceleration)), least(&|axis| axis.jerk))
    }

    fn finish_time(mut self) -> ProgramTime {
        if let Some(last) = self.waits.last() {
            let stood = self.time.dwell;
            self.add_waits(last.statement);
            if let Some(standing) = self.time.standing.last_mut() {
                *standing += self.time.dwell - stood;
            }
        }
        let Self { feed_motions, places, dynamics, time, .. } = &mut self;
        let standing = time.feed.feed;
        let mut parts = time_feed_motions(feed_motions, dynamics.corner_constant, |index, seconds| {
            let slot = places.get(index).and_then(|place| time.motions.get_mut(*place));
            if let Some(Some(sum)) = slot {
                *sum += seconds;
            }
        });
        parts.feed += standing;
        time.feed = parts;
        self.time
    }
}

/// Returns the unit tangents at the start and the end of a motion.
fn find_tangents(motion: &Motion) -> [Vector3<f64>; 2] {
    match &motion.path {
        MotionPath::Arc(arc) => [arc.tangent_at(0.0), arc.tangent_at(1.0)],
        MotionPath::Spline(spline) => [spline.start_tangent(), spline.end_tangent()],
        _ => [(motion.to.point - motion.from.point).try_normalize(0.0).unwrap_or_default(); 2],
    }
}

/// Returns the time of revolutions in s; 0 where the spindle speed is not known.
fn time_of_turns_s(turns: f64, rpm: Option<f64>) -> f64 {
    rpm.map_or(0.0, |rpm| 60.0 * turns / rpm)
}

fn keeps_tool(one: Option<&Arc<ActiveTool>>, other: Option<&Arc<ActiveTool>>) -> bool {
    match (one, other) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b) || (a.number, &a.name) == (b.number, &b.name),
        (None, None) => true,
        _ => false,
    }
}
