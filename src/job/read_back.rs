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
    let mut before: &[u8] = b"\n";
    let mut head = Vec::with_capacity(2 * parse::HEAD_LENGTH);
    let mut length = 0;
    for statement in program.statements() {
        let text = program.statement_text(statement);
        if !is_border(before, text) || !reads_back(program, statement, points) {
            return ReadBack::Unknown;
        }
        points = matches!(statement.record(), Record::Goto(_) | Record::Points(_));
        before = if *statement.record() == Record::ByteOrderMark { b"\n" } else { text };
        if head.len() < parse::HEAD_LENGTH {
            head.extend_from_slice(text.get(..parse::HEAD_LENGTH).unwrap_or(text));
        }
        length += text.len();
    }
    // A file that became too large is told as one, and so is one whose first lines are those of another kind of file.
    match u32::try_from(length).is_ok() && is_head_alike(program, &head) {
        true => ReadBack::Proven,
        false => ReadBack::Unknown,
    }
}

/// Returns whether a statement ends where the next one begins. A CR and the LF of an empty line would be one line end.
fn is_border(before: &[u8], text: &[u8]) -> bool {
    before.ends_with(b"\n") || (before.ends_with(b"\r") && !text.starts_with(b"\n"))
}

/// Returns whether a file that begins so is read statement by statement, with a byte order mark if the program has one.
fn is_head_alike(program: &Program, head: &[u8]) -> bool {
    let first = program.statements().first().map(Statement::record);
    let marked = first == Some(&Record::ByteOrderMark);
    head.starts_with(parse::BYTE_ORDER_MARK) == marked && parse::may_be_cl_data(head)
}

/// Returns whether a statement reads as its record. `points` says that a point stands before it.
fn reads_back(program: &Program, statement: &Statement, points: bool) -> bool {
    match (statement.change(), statement.record()) {
        (StatementChange::Inserted(_) | StatementChange::Deleted(_), _) => false,
        // A file with definitions may be a part program; only the whole of it tells.
        (_, Record::Definition) => false,
        // What had no meaning may get one from the statements before it, as a line of bare numbers does behind a point.
        (_, Record::Unparsed) => false,
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
