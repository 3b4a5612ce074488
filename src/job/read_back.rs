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
    // A file that became too large is told as one.
    match first.zip(second).map(|(first, second)| u32::try_from(first + second)) {
        Some(Ok(_)) => ReadBack::Proven,
        _ => ReadBack::Unknown,
    }
}

/// The number of statements from which a second thread gains more than it costs.
const WORTH_A_THREAD: usize = 20_000;

/// Reads the changed statements of a part of a program. Returns the length of its text in bytes if every statement
/// reads as its record.
fn read_part(program: &Program, part: Range<usize>) -> Option<usize> {
    let (before, rest) = program.statements().split_at_checked(part.start)?;
    let (mut points, mut closed) = match before.last() {
        Some(before) => (holds_points(before), is_closed(program, before)),
        None => (false, true),
    };
    let (mut length, mut spare) = (0, Vec::new());
    for statement in rest.iter().take(part.len()) {
        if !closed || !reads_back(program, statement, points, &mut spare) {
            return None;
        }
        (points, closed) = (holds_points(statement), is_closed(program, statement));
        length += program.statement_text(statement).len();
    }
    Some(length)
}

fn holds_points(statement: &Statement) -> bool {
    matches!(statement.record(), Record::Goto(_) | Record::Points(_))
}

/// Returns whether nothing behind a statement can belong to it.
fn is_closed(program: &Program, statement: &Statement) -> bool {
    let text = program.statement_text(statement);
    text.ends_with(b"\n") || text.ends_with(b"\r") || *statement.record() == Record::ByteOrderMark
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
