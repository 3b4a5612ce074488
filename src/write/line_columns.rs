//! This module keeps changed statements in the columns of their file: full lines are broken again where the
//! file breaks them, and identifications stay in columns 73 to 80.

use super::line_breaks::{breaks_anywhere, find_commas, last_comma_between};
use crate::parse::columns::{CARD_COLUMNS, DATA_COLUMNS, LineColumns, inspect_line, lines_with_starts};
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
    /// Joins the full lines of a text that breaks them anywhere, and every number that is broken. `numbers` are the
    /// places of numbers in the text, in their order. A statement may have hundreds of thousands of them.
    pub(super) fn new(text: &'t [u8], numbers: &[(Range<usize>, f64)], full_column: Option<usize>) -> Self {
        let mut breaks = Vec::new();
        // Most statements have one line, which nothing breaks.
        let one_line = lines_with_starts(text).nth(1).is_none();
        let anywhere = !one_line && breaks_anywhere(text, full_column);
        for (start, line) in lines_with_starts(text).filter(|_| !one_line) {
            let (end, after) = (start + line.len(), start + line.len() < text.len());
            let within_number = || {
                let before = numbers.partition_point(|(at, _)| at.start < end);
                let last = before.checked_sub(1).and_then(|last| numbers.get(last));
                last.is_some_and(|(at, _)| end < at.end)
            };
            let mark = match inspect_line(line).full.filter(|_| anywhere) {
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
/// which the file breaks full lines, if it does. A line that the old text broke within a number, a word or a text is
/// broken at the same column; any other break stays behind its comma. Each line gets back the identification that the
/// old one had.
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
    let longest = || lines_with_starts(new).map(|(_, line)| line.trim_ascii_end().len()).max();
    let too_long = full_column.is_some() && longest() > Some(DATA_COLUMNS);
    // What is not CL data proper has no columns: comments, and everything of a file that keeps none.
    (had_columns || too_long) && !new.trim_ascii_start().starts_with(b"$$")
}

/// Breaks the lines of a text that has columns.
fn break_lines(old: &[u8], new: &[u8], full_column: Option<usize>) -> Vec<u8> {
    let before: Vec<_> = lines_with_starts(old).map(|(_, line)| (line, inspect_line(line))).collect();
    let identifications: Vec<&[u8]> = before
        .iter()
        .map(|(line, seen)| {
            let columns = seen.identification.as_ref().map(|_| DATA_COLUMNS..seen.length);
            columns.and_then(|at| line.get(at)).unwrap_or_default()
        })
        .collect();
    let breaks = breaks_anywhere(old, full_column);
    let broken_at = before.iter().find_map(|(_, seen)| seen.full).filter(|_| breaks);
    let logical = join_full_lines(&before, &identifications, new, breaks);
    let width = broken_at.or(full_column).unwrap_or(DATA_COLUMNS - 1).min(CARD_COLUMNS - 1);
    // A line that was not broken may fill the last column too.
    let most = if broken_at.is_some() { width } else { DATA_COLUMNS };
    // Behind column 72 stands no data where lines have identifications.
    let commas = if breaks { Vec::new() } else { find_commas(&logical, &identifications) };
    let mut out = Vec::with_capacity(new.len() + 16);
    let mut marks = identifications.into_iter();
    for (start, line) in lines_with_starts(&logical) {
        let end = line.len() - line.iter().rev().take_while(|byte| matches!(byte, b'\n' | b'\r')).count();
        let (data, line_end) = line.split_at(end);
        let newline = if line_end.is_empty() { first_line_end(old) } else { line_end };
        let mut at = 0;
        while end - at > most {
            let next = match breaks {
                true => Some(at + width),
                false => last_comma_between(&commas, start + at, start + at + DATA_COLUMNS - 1)
                    .map(|comma| comma - start),
            };
            let Some(next) = next.filter(|next| *next < end) else { break };
            let first = [data.get(at..next).unwrap_or_default(), b"$"].concat();
            push_card(&mut out, &first, marks.next());
            out.extend_from_slice(newline);
            at = next;
        }
        push_card(&mut out, data.get(at..).unwrap_or_default(), marks.next());
        out.extend_from_slice(line_end);
    }
    out
}

/// Adds a line without its end, with all that stood in the columns of its identification where that is read as one: if the
/// data leave room for it, and end at least two blanks or none before it. A blank behind the last comma may stand for the
/// single one before it.
fn push_card(out: &mut Vec<u8>, data: &[u8], mark: Option<&[u8]>) {
    let Some(mark) = mark.filter(|mark| !mark.is_empty() && data.len() <= DATA_COLUMNS) else {
        out.extend_from_slice(data);
        return;
    };
    let first = DATA_COLUMNS + mark.len() - mark.trim_ascii_start().len();
    let comma = data.iter().rposition(|byte| matches!(byte, b',' | b'/')).map_or(0, |at| at + 1);
    let (before, behind) = data.split_at(comma);
    for data in [data.to_vec(), [before, b" ", behind].concat()] {
        let blanks = b" ".repeat(DATA_COLUMNS.saturating_sub(data.len()));
        let card = [&data, blanks.as_slice(), mark].concat();
        if inspect_line(&card).identification.is_some_and(|at| at.start == first) {
            out.extend_from_slice(&card);
            return;
        }
    }
    out.extend_from_slice(data);
}

/// Returns the new text without identifications, and with full lines joined if they are broken anywhere.
fn join_full_lines(
    before: &[(&[u8], LineColumns)],
    identifications: &[&[u8]],
    new: &[u8],
    anywhere: bool,
) -> Vec<u8> {
    let same_lines = lines_with_starts(new).count() == before.len();
    let mut logical = Vec::with_capacity(new.len());
    for (index, (start, line)) in lines_with_starts(new).enumerate() {
        let length = line.trim_ascii_end().len();
        let data = line.get(..length).unwrap_or_default();
        let mark =
            identifications.get(index).or(identifications.last()).copied().unwrap_or_default().trim_ascii();
        let last = identifications.last().copied().unwrap_or_default().trim_ascii();
        let stripped = [mark, last].into_iter().filter(|mark| !mark.is_empty()).find_map(|mark| {
            // One that fills its columns may stand right behind a number.
            let fills = mark.len() == CARD_COLUMNS - DATA_COLUMNS
                && mark.first().is_some_and(u8::is_ascii_alphabetic);
            data.strip_suffix(mark).filter(|data| fills || data.ends_with(b" ") || data.ends_with(b"$"))
        });
        let content = stripped.map_or(data, <[u8]>::trim_ascii_end);
        // A change of width moves the `$` out of its column, but the lines are still those of the old text.
        let was_full = same_lines && before.get(index).is_some_and(|(_, seen)| seen.full.is_some());
        let is_last = start + line.len() == new.len();
        let joined = anywhere && (was_full || inspect_line(line).full.is_some()) && !is_last;
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
    let line = lines_with_starts(text).next().map(|(_, line)| line).unwrap_or_default();
    [b"\r\n" as &[u8], b"\r"].into_iter().find(|end| line.ends_with(end)).unwrap_or(b"\n")
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
        let joined = JoinedText::new(text.as_bytes(), &[], None);
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
        let joined = JoinedText::new(text.as_bytes(), &numbers, Some(71));
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
        // One that does not fill its columns stays where it is in them.
        for behind in ["       6", "6       ", "  60", "JOB-001."] {
            let old = card("FEDRAT/MMPM,420.", behind);
            assert_fit(&old, &old.replace("420.", "42."), None, &card("FEDRAT/MMPM,42.", behind));
        }
        // One right behind a number goes no further with it, and the number is broken off behind its comma.
        let (first, last) = ("1".repeat(31), "2".repeat(35));
        let old = card(&format!("GOTO/{first},{last}"), "PKT00060");
        let broken = format!("{}{last}\n", card(&format!("GOTO/33{first},$"), "PKT00060"));
        assert_fit(&old, &old.replace(&first, &format!("33{first}")), None, &broken);
        // One blank before it would make it a word of the statement.
        let less = card(&format!("GOTO/{}, {last}", "1".repeat(30)), "PKT00060");
        assert_fit(&old, &old.replace(&first, &"1".repeat(30)), None, &less);
        let shorter = card(&format!("GOTO/1,{last}"), "PKT00060");
        assert_fit(&old, &old.replace(&first, "1"), None, &shorter);
    }
}
