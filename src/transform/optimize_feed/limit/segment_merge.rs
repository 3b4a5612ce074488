//! This module decides where a block is split. It merges the pieces of the block from the bottom up,
//! beginning with the pair that costs the least time.

use super::classed_pieces::ClassedPiece;
use super::feed_rules::FeedRules;
use super::window_content::{FeedBounds, WindowContent};
use crate::transform::optimize_feed::measure::FeedBlock;
use std::ops::Range;

/// Lengths that differ by no more than this fraction are equal.
const NOISE: f64 = 1e-9;

/// A run of pieces that has one feed.
#[derive(Debug, Clone)]
struct CandidateSegment {
    pieces: Range<usize>,
    length: f64,
    content: WindowContent,
    /// The time at its own feed.
    time: f64,
    /// The sum of the times of its pieces, each at its own feed. No splitting can be faster.
    least_time: f64,
}

/// Divides a block into ranges of pieces, in order.
///
/// Neighbours are merged as long as that loses no more than the fraction `min_change` of the time that their
/// pieces need one by one. A segment that is too short then grows into the neighbour where that costs less
/// time. If there are too many segments, the cheapest pairs are merged.
pub(super) fn merge_into_segments(
    block: &FeedBlock,
    bounds: &FeedBounds,
    pieces: &[ClassedPiece],
    range: Range<usize>,
    rules: &FeedRules,
) -> Vec<Range<usize>> {
    let rule = rules.split.filter(|rule| rule.applies_to(block));
    let Some(rule) = rule else { return vec![range] };
    let path = SegmentMerger { pieces, bounds, programmed: block.programmed };
    let mut segments: Vec<CandidateSegment> = Vec::new();
    for index in range {
        let one = path.build_segment(index..index + 1);
        match segments.last_mut() {
            Some(last) if has_same_limits(last.content, one.content) => {
                *last = path.join_segments(last, &one)
            }
            _ => segments.push(one),
        }
    }
    // Without an air feed, air keeps the programmed feed, which may be the slower one. So it must not be
    // joined to a cut to gain time.
    let apart = |a: &CandidateSegment, b: &CandidateSegment| {
        rules.air_feed.is_none() && a.content.cutting != b.content.cutting
    };
    let cheap = |a: &CandidateSegment, b: &CandidateSegment| {
        let joined = path.join_segments(a, b);
        // With a `min_change` of 0, only a merge that costs no time is cheap. The noise covers the rounding
        // of the sums.
        !apart(a, b) && joined.time <= (1.0 + rules.min_change) * joined.least_time * (1.0 + NOISE)
    };
    // Merging the cheapest pair first keeps the expensive boundaries, as bottom-up segmentation of time
    // series does.
    while let Some(at) = path.find_cheapest_pair(&segments, cheap) {
        path.merge_pair(&mut segments, at);
    }
    // The sum of several pieces may miss the shortest length by a rounding error, and must not grow by a
    // whole piece for that.
    let enough = rule.shortest * (1.0 - NOISE);
    while let Some(at) = find_too_short(&segments, enough) {
        path.grow_segment(&mut segments, at, enough);
    }
    // The number of parts comes last: growing may have removed some already, and merging never makes one too
    // short again.
    while segments.len() > rule.at_most.max(1) {
        match path.find_cheapest_pair(&segments, |_, _| true) {
            Some(at) => path.merge_pair(&mut segments, at),
            None => break,
        }
    }
    segments.into_iter().map(|segment| segment.pieces).collect()
}

fn has_same_limits(a: WindowContent, b: WindowContent) -> bool {
    (a.lowest, a.air, a.cutting) == (b.lowest, b.air, b.cutting)
}

/// Returns the shortest segment that is too short, unless it is the only one.
fn find_too_short(segments: &[CandidateSegment], enough: f64) -> Option<usize> {
    let short = segments.iter().enumerate().filter(|(_, segment)| segment.length < enough);
    let found = short.min_by(|(_, a), (_, b)| a.length.total_cmp(&b.length));
    found.map(|(at, _)| at).filter(|_| segments.len() > 1)
}

