//! This module pairs the motions of the programs before and after, and finds out how they differ.

use super::listing::{NONE, ProgramListing};
use super::motion_arrays::{CHORD_MM, PageMotionArrays};

/// The change of a motion. The numbers are stored in the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum PageMotionChange {
    /// It is unchanged.
    Same = 0,
    /// It is slower than it was.
    Slower = 1,
    /// It is faster than it was.
    Faster = 2,
    /// It has another path, did not exist before, or does not exist any more.
    Elsewhere = 3,
}

/// Points that are closer than this are equal, in mm. It covers the errors of coordinates as `f32` and of
/// rounding to the file's decimals.
const SAME_MM: f32 = 0.002;

/// Pairs the motions of a program with the motions before from which they were made, and classifies their
/// changes. Fills `change` and `pair` of both programs.
pub(super) fn pair_motions(
    before: &mut PageMotionArrays,
    after: &mut PageMotionArrays,
    listing: &ProgramListing,
) {
    let origins = find_origin_motions(before, after.ended_by.len(), listing);
    before.change = vec![PageMotionChange::Elsewhere as u8; before.statement.len()];
    before.pair = vec![NONE; before.statement.len()];
    // Several motions of one statement (a drilled hole) are paired in their order.
    let mut last = (NONE, 0);
    for motion in 0..after.statement.len() {
        let statement = after.statement.get(motion).copied().unwrap_or(NONE);
        let first = origins.get(statement as usize).copied().unwrap_or(NONE);
        last = if last.0 == statement { (statement, last.1 + 1) } else { (statement, 0) };
        let own = before.statement.get(first as usize);
        let nth = first.saturating_add(last.1);
        let pair = if last.1 > 0 && before.statement.get(nth as usize) == own { nth } else { first };
        let became = compare_motions(before, pair, after, motion);
        after.pair.push(pair);
        after.change.push(became as u8);
        if let Some(change) =
            before.change.get_mut(pair as usize).filter(|_| became != PageMotionChange::Elsewhere)
        {
            *change = became as u8;
        }
        if let Some(back) = before.pair.get_mut(pair as usize).filter(|back| **back == NONE) {
            *back = motion as u32;
        }
    }
}

/// Returns, for each statement of the current program, the motion of the program before that ends at it. For
/// a statement at which none ends, such as an inserted one, it is the motion that ends at the next such
/// statement.
fn find_origin_motions(before: &PageMotionArrays, statements: usize, listing: &ProgramListing) -> Vec<u32> {
    let mut found = vec![NONE; statements];
    // This runs backwards, because an inserted statement belongs to the motion that comes after it.
    let ends = listing.origins.iter().zip(&before.ended_by).rev();
    let mut ends = ends.filter(|(origin, _)| **origin != NONE).peekable();
    let mut next = NONE;
    for (statement, place) in found.iter_mut().enumerate().rev() {
        if let Some((_, motion)) = ends.next_if(|(origin, _)| **origin as usize == statement)
            && *motion != NONE
        {
            next = *motion;
        }
        *place = next;
    }
    found
}

fn compare_motions(
    before: &PageMotionArrays,
    pair: u32,
    after: &PageMotionArrays,
    motion: usize,
) -> PageMotionChange {
    let pair = pair as usize;
    let (old, new) = (before.motion_vertices(pair), after.motion_vertices(motion));
    if old.is_empty() || !new.iter().all(|point| is_on_path(old, *point)) {
        return PageMotionChange::Elsewhere;
    }
    let feeds = before.feed.get(pair).zip(after.feed.get(motion));
    match feeds {
        // The feeds are `f32` numbers of about seven digits, so a smaller difference may be nothing but
        // rounding.
        Some((old, new)) if *new < *old * (1.0 - 1e-5) => PageMotionChange::Slower,
        Some((old, new)) if *new > *old * (1.0 + 1e-5) => PageMotionChange::Faster,
        // The feed of a rapid is NaN, which is neither slower nor faster than anything. Without this arm, a
        // rapid that became a motion at feed would count as unchanged.
        Some((old, new)) if old.is_nan() != new.is_nan() => PageMotionChange::Elsewhere,
        _ => PageMotionChange::Same,
    }
}

/// Returns whether a point lies on a path of chords.
fn is_on_path(path: &[[f32; 3]], point: [f32; 3]) -> bool {
    // When a step splits an arc, its chords end at other points, and both the old and the new chords may be
    // `CHORD_MM` away from the arc.
    let most = if path.len() > 2 { 2.0 * CHORD_MM as f32 + SAME_MM } else { SAME_MM };
    path.windows(2).any(|ends| match ends {
        [from, to] => distance_to_chord(*from, *to, point) <= most,
        _ => false,
    })
}

fn distance_to_chord(from: [f32; 3], to: [f32; 3], point: [f32; 3]) -> f32 {
    let sub = |a: [f32; 3], b: [f32; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let (chord, reach) = (sub(to, from), sub(point, from));
    let long = dot(chord, chord);
    let share = if long > 0.0 { (dot(chord, reach) / long).clamp(0.0, 1.0) } else { 0.0 };
    let off = sub(reach, chord.map(|part| part * share));
    dot(off, off).sqrt()
}
