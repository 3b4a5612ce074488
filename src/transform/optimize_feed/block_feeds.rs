//! Feeds of blocks from the loads of their pieces (Kiselev, block-by-block feed, eqs. 1 and 2, and what it leaves open).
//!
//! In this order: windows over the pieces give each part its limit, blocks are split where that saves time, air near material
//! keeps the cutting feed, acceleration lowers what cannot be reached, feeds are rounded down, and changes too small for a
//! FEDRAT of their own are left out. Every stage after the first only lowers.

use super::acceleration::{self, TimedSegment};
use super::classed_pieces;
use super::feed_rounding;
use super::feed_segments;

/// What a piece of the path meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FeedLimit {
    /// Nothing.
    Air,
    /// Material: the largest feed in mm/min that keeps every target there; infinite where none is reached at any feed.
    Limit(f64),
}

/// A piece of a block, within which the load is taken as constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedPiece {
    /// Length in mm; the pieces of a block are scaled to its length.
    pub length: f64,
    /// Load.
    pub load: FeedLimit,
}

/// A block: one motion of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct FeedBlock {
    /// Length in mm. A block without length takes no part; touched, it goes along with the block before it.
    pub length: f64,
    /// Programmed feed in mm/min. Where it is not positive it is not known: such a block is not touched and separates chains.
    pub programmed: f64,
    /// Whether its feed may be changed. What is not touched is a fixed wall for acceleration.
    pub touched: bool,
    /// Whether it can be split into parts.
    pub splittable: bool,
    /// Whether a rapid, a stop or a tool change stands between it and the block before.
    pub breaks_chain: bool,
    /// Its pieces in order. A block without pieces is one of which nothing is known: it is not touched.
    pub pieces: Vec<LimitedPiece>,
}

/// Which pieces count for the feed of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FeedWindow {
    /// All of the block: no target is ever passed.
    #[default]
    Block,
    /// The half of the block before point k and the half after it (the paper's eq. 1). The first half of a block is then
    /// governed by the block before it, so a target may be passed there. The first block of a chain counts from its start, and
    /// only a block that meets nothing itself takes the air feed.
    HalfBlocks,
}

/// When blocks are split.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SplitRule {
    /// Only blocks longer than this, in mm.
    pub above: f64,
    /// No part is shorter than this, in mm.
    pub shortest: f64,
    /// Most parts of one block.
    pub at_most: usize,
}

impl SplitRule {
    /// Whether a block may be split.
    pub(super) fn applies_to(&self, block: &FeedBlock) -> bool {
        block.touched && block.splittable && block.length > self.above && !block.pieces.is_empty()
    }
}

/// What feeds have to satisfy; feeds in mm/min, lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedRules {
    /// Window.
    pub window: FeedWindow,
    /// Lowest feed.
    pub min_feed: f64,
    /// Highest feed: the lower of the step's and the machine's; infinite for none.
    pub max_feed: f64,
    /// Lowest share of the programmed feed.
    pub min_ratio: Option<f64>,
    /// Highest share of the programmed feed.
    pub max_ratio: Option<f64>,
    /// Feed in air; without one, air keeps its programmed feed whatever that is.
    pub air_feed: Option<f64>,
    /// Path before and after material that keeps the cutting feed.
    pub margin: f64,
    /// Largest change of feed along the path, in (mm/min)/s; `None` for any.
    pub max_acceleration: Option<f64>,
    /// When blocks are split; never without.
    pub split: Option<SplitRule>,
    /// Changes below this share keep the feed in force (0..1).
    pub min_change: f64,
    /// Feeds are rounded down to multiples of this; 0 for none.
    pub round_down_to: f64,
}

impl Default for FeedRules {
    /// No limits, no margin, no splitting, no rounding.
    fn default() -> Self {
        Self {
            window: FeedWindow::Block,
            min_feed: 0.0,
            max_feed: f64::INFINITY,
            min_ratio: None,
            max_ratio: None,
            air_feed: None,
            margin: 0.0,
            max_acceleration: None,
            split: None,
            min_change: 0.0,
            round_down_to: 0.0,
        }
    }
}

/// A part of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannedSegment {
    /// Where it ends, as a share of the block's length; 1 for the last.
    pub end: f64,
    /// Its feed in mm/min.
    pub feed: f64,
}

/// The feeds of all blocks.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockFeeds {
    /// Parts of each block, one at least.
    pub parts: Vec<Vec<PlannedSegment>>,
    /// Blocks with a piece whose limit is below the lowest feed allowed; they run at that feed and pass the target.
    pub below_minimum: Vec<usize>,
}

