//! The rules that feeds have to satisfy.

use crate::program::LengthUnit;
use crate::transform::optimize_feed::measure::{FeedBlock, LoadCriterion};

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
    pub(in crate::transform::optimize_feed) fn applies_to(&self, block: &FeedBlock) -> bool {
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

/// What the feeds of a program are made for: limits of loads, and rules for feeds. Lengths are in mm.
#[derive(Debug)]
pub(in crate::transform::optimize_feed) struct FeedGoals {
    /// The limits, the target first.
    pub limits: Vec<(LoadCriterion, f64)>,
    /// The rules for feeds.
    pub rules: FeedRules,
    /// The unit of lengths in the file.
    pub units: LengthUnit,
}
