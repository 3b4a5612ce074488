//! This module keeps changed statements in the columns of their file: full lines are broken again where the
//! file breaks them, and identifications stay in columns 73 to 80.

use crate::parse::columns::{CARD_COLUMNS, DATA_COLUMNS, inspect_line};
use std::borrow::Cow;
use std::ops::Range;

/// The text of a statement with its full lines joined, and the numbers' places in it.
pub(super) struct JoinedText<'t> {
    /// The text.
    pub(super) text: Cow<'t, [u8]>,
    /// The breaks that were taken out, in the order of the text.
    breaks: Vec<RemovedBreak>,
}

/// A break of a line that was taken out of a text.
#[derive(Debug, Clone, Copy)]
struct RemovedBreak {
    /// Its end in the original text.
    end: usize,
    /// The number of bytes that were taken out up to there.
    removed: usize,
}

impl<'t> JoinedText<'t> {
    /// Joins the full lines of a text, and every number that is broken. `numbers` are the places of numbers in
    /// the text, in their order. A statement may have hundreds of thousands of them.
    pub(super) fn new(text: &'t [u8], numbers: &[(Range<usize>, f64)]) -> Self {
        let mut breaks = Vec::new();
        // Most statements have one line, which nothing breaks.
        let one_line = memchr::memchr(b'\n', text).is_none_or(|end| end + 1 == text.len());
        for (start, line) in lines_with_starts(text).filter(|_| !one_line) {
            let (end, after) = (start + line.len(), start + line.len() < text.len());
            let within_number = || {
                let before = numbers.partition_point(|(at, _)| at.start < end);
                let last = before.checked_sub(1).and_then(|last| numbers.get(last));
                last.is_some_and(|(at, _)| end < at.end)
            };
            let mark = match inspect_line(line).full {
                Some(at) if after => Some(start + at),
                None if after && within_number() => {
                    line.iter().rposition(|byte| *byte == b'$').map(|at| start + at)
                }
                _ => None,
            };
            breaks.extend(mark.map(|mark| mark..end));
        }
        if breaks.is_empty() {
            return Self { text: Cow::Borrowed(text), breaks: Vec::new() };
        }
        let mut joined = Vec::with_capacity(text.len());
        let (mut copied, mut removed) = (0, 0);
        let remove_break = |at: Range<usize>| {
            joined.extend_from_slice(text.get(copied..at.start).unwrap_or_default());
            copied = at.end;
            removed += at.len();
            RemovedBreak { end: at.end, removed }
        };
        let breaks = breaks.into_iter().map(remove_break).collect();
        joined.extend_from_slice(text.get(copied..).unwrap_or_default());
        Self { text: Cow::Owned(joined), breaks }
    }

    /// Returns the offset in the joined text of an offset in the original one.
    pub(super) fn joined_offset(&self, at: usize) -> usize {
        let before = self.breaks.partition_point(|broken| broken.end <= at);
        let last = before.checked_sub(1).and_then(|last| self.breaks.get(last));
        at - last.map_or(0, |broken| broken.removed)
    }
}

/// Gives a changed text the lines that the file has, as [`fit_lines`] does.
pub(super) fn fit_lines_in_place(old: &[u8], new: &mut Vec<u8>, full_column: Option<usize>) {
    if has_columns(old, new, full_column) {
        *new = break_lines(old, new, full_column);
    }
}

/// Returns a changed text with its lines as the file has them.
///
/// `old` is the statement's text before the change, empty for a new statement. `full_column` is the offset at
/// which the file breaks full lines, if it does. A line that the old text broke is broken at the same column,
/// and each line gets back the identification that the old one had.
pub(super) fn fit_lines(old: &[u8], mut new: Vec<u8>, full_column: Option<usize>) -> Vec<u8> {
    fit_lines_in_place(old, &mut new, full_column);
    new
}

/// Returns whether lines have to be broken, or had something in their columns.
fn has_columns(old: &[u8], new: &[u8], full_column: Option<usize>) -> bool {
    // Neither is so in short lines, which are most.
    if old.len() < DATA_COLUMNS && (full_column.is_none() || new.len() <= DATA_COLUMNS) {
        return false;
    }
    let had_columns = lines_with_starts(old).any(|(_, line)| {
        let seen = inspect_line(line);
        seen.full.is_some() || seen.identification.is_some()
    });
    let longest = || new.split(|byte| *byte == b'\n').map(|line| line.trim_ascii_end().len()).max();
    let too_long = full_column.is_some() && longest() > Some(DATA_COLUMNS);
    // What is not CL data proper has no columns: comments, and everything of a file that keeps none.
    (had_columns || too_long) && !new.trim_ascii_start().starts_with(b"$$")
}

