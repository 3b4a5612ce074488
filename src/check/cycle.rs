//! This module checks drilling cycles: left on, without holes, without depth.

use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::program::motion::Motion;
use crate::program::record::DrillingCycle;
use crate::program::{Dialect, Record, Statement, StatementId};

pub(super) const CODES: &[DiagnosticCode] = &[
    codes::CYCLE_LEFT_ON,
    codes::CYCLE_WITHOUT_HOLE,
    codes::CYCLE_WITHOUT_DEPTH,
    codes::CYCLE_CUTS_NOTHING,
    codes::CYCLE_BELOW_POINT,
];

/// Follows CYCLE through the program.
#[derive(Default)]
pub(super) struct CycleLint {
    /// The cycle in force, and whether it has drilled.
    open: Option<(StatementId, bool)>,
    tool: Option<u32>,
}

impl CycleLint {
    fn report_left_on(&mut self, what: &str, found: &mut LintFindings<'_>) {
        if let Some((at, _)) = self.open.take() {
            let message = format!("this cycle is still on at the end of {what}");
            found.report(codes::CYCLE_LEFT_ON, found.statement_span(at), message, "");
        }
    }

    fn close_cycle(&mut self, found: &mut LintFindings<'_>) {
        if let Some((at, false)) = self.open.take() {
            found.report(
                codes::CYCLE_WITHOUT_HOLE,
                found.statement_span(at),
                "this cycle drills no hole",
                "",
            );
        }
    }
}

impl Lint for CycleLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::Cycle(cycle) => {
                self.close_cycle(found);
                self.open = Some((id, false));
                check_cycle(id, cycle, found);
            }
            Record::CycleOff => self.close_cycle(found),
            Record::OperationStart(_) | Record::OperationEnd => self.report_left_on("the operation", found),
            Record::ProgramEnd => self.report_left_on("the program", found),
            Record::ToolCall(call) if call.loads => {
                if self.tool.is_some_and(|tool| tool != call.number) {
                    self.report_left_on("the tool's work", found);
                }
                self.tool = Some(call.number);
            }
            _ => {}
        }
    }

    fn check_motion(&mut self, motion: &Motion, _found: &mut LintFindings<'_>) {
        if let (Some((_, drilled)), true) = (&mut self.open, motion.hole.is_some()) {
            *drilled = true;
        }
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        self.report_left_on("the program", found);
    }
}

fn check_cycle(id: StatementId, cycle: &DrillingCycle, found: &mut LintFindings<'_>) {
    let coordinate = cycle.depth_is_fedto && found.program.dialect() == Dialect::Nx;
    match cycle.depth {
        None => {
            found.report(codes::CYCLE_WITHOUT_DEPTH, found.statement_span(id), "this cycle has no depth", "")
        }
        Some(depth) if depth == 0.0 || coordinate && depth > 0.0 => {
            let span = number_span(id, depth, found);
            found.report(codes::CYCLE_CUTS_NOTHING, span, "this cycle does not go below its points", "");
        }
        Some(_) => {}
    }
    if let Some(clearance) = cycle.clearance.filter(|clearance| *clearance < 0.0) {
        let message =
            format!("the rapid of this cycle ends {} below its points", found.format_length(-clearance));
        let span = number_span(id, clearance, found);
        found.report(codes::CYCLE_BELOW_POINT, span, message, "");
    }
}

/// Returns the place of the first number of the cycle with a value. Only the reader of the record knows which
/// word governs it.
fn number_span(id: StatementId, value: f64, found: &LintFindings<'_>) -> crate::source::Span {
    let numbers = found.statement_syntax(id).numbers();
    match numbers.iter().find(|(_, found)| *found == value) {
        Some((at, _)) => found.text_span(id, at),
        None => found.statement_span(id),
    }
}
