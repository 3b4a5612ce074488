//! This module patches numbers in a statement's text, each in its own style.

use super::file_style::FileStyle;
use super::line_columns::{JoinedText, fit_lines};
use crate::parse;
use crate::program::{NumberRole, Record};
use std::borrow::Cow;
use std::ops::Range;

/// A change below this fraction of the value is noise of the arithmetic and not an edit.
const NOISE: f64 = 1e-13;

/// The fraction of a feed to which it is printed at least.
pub(crate) const FEED_SHARE: f64 = 1e-3;

/// The fewest decimals of a unit vector in a new statement. CATIA prints its start tangents with five.
const DIRECTION_DECIMALS: usize = 5;

/// The fewest decimals of other numbers in a new statement.
const LENGTH_DECIMALS: usize = 4;

/// Returns the text with new values for some of its numbers, or `None` if nothing changes.
///
/// `edits` are pairs of a number's index (in the order of the text) and its new value. Numbers keep their
/// decimals, or get more if fewer would lose the edit. In dialects with columns they keep their column.
/// Everything else stays unchanged. A value that is not finite is ignored; [`super::ProgramEditor`] refuses
/// it. Every index must be that of a number of the text.
pub(crate) fn patch_numbers(
    text: &[u8],
    record: &Record,
    edits: &[(usize, f64)],
    style: &FileStyle,
) -> Option<Vec<u8>> {
    let places = parse::statement_numbers(text);
    let patched = patch_existing_numbers((text, &places), record, edits, style);
    debug_assert!(patched.is_ok(), "the text has no number {patched:?}");
    patched.ok().flatten()
}

/// Patches numbers as [`patch_numbers`] does; the numbers of the text and their places were read.
///
/// # Errors
/// Returns the first index of `edits` that is not that of a number of the text.
pub(super) fn patch_existing_numbers(
    (text, places): (&[u8], &[(Range<usize>, f64)]),
    record: &Record,
    edits: &[(usize, f64)],
    style: &FileStyle,
) -> Result<Option<Vec<u8>>, usize> {
    if let Some((missing, _)) = edits.iter().find(|(index, _)| *index >= places.len()) {
        return Err(*missing);
    }
    let out = reprint_numbers((text, places), record, edits, style, |role, original, old, wanted| {
        let mut form = style.changed_format(role, original);
        if role == NumberRole::Feed {
            // Feeds span four powers of ten (0.002 inch/rev, 9000 mm/min), so their tolerance is relative.
            form.tolerance = form.tolerance.min(wanted.abs() * FEED_SHARE);
        }
        form.format_number(wanted, wanted - old)
    });
    Ok(out.filter(|out| out != text))
}

/// Returns a statement's text with other values for some of its numbers, for a new statement in the form of
/// an old one.
///
/// The numbers are rounded to the decimals of the old ones, or to those of the file if it has more, but to at
/// least four (unit vectors: five). So they are off by at most half of the last decimal. Values for numbers that
/// the text does not have are left out: a GOTO without axis takes the point of one with axis.
pub(crate) fn copy_with_numbers(
    text: &[u8],
    record: &Record,
    values: &[(usize, f64)],
    style: &FileStyle,
) -> Vec<u8> {
    let places = parse::statement_numbers(text);
    let out = reprint_numbers((text, &places), record, values, style, |role, original, _, wanted| {
        let (least, of_file) = match role {
            NumberRole::Direction(_) | NumberRole::ArcAxis(_) | NumberRole::FrameAxis(..) => {
                (DIRECTION_DECIMALS, 0)
            }
            _ => (LENGTH_DECIMALS, style.role_decimals(role)),
        };
        let mut form = style.changed_format(role, original);
        form.decimals = form.decimals.max(of_file).max(least);
        form.tolerance = f64::INFINITY;
        form.format_number(wanted, 0.0)
    });
    out.unwrap_or_else(|| text.to_vec())
}

/// Prints the numbers of `edits` anew, except those that do not change; `places` are all numbers of the text.
/// Returns the text, or `None` if no number changes.
fn reprint_numbers(
    (text, places): (&[u8], &[(Range<usize>, f64)]),
    record: &Record,
    edits: &[(usize, f64)],
    style: &FileStyle,
    print: impl Fn(NumberRole, &[u8], f64, f64) -> String,
) -> Option<Vec<u8>> {
    let roles = parse::number_roles(record, text);
    // In a full line a number may be broken; it is patched as one and broken again.
    let joined = JoinedText::new(text, places, style.full_column);
    let whole = &*joined.text;
    let mut out = Vec::with_capacity(text.len() + 16);
    let mut copied = 0;
    // One pass goes through both lists, because a statement may have hundreds of thousands of numbers.
    let edits = in_number_order(edits);
    let mut edits = edits.iter().copied().peekable();
    for (index, (at, old)) in places.iter().enumerate() {
        let Some((_, wanted)) = edits.next_if(|(edited, _)| *edited == index) else { continue };
        // If a number has two new values, the first one counts.
        while edits.next_if(|(edited, _)| *edited == index).is_some() {}
        if !wanted.is_finite() || (wanted - old).abs() <= NOISE * old.abs().max(1.0) {
            continue;
        }
        let role = roles.get(index).copied().unwrap_or(NumberRole::Plain);
        let at = joined.joined_offset(at.start)..joined.joined_offset(at.end);
        let original = whole.get(at.clone()).unwrap_or_default();
        let printed = print(role, original, *old, wanted);
        let before = whole.get(copied..at.start).unwrap_or_default();
        if style.columns {
            push_in_column(&mut out, before, at.len(), &printed);
        } else {
            out.extend_from_slice(before);
            out.extend_from_slice(printed.as_bytes());
        }
        copied = at.end;
    }
    if copied == 0 {
        return None;
    }
    out.extend_from_slice(whole.get(copied..).unwrap_or_default());
    Some(fit_lines(text, out, style.full_column))
}

fn in_number_order(edits: &[(usize, f64)]) -> Cow<'_, [(usize, f64)]> {
    if edits.is_sorted_by_key(|(index, _)| *index) {
        return Cow::Borrowed(edits);
    }
    let mut edits = edits.to_vec();
    edits.sort_by_key(|(index, _)| *index);
    Cow::Owned(edits)
}

/// Ends the number in the column where the old one ended, by removing blanks before it or adding some.
fn push_in_column(out: &mut Vec<u8>, before: &[u8], old_length: usize, printed: &str) {
    let blanks = before.iter().rev().take_while(|&&byte| byte == b' ').count();
    let kept = before.get(..before.len() - blanks).unwrap_or_default();
    let width = blanks + old_length;
    // If only blanks, and no comma, separate a number from the text before it, one blank must stay.
    let least =
        usize::from(blanks > 0 && !matches!(kept.last(), None | Some(b',' | b'/' | b'(' | b'\n' | b'\r')));
    out.extend_from_slice(kept);
    out.extend(std::iter::repeat_n(b' ', width.saturating_sub(printed.len()).max(least)));
    out.extend_from_slice(printed.as_bytes());
}
