//! This module finds which statement of one program corresponds to which statement of the other.
//!
//! It is a patience diff (Bram Cohen). First, equal statements at both ends of the programs are paired. Then
//! the statements that occur exactly once in both programs are paired; they are the anchors. Between anchors,
//! statements are paired by their shape, in windows of bounded size.
//!
//! Except for sorting, the time is linear, so that files of millions of statements can be compared. The
//! search has no time limit, so the result does not depend on the speed of the machine.

use super::alignment_keys::AlignmentKeys;
use crate::program::StatementId;
use similar::{Algorithm, DiffOp, capture_diff_slices};
use std::ops::Range;

/// The number of statements in a window. The time for a window grows at most with its square.
const WINDOW: usize = 512;

/// A run of the alignment. Positions are indices of live statements, from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::report) enum AlignmentRun {
    /// Ranges of equal length in both programs, whose statements correspond one to one.
    Pairs(Range<usize>, Range<usize>),
    /// Statements of the first program only, and their position in the second.
    Removed(Range<usize>, usize),
    /// Statements of the second program only, and their position in the first.
    Added(usize, Range<usize>),
}

/// The alignment of two programs.
#[derive(Debug)]
pub(in crate::report) struct StatementAlignment {
    /// The runs in order. Together they hold every live statement of both programs.
    pub runs: Vec<AlignmentRun>,
    /// The live statements of the first program.
    pub ids_a: Vec<StatementId>,
    /// The live statements of the second program.
    pub ids_b: Vec<StatementId>,
}

/// Aligns two programs. `shifted` returns whether one range of statements is another one of the same shape,
/// displaced as a whole. Such ranges are paired one to one, even if single statements happen to equal
/// statements at other positions.
pub(super) fn align_statements(
    a: &AlignmentKeys,
    b: &AlignmentKeys,
    shifted: impl Fn(Range<usize>, Range<usize>) -> bool,
) -> Vec<AlignmentRun> {
    let mut out = AlignmentBuilder { a, b, runs: Vec::new() };
    let (head, tail) = count_equal_ends(&a.meaning, &b.meaning);
    let (middle_a, middle_b) = (head..a.len() - tail, head..b.len() - tail);
    out.push_pairs(0..head, 0..head);
    let anchors = find_anchors(a, &middle_a, b, &middle_b);
    if out.have_same_shape(&middle_a, &middle_b) {
        let at_place = out.count_equal_in_place(&middle_a, &middle_b);
        // With equal shapes throughout, a step has most likely edited numbers in place. Anchors count against
        // that only if they are many, and more than the statements that are equal in place.
        let few = anchors.len() * 2 < middle_a.len();
        if few || at_place >= anchors.len() || shifted(middle_a.clone(), middle_b.clone()) {
            out.push_pairs(middle_a.clone(), middle_b.clone());
            out.push_pairs(middle_a.end..a.len(), middle_b.end..b.len());
            return out.runs;
        }
    }
    let (mut at_a, mut at_b) = (middle_a.start, middle_b.start);
    for (anchor_a, anchor_b) in anchors {
        out.align_gap(at_a..anchor_a, at_b..anchor_b);
        out.push_pairs(anchor_a..anchor_a + 1, anchor_b..anchor_b + 1);
        (at_a, at_b) = (anchor_a + 1, anchor_b + 1);
    }
    out.align_gap(at_a..middle_a.end, at_b..middle_b.end);
    out.push_pairs(middle_a.end..a.len(), middle_b.end..b.len());
    out.runs
}

fn count_equal_ends<T: PartialEq>(a: &[T], b: &[T]) -> (usize, usize) {
    let head = a.iter().zip(b).take_while(|(a, b)| a == b).count();
    let rest = a.len().min(b.len()) - head;
    let tail = a.iter().rev().zip(b.iter().rev()).take(rest).take_while(|(a, b)| a == b).count();
    (head, tail)
}

fn slice_range<'k, T>(keys: &'k [T], range: &Range<usize>) -> &'k [T] {
    keys.get(range.clone()).unwrap_or_default()
}

/// Returns pairs of statements that occur once in both. Of all such pairs, it returns the longest chain that
/// is in order in both programs.
fn find_anchors(
    a: &AlignmentKeys,
    in_a: &Range<usize>,
    b: &AlignmentKeys,
    in_b: &Range<usize>,
) -> Vec<(usize, usize)> {
    let (once_a, once_b) = (find_unique_keys(a, in_a), find_unique_keys(b, in_b));
    let mut pairs = Vec::new();
    let mut others = once_b.into_iter().peekable();
    for (key, at_a) in once_a {
        while others.next_if(|(other, _)| *other < key).is_some() {}
        if let Some((_, at_b)) = others.next_if(|(other, _)| *other == key) {
            pairs.push((at_a as usize, at_b as usize));
        }
    }
    pairs.sort_unstable();
    find_longest_ascending(&pairs)
}

