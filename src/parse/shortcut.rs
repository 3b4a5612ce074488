//! This module is a shortcut for plain GOTO lines, which are most of every file, and for the comments that
//! clsmith itself writes before them.
//!
//! It must agree with the grammar or decline; the property test `shortcut_agrees_with_the_grammar` checks
//! this.

use super::statement_limit::is_readable_length;
use crate::number::parse_plain_decimal;
use crate::program::OWN_WORD;
use crate::program::record::{Goto, has_direction};
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// Reads `GOTO/x,y,z[,i,j,k]`, with blanks and a `$` continuation as CATIA and Creo write them.
///
/// Returns the record and its length in bytes with the line end. Returns `None` for anything else, including
/// comments and exponents.
#[inline]
pub(super) fn read_plain_goto(text: &[u8]) -> Option<(Goto, usize)> {
    let scan = scan_goto(text)?;
    let [x, y, z, i, j, k] = scan.values;
    let axis = match scan.count {
        3 => None,
        // An axis without direction is an error, which the grammar reports.
        _ => Some(Vector3::new(i, j, k)).filter(has_direction).map(Some)?,
    };
    Some((Goto { point: Point3::new(x, y, z), axis }, scan.end))
}

/// Returns the numbers of such a line with their places in it.
pub(super) fn plain_goto_numbers(text: &[u8]) -> Option<Vec<(Range<usize>, f64)>> {
    let mut numbers = Vec::new();
    add_plain_goto_numbers(text, &mut numbers).then_some(numbers)
}

/// Adds the numbers of such a line to a list. Returns whether the text is one; if not, none is added.
pub(super) fn add_plain_goto_numbers(text: &[u8], into: &mut Vec<(Range<usize>, f64)>) -> bool {
    let Some(scan) = scan_goto(text).filter(|scan| scan.end == text.len()) else { return false };
    let numbers = scan.places.into_iter().zip(scan.values).take(scan.count);
    into.extend(numbers.map(|((start, end), value)| (start..end, value)));
    true
}

/// Returns the length, with its line end, of a comment of clsmith's own at the start of a text. Comments
/// longer than clsmith writes are left to the grammar.
pub(super) fn provenance_comment_length(text: &[u8]) -> Option<usize> {
    text.strip_prefix(b"$$ ")?.strip_prefix(OWN_WORD.as_bytes())?.strip_prefix(b" ")?;
    let line = text.get(..OWN_LENGTH).unwrap_or(text);
    match memchr::memchr2(b'\n', b'\r', line) {
        Some(end) => Some(end + if text.get(end..end + 2) == Some(b"\r\n") { 2 } else { 1 }),
        None => (line.len() == text.len()).then_some(text.len()),
    }
}

/// The longest comment in bytes that the shortcut takes.
const OWN_LENGTH: usize = 128;

/// The values of a GOTO line, their places, their number, and the end of the line.
struct GotoScan {
    values: [f64; 6],
    places: [(usize, usize); 6],
    count: usize,
    end: usize,
}

/// Scans a GOTO line; returns `None` if it is not plain.
#[inline(always)]
fn scan_goto(text: &[u8]) -> Option<GotoScan> {
    let mut at = text.strip_prefix(b"GOTO").map(|_| 4)?;
    at = skip_blanks(text, at);
    if text.get(at) != Some(&b'/') {
        return None;
    }
    at += 1;
    let mut scan = GotoScan { values: [0.0; 6], places: [(0, 0); 6], count: 0, end: 0 };
    for (value, place) in scan.values.iter_mut().zip(&mut scan.places) {
        at = skip_blanks(text, at);
        let (number, length) = parse_plain_decimal(text.get(at..)?)?;
        *value = number;
        *place = (at, at + length);
        scan.count += 1;
        at = skip_blanks(text, at + length);
        if text.get(at) != Some(&b',') {
            break;
        }
        // A comma after six values means more values, or a `$` that may continue past the end of the file.
        if scan.count == 6 {
            return None;
        }
        at = skip_continuation(text, at + 1)?;
    }
    scan.end = find_line_end(text, at)?;
    (matches!(scan.count, 3 | 6) && is_readable_length(text.get(..scan.end)?)).then_some(scan)
}

