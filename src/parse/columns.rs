//! This module holds what columns mean in CL text: lines that were broken because they were full, and the
//! identification in columns 73 to 80. Both come from punched cards; CATIA and old processors still write
//! them.
//!
//! A column is a byte here, as it is for the programs that write such files in 8-bit code pages.

use std::borrow::Cow;
use std::ops::Range;

/// The number of columns for data. Identification stands behind them.
pub(crate) const DATA_COLUMNS: usize = 72;

/// The number of columns of a card, with the identification.
pub(crate) const CARD_COLUMNS: usize = 80;

/// The byte that stands for a `$` at the end of a full line in the text that the grammar reads.
pub(super) const FULL_LINE: u8 = 1;

/// What columns say about a line; offsets are relative to its start.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LineColumns {
    /// The bytes of the line without its line end.
    pub length: usize,
    /// The offset of the `$` that ends a full line.
    pub full: Option<usize>,
    /// The place of the identification, without the blanks before it.
    pub identification: Option<Range<usize>>,
}

/// Returns what columns say about a line, which may have a line end.
///
/// A line is full if it ends in a single `$` in column 72 or behind it (a file that was converted to UTF-8 has
/// more bytes than columns), or in column 72 with an identification after it.
pub(crate) fn inspect_line(line: &[u8]) -> LineColumns {
    let length = line.len() - line.iter().rev().take_while(|byte| matches!(byte, b'\n' | b'\r')).count();
    let line = line.get(..length).unwrap_or_default();
    let mut found = LineColumns { length, full: None, identification: None };
    if !(DATA_COLUMNS..=CARD_COLUMNS).contains(&length) {
        return found;
    }
    let is_single = |at: usize| line.get(at) == Some(&b'$') && line.get(at - 1) != Some(&b'$');
    if is_single(length - 1) {
        found.full = Some(length - 1);
        return found;
    }
    found.identification = find_identification(line);
    if found.identification.is_some() && is_single(DATA_COLUMNS - 1) {
        found.full = Some(DATA_COLUMNS - 1);
    }
    found
}

/// Returns the place of an identification such as `PT     2`, `PKT00010` or `00000010`.
///
/// It must be told apart from data that happen to reach these columns, so nothing before it may wait for more:
/// blanks stand before it, or it fills its eight columns and stands right behind a number or a `$`.
fn find_identification(line: &[u8]) -> Option<Range<usize>> {
    let (data, behind) = line.split_at_checked(DATA_COLUMNS)?;
    let behind = behind.trim_ascii_end();
    let blanks = behind.len() - behind.trim_ascii_start().len();
    let text = behind.trim_ascii_start();
    if text.is_empty() || !text.iter().all(is_identification_byte) {
        return None;
    }
    let ink = data.trim_ascii();
    // Comments and names of operations are texts of people, which may hold anything in any column.
    if (ink.starts_with(b"$$") && !ink.starts_with(b"$$->"))
        || ink.get(..4).is_some_and(|word| word.eq_ignore_ascii_case(b"TOOL"))
    {
        return None;
    }
    let last = ink.last().copied().unwrap_or(b' ');
    let gap = data.len() - data.trim_ascii_end().len() + blanks;
    if matches!(last, b' ' | b',' | b'/' | b'(' | b'-' | b'+') {
        return None;
    }
    let fits = match split_line_number(text) {
        // A word, or letters and digits mixed (`A1B00010`, `JOB-001.`), which begins its columns.
        None => {
            let begins = blanks == 0 && text.first().is_some_and(u8::is_ascii_alphabetic);
            begins && gap >= 2 && !text.contains(&b' ')
        }
        Some(_) if gap >= 2 => true,
        Some(_) if gap != 0 || behind.len() != CARD_COLUMNS - DATA_COLUMNS => false,
        Some(_) if matches!(last, b'$' | b')') => true,
        // Digits behind a number could be more of its decimals; a line's number begins with zeros, and then the difference
        // would be less than what any machine moves.
        Some((0, number)) => last.is_ascii_digit() && number.starts_with(b"000") && ends_in_decimals(ink),
        Some(_) => last.is_ascii_digit() || last == b'.',
    };
    fits.then(|| DATA_COLUMNS + blanks..DATA_COLUMNS + behind.len())
}

fn is_identification_byte(byte: &u8) -> bool {
    byte.is_ascii_alphanumeric() || b" ._#-".contains(byte)
}

/// Splits an identification into how many letters it begins with and its number; `None` if it has another form.
fn split_line_number(text: &[u8]) -> Option<(usize, &[u8])> {
    let letters = text.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
    let number = text.get(letters..)?.trim_ascii_start();
    (!number.is_empty() && number.iter().all(u8::is_ascii_digit)).then_some((letters, number))
}

/// The most decimals that a system writes: a longer row of digits goes on behind the column of data.
const MOST_DECIMALS: usize = 12;

/// Returns whether data end in a number with a decimal at least, and with no more than any system writes.
fn ends_in_decimals(ink: &[u8]) -> bool {
    let digits = ink.iter().rev().take_while(|byte| byte.is_ascii_digit()).count();
    (1..=MOST_DECIMALS).contains(&digits)
        && ink.len().checked_sub(digits + 1).and_then(|at| ink.get(at)) == Some(&b'.')
}

