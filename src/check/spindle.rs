//! This module reports cuts without spindle or coolant.

use super::findings::coolant_switch;
use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::program::motion::Motion;
use crate::program::{Record, Statement, StatementId};

pub(super) const CODES: &[DiagnosticCode] =
    &[codes::CUT_WITHOUT_SPINDLE, codes::NO_SPINDLE, codes::ZERO_SPEED, codes::SPINDLE_NOT_RESTARTED];

/// Reports cuts while the spindle does not turn.
#[derive(Default)]
pub(super) struct SpindleLint {
    /// The last SPINDL/OFF, while it is in force.
    off: Option<StatementId>,
    /// Whether the stop in force was reported.
    reported: bool,
    tool: Option<u32>,
    /// A tool change without a SPINDL after it yet.
    changed: Option<StatementId>,
}

impl Lint for SpindleLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::Spindle(spindle) => {
                self.off = (!spindle.on).then_some(id);
                self.reported = false;
                self.changed = None;
                if spindle.on && spindle.speed == Some(0.0) {
                    let span = found.numbers_span(id, 0..1);
                    found.report(codes::ZERO_SPEED, span, "the spindle is started with speed 0", "");
                }
            }
            Record::ToolCall(call) if call.loads => {
                if self.tool.is_some_and(|tool| tool != call.number) {
                    self.changed = Some(id);
                }
                self.tool = Some(call.number);
            }
            _ => {}
        }
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        let turns = motion.spindle.as_ref().is_some_and(|spindle| spindle.on);
        if turns && self.changed.is_none()
            || self.reported
            || found.facts.wire
            || !found.is_cutting_motion(motion)
        {
            return;
        }
        let span = found.end_point_span(motion);
        if let (true, Some(changed)) = (turns, self.changed.take()) {
            let message = "the tool was changed, and no SPINDL comes before this cut";
            let change = (found.numbers_span(changed, 0..1), "the tool change");
            return found.report_at_two_spans(
                codes::SPINDLE_NOT_RESTARTED,
                message,
                (span, "the first cut after it"),
                change,
            );
        }
        self.reported = true;
        let message = "the spindle does not turn at this feed motion";
        match self.off {
            _ if !found.facts.spindle => {
                found.report(
                    codes::NO_SPINDLE,
                    span,
                    "the program cuts, but never starts a spindle",
                    "the first cut",
                );
            }
            None => found.report(codes::CUT_WITHOUT_SPINDLE, span, message, "it is started later"),
            Some(off) => {
                let off = (found.statement_span(off), "switched off here");
                found.report_at_two_spans(
                    codes::CUT_WITHOUT_SPINDLE,
                    message,
                    (span, "the first cut after it"),
                    off,
                );
            }
        }
    }
}

/// Reports cuts without the coolant that the file uses elsewhere.
#[derive(Default)]
pub(super) struct CoolantLint {
    on: bool,
    reported: bool,
}

impl Lint for CoolantLint {
    fn check_statement(&mut self, _id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        if let Record::Known = statement.record()
            && let Some(on) = coolant_switch(found.program.statement_text(statement))
        {
            self.reported &= self.on == on;
            self.on = on;
        }
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if self.on || self.reported || !found.facts.coolant || !found.is_cutting_motion(motion) {
            return;
        }
        self.reported = true;
        let span = found.end_point_span(motion);
        found.report(
            codes::NO_COOLANT,
            span,
            "coolant is off at this cut, but used elsewhere",
            "the first such cut",
        );
    }
}