/// Skips blanks.
#[inline]
fn skip_blanks(text: &[u8], mut at: usize) -> usize {
    while text.get(at) == Some(&b' ') {
        at += 1;
    }
    at
}

/// Skips blanks and, after a comma, one `$` with its line end. Returns `None` if a comment follows the `$`.
#[inline]
fn skip_continuation(text: &[u8], at: usize) -> Option<usize> {
    let at = skip_blanks(text, at);
    if text.get(at) != Some(&b'$') {
        return Some(at);
    }
    match text.get(at + 1..)? {
        [b'\n', ..] => Some(at + 2),
        [b'\r', b'\n', ..] => Some(at + 3),
        _ => None,
    }
}

/// Returns the end of the line if it only has blanks from `at` on. The end of the text counts as a line end.
#[inline]
fn find_line_end(text: &[u8], at: usize) -> Option<usize> {
    let at = skip_blanks(text, at);
    match text.get(at..)? {
        [] => Some(at),
        [b'\n', ..] => Some(at + 1),
        [b'\r', b'\n', ..] => Some(at + 2),
        // A lone CR also ends a line, but only the grammar decides what follows it.
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::{provenance_comment_length, read_plain_goto};
    use crate::parse::split_by_grammar;
    use crate::program::Record;
    use proptest::prelude::*;

    /// Checks that the shortcut declines or gives what the grammar gives: the same record bit for bit, the
    /// same length, and no finding.
    fn agrees(text: &[u8]) -> Result<bool, TestCaseError> {
        let Some((short, length)) = read_plain_goto(text) else { return Ok(false) };
        let (syntax, full_length) = split_by_grammar(text);
        prop_assert!(!syntax.open, "open: {:?}", String::from_utf8_lossy(text));
        prop_assert_eq!(length, full_length, "{:?}", String::from_utf8_lossy(text));
        let Ok(Record::Goto(full)) = Record::read(&syntax) else {
            return Err(TestCaseError::fail(format!("{:?} {syntax:?}", String::from_utf8_lossy(text))));
        };
        let bits = |goto: &crate::program::record::Goto| {
            (goto.point.coords.map(f64::to_bits), goto.axis.map(|axis| axis.map(f64::to_bits)))
        };
        prop_assert_eq!(bits(&short), bits(&full));
        Ok(true)
    }

    /// Makes values that are mostly plain, so that most lines have at most one unusual part and are close to
    /// the shortcut's limits.
    fn value() -> impl Strategy<Value = String> {
        prop_oneof![
            40 => "-?[0-9]{1,4}\\.[0-9]{0,10}",
            2 => "-?[0-9]{0,3}\\.?[0-9]{0,3}",
            1 => "[+-]{0,2}[0-9]{1,2}([eEdD][+-]?[0-9]{1,3})?",
            1 => "[0-9]{14,22}\\.[0-9]{0,22}",
            1 => "-?0(\\.0{0,12})?",
            1 => "[0-9A-Z.]{0,6}",
        ]
    }

    /// Makes the text between two values.
    fn between() -> impl Strategy<Value = String> {
        prop_oneof![
            40 => " {0,3}, {0,3}",
            8 => Just(",  $\n".to_owned()),
            1 => Just(",$\r\n ".to_owned()),
            1 => "[ ,\t]{0,3}\\$[ x$]{0,2}(\n|\r\n|\r|)[ $,]{0,2}",
            1 => "[ ,/$\t'(]{0,3}",
        ]
    }

    /// Makes the text after the last value.
    fn tail() -> impl Strategy<Value = String> {
        prop_oneof![
            6 => prop::sample::select(vec!["\n", "\r\n", "", " \n", "  \r\n"]).prop_map(str::to_owned),
            2 => "[ ,$]{0,4}(\n|\r\n|\r|)",
            1 => " {0,2}\\$\\$ ?[a-z]{0,3}\n",
            1 => ",?  ?\\$(\n|\r\n|)(0|1,2|[$])?\n?",
            1 => "\r?\r?\n?",
            1 => "[A-Z0-9.,/]{1,3}\n",
        ]
    }

    fn near_goto() -> impl Strategy<Value = String> {
        let head = prop_oneof![
            6 => Just("GOTO/".to_owned()), 2 => "GOTO {0,3}/ {0,4}", 1 => "[ \t]?(GOTO|goto|GOTOX|GO TO|GOT)[ $\t]?/?",
        ];
        let count = prop_oneof![4 => Just(3usize), 4 => Just(6usize), 1 => 0usize..10];
        let values = count.prop_flat_map(|count| prop::collection::vec((value(), between()), count));
        (head, values, tail(), "(GOTO/1,2,3\n)?").prop_map(|(head, values, tail, next)| {
            let last = values.len().saturating_sub(1);
            let mut text = head;
            for (index, (value, between)) in values.into_iter().enumerate() {
                text += &value;
                text += if index == last { "" } else { &between };
            }
            text + &tail + &next
        })
    }

    proptest! {
        #![proptest_config(crate::property::property(4000))]

        #[test]
        fn shortcut_agrees_with_the_grammar(text in near_goto()) {
            agrees(text.as_bytes())?;
        }

        #[test]
        fn shortcut_agrees_after_any_byte_was_changed(text in near_goto(), at in any::<usize>(), byte in any::<u8>()) {
            let mut bytes = text.into_bytes();
            if let Some(length) = Some(bytes.len()).filter(|&length| length > 0) {
                bytes[at % length] = byte;
            }
            agrees(&bytes)?;
        }
    }

    #[test]
    fn shortcut_takes_the_plain_lines_of_every_dialect() {
        for text in [
            "GOTO/1.0000,-2.0000,0.0000\n",
            "GOTO/1.0000,2.0000,3.0000,0.0000000,0.6000000,0.8000000\r\n",
            "GOTO  /   17.00000,    0.00000,    2.00000\n",
            "GOTO / 288.1640937215, 71.2503418896, 133.5817460029,  $\n0.9992386202, -0.0000004711, 0.0390151234\n",
            "GOTO/120.,.5,-0.1",
            "GOTO/ 1.000000,-0.000000,3.000000 \n",
        ] {
            assert!(agrees(text.as_bytes()).unwrap(), "declined: {text}");
        }
    }

    #[test]
    fn shortcut_declines_what_it_does_not_know() {
        for text in [
            "GOTO/1,2,3$$c\n",
            "GOTO/1,2,1E3\n",
            "GOTO/1,2,3,0,0,1,$\n",
            "GOTO/1,2\n",
            "goto/1,2,3\n",
            "GOTO/1,2,3\r",
        ] {
            assert!(!agrees(text.as_bytes()).unwrap(), "{text}");
        }
    }

    proptest! {
        #![proptest_config(crate::property::property(2000))]

        #[test]
        fn own_comments_are_comments_to_the_grammar(text in "\\$\\$ ?clsmith ?[ -~]{0,140}[$]?(\r\n|\n|\r|)(GOTO/1,2,3\n)?") {
            if let Some(length) = provenance_comment_length(text.as_bytes()) {
                let (syntax, end) = crate::parse::split_by_grammar(text.as_bytes());
                prop_assert_eq!(syntax.form, crate::program::StatementKind::Comment);
                prop_assert_eq!(end, length);
                prop_assert!(!syntax.open);
                prop_assert_eq!(Record::read(&syntax).unwrap(), Record::Comment);
            }
        }
    }

    #[test]
    fn own_comments_are_taken() {
        for (text, length) in [
            ("$$ clsmith 0.1.0 x\nGOTO/1,2,3\n", Some(19)),
            ("$$ clsmith a: b\r\n", Some(17)),
            ("$$ clsmith a", Some(12)),
        ] {
            assert_eq!(provenance_comment_length(text.as_bytes()), length, "{text}");
        }
        for text in ["$$ clsmiths\n", "$$-> clsmith \n", " $$ clsmith x\n", "REMARK clsmith x\n"] {
            assert_eq!(provenance_comment_length(text.as_bytes()), None, "{text}");
        }
        let long = format!("$$ clsmith {}", "x".repeat(200));
        assert_eq!(provenance_comment_length(long.as_bytes()), None);
    }
}
