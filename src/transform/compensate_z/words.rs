//! What the step says.

use super::leads::Stuck;
use super::passes::NoPass;
use super::profile::Fault;
use super::write::Unwritable;
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::program::motion::Motion;
use crate::program::{Program, Statement};
use crate::transform::Context;

/// A program and its motions.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub program: &'a Program,
    pub motions: &'a [Motion],
}

impl Place<'_> {
    /// A finding at the statement that ends a motion, and at the step.
    pub fn finding(
        &self,
        code: Code,
        message: String,
        motion: usize,
        label: &str,
        context: &Context<'_>,
    ) -> Diagnostic {
        let statement = self.motions.get(motion).map(Motion::last_statement);
        let span = statement
            .and_then(|index| self.program.statement(index))
            .map(Statement::origin)
            .unwrap_or_default();
        let step = context.recipe.step_place(usize::from(context.step.0));
        Diagnostic::new(code, message).label(self.program.source(), span, label).label(
            &context.recipe.source,
            step,
            "by this step",
        )
    }

    /// Why the step cannot go on, at a motion.
    pub fn fail(
        &self,
        message: String,
        motion: usize,
        label: &str,
        context: &Context<'_>,
    ) -> Box<Diagnostic> {
        Box::new(self.finding(codes::STEP_FAILED, message, motion, label, context))
    }

    pub fn no_pass(&self, why: NoPass, context: &Context<'_>) -> Box<Diagnostic> {
        match why {
            NoPass::LeavesPlane(motion) => {
                let help = "Name the finishing passes by `where`, or compensate `against: { mesh: ... }` or `normals`, which need no planes.";
                let message =
                    "the path is not made of passes in vertical planes: here it leaves the plane of its pass";
                Box::new(
                    self.finding(codes::STEP_FAILED, message.to_owned(), motion, "leaves the plane", context)
                        .help(help),
                )
            }
            NoPass::TurnsBack(motion) => {
                let help = "A pass goes one way. Put a link or a retract between two passes in one plane, or compensate `against: { mesh: ... }`.";
                let message =
                    "the path turns back in the plane of its pass: here it goes over what it has been over";
                Box::new(
                    self.finding(codes::STEP_FAILED, message.to_owned(), motion, "goes back", context)
                        .help(help),
                )
            }
            NoPass::AxisTurns(motion) => {
                let help = "With a turning axis, compensate `against: normals`.";
                let message = "the tool axis turns within a pass, so the pass has no plane along it";
                Box::new(
                    self.finding(codes::STEP_FAILED, message.to_owned(), motion, "turns the axis", context)
                        .help(help),
                )
            }
        }
    }

    pub fn stuck(&self, why: Stuck, context: &Context<'_>) -> Box<Diagnostic> {
        let (motion, message, help) = match why {
            Stuck::Rapid(motion) => (
                motion,
                "a pass begins where this rapid ends, and the rapid would have to end elsewhere",
                "Go down to the pass at feed, straight along the tool axis; or mark cuts and leads (PAINT/COLOR), so that a lead is not taken for a cut.",
            ),
            Stuck::Excluded(motion) => (
                motion,
                "a pass goes on from or into this cut, which `where` leaves out, so their common point cannot move",
                "Select both, or neither.",
            ),
            Stuck::Fixed(motion) => (
                motion,
                "a pass begins here, at a place that its operation cannot move (another operation's last point, or FROM)",
                "Let the operation go to the start of its pass by a motion of its own.",
            ),
        };
        Box::new(self.finding(codes::STEP_FAILED, message.to_owned(), motion, "here", context).help(help))
    }

    pub fn fault(&self, why: &Fault, motion: usize, context: &Context<'_>) -> Box<Diagnostic> {
        match why {
            Fault::Pass(why) => self.no_pass(*why, context),
            Fault::Geometry(why) => {
                self.fail(format!("this pass cannot be compensated: {why}"), motion, "the pass", context)
            }
        }
    }

    pub fn unwritable(&self, why: Unwritable, motion: usize, context: &Context<'_>) -> Box<Diagnostic> {
        self.fail(
            format!("this motion cannot be given another end: {why}"),
            motion,
            "would have to move",
            context,
        )
    }
}
