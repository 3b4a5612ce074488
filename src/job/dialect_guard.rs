//! This module tells when steps make a program one of another dialect.
//!
//! Both proofs of a corrected program read its statements in the words of the original's dialect. The next reader does
//! not know it: it looks for the marks of a system, and gives arcs and axes the meaning that they have there.

use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::parse;
use crate::program::motion::Motion;
use crate::program::{Dialect, DialectDetector, Program, Record, Statement, StatementChange};
use crate::source::Span;

/// Finds out whether a changed program reads as one of another dialect, if the dialect of the original was detected.
pub(super) fn find_changed_dialect(program: &Program) -> Option<Diagnostic> {
    // Marks that nobody touched decide as they did.
    let changed = program.statements().iter().filter(|statement| changes_marks(program, statement));
    let places: Vec<Span> = changed.map(Statement::origin).collect();
    let first = *places.first()?;
    let read = detect_dialect(program);
    if read == program.dialect() {
        return None;
    }
    let (code, consequence) = compare_motions(program, read);
    let message = format!(
        "the program was read as {}, the corrected one reads as {read}{consequence}",
        program.dialect()
    );
    Some(Diagnostic::new(code, message).with_label(program.source(), first, "a mark of a system was changed"))
}

/// Returns whether the change of a statement may change what the marks of the program tell.
fn changes_marks(program: &Program, statement: &Statement) -> bool {
    let old = program.source().slice(statement.origin());
    let new = program.statement_text(statement);
    let bears_mark = |text: &[u8]| {
        let mut detector = DialectDetector::default();
        detector.observe_statement(&parse::syntax(text), statement.record());
        detector.has_mark()
    };
    match (statement.change(), statement.record()) {
        (StatementChange::Untouched, _) => false,
        (StatementChange::Inserted(_), _) => bears_mark(new),
        (StatementChange::Deleted(_), _) => bears_mark(old),
        // Nearly all changes are moved points.
        (StatementChange::Edited(_), Record::Goto(_)) if old.starts_with(b"GOTO") => false,
        (StatementChange::Edited(_), _) => {
            !differ_only_in_numbers(old, new) && (bears_mark(old) || bears_mark(new))
        }
    }
}

/// Returns whether two statements of words have the same words, and nothing but numbers, blanks and line ends differs.
fn differ_only_in_numbers(old: &[u8], new: &[u8]) -> bool {
    let is_comment = old.trim_ascii_start().starts_with(b"$$");
    match (split_at_slash(old), split_at_slash(new)) {
        (Some((old_word, old_fields)), Some((new_word, new_fields))) if !is_comment => {
            old_word == new_word && words_of_fields(old_fields).eq(words_of_fields(new_fields))
        }
        _ => false,
    }
}

fn split_at_slash(text: &[u8]) -> Option<(&[u8], &[u8])> {
    memchr::memchr(b'/', text).and_then(|slash| text.split_at_checked(slash))
}

/// Returns the bytes of fields that belong to no number.
fn words_of_fields(fields: &[u8]) -> impl Iterator<Item = u8> {
    let after = fields.iter().skip(1).copied().chain([b'\n']);
    let pairs = fields.iter().copied().zip(after);
    pairs.filter_map(|(byte, next)| match byte {
        b'0'..=b'9' | b'.' | b' ' | b'\r' | b'\n' => None,
        b'-' | b'+' if next.is_ascii_digit() || next == b'.' => None,
        _ => Some(byte),
    })
}

/// Detects the dialect of the program as it will be written.
fn detect_dialect(program: &Program) -> Dialect {
    let mut detector = DialectDetector::default();
    for (_, statement) in program.live_statements() {
        if detector.is_decided() {
            break;
        }
        if !matches!(statement.record(), Record::Goto(_)) {
            detector.observe_statement(&parse::syntax(program.statement_text(statement)), statement.record());
        }
    }
    detector.detected_dialect()
}

/// Returns the code for a program that reads as one of another dialect, and what that does to its motions.
fn compare_motions(program: &Program, read: Dialect) -> (DiagnosticCode, &'static str) {
    let mut other = program.clone();
    other.set_dialect(read);
    let is_same = |(left, right): (Motion, Motion)| {
        (left.to, left.path, left.rapid, left.cuts_thread)
            == (right.to, right.path, right.rapid, right.cuts_thread)
    };
    let same_length = program.motions().count() == other.motions().count();
    match same_length && program.motions().zip(other.motions()).all(is_same) {
        true => (codes::DIALECT_CHANGED, ""),
        false => (codes::MOTIONS_OF_OTHER_DIALECT, ", with other motions"),
    }
}
