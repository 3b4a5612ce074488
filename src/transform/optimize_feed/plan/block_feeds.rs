//! This module plans the feeds of blocks from the loads of their pieces (Kiselev, block-by-block feed, eqs. 1
//! and 2, and what these leave open).
//!
//! The order is as follows. Windows over the pieces give each segment its limit. Blocks are split where that
//! saves time. Air near material keeps the cutting feed. Feeds are rounded down and joined to plateaus, so that
//! few FEDRATs are needed. What is too short to slow down in is lowered. Every stage after the first only lowers
//! feeds. Ramps are left to the control, which accelerates within a feed by itself.

use super::feed_plateaus::join_into_plateaus;
use super::path_time::TimedSegment;
use crate::transform::optimize_feed::limit::{FeedRules, FeedSegment, build_feed_segments, classify_pieces};
use crate::transform::optimize_feed::measure::{FeedBlock, FeedLimit};

/// A segment of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedSegment {
    /// Where it ends, as a fraction of the block's length; 1 for the last segment.
    pub end: f64,
    /// Its feed in mm/min.
    pub feed: f64,
}

/// The feeds of all blocks.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockFeeds {
    /// The segments of each block, at least one.
    pub segments: Vec<Vec<PlannedSegment>>,
    /// Blocks with a piece whose limit is below the lowest allowed feed. They run at the lowest feed and
    /// exceed the target.
    pub below_minimum: Vec<usize>,
}

impl BlockFeeds {
    /// Returns the path at these feeds, for [`path_time_s`](super::path_time_s).
    pub fn timed_segments(&self, blocks: &[FeedBlock]) -> Vec<TimedSegment> {
        let mut found = Vec::with_capacity(blocks.len());
        for (block, segments) in blocks.iter().zip(&self.segments) {
            let mut start = 0.0;
            for (index, segment) in segments.iter().enumerate() {
                found.push(TimedSegment {
                    length: (segment.end - start) * block.length,
                    feed: segment.feed,
                    breaks_chain: block.breaks_chain && index == 0,
                });
                start = segment.end;
            }
        }
        found
    }
}

/// Plans the feeds of a path.
///
/// The result has these properties for touched blocks:
/// - no segment is faster than its limit (its window's lowest), nor than the highest feed, nor slower than the lowest feed unless
///   acceleration asks for it; a limit below the lowest feed takes the lowest feed and is reported;
/// - with an acceleration, `F_k^2 <= F_{k+1}^2 + 120 a L_k` where a plateau of length `L_k` is followed by another one in its
///   chain, to the rounding of feeds. Speeding up is left to the machine;
/// - the path takes at most the fraction `min_change` longer than with a FEDRAT wherever the limit changes;
/// - the result fed back as programmed feeds comes out unchanged, unless ratios of the programmed feed are limits. Parts
///   that are blocks the second time may fall apart further where `shortest` or `at_most` had held them together.
///
/// A segment that nothing limits (no material and no air feed, or an infinite limit and no highest feed)
/// keeps its programmed feed. For acceleration it is fixed, like a block that is not touched.
pub fn plan_block_feeds(blocks: &[FeedBlock], rules: &FeedRules) -> BlockFeeds {
    let chains = number_chains(blocks);
    let pieces = classify_pieces(blocks, &chains, rules);
    let mut segments = build_feed_segments(blocks, &chains, &pieces, rules);
    let mut below_minimum: Vec<usize> =
        segments.iter().filter(|segment| segment.below).map(|segment| segment.block).collect();
    below_minimum.dedup();
    join_into_plateaus(&mut segments, blocks, rules);
    BlockFeeds { segments: collect_planned_segments(blocks, &segments), below_minimum }
}

/// Returns the number of the chain to which each block belongs. A block of unknown feed has a chain of its
/// own.
fn number_chains(blocks: &[FeedBlock]) -> Vec<usize> {
    let mut chain = 0;
    let mut last_known = true;
    let mut found = Vec::with_capacity(blocks.len());
    for block in blocks {
        let known = block.has_known_feed();
        // Acceleration cannot be computed across an unknown feed, so a chain ends before and after it.
        chain += usize::from(block.breaks_chain || !known || !last_known);
        last_known = known;
        found.push(chain);
    }
    found
}

/// Returns the segments of each block. Neighbours of equal feed become one segment.
fn collect_planned_segments(blocks: &[FeedBlock], segments: &[FeedSegment]) -> Vec<Vec<PlannedSegment>> {
    let mut found: Vec<Vec<PlannedSegment>> = vec![Vec::new(); blocks.len()];
    for segment in segments {
        let Some(block) = found.get_mut(segment.block) else { continue };
        match block.last_mut() {
            Some(last) if last.feed == segment.feed => last.end = segment.end,
            _ => block.push(PlannedSegment { end: segment.end, feed: segment.feed }),
        }
    }
    let mut before = None;
    for (segments, block) in found.iter_mut().zip(blocks) {
        match segments.last_mut() {
            // The lengths of the parts sum up to the whole only up to rounding. With an exact end, no motion
            // is split a hair before its end.
            Some(last) => last.end = 1.0,
            None => segments.push(PlannedSegment { end: 1.0, feed: inherit_feed(block, before) }),
        }
        before = segments.last().map(|segment| segment.feed).or(before);
    }
    found
}

/// Returns the feed of a block without segments. A block without length takes the feed of the block before it
/// and needs no FEDRAT.
fn inherit_feed(block: &FeedBlock, before: Option<f64>) -> f64 {
    let limits = block.pieces.iter().filter_map(|piece| match piece.limit {
        FeedLimit::Limit(limit) => Some(limit),
        FeedLimit::Air => None,
    });
    match before {
        Some(before)
            if block.touched && block.has_known_feed() && limits.clone().all(|limit| limit >= before) =>
        {
            before
        }
        _ => block.programmed,
    }
}
