//! This module checks points: repeated ones, distant ones, none at all, and a last one in the material.

use super::{Lint, LintFindings};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::MotionClass;
use crate::program::geometry::MotionPath;
use crate::program::motion::{ActiveTool, Motion};
use crate::program::{Record, Statement, StatementId};
use std::sync::Arc;

/// A hundred metres in mm.
pub(super) const FAR: f64 = 1e5;

/// Reports repeated and distant points, and files without any.
#[derive(Default)]
pub(super) struct PointLint {
    moved: bool,
    /// The tool of the motion before.
    tool: Option<Arc<ActiveTool>>,
}

impl Lint for PointLint {
    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        self.moved = true;
        let point = motion.to.point;
        let far = found.mm_to_file_unit(FAR);
        if let Some(axis) = point.iter().position(|value| value.abs() > far) {
            let at = motion.last_statement();
            let span = match found.program.statement(at).record() {
                Record::Goto(_) | Record::From(_) | Record::Control(_) => {
                    found.numbers_span(at, axis..axis + 1)
                }
                _ => found.statement_span(at),
            };
            let value = point.iter().nth(axis).copied().unwrap_or_default();
            let message = format!("this coordinate is {} away", found.format_length(value.abs()));
            found.report(codes::FAR_AWAY, span, message, "");
        }
        // Behind a tool change the machine comes from elsewhere, whatever the file prints.
        let same = |a: &ActiveTool, b: &ActiveTool| a.number == b.number && a.name == b.name;
        let changed = match (&self.tool, &motion.tool) {
            (Some(before), Some(tool)) => !Arc::ptr_eq(before, tool) && !same(before, tool),
            (before, tool) => before.is_some() != tool.is_some(),
        };
        self.tool.clone_from(&motion.tool);
        let stays = !changed
            && matches!(motion.path, MotionPath::Line)
            && motion.from == motion.to
            && motion.hole.is_none();
        if stays {
            let span = found.end_point_span(motion);
            found.report(
                codes::REPEATED_POINT,
                span,
                "the tool is here already",
                "the same point and axis as before",
            );
        }
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        if !self.moved {
            found.push(Diagnostic::new(codes::NO_MOTION, "nothing moves in this program"));
        }
    }
}

/// Reports tools that are left in a cut. Only marked motions count, because without marks a retract looks
/// like a cut.
#[derive(Default)]
pub(super) struct LeftInCutLint {
    cut: Option<StatementId>,
    tool: Option<u32>,
}

impl LeftInCutLint {
    fn report_left_in_cut(&mut self, before: &str, found: &mut LintFindings<'_>) {
        if let Some(at) = self.cut.take() {
            let message = format!("the tool is left in the cut {before}");
            found.report(codes::LEFT_IN_CUT, found.statement_span(at), message, "the last motion is a cut");
        }
    }
}

impl Lint for LeftInCutLint {
    fn check_statement(&mut self, _id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        if let Record::ToolCall(call) = statement.record()
            && call.loads
        {
            if self.tool.is_some_and(|tool| tool != call.number) {
                self.report_left_in_cut("before the tool change", found);
            }
            self.tool = Some(call.number);
        }
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        let cut = motion.class_is_stated && motion.class == MotionClass::Cut && !found.facts.wire;
        self.cut = cut.then(|| motion.last_statement());
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        self.report_left_in_cut("at the end of the program", found);
    }
}
