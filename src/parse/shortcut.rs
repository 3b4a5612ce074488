//! A shortcut for plain GOTO lines, which are most of every file.
//!
//! It may only agree with the grammar or decline: the property test `shortcut_agrees_with_the_grammar` holds it to that.

use crate::number::plain_decimal;
use crate::program::record::Goto;
use nalgebra::{Point3, Vector3};

/// Reads `GOTO/x,y,z[,i,j,k]` with blanks and a `$` continuation where CATIA and Creo write them.
///
/// Gives the record and the length in bytes with the line end. `None` for anything else, comments and exponents included.
#[inline]
pub(super) fn goto(text: &[u8]) -> Option<(Goto, usize)> {
    let mut at = text.strip_prefix(b"GOTO").map(|_| 4)?;
    at = blanks(text, at);
    if text.get(at) != Some(&b'/') {
        return None;
    }
    at += 1;
    let mut values = [0.0; 6];
    let mut count = 0;
    for value in &mut values {
        at = blanks(text, at);
        let (number, length) = plain_decimal(text.get(at..)?)?;
        *value = number;
        count += 1;
        at += length;
        at = blanks(text, at);
        if text.get(at) != Some(&b',') {
            break;
        }
        at = continuation(text, at + 1)?;
    }
    let end = line_end(text, at)?;
    let [x, y, z, i, j, k] = values;
    let point = Point3::new(x, y, z);
    let axis = match count {
        3 => None,
        6 => Some(Vector3::new(i, j, k)),
        _ => return None,
    };
    Some((Goto { point, axis }, end))
}

#[inline]
fn blanks(text: &[u8], mut at: usize) -> usize {
    while text.get(at) == Some(&b' ') {
        at += 1;
    }
    at
}

/// Skips blanks and one `$` with its line end after a comma. `None` when a comment follows the `$`.
#[inline]
fn continuation(text: &[u8], at: usize) -> Option<usize> {
    let at = blanks(text, at);
    if text.get(at) != Some(&b'$') {
        return Some(at);
    }
    match text.get(at + 1..)? {
        [b'\n', ..] => Some(at + 2),
        [b'\r', b'\n', ..] => Some(at + 3),
        _ => None,
    }
}

/// The end of the line that may hold only blanks from `at` on; the end of the text counts as one.
#[inline]
fn line_end(text: &[u8], at: usize) -> Option<usize> {
    let at = blanks(text, at);
    match text.get(at..)? {
        [] => Some(at),
        [b'\n', ..] => Some(at + 1),
        [b'\r', b'\n', ..] => Some(at + 2),
        // A lone CR ends a line as well, but only the grammar decides what follows it.
        _ => None,
    }
}
