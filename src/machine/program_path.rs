//! This module holds the path on which a machine takes the tool through a program, where it is not the programmed one.
//!
//! The program says where the tip stands at its points, and which way the tool points. Between them the machine turns its
//! rotary axes evenly. With control of the tip, the tip runs evenly on its line and the tool axis goes over the cone that
//! the rotary axes make, not over the shortest way between both directions. Without, the linear axes run evenly, too, and the tip
//! leaves its line. Arcs and splines on which rotary axes turn are taken as they are programmed, for how a control
//! divides them is not known.

use super::joint_motion::{AxisInterpolation, JointMotion};
use super::joint_values::JointValues;
use super::kinematic_chain::KinematicChain;
use super::program_poses::{ProgramPose, solve_program_poses};
use crate::engagement::{MachinePath, distance_from_chord_mm};
use crate::program::geometry::{MotionPath, Pose};
use crate::program::{LengthUnit, Program, StatementId};
use nalgebra::Point3;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A motion that is nowhere further than this from the programmed one, in mm, is taken as programmed. It is half of the finest
/// tolerance with which paths are divided, and below the resolution of any axis.
const AS_PROGRAMMED_MM: f64 = 1e-4;

/// The largest step of a rotary axis in degrees on an even part of a motion.
const LARGEST_PART_DEG: f64 = 10.0;

/// The path of a machine through a program.
#[derive(Debug, Clone)]
pub struct ProgramPath {
    chain: Arc<KinematicChain>,
    interpolation: AxisInterpolation,
    /// The motions that are made in another way than they are programmed, by their numbers.
    motions: BTreeMap<usize, RotaryMotion>,
    /// The motion that is furthest from the programmed one.
    furthest: Option<MachineDeviation>,
    /// The number of arcs and splines on which rotary axes turn.
    curves: usize,
    /// The number of motions from or to a pose that the machine cannot reach.
    unreached: usize,
}

/// How far a motion is from the programmed one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MachineDeviation {
    /// The statement that ends the motion.
    pub statement: StatementId,
    /// The largest distance of the tip from its line, in mm; 0 with control of the tip.
    pub sag_mm: f64,
    /// The largest distance in mm between the tool as programmed and as it is at the same time, at the tip or 20 mm above.
    pub distance_mm: f64,
}

/// A motion on which rotary axes turn: the joints and the tips at its ends, in mm.
#[derive(Debug, Clone, Copy)]
struct RotaryMotion {
    from: JointValues,
    to: JointValues,
    tips: [Point3<f64>; 2],
}

impl ProgramPath {
    /// Finds the path of a machine through a program.
    pub fn from_program(
        program: &Program,
        chain: &Arc<KinematicChain>,
        interpolation: AxisInterpolation,
        units: LengthUnit,
    ) -> Self {
        let mut path = Self {
            chain: Arc::clone(chain),
            interpolation,
            motions: BTreeMap::new(),
            furthest: None,
            curves: 0,
            unreached: 0,
        };
        if chain.rotary_axes().next().is_none() {
            return path;
        }
        let poses = solve_program_poses(program, chain, units);
        let mut before: Option<&ProgramPose> = None;
        for (number, (motion, pose)) in program.motions().zip(&poses).enumerate() {
            if let Some(before) = before
                && motion.path != MotionPath::Start
            {
                path.add_motion(number, motion.path == MotionPath::Line, [before, pose]);
            }
            before = Some(pose);
        }
        path
    }

    fn add_motion(&mut self, number: usize, is_line: bool, [before, pose]: [&ProgramPose; 2]) {
        let chain = Arc::clone(&self.chain);
        let Some(joints) = pose.motion_from(before, &chain) else {
            self.unreached += 1;
            return;
        };
        if joints.rotary_steps().iter().all(|step| *step == 0.0) {
            return;
        }
        if !is_line {
            self.curves += 1;
            return;
        }
        let JointMotion { from, to, tips, .. } = joints;
        let turning = RotaryMotion { from, to, tips };
        let ends = [before, pose].map(|pose| Pose { point: pose.tip, axis: pose.axis });
        // A wide turn may come back to the line at every quarter.
        let looks = turning.even_parts() * 4;
        let at = |look: usize| {
            let share = look as f64 / looks as f64;
            distance_from_chord_mm(&ends[0], &ends[1], share, &self.place_motion(&turning, share))
        };
        let distance_mm = (1..looks).map(at).fold(0.0, f64::max);
        if distance_mm <= AS_PROGRAMMED_MM {
            return;
        }
        if self.furthest.is_none_or(|known| distance_mm > known.distance_mm) {
            let sag_mm = match self.interpolation {
                AxisInterpolation::JointLinear => joints.tip_sag_mm(),
                AxisInterpolation::TipControlled => 0.0,
            };
            self.furthest = Some(MachineDeviation { statement: pose.statement, sag_mm, distance_mm });
        }
        self.motions.insert(number, turning);
    }

    fn place_motion(&self, motion: &RotaryMotion, share: f64) -> Pose {
        let joints = motion.from.interpolate(&motion.to, share);
        let (tip, axis) = self.chain.locate_tool(&joints);
        let point = match self.interpolation {
            AxisInterpolation::JointLinear => tip,
            AxisInterpolation::TipControlled => motion.tips[0] + (motion.tips[1] - motion.tips[0]) * share,
        };
        Pose { point, axis }
    }

    /// Returns how the machine goes from pose to pose.
    pub fn interpolation(&self) -> AxisInterpolation {
        self.interpolation
    }

    /// Returns how many motions are made in another way than they are programmed.
    pub fn count_motions(&self) -> usize {
        self.motions.len()
    }

    /// Returns the motion that is furthest from the programmed one.
    pub fn furthest(&self) -> Option<MachineDeviation> {
        self.furthest
    }

    /// Returns the number of arcs and splines on which rotary axes turn, and of motions from or to a pose that the machine cannot
    /// reach. These are taken as they are programmed.
    pub fn count_unknown(&self) -> [usize; 2] {
        [self.curves, self.unreached]
    }
}

impl RotaryMotion {
    fn even_parts(&self) -> usize {
        let steps = [0, 1].map(|slot| {
            let [from, to] = [&self.from, &self.to].map(|joints| joints.rotaries.get(slot).copied());
            (to.unwrap_or_default() - from.unwrap_or_default()).abs()
        });
        (steps[0].max(steps[1]) / LARGEST_PART_DEG).ceil().max(1.0) as usize
    }
}

impl MachinePath for ProgramPath {
    fn even_parts(&self, number: usize) -> Option<usize> {
        self.motions.get(&number).map(RotaryMotion::even_parts)
    }

    fn pose_at(&self, number: usize, share: f64) -> Option<Pose> {
        self.motions.get(&number).map(|motion| self.place_motion(motion, share))
    }
}
