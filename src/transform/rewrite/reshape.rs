//! This module gives a statement a new text and keeps as much of the old one as possible.

use super::rule_subject::{RuleSubject, SubjectClass};
use super::spacing_style::SpacingStyle;
use super::wildcards::is_same_folded;
use crate::program::{FieldKind, Program, Record, Statement, StatementField, join_broken};
use crate::write::{FileStyle, patch_numbers};
use std::ops::Range;

/// Returns the new text of a statement, including its line end.
///
/// If both texts have the same word and as many arguments, only the arguments that differ are changed,
/// numbers with the file's decimals and columns. Spelling, continuation and comment stay. Otherwise the new
/// text is written as the file writes its statements, between the indentation and the line end of the old
/// one.
pub(super) fn reshape_statement(
    program: &Program,
    statement: &Statement,
    new: &[u8],
    style: &FileStyle,
    look: &mut SpacingStyle,
) -> Vec<u8> {
    let (text, record) = (program.statement_text(statement), statement.record());
    let (old, wanted) = (RuleSubject::from_text(text), RuleSubject::from_text(new));
    if wanted.is_whole(new) && has_same_shape(&old, &wanted) {
        return patch_arguments(text, record, &old, &wanted, style);
    }
    let indent = text.iter().position(|byte| !matches!(byte, b' ' | b'\t')).unwrap_or(0);
    let mut out = text.get(..indent).unwrap_or_default().to_vec();
    out.extend(look.apply_spacing(new, program).trim_ascii());
    let is_text = |subject: &RuleSubject<'_>| subject.class != SubjectClass::Words;
    let tail =
        match is_text(&old) || is_text(&wanted) || wanted.remark.is_some() || takes_rest_of_line(&wanted) {
            true => line_end(text),
            false => trailing_text(&old),
        };
    out.extend_from_slice(tail);
    out
}

fn has_same_shape(old: &RuleSubject<'_>, new: &RuleSubject<'_>) -> bool {
    old.class == new.class
        && old.class != SubjectClass::Other
        && (new.remark.is_none() || old.class == SubjectClass::Comment)
        && is_same_folded(old.bytes_at(&old.word), new.bytes_at(&new.word))
        && old.fields.len() == new.fields.len()
}

fn patch_arguments(
    text: &[u8],
    record: &Record,
    old: &RuleSubject<'_>,
    new: &RuleSubject<'_>,
    style: &FileStyle,
) -> Vec<u8> {
    let mut changes = ArgumentChanges::default();
    changes.collect_changes(old, &old.fields, new, &new.fields);
    let numbers = patch_numbers(text, record, &changes.numbers, style);
    let text = numbers.as_deref().unwrap_or(text);
    // New numbers may have moved everything behind them, so the places are read again.
    let old = RuleSubject::from_text(text);
    let mut changes = ArgumentChanges::default();
    changes.collect_changes(&old, &old.fields, new, &new.fields);
    let mut out = Vec::with_capacity(text.len() + 16);
    let mut copied = 0;
    for (at, bytes) in changes.parts {
        out.extend_from_slice(text.get(copied..at.start).unwrap_or_default());
        out.extend_from_slice(bytes);
        copied = at.end;
    }
    out.extend_from_slice(text.get(copied..).unwrap_or_default());
    out
}

/// The arguments that differ: numbers by their index, all others by their place.
#[derive(Default)]
struct ArgumentChanges<'n> {
    seen: usize,
    numbers: Vec<(usize, f64)>,
    parts: Vec<(Range<usize>, &'n [u8])>,
}

impl<'n> ArgumentChanges<'n> {
    fn collect_changes(
        &mut self,
        old: &RuleSubject<'_>,
        from: &[StatementField],
        new: &RuleSubject<'n>,
        to: &[StatementField],
    ) {
        for (before, after) in from.iter().zip(to) {
            let bytes = new.bytes_at(&after.at);
            match (&before.kind, &after.kind) {
                (FieldKind::Number(value), FieldKind::Number(wanted)) => {
                    if value != wanted {
                        self.numbers.push((self.seen, *wanted));
                    }
                    self.seen += 1;
                }
                (FieldKind::Group(a), FieldKind::Group(b))
                    if a.fields.len() == b.fields.len()
                        && is_same_folded(old.bytes_at(&a.word), new.bytes_at(&b.word)) =>
                {
                    self.collect_changes(old, &a.fields, new, &b.fields);
                }
                _ => {
                    self.seen += count_numbers(before);
                    if join_broken(old.bytes_at(&before.at)) != join_broken(bytes) {
                        self.parts.push((before.at.clone(), bytes));
                    }
                }
            }
        }
    }
}

fn count_numbers(field: &StatementField) -> usize {
    match &field.kind {
        FieldKind::Number(_) => 1,
        FieldKind::Group(group) => group.fields.iter().map(count_numbers).sum(),
        _ => 0,
    }
}

/// Returns whether a statement takes the rest of the line as text, like `PPRINT`. A `$$` would be text there,
/// too.
fn takes_rest_of_line(new: &RuleSubject<'_>) -> bool {
    let with_comment = [new.text.trim_ascii_end(), b" $$ x"].concat();
    RuleSubject::from_text(&with_comment).remark.is_none()
}

/// Returns what follows the last argument: blanks, a comment and the line end. A continuation mark is left
/// out, because nothing would follow it.
fn trailing_text<'t>(old: &RuleSubject<'t>) -> &'t [u8] {
    let end = old.fields.last().map_or(old.word.end, |field| field.at.end);
    let tail = old.text.get(end..).unwrap_or_default();
    let before = old.remark.as_ref().map_or(tail.len(), |remark| remark.start.saturating_sub(end));
    match tail.get(..before).is_some_and(|gap| gap.iter().all(u8::is_ascii_whitespace)) {
        true => tail,
        false => line_end(old.text),
    }
}

fn line_end(text: &[u8]) -> &[u8] {
    let end = text.iter().rposition(|byte| !matches!(byte, b'\n' | b'\r')).map_or(0, |last| last + 1);
    text.get(end..).unwrap_or_default()
}