/// The pieces of a block, and the bounds of their feeds.
struct SegmentMerger<'a> {
    pieces: &'a [ClassedPiece],
    bounds: &'a FeedBounds,
    programmed: f64,
}

impl SegmentMerger<'_> {
    fn time_min(&self, content: WindowContent, length: f64) -> f64 {
        length / self.bounds.window_feed_mm_min(content).unwrap_or(self.programmed)
    }

    fn build_segment(&self, range: Range<usize>) -> CandidateSegment {
        let (mut content, mut length, mut least_time) = (WindowContent::NOTHING, 0.0, 0.0);
        let own = self.pieces.get(range.clone());
        debug_assert!(own.is_some(), "a segment consists of pieces of the list");
        for piece in own.unwrap_or_default() {
            let own = WindowContent::from_piece(piece, self.pieces);
            content = content.combined_with(own);
            length += piece.length;
            least_time += self.time_min(own, piece.length);
        }
        CandidateSegment { pieces: range, length, content, time: self.time_min(content, length), least_time }
    }

    fn join_segments(&self, a: &CandidateSegment, b: &CandidateSegment) -> CandidateSegment {
        let (content, length) = (a.content.combined_with(b.content), a.length + b.length);
        let least_time = a.least_time + b.least_time;
        CandidateSegment {
            pieces: a.pieces.start..b.pieces.end,
            length,
            content,
            time: self.time_min(content, length),
            least_time,
        }
    }

    /// Returns how much more time other segments need than two given ones, in minutes.
    fn added_time_min(&self, before: [&CandidateSegment; 2], after: &[CandidateSegment]) -> f64 {
        let sum: f64 = after.iter().map(|segment| segment.time).sum();
        before.into_iter().fold(sum, |sum, segment| sum - segment.time)
    }

    /// Returns the index of the first segment of the pair that is cheapest to merge, among the pairs that
    /// `may` be merged. Of equal ones the first counts.
    fn find_cheapest_pair(
        &self,
        segments: &[CandidateSegment],
        may: impl Fn(&CandidateSegment, &CandidateSegment) -> bool,
    ) -> Option<usize> {
        let mut best: Option<(usize, f64)> = None;
        for (at, pair) in segments.windows(2).enumerate() {
            let [a, b] = pair else { continue };
            let cost = self.added_time_min([a, b], &[self.join_segments(a, b)]);
            // `may` is asked last, because it joins the pair once more, and few pairs are the cheapest so
            // far.
            if best.is_none_or(|(_, least)| cost < least) && may(a, b) {
                best = Some((at, cost));
            }
        }
        best.map(|(at, _)| at)
    }

    fn merge_pair(&self, segments: &mut Vec<CandidateSegment>, at: usize) {
        if let (Some(a), Some(b)) = (segments.get(at), segments.get(at + 1)) {
            let joined = self.join_segments(a, b);
            segments.splice(at..at + 2, [joined]);
        }
    }

    /// Gives a segment that is too short a piece of a neighbour, or the whole neighbour if that would itself
    /// be too short without the piece.
    fn grow_segment(&self, segments: &mut Vec<CandidateSegment>, at: usize, enough: f64) {
        let options = [at.checked_sub(1), Some(at)].into_iter().flatten();
        let options = options.filter_map(|first| {
            let (a, b) = (segments.get(first)?, segments.get(first + 1)?);
            // Growing piece by piece leaves the neighbour as much of its own feed as possible.
            let boundary = if first == at { b.pieces.start + 1 } else { a.pieces.end - 1 };
            let (left, right) =
                (self.build_segment(a.pieces.start..boundary), self.build_segment(boundary..b.pieces.end));
            let giver = if first == at { &right } else { &left };
            let new = if giver.length < enough { vec![self.join_segments(a, b)] } else { vec![left, right] };
            Some((self.added_time_min([a, b], &new), first, new))
        });
        if let Some((_, first, new)) = options.min_by(|(a, ..), (b, ..)| a.total_cmp(b)) {
            segments.splice(first..first + 2, new);
        }
    }
}
