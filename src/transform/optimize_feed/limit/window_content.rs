//! This module holds the content of a window over pieces, and the feed that follows from it.

use super::classed_pieces::{ClassedPiece, PieceClass};
use super::feed_rules::FeedRules;
use crate::transform::optimize_feed::measure::FeedBlock;

/// The content of a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WindowContent {
    /// The lowest limit. It is infinite without material.
    pub lowest: f64,
    /// The lowest limit of the material itself, without the margins of other material.
    pub lowest_cut: f64,
    pub air: bool,
    pub cutting: bool,
}

impl WindowContent {
    pub(super) const NOTHING: Self =
        Self { lowest: f64::INFINITY, lowest_cut: f64::INFINITY, air: false, cutting: false };

    pub(super) fn from_piece(piece: &ClassedPiece, all: &[ClassedPiece]) -> Self {
        match piece.kind {
            PieceClass::Air => Self { air: true, ..Self::NOTHING },
            PieceClass::Cut(limit) => Self { lowest: limit, lowest_cut: limit, cutting: true, air: false },
            PieceClass::Margin(left, right) => {
                let limit =
                    |cut: Option<usize>| match cut.and_then(|cut| all.get(cut)).map(|piece| piece.kind) {
                        Some(PieceClass::Cut(limit)) => limit,
                        _ => f64::INFINITY,
                    };
                // Where two cuts lie close together their margins overlap, and the slower cut decides. A
                // margin counts as cutting, so that it never gets the air feed.
                let lowest = limit(left).min(limit(right));
                Self { lowest, cutting: true, ..Self::NOTHING }
            }
        }
    }

    pub(super) fn combined_with(self, other: Self) -> Self {
        Self {
            lowest: self.lowest.min(other.lowest),
            lowest_cut: self.lowest_cut.min(other.lowest_cut),
            air: self.air || other.air,
            cutting: self.cutting || other.cutting,
        }
    }
}

/// The lowest and the highest feed of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct FeedBounds {
    pub least: f64,
    most: f64,
    air: Option<f64>,
    /// What axes follow, where the programmed feed is above it.
    too_fast: Option<f64>,
}

impl FeedBounds {
    pub(super) fn from_rules(block: &FeedBlock, rules: &FeedRules) -> Self {
        let feed_at = |ratio: Option<f64>| ratio.map(|ratio| ratio * block.programmed);
        let most =
            rules.max_feed.min(feed_at(rules.max_ratio).unwrap_or(f64::INFINITY)).min(block.axis_limit);
        let too_fast = (block.programmed > block.axis_limit).then_some(most);
        let least = rules.min_feed.max(feed_at(rules.min_ratio).unwrap_or(0.0)).min(most);
        Self { least, most, air: rules.air_feed, too_fast }
    }

    /// Returns the feed of a window. Returns `None` if nothing limits it, so that the programmed feed stays.
    pub(super) fn window_feed_mm_min(&self, content: WindowContent) -> Option<f64> {
        self.limited_feed_mm_min(content).or(self.too_fast)
    }

    fn limited_feed_mm_min(&self, content: WindowContent) -> Option<f64> {
        let air = if content.air { self.air } else { None };
        let wanted = match (content.cutting, air) {
            (false, air) => air?,
            // A segment has a single feed. If it holds air and a cut, the slower of their feeds is right for
            // both.
            (true, air) => content.lowest.min(air.unwrap_or(f64::INFINITY)),
        };
        // The highest feed is applied last: it is a limit of the machine, the lowest feed only a wish.
        let feed = wanted.max(self.least).min(self.most);
        feed.is_finite().then_some(feed)
    }
}
