//! This module takes the poses of a program to the machine.

use super::branch_choice::{BranchChoice, ChosenPose};
use super::joint_motion::JointMotion;
use super::kinematic_chain::KinematicChain;
use crate::engagement::PathLinearizer;
use crate::program::{LengthUnit, Program, StatementId};
use nalgebra::{Point3, Vector3};

/// The end of a motion of a program, and the values of the axes there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProgramPose {
    /// The statement that ends the motion.
    pub statement: StatementId,
    /// The tip in the workpiece frame in mm: the frame of the program's first motion.
    pub tip: Point3<f64>,
    /// The tool axis there.
    pub axis: Vector3<f64>,
    /// The values; `None` where the machine cannot give the tool this direction.
    pub chosen: Option<ChosenPose>,
}

/// Returns the end of each motion of a program, in their order, with the values of all axes on the best way of the
/// whole program; see [`BranchChoice`].
pub fn solve_program_poses(program: &Program, chain: &KinematicChain, units: LengthUnit) -> Vec<ProgramPose> {
    let mut frames = PathLinearizer::new(units.mm_per_unit(), 1.0, f64::INFINITY);
    let mut choice = BranchChoice::new(chain);
    let mut poses = Vec::new();
    for motion in program.motions() {
        frames.adopt_workpiece_frame(&motion);
        let pose = frames.place_pose(&motion, motion.to);
        choice.add_pose(pose.point, &pose.axis);
        let statement = motion.last_statement();
        poses.push(ProgramPose { statement, tip: pose.point, axis: pose.axis, chosen: None });
    }
    for (pose, chosen) in poses.iter_mut().zip(choice.finish_choice()) {
        pose.chosen = chosen;
    }
    poses
}

impl ProgramPose {
    /// Returns the motion from the pose before to this one, if the machine reaches both.
    pub fn motion_from<'c>(&self, before: &Self, chain: &'c KinematicChain) -> Option<JointMotion<'c>> {
        let (from, to) = (before.chosen?.joints, self.chosen?.joints);
        Some(JointMotion { chain, from, to, tips: [before.tip, self.tip] })
    }
}
