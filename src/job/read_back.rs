//! This module proves a corrected program without reading all of it again: it looks at the statements that a step
//! has changed, and at the state that flows from them.
//!
//! The grammar reads a statement from its own lines alone. So statements that read back one by one are what a whole
//! reading gives, unless one of them depends on its neighbours. Where that may be, the whole text decides.

use crate::parse;
use crate::program::{Program, Record, Statement, StatementChange, StatementField};
use crate::threads::both_ways;
use std::ops::Range;

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
    let count = program.statements().len();
    let (first, second) = both_ways(
        count >= WORTH_A_THREAD,
        || read_part(program, 0..count / 2),
        || read_part(program, count / 2..count),
    );
    // A file that became too large is told as one, and so is one whose first lines are those of another kind of file.
    match first.zip(second).map(|(first, second)| u32::try_from(first + second)) {
        Some(Ok(_)) if is_head_alike(program, &read_head(program)) => ReadBack::Proven,
        _ => ReadBack::Unknown,
    }
}

/// The number of statements from which a second thread gains more than it costs.
const WORTH_A_THREAD: usize = 20_000;

/// Reads the changed statements of a part of a program. Returns the length of its text in bytes if every statement
/// reads as its record.
fn read_part(program: &Program, part: Range<usize>) -> Option<usize> {
    let (ahead, rest) = program.statements().split_at_checked(part.start)?;
    let mut points = ahead.last().is_some_and(holds_points);
    let mut before = ahead.last().map_or(b"\n" as &[u8], |last| text_before_next(program, last));
    let (mut length, mut spare) = (0, Vec::new());
    for statement in rest.iter().take(part.len()) {
        let text = program.statement_text(statement);
        if !is_border(before, text) || !reads_back(program, statement, points, &mut spare) {
            return None;
        }
        (points, before) = (holds_points(statement), text_before_next(program, statement));
        length += text.len();
    }
    Some(length)
}

fn holds_points(statement: &Statement) -> bool {
    matches!(statement.record(), Record::Goto(_) | Record::Points(_))
}

/// Returns the text that the next statement follows. A byte order mark needs no line end.
fn text_before_next<'p>(program: &'p Program, statement: &Statement) -> &'p [u8] {
    match statement.record() {
        Record::ByteOrderMark => b"\n",
        _ => program.statement_text(statement),
    }
}

/// Returns the beginning of the text, as much of it as tells the kind of a file.
fn read_head(program: &Program) -> Vec<u8> {
    let mut head = Vec::with_capacity(2 * parse::HEAD_LENGTH);
    for statement in program.statements() {
        if head.len() >= parse::HEAD_LENGTH {
            break;
        }
        let text = program.statement_text(statement);
        head.extend_from_slice(text.get(..parse::HEAD_LENGTH).unwrap_or(text));
    }
    head
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

/// Returns whether a statement reads as its record. `points` says that a point stands before it; `spare` is memory for
/// its fields.
fn reads_back(
    program: &Program,
    statement: &Statement,
    points: bool,
    spare: &mut Vec<StatementField>,
) -> bool {
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
            let read = parse::read_whole_record_in(text, program.vocabulary(), spare);
            read.is_ok_and(|read| read == *record)
        }
    }
}

fn starts_with_number(text: &[u8]) -> bool {
    text.trim_ascii_start().first().is_some_and(|first| first.is_ascii_digit() || b".-+".contains(first))
}
