//! This module patches numbers in a statement's text, each in its own style.

use super::file_style::FileStyle;
use super::line_columns::{JoinedText, fit_lines_in_place};
use crate::number::NumberFormat;
use crate::parse::StatementNumbers;
use crate::program::{NumberRole, Record};
use std::borrow::Cow;

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
    let patched = patch_existing_numbers(text, record, edits, style);
    debug_assert!(patched.is_ok(), "the text has no number {patched:?}");
    patched.ok().flatten()
}

/// Patches numbers as [`patch_numbers`] does.
///
/// # Errors
/// Returns the first index of `edits` that is not that of a number of the text.
fn patch_existing_numbers(
    text: &[u8],
    record: &Record,
    edits: &[(usize, f64)],
    style: &FileStyle,
) -> Result<Option<Vec<u8>>, usize> {
    let mut patcher = NumberPatcher::default();
    patcher.numbers.read(record, text);
    patcher.edits.extend_from_slice(edits);
    let changed = patcher.patch(text, style)?;
    Ok(changed.then_some(patcher.out))
}

/// The memory in which the numbers of one statement after the other are patched.
#[derive(Debug, Default)]
pub(super) struct NumberPatcher {
    /// The numbers of the statement.
    pub(super) numbers: StatementNumbers,
    /// Their new values: pairs of a number's index and its value.
    pub(super) edits: Vec<(usize, f64)>,
    /// The patched text.
    pub(super) out: Vec<u8>,
    /// A number that is being printed.
    printed: Vec<u8>,
}

impl NumberPatcher {
    /// Patches a text, whose numbers were read, by the edits. Returns whether `out` is another text.
    ///
    /// # Errors
    /// Returns the first index of the edits that is not that of a number of the text.
    pub(super) fn patch(&mut self, text: &[u8], style: &FileStyle) -> Result<bool, usize> {
        let count = self.numbers.places.len();
        if let Some((missing, _)) = self.edits.iter().find(|(index, _)| *index >= count) {
            return Err(*missing);
        }
        let changed = self.reprint_numbers(text, style, |role, original, old, wanted| {
            let mut form = style.changed_format(role, original);
            if role == NumberRole::Feed {
                // Feeds span four powers of ten (0.002 inch/rev, 9000 mm/min), so their tolerance is relative.
                form.tolerance = form.tolerance.min(wanted.abs() * FEED_SHARE);
            }
            (form, wanted - old)
        });
        Ok(changed && self.out != text)
    }

    /// Prints the numbers of the edits anew, except those that do not change; `form` returns how, and by how much a
    /// number changes. Returns whether a number changes.
    fn reprint_numbers(
        &mut self,
        text: &[u8],
        style: &FileStyle,
        form: impl Fn(NumberRole, &[u8], f64, f64) -> (NumberFormat, f64),
    ) -> bool {
        let Self { numbers: StatementNumbers { places, roles, .. }, edits, out, printed } = self;
        // In a full line a number may be broken; it is patched as one and broken again.
        let joined = JoinedText::new(text, places, style.full_column);
        let whole = &*joined.text;
        out.clear();
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
            let (form, change) = form(role, original, *old, wanted);
            form.write_number(wanted, change, printed);
            let before = whole.get(copied..at.start).unwrap_or_default();
            if style.columns {
                push_in_column(out, before, at.len(), printed);
            } else {
                out.extend_from_slice(before);
                out.extend_from_slice(printed);
            }
            copied = at.end;
        }
        if copied == 0 {
            return false;
        }
        out.extend_from_slice(whole.get(copied..).unwrap_or_default());
        fit_lines_in_place(text, out, style.full_column);
        true
    }
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
    let mut patcher = NumberPatcher::default();
    patcher.numbers.read(record, text);
    patcher.edits.extend_from_slice(values);
    let changed = patcher.reprint_numbers(text, style, |role, original, _, _| {
        let (least, of_file) = match role {
            NumberRole::Direction(_) | NumberRole::ArcAxis(_) | NumberRole::FrameAxis(..) => {
                (DIRECTION_DECIMALS, 0)
            }
            _ => (LENGTH_DECIMALS, style.role_decimals(role)),
        };
        let mut form = style.changed_format(role, original);
        form.decimals = form.decimals.max(of_file).max(least);
        form.tolerance = f64::INFINITY;
        (form, 0.0)
    });
    if changed { patcher.out } else { text.to_vec() }
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
fn push_in_column(out: &mut Vec<u8>, before: &[u8], old_length: usize, printed: &[u8]) {
    let blanks = before.iter().rev().take_while(|&&byte| byte == b' ').count();
    let kept = before.get(..before.len() - blanks).unwrap_or_default();
    let width = blanks + old_length;
    // If only blanks, and no comma, separate a number from the text before it, one blank must stay.
    let least =
        usize::from(blanks > 0 && !matches!(kept.last(), None | Some(b',' | b'/' | b'(' | b'\n' | b'\r')));
    out.extend_from_slice(kept);
    out.extend(std::iter::repeat_n(b' ', width.saturating_sub(printed.len()).max(least)));
    out.extend_from_slice(printed);
}
