//! Statements at which the machine stands still.

use crate::program::{Program, Record, Statement, StatementId};
use crate::transform::statement_numbers::major_word;

/// Whether the machine stands still behind a statement and up to another: STOP, OPSTOP, DELAY.
pub(in crate::transform::optimize_feed) fn has_machine_stop(
    program: &Program,
    behind: StatementId,
    until: StatementId,
) -> bool {
    let waits = |statement: &Statement| {
        matches!(statement.record(), Record::Known | Record::Other)
            && matches!(major_word(program.statement_text(statement)).as_ref(), "STOP" | "OPSTOP" | "DELAY")
    };
    let between = program.statements_between(behind.after(), until.after());
    between.iter().any(|statement| statement.is_live() && waits(statement))
}