/// Breaks the lines of a text that has columns.
fn break_lines(old: &[u8], new: &[u8], full_column: Option<usize>) -> Vec<u8> {
    let before: Vec<_> = lines_with_starts(old).map(|(_, line)| (line, inspect_line(line))).collect();
    let identifications: Vec<&[u8]> = before
        .iter()
        .map(|(line, seen)| seen.identification.clone().and_then(|at| line.get(at)).unwrap_or_default())
        .collect();
    let broken_at = before.iter().find_map(|(_, seen)| seen.full);
    let logical = join_full_lines(&before, &identifications, new);
    let width = broken_at.or(full_column).unwrap_or(DATA_COLUMNS - 1).min(CARD_COLUMNS - 1);
    // A line that was not broken may fill the last column too.
    let most = if broken_at.is_some() { width } else { DATA_COLUMNS };
    let breaks = broken_at.is_some() || full_column.is_some();
    let mut out = Vec::with_capacity(new.len() + 16);
    let mut marks = identifications.into_iter();
    for line in logical.split_inclusive(|byte| *byte == b'\n') {
        let end = line.len() - line.iter().rev().take_while(|byte| matches!(byte, b'\n' | b'\r')).count();
        let (mut data, line_end) = line.split_at(end);
        let newline = if line_end.is_empty() { first_line_end(old) } else { line_end };
        while breaks && data.len() > most {
            let (first, rest) = data.split_at(width);
            out.extend_from_slice(first);
            out.push(b'$');
            out.extend_from_slice(marks.next().unwrap_or_default());
            out.extend_from_slice(newline);
            data = rest;
        }
        out.extend_from_slice(data);
        if let Some(mark) = marks.next().filter(|mark| !mark.is_empty() && data.len() <= DATA_COLUMNS) {
            out.extend(std::iter::repeat_n(b' ', DATA_COLUMNS - data.len()));
            out.extend_from_slice(mark);
        }
        out.extend_from_slice(line_end);
    }
    out
}

/// Returns the new text with full lines joined and without identifications.
fn join_full_lines(
    before: &[(&[u8], crate::parse::columns::LineColumns)],
    identifications: &[&[u8]],
    new: &[u8],
) -> Vec<u8> {
    let same_lines = lines_with_starts(new).count() == before.len();
    let mut logical = Vec::with_capacity(new.len());
    for (index, (start, line)) in lines_with_starts(new).enumerate() {
        let length = line.trim_ascii_end().len();
        let data = line.get(..length).unwrap_or_default();
        let mark = identifications.get(index).or(identifications.last()).copied().unwrap_or_default();
        let last = identifications.last().copied().unwrap_or_default();
        let stripped = [mark, last].into_iter().filter(|mark| !mark.is_empty()).find_map(|mark| {
            data.strip_suffix(mark).filter(|data| data.ends_with(b" ") || data.ends_with(b"$"))
        });
        let content = stripped.map_or(data, <[u8]>::trim_ascii_end);
        // A change of width moves the `$` out of its column, but the lines are still those of the old text.
        let was_full = same_lines && before.get(index).is_some_and(|(_, seen)| seen.full.is_some());
        let is_last = start + line.len() == new.len();
        let joined = (was_full || inspect_line(line).full.is_some()) && !is_last;
        match content.strip_suffix(b"$").filter(|_| joined) {
            Some(content) => logical.extend_from_slice(content),
            None if stripped.is_some() => {
                logical.extend_from_slice(content);
                logical.extend_from_slice(line.get(length..).unwrap_or_default());
            }
            None => logical.extend_from_slice(line),
        }
    }
    logical
}

/// Returns the line end of the first line of a text.
fn first_line_end(text: &[u8]) -> &[u8] {
    let line = text.split_inclusive(|byte| *byte == b'\n').next().unwrap_or_default();
    if line.ends_with(b"\r\n") { b"\r\n" } else { b"\n" }
}