impl BlockFeeds {
    /// The path at these feeds, for [`acceleration::path_time_s`].
    pub fn timed_segments(&self, blocks: &[FeedBlock]) -> Vec<TimedSegment> {
        let mut found = Vec::with_capacity(blocks.len());
        for (block, parts) in blocks.iter().zip(&self.parts) {
            let mut start = 0.0;
            for (index, part) in parts.iter().enumerate() {
                found.push(TimedSegment {
                    length: (part.end - start) * block.length,
                    feed: part.feed,
                    breaks_chain: block.breaks_chain && index == 0,
                });
                start = part.end;
            }
        }
        found
    }
}

/// The feeds of a path.
///
/// What holds afterwards, for touched blocks:
/// - no part is faster than its limit (its window's lowest), nor than the highest feed, nor slower than the lowest feed unless
///   acceleration asks for it; a limit below the lowest feed takes the lowest feed and is reported;
/// - before rounding, `F_k^2 <= F_{k-1}^2 + 120 a L_k` and `F_k^2 <= F_{k+1}^2 + 120 a L_k` in each chain. Rounding and
///   `min_change` lower single parts afterwards, so in the result a feed may be above what its neighbour allows by one
///   rounding step and twice the share `min_change` of that neighbour. (Lowering on until it held again would creep through chains of
///   short blocks, where no step up is as large as a rounding step.) The machine, which changes feed no faster than `a`, stays
///   below the unrounded feeds all the same;
/// - the result fed back as programmed feeds comes out unchanged, unless ratios of the programmed feed are limits. Parts
///   that are blocks the second time may fall apart further where `shortest` or `at_most` had held them together.
///
/// A part that nothing limits (no material, no air feed; or an infinite limit and no highest feed) keeps its programmed feed
/// whatever it is, and is a wall for acceleration like a block that is not touched.
pub fn plan_block_feeds(blocks: &[FeedBlock], rules: &FeedRules) -> BlockFeeds {
    let chains = number_chains(blocks);
    let atoms = classed_pieces::classify_pieces(blocks, &chains, rules);
    let mut spans = feed_segments::build_feed_segments(blocks, &chains, &atoms, rules);
    let mut below_minimum: Vec<usize> =
        spans.iter().filter(|span| span.below).map(|span| span.block).collect();
    below_minimum.dedup();
    if let Some(acceleration) = rules.max_acceleration {
        acceleration::limit_feed_changes(&mut spans, acceleration);
    }
    feed_rounding::round_and_even_out(&mut spans, blocks, rules);
    BlockFeeds { parts: collect_planned_segments(blocks, &spans), below_minimum }
}

/// Whether a block takes part in chains.
pub(super) fn has_length(block: &FeedBlock) -> bool {
    block.length.is_finite() && block.length > 0.0
}

/// Whether the programmed feed of a block is known.
pub(super) fn has_known_feed(block: &FeedBlock) -> bool {
    block.programmed.is_finite() && block.programmed > 0.0
}

/// The number of the chain that each block belongs to. Blocks of unknown feed have one of their own.
fn number_chains(blocks: &[FeedBlock]) -> Vec<usize> {
    let mut chain = 0;
    let mut last_known = true;
    let mut found = Vec::with_capacity(blocks.len());
    for block in blocks {
        let known = has_known_feed(block);
        chain += usize::from(block.breaks_chain || !known || !last_known);
        last_known = known;
        found.push(chain);
    }
    found
}

/// Spans as parts of their blocks; neighbours of equal feed are one part.
fn collect_planned_segments(
    blocks: &[FeedBlock],
    spans: &[feed_segments::FeedSegment],
) -> Vec<Vec<PlannedSegment>> {
    let mut found: Vec<Vec<PlannedSegment>> = vec![Vec::new(); blocks.len()];
    for span in spans {
        let Some(block) = found.get_mut(span.block) else { continue };
        match block.last_mut() {
            Some(last) if last.feed == span.feed => last.end = span.end,
            _ => block.push(PlannedSegment { end: span.end, feed: span.feed }),
        }
    }
    let mut before = None;
    for (parts, block) in found.iter_mut().zip(blocks) {
        match parts.last_mut() {
            Some(last) => last.end = 1.0,
            None => parts.push(PlannedSegment { end: 1.0, feed: inherit_feed(block, before) }),
        }
        before = parts.last().map(|part| part.feed).or(before);
    }
    found
}

/// The feed of a block that takes no part: without length, it goes along with the block before it and needs no FEDRAT.
fn inherit_feed(block: &FeedBlock, before: Option<f64>) -> f64 {
    let limits = block.pieces.iter().filter_map(|piece| match piece.load {
        FeedLimit::Limit(limit) => Some(limit),
        FeedLimit::Air => None,
    });
    match before {
        Some(before)
            if block.touched && has_known_feed(block) && limits.clone().all(|limit| limit >= before) =>
        {
            before
        }
        _ => block.programmed,
    }
}
