//! This module holds the rules that feeds have to satisfy.

use crate::program::LengthUnit;
use crate::transform::optimize_feed::measure::{FeedBlock, LoadCriterion};

/// The pieces that count for the feed of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FeedWindow {
    /// All pieces of the block count, so no target is ever exceeded.
    #[default]
    Block,
    /// The half of the block before point k and the half of the next block after it count (eq. 1 of the
    /// paper). The feed of the previous block then governs the first half of a block, so a target may be
    /// exceeded there. The first block of a chain counts from its start, and only a block that meets no
    /// material itself takes the air feed.
    HalfBlocks,
}

/// The rule by which blocks are split.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SplitRule {
    /// Only blocks longer than this are split, in mm.
    pub above: f64,
    /// No part becomes shorter than this, in mm.
    pub shortest: f64,
    /// A block gets at most so many parts.
    pub at_most: usize,
}

impl SplitRule {
    /// Returns whether a block may be split.
    pub(in crate::transform::optimize_feed) fn applies_to(&self, block: &FeedBlock) -> bool {
        block.touched && block.splittable && block.length > self.above && !block.pieces.is_empty()
    }
}

/// The rules that feeds have to satisfy. Feeds are in mm/min and lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedRules {
    /// The pieces that count for a block.
    pub window: FeedWindow,
    /// The lowest feed.
    pub min_feed: f64,
    /// The highest feed: the lower one of the step's and the machine's. It is infinite if there is none.
    pub max_feed: f64,
    /// The lowest feed as a fraction of the programmed one.
    pub min_ratio: Option<f64>,
    /// The highest feed as a fraction of the programmed one.
    pub max_ratio: Option<f64>,
    /// The feed in air. Without it, air keeps its programmed feed.
    pub air_feed: Option<f64>,
    /// The length of path before and after material that keeps the cutting feed.
    pub margin: f64,
    /// How fast the machine changes its feed along the path, in (mm/min)/s. With `None`, feeds change at once.
    pub max_acceleration: Option<f64>,
    /// The rule by which blocks are split. With `None`, no block is split.
    pub split: Option<SplitRule>,
    /// The part of the path time (0..1) that may be given up for fewer FEDRATs.
    pub min_change: f64,
    /// Feeds are rounded down to multiples of this; 0 means no rounding.
    pub round_down_to: f64,
}

impl FeedRules {
    /// Returns whether feeds are tied to the programmed ones.
    pub(in crate::transform::optimize_feed) fn has_ratios(&self) -> bool {
        self.min_ratio.is_some() || self.max_ratio.is_some()
    }
}

impl Default for FeedRules {
    /// Makes rules without limits, margin, splitting or rounding.
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

/// The goals of the feeds of a program: limits of loads and rules for feeds. Lengths are in mm.
#[derive(Debug)]
pub(in crate::transform::optimize_feed) struct FeedGoals {
    /// The limits, the target first.
    pub limits: Vec<(LoadCriterion, f64)>,
    /// The rules for feeds.
    pub rules: FeedRules,
    /// The unit of lengths in the file.
    pub units: LengthUnit,
}
