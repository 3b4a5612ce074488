//! This module proves a corrected program without reading all of it again: it looks at the statements that a step
//! has changed, and at the state that flows from them.
//!
//! The grammar reads a statement from its own lines alone. So statements that read back one by one are what a whole
//! reading gives, unless one of them depends on its neighbours. Where that may be, the whole text decides.

use crate::parse;
use crate::program::{Program, Record, Statement, StatementChange};

/// How a program reads back, as far as its changed statements tell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ReadBack {
    /// Every statement reads as what the steps made of it.
    Proven,
    /// The whole text has to be read.
    Unknown,
}

/// Reads the changed statements of a program, each from its own text.
///
/// Statements that were put in or taken out change their neighbours, and a finding near them has no place of its own in
/// the original: then the whole text decides.
pub(super) fn read_changed_statements(program: &Program) -> ReadBack {
    // A shop's own words are given their meanings after all else was read.
    if !program.vocabulary().is_empty() {
        return ReadBack::Unknown;
    }
    let mut points = false;
    let mut closed = true;
    let mut length = 0;
    for statement in program.statements() {
        if !closed || !reads_back(program, statement, points) {
            return ReadBack::Unknown;
        }
        let text = program.statement_text(statement);
        points = matches!(statement.record(), Record::Goto(_) | Record::Points(_));
        closed =
            text.ends_with(b"\n") || text.ends_with(b"\r") || *statement.record() == Record::ByteOrderMark;
        length += text.len();
    }
    // A file that became too large is told as one.
    if u32::try_from(length).is_ok() { ReadBack::Proven } else { ReadBack::Unknown }
}

/// Returns whether a statement reads as its record. `points` says that a point stands before it.
fn reads_back(program: &Program, statement: &Statement, points: bool) -> bool {
    match (statement.change(), statement.record()) {
        (StatementChange::Inserted(_) | StatementChange::Deleted(_), _) => false,
        // A file with definitions may be a part program; only the whole of it tells.
        (_, Record::Definition) => false,
        // A line of bare numbers is one only behind a point.
        (_, Record::Points(_)) if !points && starts_with_number(program.statement_text(statement)) => false,
        (StatementChange::Untouched, _) => true,
        (StatementChange::Edited(_), record) => {
            let text = program.statement_text(statement);
            parse::read_whole_record(text, program.vocabulary()).is_ok_and(|read| read == *record)
        }
    }
}

fn starts_with_number(text: &[u8]) -> bool {
    text.trim_ascii_start().first().is_some_and(|first| first.is_ascii_digit() || b".-+".contains(first))
}
