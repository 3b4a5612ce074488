//! Where a statement may be put in front of a motion.

use crate::program::motion::Motion;
use crate::program::{Program, Record, StatementId, StatementRange};

/// Finds the statement that stands in front of each motion. Motions are asked for in their order.
#[derive(Debug)]
pub struct MotionInsertion<'p> {
    program: &'p Program,
    found: Option<StatementRange>,
}

impl<'p> MotionInsertion<'p> {
    /// For the motions of a program.
    pub fn new(program: &'p Program) -> Self {
        Self { program, found: None }
    }

    /// Returns the statements of the next motion, or of several that cannot be parted: what shall hold for them is
    /// put in before the first, and the last is their GOTO. Points of one GOTO share what announces the first of them: a RAPID must not be
    /// parted from it, nor lines of bare numbers from their GOTO.
    pub fn find_statements(&mut self, motion: &Motion) -> StatementRange {
        let end = motion.last_statement();
        match self.found {
            Some(found) if found.last() == end || is_continuation_line(self.program, end) => found,
            _ => *self.found.insert(motion.statements),
        }
    }
}

/// Whether a statement is a line of bare numbers, which goes on with the GOTO before it.
fn is_continuation_line(program: &Program, statement: StatementId) -> bool {
    let found = program.statement(statement);
    let first = program.statement_text(found).trim_ascii_start().first();
    matches!(found.record(), Record::Points(_)) && first.is_some_and(|byte| !byte.is_ascii_alphabetic())
}
