//! This module finds where a statement may be inserted before a motion.

use crate::program::motion::Motion;
use crate::program::{Program, Record, StatementId, StatementRange};

/// Finds the statements of each motion before which another one may be inserted. Motions have to be asked for
/// in their order.
#[derive(Debug)]
pub struct MotionInsertion<'p> {
    program: &'p Program,
    found: Option<StatementRange>,
}

impl<'p> MotionInsertion<'p> {
    /// Prepares the search for the motions of a program.
    pub fn new(program: &'p Program) -> Self {
        Self { program, found: None }
    }

    /// Returns the statements of the next motion, or of several motions that cannot be separated. A statement
    /// that governs them is inserted before the first one, and the last one is their GOTO. The points of one
    /// GOTO have in common what announces the first of them: a RAPID must not be separated from them, nor
    /// lines of bare numbers from their GOTO.
    pub fn find_statements(&mut self, motion: &Motion) -> StatementRange {
        let end = motion.last_statement();
        match self.found {
            Some(found) if found.last() == end || is_continuation_line(self.program, end) => found,
            _ => *self.found.insert(motion.statements),
        }
    }
}

/// Returns whether a statement is a line of bare numbers that continues the GOTO before it.
fn is_continuation_line(program: &Program, statement: StatementId) -> bool {
    let found = program.statement(statement);
    let first = program.statement_text(found).trim_ascii_start().first();
    matches!(found.record(), Record::Points(_)) && first.is_some_and(|byte| !byte.is_ascii_alphabetic())
}
