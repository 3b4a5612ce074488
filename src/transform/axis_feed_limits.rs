//! This module finds the feeds that the axes of a machine follow, for steps that keep to them.

use super::StepContext;
use crate::diagnostic::{Failure, codes};
use crate::machine::{ProgramPose, solve_program_poses};
use crate::program::geometry::MotionPath;
use crate::program::{Program, StatementId};
use std::collections::BTreeMap;

/// Returns the highest feed in mm/min that the axes of the setup's machine follow on each straight motion, by the statement
/// that ends it. Of several motions with one statement the slowest counts.
///
/// # Errors
/// Returns [`codes::MACHINE_WITHOUT_AXES`] at the key `axes` of the step if the setup has no axes.
pub(super) fn list_axis_feed_limits(
    program: &Program,
    context: &StepContext<'_>,
) -> Result<BTreeMap<StatementId, f64>, Failure> {
    let machine = &context.setup.machine;
    let Some(chain) = &machine.chain else {
        let message = "`axes` asks for the axes of a machine, and the setup has none; add them under `machine:`, or name a \
                       file: `machine: { file: cradle.yaml }`";
        let found = context.step_finding(codes::MACHINE_WITHOUT_AXES, message, &["axes"], "asked for here");
        return Err(found.into());
    };
    let poses = solve_program_poses(program, chain, context.file_length_unit(program));
    let mut limits = BTreeMap::new();
    let mut before: Option<&ProgramPose> = None;
    for (motion, pose) in program.motions().zip(&poses) {
        let joints = before.and_then(|before| pose.motion_from(before, chain));
        before = Some(pose);
        let Some(joints) = joints.filter(|_| !motion.rapid && motion.path == MotionPath::Line) else {
            continue;
        };
        let (least, length) = (joints.axis_demand(machine.interpolation()).least_s, joints.tip_length_mm());
        if least > 0.0 && length > 0.0 {
            let most = 60.0 * length / least;
            let slot = limits.entry(pose.statement).or_insert(most);
            *slot = slot.min(most);
        }
    }
    Ok(limits)
}