/// Returns the keys that occur once in a range, with their positions, sorted by key.
fn find_unique_keys(keys: &AlignmentKeys, range: &Range<usize>) -> Vec<(u64, u32)> {
    let placed = slice_range(&keys.meaning, range).iter().zip(range.clone());
    let mut sorted: Vec<(u64, u32)> = placed.map(|(key, at)| (*key, at as u32)).collect();
    sorted.sort_unstable();
    let groups = sorted.chunk_by(|(one, _), (other, _)| one == other);
    groups.filter_map(|group| if let [only] = group { Some(*only) } else { None }).collect()
}

/// Returns the longest subsequence of pairs whose second elements ascend (patience sorting).
fn find_longest_ascending(pairs: &[(usize, usize)]) -> Vec<(usize, usize)> {
    let mut tops: Vec<(usize, usize)> = Vec::new();
    let mut before: Vec<Option<usize>> = Vec::with_capacity(pairs.len());
    for (index, (_, at_b)) in pairs.iter().enumerate() {
        // The tops of the piles ascend, so bisection finds the pile, and the whole search takes n log n
        // steps.
        let pile = tops.partition_point(|(top, _)| top < at_b);
        before.push(pile.checked_sub(1).and_then(|left| tops.get(left)).map(|(_, index)| *index));
        match tops.get_mut(pile) {
            Some(top) => *top = (*at_b, index),
            None => tops.push((*at_b, index)),
        }
    }
    let mut chain = Vec::with_capacity(tops.len());
    let mut next = tops.last().map(|(_, index)| *index);
    while let Some(index) = next {
        chain.extend(pairs.get(index).copied());
        next = before.get(index).copied().flatten();
    }
    chain.reverse();
    chain
}

struct AlignmentBuilder<'k> {
    a: &'k AlignmentKeys,
    b: &'k AlignmentKeys,
    runs: Vec<AlignmentRun>,
}

impl AlignmentBuilder<'_> {
    fn have_same_shape(&self, a: &Range<usize>, b: &Range<usize>) -> bool {
        slice_range(&self.a.shape, a) == slice_range(&self.b.shape, b)
    }

    fn count_equal_in_place(&self, a: &Range<usize>, b: &Range<usize>) -> usize {
        slice_range(&self.a.meaning, a)
            .iter()
            .zip(slice_range(&self.b.meaning, b))
            .filter(|(a, b)| a == b)
            .count()
    }

    fn push_pairs(&mut self, a: Range<usize>, b: Range<usize>) {
        if a.is_empty() {
            return;
        }
        match self.runs.last_mut() {
            Some(AlignmentRun::Pairs(last_a, last_b)) if last_a.end == a.start && last_b.end == b.start => {
                (last_a.end, last_b.end) = (a.end, b.end);
            }
            _ => self.runs.push(AlignmentRun::Pairs(a, b)),
        }
    }

    fn push_unpaired(&mut self, a: Range<usize>, b: Range<usize>) {
        if !a.is_empty() {
            self.runs.push(AlignmentRun::Removed(a.clone(), b.start));
        }
        if !b.is_empty() {
            self.runs.push(AlignmentRun::Added(a.end, b));
        }
    }

    /// Aligns the statements between two anchors: first equal ones that occur more than once, then equal
    /// shapes.
    fn align_gap(&mut self, a: Range<usize>, b: Range<usize>) {
        if a.is_empty() || b.is_empty() {
            return self.push_unpaired(a, b);
        }
        let (head, tail) =
            count_equal_ends(slice_range(&self.a.meaning, &a), slice_range(&self.b.meaning, &b));
        self.push_pairs(a.start..a.start + head, b.start..b.start + head);
        let inner_a = a.start + head..a.end - tail;
        let inner_b = b.start + head..b.end - tail;
        // Equal shapes throughout mean that only numbers were changed, so each statement belongs to the one
        // in its place.
        if self.have_same_shape(&inner_a, &inner_b) {
            self.push_pairs(inner_a.clone(), inner_b.clone());
        } else {
            self.align_by_meaning(&inner_a, &inner_b);
        }
        self.push_pairs(inner_a.end..a.end, inner_b.end..b.end);
    }

    fn align_by_meaning(&mut self, a: &Range<usize>, b: &Range<usize>) {
        for (equal, a, b) in diff_in_windows(&self.a.meaning, a, &self.b.meaning, b) {
            if equal { self.push_pairs(a, b) } else { self.align_by_shape(&a, &b) }
        }
    }

    fn align_by_shape(&mut self, a: &Range<usize>, b: &Range<usize>) {
        for (equal, a, b) in diff_in_windows(&self.a.shape, a, &self.b.shape, b) {
            if equal { self.push_pairs(a, b) } else { self.push_unpaired(a, b) }
        }
    }
}

