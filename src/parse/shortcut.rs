//! A shortcut for plain GOTO lines, which are most of every file.
//!
//! It may only agree with the grammar or decline: the property test `shortcut_agrees_with_the_grammar` holds it to that.

use crate::number::plain_decimal;
use crate::program::record::Goto;
use nalgebra::{Point3, Vector3};
use std::ops::Range;

/// Reads `GOTO/x,y,z[,i,j,k]` with blanks and a `$` continuation where CATIA and Creo write them.
///
/// Gives the record and the length in bytes with the line end. `None` for anything else, comments and exponents included.
#[inline]
pub(super) fn goto(text: &[u8]) -> Option<(Goto, usize)> {
    let scan = scan(text)?;
    let [x, y, z, i, j, k] = scan.values;
    let axis = (scan.count == 6).then(|| Vector3::new(i, j, k));
    Some((Goto { point: Point3::new(x, y, z), axis }, scan.end))
}

/// The numbers of such a line with their places in it.
pub(super) fn goto_numbers(text: &[u8]) -> Option<Vec<(Range<usize>, f64)>> {
    let scan = scan(text).filter(|scan| scan.end == text.len())?;
    let numbers = scan.places.into_iter().zip(scan.values).take(scan.count);
    Some(numbers.map(|((start, end), value)| (start..end, value)).collect())
}

struct Scan {
    values: [f64; 6],
    places: [(usize, usize); 6],
    count: usize,
    end: usize,
}

#[inline(always)]
fn scan(text: &[u8]) -> Option<Scan> {
    let mut at = text.strip_prefix(b"GOTO").map(|_| 4)?;
    at = blanks(text, at);
    if text.get(at) != Some(&b'/') {
        return None;
    }
    at += 1;
    let mut scan = Scan { values: [0.0; 6], places: [(0, 0); 6], count: 0, end: 0 };
    for (value, place) in scan.values.iter_mut().zip(&mut scan.places) {
        at = blanks(text, at);
        let (number, length) = plain_decimal(text.get(at..)?)?;
        *value = number;
        *place = (at, at + length);
        scan.count += 1;
        at = blanks(text, at + length);
        if text.get(at) != Some(&b',') {
            break;
        }
        at = continuation(text, at + 1)?;
    }
    scan.end = line_end(text, at)?;
    matches!(scan.count, 3 | 6).then_some(scan)
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