/// Returns the text that the grammar reads: bytes from 0x80 on as DEL, the `$` of full lines as
/// [`FULL_LINE`], and identifications as blanks. Every byte stays one byte.
pub(super) fn mask_for_grammar(window: &[u8]) -> Cow<'_, str> {
    let columns = window.len() >= DATA_COLUMNS;
    let plain = match std::str::from_utf8(window) {
        Ok(text) if text.is_ascii() && memchr::memchr(FULL_LINE, window).is_none() => Some(text),
        _ => None,
    };
    if let Some(text) = plain.filter(|_| !columns) {
        return Cow::Borrowed(text);
    }
    let mut masks = Vec::new();
    if columns {
        for (start, line) in lines_with_starts(window) {
            let found = inspect_line(line);
            masks.extend(found.full.map(|at| (start + at..start + at + 1, FULL_LINE)));
            masks.extend(found.identification.map(|at| (start + at.start..start + at.end, b' ')));
        }
    }
    if let Some(text) = plain.filter(|_| masks.is_empty()) {
        return Cow::Borrowed(text);
    }
    let mut bytes: Vec<u8> =
        window.iter().map(|&byte| if byte.is_ascii() && byte != FULL_LINE { byte } else { 0x7F }).collect();
    for (at, mask) in masks {
        if let Some(masked) = bytes.get_mut(at) {
            masked.fill(mask);
        }
    }
    Cow::Owned(bytes.into_iter().map(char::from).collect())
}

/// Returns a part of a statement's text without the breaks of full lines in it.
pub(crate) fn without_full_breaks<'t>(text: &'t [u8], at: &Range<usize>) -> Cow<'t, [u8]> {
    let part = text.get(at.clone()).unwrap_or_default();
    if memchr::memchr2(b'\n', b'\r', part).is_none() {
        return Cow::Borrowed(part);
    }
    let mut joined = Vec::with_capacity(part.len());
    for (start, line) in lines_with_starts(text) {
        let end = start + inspect_line(line).full.unwrap_or(line.len());
        let shown = start.max(at.start)..end.min(at.end);
        joined.extend_from_slice(text.get(shown).unwrap_or_default());
    }
    Cow::Owned(joined)
}

/// Returns the lines of a text with their starts and line ends: LF, CRLF or a lone CR. Columns are counted from there.
pub(crate) fn lines_with_starts(text: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut end = 0;
    std::iter::from_fn(move || {
        let start = end;
        end = find_line_end(text, start)?;
        text.get(start..end).map(|line| (start, line))
    })
}

/// Returns the end of the line that starts at `from`, behind its line end; `None` at the end of the text.
pub(super) fn find_line_end(text: &[u8], from: usize) -> Option<usize> {
    let rest = text.get(from..).filter(|rest| !rest.is_empty())?;
    Some(match memchr::memchr2(b'\n', b'\r', rest) {
        None => text.len(),
        Some(at) if rest.get(at..at + 2) == Some(b"\r\n") => from + at + 2,
        Some(at) => from + at + 1,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn card(data: &str, behind: &str) -> String {
        format!("{data:<72}{behind}\r\n")
    }

    #[test]
    fn identifications_are_told_from_data() {
        for (line, expected) in [
            (card("GOTO/1,2,3", "PT     2"), true),
            (card("GOTO/1,2,3", "00000010"), true),
            (card("GOTO/1,2,3", "      10"), true),
            (card("RAPID", "PKT00070"), true),
            (card(&format!("GOTO  /{}", "1".repeat(65)), "PT     1"), true),
            (card(&format!("GOTO  /{}$", "1".repeat(64)), "PT     1"), true),
            (card(&format!("GOTO/1,{}", "1".repeat(63) + ".5"), "00000120"), true),
            (card(&format!("CIRCLE/(1,{})", "1".repeat(61)), "00000120"), true),
            (card(&format!("GOTO  /{}$", "1".repeat(64)), "00000130"), true),
            (card("$$-> CUTTER / 12.000000", "00000140"), true),
            (card("GOTO/1,2,3", "JOB-001."), true),
            (card("GOTO/1,2,3", "A1B00010"), true),
            (card("RAPID", "POCKET"), true),
            // The number that a comma waits for, the name of a tool, a text, and a number that goes on.
            (card("GOTO/1,2,", "00000010"), false),
            (card("TOOL PATH/A,TOOL,EM", "R5"), false),
            (card("$$ A COMMENT", "AB12"), false),
            (card(&format!("GOTO/1,{}", "1".repeat(65)), "123"), false),
            (card(&format!("GOTO/1,{}0.{}", " ".repeat(45), "0".repeat(18)), "00000861"), false),
            (card("GOTO/1,2,3", "PT   2 X"), false),
            // A further number, a word that does not begin its columns, and a list.
            (card("GOTO/1,2,3", "4.5"), false),
            (card("SPINDL/1000,RPM", "  CLW"), false),
            (card("SPINDL/1000,RPM", "CLW,ON"), false),
        ] {
            assert_eq!(inspect_line(line.as_bytes()).identification.is_some(), expected, "{line}");
        }
    }

    #[test]
    fn a_full_line_ends_in_a_dollar_in_column_72_or_behind() {
        let line = |length: usize, end: &str| format!("{}{end}\n", "X".repeat(length));
        assert_eq!(inspect_line(line(71, "$").as_bytes()).full, Some(71));
        assert_eq!(inspect_line(line(73, "$").as_bytes()).full, Some(73));
        for (length, end) in [(70, "$"), (71, "$$"), (71, "$ A"), (90, "$")] {
            assert_eq!(inspect_line(line(length, end).as_bytes()).full, None, "{length} {end}");
        }
    }
}
