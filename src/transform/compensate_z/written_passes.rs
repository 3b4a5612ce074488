//! This module finds the written passes among the motions that were read back.

use crate::program::motion::Motion;
use std::ops::Range;

/// Finds each pass among the new motions. A pass is given by its old motions and by the number of motions
/// that it should have now. Between passes there have to be as many motions as before, of the same classes.
///
/// # Errors
/// Returns the old motion from which on the program does not fit.
pub(super) fn find_written_passes<'a>(
    before: &[Motion],
    after: &[Motion],
    passes: impl Iterator<Item = (&'a Range<usize>, usize)>,
) -> Result<Vec<Range<usize>>, usize> {
    let (mut old, mut new) = (0, 0);
    let mut found = Vec::new();
    for (pass, count) in passes {
        let gap = pass.start.checked_sub(old).ok_or(old)?;
        check_same_motions(before, after, (old, new), gap)?;
        let start = new + gap;
        let written = after.get(start..start + count).ok_or(pass.start)?;
        let first = before.get(pass.start).ok_or(pass.start)?;
        if written.iter().any(|motion| motion.rapid || motion.operation != first.operation) {
            return Err(pass.start);
        }
        found.push(start..start + count);
        (old, new) = (pass.end, start + count);
    }
    let rest = before.len().saturating_sub(old);
    check_same_motions(before, after, (old, new), rest)?;
    if after.len() == new + rest { Ok(found) } else { Err(old.min(before.len().saturating_sub(1))) }
}

fn check_same_motions(
    before: &[Motion],
    after: &[Motion],
    (old, new): (usize, usize),
    count: usize,
) -> Result<(), usize> {
    let one = before.get(old..old + count).ok_or(old)?;
    let other = after.get(new..new + count).ok_or(old)?;
    let same = |(one, other): (&Motion, &Motion)| {
        // Points are not compared, because those around a pass may have moved with its ends.
        one.rapid == other.rapid
            && one.feed == other.feed
            && one.operation == other.operation
            && one.tool == other.tool
    };
    match one.iter().zip(other).position(|pair| !same(pair)) {
        Some(at) => Err(old + at),
        None => Ok(()),
    }
}
