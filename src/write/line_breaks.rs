//! This module finds where lines are broken: anywhere because they are full, as CATIA does it, or behind fields.

use crate::parse;
use crate::parse::columns::{DATA_COLUMNS, inspect_line, lines_with_starts};
use crate::program::StatementKind;
use std::ops::Range;

/// Returns whether full lines are broken anywhere, within numbers too: the file does so (`full_column`), or this text.
/// A line that happens to end in `,$` in such a column is not full; whoever wrote it broke it behind the field.
pub(super) fn breaks_anywhere(text: &[u8], full_column: Option<usize>) -> bool {
    let mut tokens = None;
    full_column.is_some()
        || lines_with_starts(text).any(|(start, line)| {
            inspect_line(line).full.is_some_and(|at| {
                let tokens = tokens.get_or_insert_with(|| parse::syntax(text).token_places());
                is_within(tokens, start + at)
            })
        })
}

/// Returns whether a place is within one of the tokens, which are in the order of the text.
fn is_within(tokens: &[Range<usize>], at: usize) -> bool {
    let before = tokens.partition_point(|token| token.start <= at);
    before.checked_sub(1).and_then(|last| tokens.get(last)).is_some_and(|token| at < token.end)
}

/// Returns the places behind the commas at which a statement with identifications may be broken, since they end
/// fields. There are none in other texts.
pub(super) fn find_commas(text: &[u8], identifications: &[&[u8]]) -> Vec<usize> {
    let is_short = || lines_with_starts(text).all(|(_, line)| line.trim_ascii_end().len() <= DATA_COLUMNS);
    if identifications.iter().all(|mark| mark.is_empty()) || is_short() {
        return Vec::new();
    }
    let syntax = parse::syntax(text);
    if syntax.form != StatementKind::Words {
        return Vec::new();
    }
    let tokens = syntax.token_places();
    let end = syntax.remark.map_or(syntax.text.len(), |remark| remark.start);
    let fields = text.get(..end).unwrap_or_default();
    memchr::memchr_iter(b',', fields).filter(|at| !is_within(&tokens, *at)).map(|at| at + 1).collect()
}

/// Returns the last of the places behind `from` and up to `to`.
pub(super) fn last_comma_between(commas: &[usize], from: usize, to: usize) -> Option<usize> {
    let before = commas.partition_point(|comma| *comma <= to);
    before.checked_sub(1).and_then(|last| commas.get(last)).copied().filter(|comma| *comma > from)
}

/// Returns the offset of the `$` at which a file breaks full lines inside numbers and words, or `None` if it
/// breaks none.
pub(super) fn find_full_column(bytes: &[u8]) -> Option<usize> {
    for at in memchr::memchr_iter(b'$', bytes) {
        let after = match bytes.get(at + 1..) {
            Some([b'\r', b'\n', first, ..] | [b'\n' | b'\r', first, ..]) => *first,
            _ => continue,
        };
        let before = at.checked_sub(1).and_then(|before| bytes.get(before)).copied().unwrap_or(b' ');
        let is_token = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'-');
        if !is_token(before) || !is_token(after) {
            continue;
        }
        let start = memchr::memrchr2(b'\n', b'\r', bytes.get(..at)?).map_or(0, |end| end + 1);
        let line = bytes.get(start..=at)?;
        // What stands behind a `$` is a comment.
        if memchr::memchr(b'$', line) != Some(at - start) {
            continue;
        }
        if let Some(full) = inspect_line(line).full.filter(|_| !line.trim_ascii_start().starts_with(b"$$")) {
            return Some(full);
        }
    }
    None
}
