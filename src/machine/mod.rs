//! This module is the machine: its axes, where they stand at every pose of a program, and the time that they take.
//!
//! A machine is a chain of axes from the workpiece to the frame and from the frame to the tool ([`KinematicChain`]).
//! [`BranchChoice`] finds the values of all axes over a program: in closed form, with the shortest way of the rotary
//! axes. [`JointMotion`] says what a motion asks of the axes and how far the tip leaves its line without control.
//! [`ProgramPath`] is the path that the machine makes of a program, which simulations follow. [`time_program`] is the time of a program with acceleration, jerk, corners and the rapids of each axis.
//!
//! With all joints at 0, the workpiece frame and the frame of the machine are the same, and the tip stands at the zero
//! of the workpiece. Lengths are in mm, angles in degrees, speeds per minute, accelerations per s2.

mod axis_time;
mod branch_choice;
mod joint_motion;
mod joint_values;
mod kinematic_chain;
mod machine_axis;
mod machine_findings;
mod machine_waits;
mod motion_faults;
mod path_time;
mod program_path;
mod program_poses;
mod program_time;
mod rotary_geometry;
mod timing_fit;

pub use axis_time::rest_to_rest_s;
pub use branch_choice::{BranchChoice, ChosenPose};
pub use joint_motion::{AxisDemand, AxisInterpolation, JointMotion};
pub use joint_values::JointValues;
pub use kinematic_chain::{ChainFault, KinematicChain};
pub use machine_axis::{AxisKind, AxisMount, MachineAxis};
pub use machine_findings::find_machine_findings;
pub use motion_faults::{FaultSearch, MotionFault, MotionFaultKind};
pub use path_time::{FeedMotion, FeedTimeParts, time_feed_motions};
pub use program_path::{MachineDeviation, ProgramPath};
pub use program_poses::{ProgramPose, solve_program_poses};
pub use program_time::{MachineDynamics, ProgramTime, time_program};
pub use rotary_geometry::{POLE_ANGLE_DEG, RotarySolution, RotarySolutions};
pub use timing_fit::{
    FittedTiming, TimedCorner, TimedStroke, fit_axis_rapid, fit_corner_constant, fit_path_acceleration,
};
