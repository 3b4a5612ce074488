//! Where a statement may be put in front of a motion.

use crate::program::motion::Motion;
use crate::program::{Program, Record, Statement};

/// Finds the statement that stands in front of each motion. Motions are asked for in their order.
#[derive(Debug)]
pub struct MotionInsertion<'p> {
    program: &'p Program,
    found: Option<MotionStatements>,
}

/// The statements of a motion, or of several that cannot be parted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MotionStatements {
    /// The first; what shall hold for the motion is put in before it.
    pub first: usize,
    /// The last: the GOTO, also of points in lines of bare numbers that go on with it.
    pub last: usize,
}

impl<'p> MotionInsertion<'p> {
    /// For the motions of a program.
    pub fn new(program: &'p Program) -> Self {
        Self { program, found: None }
    }

    /// The statements of the next motion. Points of one GOTO share what announces the first of them: a RAPID must not be
    /// parted from it, nor lines of bare numbers from their GOTO.
    pub fn find_statements(&mut self, motion: &Motion) -> MotionStatements {
        let end = motion.last_statement();
        match self.found {
            Some(found) if found.last == end || is_continuation_line(self.program, end) => found,
            _ => *self.found.insert(MotionStatements { first: motion.statements.start, last: end }),
        }
    }
}

/// Whether a statement is a line of bare numbers, which goes on with the GOTO before it.
fn is_continuation_line(program: &Program, statement: usize) -> bool {
    let points = |found: &&Statement| matches!(found.record(), Record::Points(_));
    let first = program
        .statement(statement)
        .filter(points)
        .and_then(|found| program.statement_text(found).trim_ascii_start().first());
    first.is_some_and(|byte| !byte.is_ascii_alphabetic())
}
