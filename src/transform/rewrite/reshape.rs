//! A new text for a statement with as little of the old one lost as can be.

use super::look::Look;
use super::subject::{Class, Subject};
use super::wild::same;
use crate::program::{Field, FieldKind, Program, Record, Statement};
use crate::write::{Style, patch_numbers};
use std::ops::Range;

/// The text that a statement gets, line end included.
///
/// Where old and new have the same word and as many arguments, only the arguments that differ change, numbers with the file's
/// decimals and columns; spelling, continuation and comment stay. Else the new text is written as the file writes its
/// statements, between the old one's indentation and its line end.
pub(super) fn reshaped(
    program: &Program,
    statement: &Statement,
    new: &[u8],
    style: &Style,
    look: &mut Look,
) -> Vec<u8> {
    let (text, record) = (program.text(statement), statement.record());
    let (old, wanted) = (Subject::of(text), Subject::of(new));
    if wanted.is_whole(new) && has_shape(&old, &wanted) {
        return patched(text, record, &old, &wanted, style);
    }
    let indent = text.iter().position(|byte| !matches!(byte, b' ' | b'\t')).unwrap_or(0);
    let mut out = text.get(..indent).unwrap_or_default().to_vec();
    out.extend(look.written(new, program).trim_ascii());
    let is_text = |subject: &Subject<'_>| subject.class != Class::Words;
    let tail =
        match is_text(&old) || is_text(&wanted) || wanted.remark.is_some() || takes_rest_of_line(&wanted) {
            true => line_end(text),
            false => tail(&old),
        };
    out.extend_from_slice(tail);
    out
}

fn has_shape(old: &Subject<'_>, new: &Subject<'_>) -> bool {
    old.class == new.class
        && old.class != Class::Other
        && (new.remark.is_none() || old.class == Class::Comment)
        && same(old.bytes(&old.word), new.bytes(&new.word))
        && old.fields.len() == new.fields.len()
}

fn patched(text: &[u8], record: &Record, old: &Subject<'_>, new: &Subject<'_>, style: &Style) -> Vec<u8> {
    let mut changes = Changes::default();
    changes.collect(old, &old.fields, new, &new.fields);
    let numbers = patch_numbers(text, record, &changes.numbers, style);
    let text = numbers.as_deref().unwrap_or(text);
    // Numbers may have moved what stands behind them.
    let old = Subject::of(text);
    let mut changes = Changes::default();
    changes.collect(&old, &old.fields, new, &new.fields);
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

/// What differs: numbers by their index, everything else by its place.
#[derive(Default)]
struct Changes<'n> {
    seen: usize,
    numbers: Vec<(usize, f64)>,
    parts: Vec<(Range<usize>, &'n [u8])>,
}

impl<'n> Changes<'n> {
    fn collect(&mut self, old: &Subject<'_>, from: &[Field], new: &Subject<'n>, to: &[Field]) {
        for (before, after) in from.iter().zip(to) {
            let bytes = new.bytes(&after.at);
            match (&before.kind, &after.kind) {
                (FieldKind::Number(value), FieldKind::Number(wanted)) => {
                    if value != wanted {
                        self.numbers.push((self.seen, *wanted));
                    }
                    self.seen += 1;
                }
                (FieldKind::Group(a), FieldKind::Group(b))
                    if a.fields.len() == b.fields.len() && same(old.bytes(&a.word), new.bytes(&b.word)) =>
                {
                    self.collect(old, &a.fields, new, &b.fields);
                }
                _ => {
                    self.seen += numbers_in(before);
                    if old.bytes(&before.at) != bytes {
                        self.parts.push((before.at.clone(), bytes));
                    }
                }
            }
        }
    }
}

fn numbers_in(field: &Field) -> usize {
    match &field.kind {
        FieldKind::Number(_) => 1,
        FieldKind::Group(group) => group.fields.iter().map(numbers_in).sum(),
        _ => 0,
    }
}

/// `PPRINT` and its kin, in which a `$$` would be text.
fn takes_rest_of_line(new: &Subject<'_>) -> bool {
    let with_comment = [new.text.trim_ascii_end(), b" $$ x"].concat();
    Subject::of(&with_comment).remark.is_none()
}

/// What follows the last argument: blanks, a comment, the line end. A continuation in it would continue nothing.
fn tail<'t>(old: &Subject<'t>) -> &'t [u8] {
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