/// Returns the lines of a text with their starts and line ends. A lone CR ends no line here, since no file with
/// columns has it.
fn lines_with_starts(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut start = 0;
    text.split_inclusive(|byte| *byte == b'\n').map(move |line| {
        let at = start;
        start += line.len();
        (at, line)
    })
}

/// Returns the offset of the `$` at which a file breaks full lines inside numbers and words, or `None` if it
/// breaks none.
pub(super) fn find_full_column(bytes: &[u8]) -> Option<usize> {
    for at in memchr::memchr_iter(b'$', bytes) {
        let after = match bytes.get(at + 1..) {
            Some([b'\r', b'\n', first, ..]) | Some([b'\n', first, ..]) => *first,
            _ => continue,
        };
        let before = at.checked_sub(1).and_then(|before| bytes.get(before)).copied().unwrap_or(b' ');
        let is_token = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'-');
        if !is_token(before) || !is_token(after) {
            continue;
        }
        let start = memchr::memrchr(b'\n', bytes.get(..at)?).map_or(0, |end| end + 1);
        let line = bytes.get(start..=at)?;
        if let Some(full) = inspect_line(line).full.filter(|_| !line.trim_ascii_start().starts_with(b"$$")) {
            return Some(full);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks the text that a change of an old text becomes.
    fn assert_fit(old: &str, new: &str, full_column: Option<usize>, expected: &str) {
        let fitted = fit_lines(old.as_bytes(), new.as_bytes().to_vec(), full_column);
        assert_eq!(String::from_utf8(fitted).unwrap(), expected);
    }

    #[test]
    fn offsets_in_a_joined_text_are_those_of_the_original_without_its_breaks() {
        let text = format!("{}1$\n2,{}3$\n4\n", "X".repeat(70), "Y".repeat(68));
        let joined = JoinedText::new(text.as_bytes(), &[]);
        assert_eq!(*joined.text, *text.replace("$\n", "").as_bytes());
        for (at, byte) in text.bytes().enumerate().filter(|(_, byte)| !matches!(byte, b'$' | b'\n')) {
            assert_eq!(joined.text.get(joined.joined_offset(at)), Some(&byte), "{at}");
        }
    }

    /// Every line looked through all numbers, and every number through all breaks.
    #[test]
    fn a_statement_of_many_lines_is_joined_in_linear_time() {
        let line = format!("{}1$\n", "X".repeat(70));
        let text = line.repeat(160_000);
        let numbers: Vec<_> =
            (0..160_000).map(|index| (index * line.len() + 70..index * line.len() + 71, 1.0)).collect();
        let begun = std::time::Instant::now();
        let joined = JoinedText::new(text.as_bytes(), &numbers);
        let last = numbers.iter().map(|(at, _)| joined.joined_offset(at.start)).max();
        assert_eq!(last, Some(159_999 * 71 + 70));
        assert!(begun.elapsed() < std::time::Duration::from_secs(4), "{:?}", begun.elapsed());
    }

    #[test]
    fn a_full_line_is_broken_where_the_old_one_was() {
        let (head, tail) = ("X".repeat(71), "12.5\r\n");
        let old = format!("{head}$\r\n{tail}");
        assert_fit(&old, &format!("{head}{tail}"), None, &old);
        // One byte less moves the break into the rest, and one line is enough for a short text.
        let less = format!("{}{tail}", "X".repeat(70));
        assert_fit(&old, &less, None, &format!("{}1$\r\n2.5\r\n", "X".repeat(70)));
        assert_fit(&old, "X\r\n", None, "X\r\n");
    }

    #[test]
    fn a_line_that_grew_is_broken_as_the_file_breaks_its_own() {
        let new = format!("{}\n", "X".repeat(75));
        assert_fit("", &new, Some(71), &format!("{}$\n{}\n", "X".repeat(71), "X".repeat(4)));
        assert_fit("", &new, None, &new);
    }

    #[test]
    fn identifications_keep_their_columns() {
        let card = |data: &str, behind: &str| format!("{data:<72}{behind}\n");
        let old = card("FEDRAT/MMPM,420.", "PKT00060");
        assert_fit(&old, &old.replace("420.", "42."), None, &card("FEDRAT/MMPM,42.", "PKT00060"));
        assert_fit(&old, "FEDRAT/IPM,42.\n", None, &card("FEDRAT/IPM,42.", "PKT00060"));
    }
}
