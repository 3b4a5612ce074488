//! This module words what an edit has changed, in a few words.

use super::comment_format::{shorten_middle, to_printable_ascii};
use crate::parse;
use crate::program::{NumberRole, Record, StatementKind, fold_text};

/// The length of the longest name that is used for a record.
const LONGEST_NAME: usize = 20;

/// Describes the difference between two texts of a record, in at most `width` columns: the numbers that
/// changed as they are printed, or what was there before.
pub(super) fn describe_difference(record: &Record, before: &[u8], after: &[u8], width: usize) -> String {
    match list_changed_numbers(record, before, after) {
        Some(changed) if !changed.is_empty() => join_fitting(&changed, width),
        _ => format!("was {}", shorten_middle(&to_one_line(before), width.saturating_sub("was ".len()))),
    }
}

/// Returns a record's text in one line, without its line end and repeated blanks.
pub(super) fn to_one_line(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    to_printable_ascii(&text.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// Returns the name of a record, for a comment that is not directly before it.
pub(super) fn record_name(record: &Record, text: &[u8]) -> String {
    let syntax = parse::syntax(text);
    let name = match (record, syntax.form) {
        (Record::MatrixRow(_), _) => "matrix".to_owned(),
        (_, StatementKind::Numbers) => "point".to_owned(),
        _ => fold_text(syntax.bytes_at(&syntax.word)).into_owned(),
    };
    shorten_middle(&to_printable_ascii(&name), LONGEST_NAME)
}

/// Returns the numbers that differ, each with its letter. Returns `None` if more than numbers differs.
fn list_changed_numbers(record: &Record, before: &[u8], after: &[u8]) -> Option<Vec<String>> {
    let (old, new) = (parse::statement_numbers(before), parse::statement_numbers(after));
    let places =
        |found: &[(std::ops::Range<usize>, f64)]| found.iter().map(|(at, _)| at.clone()).collect::<Vec<_>>();
    let (old, new) = (places(&old), places(&new));
    if old.len() != new.len() || text_between_numbers(before, &old) != text_between_numbers(after, &new) {
        return None;
    }
    let roles = parse::number_roles(record, after);
    let mut found = Vec::new();
    for (index, (old, new)) in old.into_iter().zip(new).enumerate() {
        let (old, new) = (before.get(old)?, after.get(new)?);
        if old != new {
            let letter = roles.get(index).copied().and_then(role_letter).unwrap_or_default();
            let [old, new] = [old, new].map(String::from_utf8_lossy);
            found.push(format!("{letter}{old} -> {new}"));
        }
    }
    Some(found)
}

/// Returns the parts of a text between its numbers, without blanks.
fn text_between_numbers(text: &[u8], numbers: &[std::ops::Range<usize>]) -> Vec<Vec<u8>> {
    let starts = std::iter::once(0).chain(numbers.iter().map(|at| at.end));
    let ends = numbers.iter().map(|at| at.start).chain([text.len()]);
    let part = |(start, end)| {
        let part: &[u8] = text.get(start..end).unwrap_or_default();
        part.iter().copied().filter(|byte| !byte.is_ascii_whitespace()).collect()
    };
    starts.zip(ends).map(part).collect()
}

fn role_letter(role: NumberRole) -> Option<&'static str> {
    let (letters, axis) = match role {
        NumberRole::Point(axis) | NumberRole::Step(axis) | NumberRole::FrameOrigin(axis) => {
            (["X ", "Y ", "Z "], axis)
        }
        NumberRole::Direction(axis) | NumberRole::ArcAxis(axis) => (["I ", "J ", "K "], axis),
        NumberRole::FrameAxis(..)
        | NumberRole::Length
        | NumberRole::Feed
        | NumberRole::SurfaceSpeed
        | NumberRole::Plain => return None,
    };
    letters.get(usize::from(axis)).copied()
}

/// Joins as many texts as fit, and the number of those that are left out.
fn join_fitting(changed: &[String], width: usize) -> String {
    let mut out = String::new();
    for (index, one) in changed.iter().enumerate() {
        let comma = if index == 0 { "" } else { ", " };
        let left = changed.len() - index - 1;
        // This leaves columns for the number of texts that are left out.
        let reserve = if left > 0 { ", 99 more".len() } else { 0 };
        if index > 0 && out.len() + comma.len() + one.len() + reserve > width {
            out.push_str(&format!(", {} more", left + 1));
            return out;
        }
        out.push_str(comma);
        out.push_str(one);
    }
    out
}
