//! This module checks structure: operations that are open or empty, and the end of the program.

use super::{Lint, LintFindings};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::motion::Motion;
use crate::program::{Dialect, Record, Statement, StatementId, operation};

/// Reports operations that are not closed or do nothing, in the dialects that close them.
#[derive(Default)]
pub(super) struct OperationLint {
    open: Option<StatementId>,
    moved: bool,
}

impl OperationLint {
    fn report_left_open(&mut self, found: &mut LintFindings<'_>) {
        if let Some(at) = self.open.take() {
            let message = format!("the operation{} is not closed", quoted_operation_name(at, found));
            found.report(codes::OPERATION_OPEN, found.statement_span(at), message, "starts here");
        }
    }
}

impl Lint for OperationLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        if !closes_operations(found.program.dialect()) {
            return;
        }
        match statement.record() {
            Record::OperationStart(_) => {
                self.report_left_open(found);
                (self.open, self.moved) = (Some(id), false);
            }
            Record::OperationEnd => {
                if let Some(at) = self.open.take().filter(|_| !self.moved) {
                    let message =
                        format!("nothing moves in the operation{}", quoted_operation_name(at, found));
                    found.report(codes::EMPTY_OPERATION, found.statement_span(at), message, "");
                }
            }
            _ => {}
        }
    }

    fn check_motion(&mut self, _motion: &Motion, _found: &mut LintFindings<'_>) {
        self.moved = true;
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        self.report_left_open(found);
    }
}

fn quoted_operation_name(at: StatementId, found: &LintFindings<'_>) -> String {
    let name = operation::operation_name(found.program, found.program.statement(at));
    name.filter(|name| !name.is_empty()).map(|name| format!(" `{name}`")).unwrap_or_default()
}

/// Returns whether the dialect closes operations. CATIA only marks their end in the language of the PC.
fn closes_operations(dialect: Dialect) -> bool {
    matches!(dialect, Dialect::Nx | Dialect::Creo | Dialect::CreoGpost | Dialect::CamWorks)
}

/// Reports a missing FINI, and statements after it.
#[derive(Default)]
pub(super) struct ProgramEndLint {
    end: Option<StatementId>,
    /// The first statement after the end, and their number.
    after: Option<(StatementId, usize)>,
    /// The number of these that move the tool.
    motions: usize,
}

impl Lint for ProgramEndLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, _found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::ProgramEnd => {
                self.end.get_or_insert(id);
            }
            Record::Blank | Record::Comment => {}
            record if self.end.is_some() => {
                self.after.get_or_insert((id, 0)).1 += 1;
                self.motions += usize::from(record.is_motion());
            }
            _ => {}
        }
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        match (self.end, self.after) {
            (Some(end), Some((first, count))) => {
                let message = match (count, self.motions) {
                    (1, 0) => "a statement follows the end of the program".to_owned(),
                    (_, 0) => format!("{count} statements follow the end of the program"),
                    (_, motions) => {
                        format!("{count} statements follow the end of the program, {motions} of them motions")
                    }
                };
                let end = (found.statement_span(end), "the program ends here");
                found.report_at_two_spans(
                    codes::AFTER_END,
                    message,
                    (found.statement_span(first), "never read by a post"),
                    end,
                );
            }
            (None, _) if found.program.dialect().ends_with_fini() => report_missing_end(found),
            _ => {}
        }
    }
}

fn report_missing_end(found: &mut LintFindings<'_>) {
    let message = format!("{} programs end with FINI, this one does not", found.program.dialect());
    let last = found
        .program
        .live_statements()
        .rev()
        .find(|(_, statement)| !matches!(statement.record(), Record::Blank));
    match last.map(|(id, _)| id) {
        Some(last) => {
            found.report(codes::MISSING_END, found.statement_span(last), message, "the last statement")
        }
        None => found.push(Diagnostic::new(codes::MISSING_END, message)),
    }
}
