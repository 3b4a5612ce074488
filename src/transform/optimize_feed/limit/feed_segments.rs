//! This module builds segments of blocks with their limits, from windows over pieces, bounds, and the feeds
//! beside margins.

use super::classed_pieces::{ClassedPiece, PieceClass, group_by_block};
use super::feed_rules::{FeedRules, FeedWindow};
use super::segment_merge::merge_into_segments;
use super::window_content::{FeedBounds, WindowContent};
use crate::transform::optimize_feed::measure::FeedBlock;
use std::ops::Range;

/// Overlaps below this (mm) do not count for a window.
const NOTHING: f64 = 1e-9;

/// A segment of a block that gets one feed.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::transform::optimize_feed) struct FeedSegment {
    pub block: usize,
    pub chain: usize,
    pub pieces: Range<usize>,
    pub length: f64,
    /// Its end as a fraction of the block.
    pub end: f64,
    /// Its feed so far. It starts as the limit.
    pub feed: f64,
    /// The lowest feed that its block allows.
    pub least: f64,
    /// Whether the feed is the programmed one and stays.
    pub fixed: bool,
    /// Whether a limit was below the lowest feed.
    pub below: bool,
}

/// Builds the segments of all blocks that have a length and a known feed, with their limits as feeds.
pub(in crate::transform::optimize_feed) fn build_feed_segments(
    blocks: &[FeedBlock],
    chains: &[usize],
    pieces: &[ClassedPiece],
    rules: &FeedRules,
) -> Vec<FeedSegment> {
    let mut found = Vec::new();
    for range in group_by_block(pieces) {
        let Some(index) = pieces.get(range.start).map(|piece| piece.block) else { continue };
        let (Some(block), Some(chain)) = (blocks.get(index), chains.get(index)) else { continue };
        let bounds = FeedBounds::from_rules(block, rules);
        let mut end = 0.0;
        for segment in merge_into_segments(block, &bounds, pieces, range, rules) {
            let length: f64 =
                pieces.get(segment.clone()).unwrap_or_default().iter().map(|piece| piece.length).sum();
            end += length;
            found.push(FeedSegment {
                block: index,
                chain: *chain,
                pieces: segment,
                length,
                end: end / block.length,
                feed: block.programmed,
                least: bounds.least,
                // A segment is fixed until a window limits it, so whatever nothing limits keeps its
                // programmed feed.
                fixed: true,
                below: false,
            });
        }
    }
    apply_window_limits(&mut found, blocks, pieces, rules);
    keep_margins(&mut found, pieces);
    found
}

fn apply_window_limits(
    segments: &mut [FeedSegment],
    blocks: &[FeedBlock],
    pieces: &[ClassedPiece],
    rules: &FeedRules,
) {
    let windows: Vec<WindowContent> =
        (0..segments.len()).map(|index| find_window_content(segments, index, pieces, rules.window)).collect();
    for (segment, content) in segments.iter_mut().zip(windows) {
        let Some(block) = blocks.get(segment.block).filter(|block| block.touched && !block.pieces.is_empty())
        else {
            continue;
        };
        let bounds = FeedBounds::from_rules(block, rules);
        if let Some(feed) = bounds.window_feed_mm_min(content) {
            (segment.feed, segment.fixed) = (feed, false);
            // Only the limit of the material itself tells that a block exceeds its target. In a margin there
            // is only air, whatever its feed.
            segment.below = content.lowest_cut < bounds.least;
        }
    }
}

fn find_window_content(
    segments: &[FeedSegment],
    index: usize,
    pieces: &[ClassedPiece],
    window: FeedWindow,
) -> WindowContent {
    let Some(segment) = segments.get(index) else { return WindowContent::NOTHING };
    let own = content_between(segment, pieces, 0.0, segment.length);
    if window == FeedWindow::Block {
        return own;
    }
    let in_chain = |other: &&FeedSegment| other.chain == segment.chain;
    let before = index.checked_sub(1).and_then(|before| segments.get(before)).filter(in_chain);
    // Eq. 1 of the paper: the feed at point k follows from the halves of the blocks on both sides of it.
    let start = if before.is_some() { segment.length / 2.0 } else { 0.0 };
    let mut content = content_between(segment, pieces, start, segment.length);
    if let Some(after) = segments.get(index + 1).filter(in_chain) {
        content = content.combined_with(content_between(after, pieces, 0.0, after.length / 2.0));
    }
    // A block that cuts anywhere never takes the air feed.
    if own.cutting && !content.cutting { own } else { content }
}

/// Returns the content of a segment between two distances from its start, in mm.
fn content_between(segment: &FeedSegment, pieces: &[ClassedPiece], from: f64, to: f64) -> WindowContent {
    let mut content = WindowContent::NOTHING;
    let mut start = 0.0;
    let own = pieces.get(segment.pieces.clone());
    debug_assert!(own.is_some(), "a segment consists of pieces of the list");
    for piece in own.unwrap_or_default() {
        let end = start + piece.length;
        // A piece that is itself shorter than the tolerance has to count for its own segment, or its limit
        // would be lost. So half of its length is the tolerance there.
        if end.min(to) - start.max(from) > NOTHING.min(piece.length / 2.0) {
            content = content.combined_with(WindowContent::from_piece(piece, pieces));
        }
        start = end;
    }
    content
}

/// Limits the feed in margins to the feed of the segment that cuts beside them, before acceleration lowers
/// anything.
fn keep_margins(segments: &mut [FeedSegment], pieces: &[ClassedPiece]) {
    // The limits are read before any margin changes, so that the order of segments does not matter.
    let mut limit_at = vec![f64::INFINITY; pieces.len()];
    for segment in segments.iter() {
        limit_at.get_mut(segment.pieces.clone()).unwrap_or_default().fill(segment.feed);
    }
    for segment in segments.iter_mut().filter(|segment| !segment.fixed) {
        for piece in pieces.get(segment.pieces.clone()).unwrap_or_default() {
            let PieceClass::Margin(left, right) = piece.kind else { continue };
            for cut in [left, right].into_iter().flatten() {
                let beside = limit_at.get(cut).copied().unwrap_or(f64::INFINITY);
                // The lowest feed of this block still holds, even if the cut beside the margin lies in a
                // block that may run slower.
                segment.feed = segment.feed.min(beside.max(segment.least));
            }
        }
    }
}
