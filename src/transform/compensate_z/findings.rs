//! This module words the findings of the step.

use super::lead_conflict::LeadConflict;
use super::pass_profile::PassFault;
use super::pass_writer::{UnwritableMotion, WriteFault};
use super::vertical_passes::NoPassReason;
use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::transform::StepContext;

/// A program and its motions, to which findings refer.
#[derive(Clone, Copy)]
pub(super) struct MotionFindings<'a> {
    pub program: &'a Program,
    pub motions: &'a [Motion],
}

impl MotionFindings<'_> {
    /// Builds a finding at the statement that ends a motion, and at the step.
    pub(super) fn build_finding(
        &self,
        code: DiagnosticCode,
        message: String,
        motion: usize,
        label: &str,
        context: &StepContext<'_>,
    ) -> Diagnostic {
        let mut finding = Diagnostic::new(code, message);
        match self.motions.get(motion) {
            Some(motion) => {
                let statement = self.program.statement(motion.last_statement());
                finding = finding.with_label(self.program.source(), statement.origin(), label);
            }
            None => debug_assert!(false, "motion {motion} of {} does not exist", self.motions.len()),
        }
        context.label_step(finding, "by this step")
    }

    /// Builds the failure that stops the step at a motion.
    pub(super) fn build_failure(
        &self,
        message: String,
        motion: usize,
        label: &str,
        context: &StepContext<'_>,
    ) -> Failure {
        self.build_finding(codes::STEP_FAILED, message, motion, label, context).into()
    }

    pub(super) fn describe_no_pass(&self, why: NoPassReason, context: &StepContext<'_>) -> Failure {
        match why {
            NoPassReason::LeavesPlane(motion) => {
                let help = "Name the finishing passes by `where`, or compensate `against: { mesh: ... }` or `normals`, which need no planes.";
                let message = "the path does not consist of passes in vertical planes: here it leaves the plane of its pass";
                self.build_finding(
                    codes::STEP_FAILED,
                    message.to_owned(),
                    motion,
                    "leaves the plane",
                    context,
                )
                .with_help(help)
                .into()
            }
            NoPassReason::TurnsBack(motion) => {
                let help = "A pass runs in one direction. Put a link or a retract between two passes in one plane, or compensate `against: { mesh: ... }`.";
                let message = "the path turns back in the plane of its pass: from here it runs over the same profile again";
                self.build_finding(codes::STEP_FAILED, message.to_owned(), motion, "goes back", context)
                    .with_help(help)
                    .into()
            }
            NoPassReason::AxisTurns(motion) => {
                let help = "Compensate a path with a turning axis `against: normals`.";
                let message = "the tool axis turns within a pass, so no plane holds the pass and the axis";
                self.build_finding(codes::STEP_FAILED, message.to_owned(), motion, "turns the axis", context)
                    .with_help(help)
                    .into()
            }
        }
    }

    pub(super) fn describe_lead_conflict(&self, why: LeadConflict, context: &StepContext<'_>) -> Failure {
        let (motion, message, help) = match why {
            LeadConflict::Rapid(motion) => (
                motion,
                "a pass begins where this rapid ends, and compensation would move that point",
                "Go down to the pass at feed, straight along the tool axis. Or mark cuts and leads (PAINT/COLOR), so that a lead is not taken for a cut.",
            ),
            LeadConflict::Excluded(motion) => (
                motion,
                "this cut continues a pass or leads into one, but `where` leaves it out, so their common point cannot move",
                "Let `where` select both motions, or neither of them.",
            ),
            LeadConflict::Fixed(motion) => (
                motion,
                "a pass begins at this point, which its operation cannot move (it is another operation's last point, or a FROM)",
                "Add a motion to the operation that goes to the start of its pass.",
            ),
        };
        self.build_finding(codes::STEP_FAILED, message.to_owned(), motion, "here", context)
            .with_help(help)
            .into()
    }

    pub(super) fn describe_pass_fault(
        &self,
        why: &PassFault,
        motion: usize,
        context: &StepContext<'_>,
    ) -> Failure {
        match why {
            PassFault::Pass(why) => self.describe_no_pass(*why, context),
            PassFault::Geometry(why) => self.build_failure(
                format!("this pass cannot be compensated: {why}"),
                motion,
                "the pass",
                context,
            ),
        }
    }

    /// Words the reason why a motion could not be written. A failure of the editor stays as it is.
    pub(super) fn describe_write_fault(
        &self,
        fault: WriteFault,
        motion: usize,
        context: &StepContext<'_>,
    ) -> Failure {
        match fault {
            WriteFault::Unwritable(why) => self.describe_unwritable_motion(why, motion, context),
            WriteFault::Failed(failure) => failure,
        }
    }

    pub(super) fn describe_unwritable_motion(
        &self,
        why: UnwritableMotion,
        motion: usize,
        context: &StepContext<'_>,
    ) -> Failure {
        self.build_failure(
            format!("this motion cannot be given another end: {why}"),
            motion,
            "would have to move",
            context,
        )
    }
}
