//! Points: repeated ones, ones far away, none at all, and a last one in the material.

use super::{Findings, Lint};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::class::MotionClass;
use crate::program::geometry::Path;
use crate::program::motion::Motion;
use crate::program::{Record, Statement};

/// Millimetres: a hundred metres.
const FAR: f64 = 1e5;

/// Repeated and distant points, and files without any.
#[derive(Default)]
pub(super) struct Points {
    moved: bool,
}

impl Lint for Points {
    fn motion(&mut self, motion: &Motion, found: &mut Findings<'_>) {
        self.moved = true;
        let point = motion.to.point;
        let far = found.millimetres(FAR);
        if let Some(axis) = point.iter().position(|value| value.abs() > far) {
            let at = motion.last_statement();
            let span = match found.program.statement(at).map(|statement| statement.record()) {
                Some(Record::Goto(_) | Record::From(_) | Record::Control(_)) => {
                    found.numbers(at, axis..axis + 1)
                }
                _ => found.whole(at),
            };
            let value = point.iter().nth(axis).copied().unwrap_or_default();
            let message = format!("this coordinate is {} away", found.length(value.abs()));
            found.report(codes::FAR_AWAY, span, message, "");
        }
        let stays = matches!(motion.path, Path::Line) && motion.from == motion.to && motion.hole.is_none();
        if stays {
            let span = found.end_point(motion);
            found.report(
                codes::REPEATED_POINT,
                span,
                "the tool is here already",
                "the same point and axis as before",
            );
        }
    }

    fn finish(&mut self, found: &mut Findings<'_>) {
        if !self.moved {
            found.push(Diagnostic::new(codes::NO_MOTION, "nothing moves in this program"));
        }
    }
}

/// Tools that are left in a cut. Only marked motions count: without marks a retract cannot be told from a cut.
#[derive(Default)]
pub(super) struct LeftInCut {
    cut: Option<usize>,
    tool: Option<u32>,
}

impl LeftInCut {
    fn end(&mut self, before: &str, found: &mut Findings<'_>) {
        if let Some(at) = self.cut.take() {
            let message = format!("the tool is left in the cut {before}");
            found.report(codes::LEFT_IN_CUT, found.whole(at), message, "the last motion is a cut");
        }
    }
}

impl Lint for LeftInCut {
    fn statement(&mut self, _index: usize, statement: &Statement, found: &mut Findings<'_>) {
        if let Record::ToolCall(call) = statement.record()
            && call.loads
        {
            if self.tool.is_some_and(|tool| tool != call.number) {
                self.end("before the tool change", found);
            }
            self.tool = Some(call.number);
        }
    }

    fn motion(&mut self, motion: &Motion, found: &mut Findings<'_>) {
        let cut = motion.class_is_told && motion.class == MotionClass::Cut && !found.facts.wire;
        self.cut = cut.then(|| motion.last_statement());
    }

    fn finish(&mut self, found: &mut Findings<'_>) {
        self.end("at the end of the program", found);
    }
}