/// Compares two sequences window by window. Returns consecutive ranges of both, each with whether they are
/// equal. Unless both sequences end within a window, its result only counts up to the last equal range that
/// begins in its first three quarters, because the rest may depend on statements beyond the window.
fn diff_in_windows<T: std::hash::Hash + Eq + Ord + Clone>(
    a: &[T],
    in_a: &Range<usize>,
    b: &[T],
    in_b: &Range<usize>,
) -> Vec<(bool, Range<usize>, Range<usize>)> {
    let (mut at_a, mut at_b) = (in_a.start, in_b.start);
    let mut out: Vec<(bool, Range<usize>, Range<usize>)> = Vec::new();
    while at_a < in_a.end || at_b < in_b.end {
        let to_a = (at_a + WINDOW).min(in_a.end);
        let to_b = (at_b + WINDOW).min(in_b.end);
        let last = to_a == in_a.end && to_b == in_b.end;
        let ops = capture_diff_slices(
            Algorithm::Myers,
            slice_range(a, &(at_a..to_a)),
            slice_range(b, &(at_b..to_b)),
        );
        let early =
            |op: &DiffOp| op.old_range().start < WINDOW * 3 / 4 && op.new_range().start < WINDOW * 3 / 4;
        let equal = |op: &&DiffOp| matches!(op, DiffOp::Equal { .. });
        // Without an equal range early in the window there is nothing to continue from, so the whole window
        // is kept.
        let kept = ops.iter().rposition(|op| equal(&op) && early(op)).map_or(ops.len(), |at| at + 1);
        let kept = if last { ops.len() } else { kept };
        let (base_a, base_b) = (at_a, at_b);
        for op in ops.iter().take(kept) {
            let (old, new) = (op.old_range(), op.new_range());
            let old = base_a + old.start..base_a + old.end;
            let new = base_b + new.start..base_b + new.end;
            (at_a, at_b) = (old.end, new.end);
            append_range_pair(&mut out, equal(&op), old, new);
        }
    }
    out
}

fn append_range_pair(
    out: &mut Vec<(bool, Range<usize>, Range<usize>)>,
    equal: bool,
    a: Range<usize>,
    b: Range<usize>,
) {
    match out.last_mut() {
        Some((last, last_a, last_b)) if *last == equal && last_a.end == a.start && last_b.end == b.start => {
            (last_a.end, last_b.end) = (a.end, b.end);
        }
        _ => out.push((equal, a, b)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(meaning: &[u64], shape: &[u32]) -> AlignmentKeys {
        AlignmentKeys { ids: Vec::new(), meaning: meaning.into(), shape: shape.into() }
    }

    #[test]
    fn an_insertion_between_changed_points_is_found_by_shape() {
        let a = keys(&[1, 2, 3], &[7, 7, 7]);
        let b = keys(&[11, 9, 12, 13], &[7, 8, 7, 7]);
        let runs = align_statements(&a, &b, |_, _| false);
        assert_eq!(
            runs,
            [AlignmentRun::Pairs(0..1, 0..1), AlignmentRun::Added(1, 1..2), AlignmentRun::Pairs(1..3, 2..4)]
        );
    }

    #[test]
    fn a_removed_statement_among_equal_shapes_is_found_by_its_neighbours() {
        let a = keys(&[1, 2, 3, 4], &[7; 4]);
        let b = keys(&[1, 3, 4, 5], &[7; 4]);
        let runs = align_statements(&a, &b, |_, _| false);
        assert_eq!(
            runs,
            [
                AlignmentRun::Pairs(0..1, 0..1),
                AlignmentRun::Removed(1..2, 1),
                AlignmentRun::Pairs(2..4, 1..3),
                AlignmentRun::Added(4, 3..4)
            ]
        );
    }

    #[test]
    fn windows_cover_everything_once() {
        let a: Vec<u64> = (0..5000).map(|n| n * n % 17).collect();
        let b: Vec<u64> = (0..4000).map(|n| n * n % 13).collect();
        let (mut at_a, mut at_b) = (0, 0);
        for (equal, in_a, in_b) in diff_in_windows(&a, &(0..a.len()), &b, &(0..b.len())) {
            assert_eq!((in_a.start, in_b.start), (at_a, at_b));
            assert!(!equal || a[in_a.clone()] == b[in_b.clone()]);
            (at_a, at_b) = (in_a.end, in_b.end);
        }
        assert_eq!((at_a, at_b), (a.len(), b.len()));
    }
}
