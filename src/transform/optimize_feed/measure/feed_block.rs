//! This module holds blocks: feed motions with their measured limits.

/// The limit of a piece of path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FeedLimit {
    /// It meets no material.
    Air,
    /// It meets material. The number is the largest feed in mm/min at which every target is kept; it is
    /// infinite if no feed reaches a target.
    Limit(f64),
}

/// A piece of a block on which the load is taken as constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitedPiece {
    /// Its length in mm. The pieces of a block are scaled to the length of the block.
    pub length: f64,
    /// The largest feed on this piece.
    pub limit: FeedLimit,
}

/// A block: one feed motion of the path.
#[derive(Debug, Clone, PartialEq)]
pub struct FeedBlock {
    /// Its length in mm. A block without length is not planned. If it is touched, it takes the feed of the
    /// block before it.
    pub length: f64,
    /// Its programmed feed in mm/min. If it is not positive, it is not known. Such a block is not touched,
    /// and it separates chains.
    pub programmed: f64,
    /// Whether its feed may be changed. Acceleration cannot change the feed of a block that is not touched.
    pub touched: bool,
    /// Whether it can be split.
    pub splittable: bool,
    /// The largest feed in mm/min that the axes of the machine follow, if the step keeps to it; else infinite.
    pub axis_limit: f64,
    /// Whether a rapid, a stop or a tool change lies between it and the block before.
    pub breaks_chain: bool,
    /// Its pieces in order. A block without pieces is not touched, because nothing is known about it.
    pub pieces: Vec<LimitedPiece>,
}

impl FeedBlock {
    /// Returns whether it takes part in chains.
    pub(in crate::transform::optimize_feed) fn has_length(&self) -> bool {
        self.length.is_finite() && self.length > 0.0
    }

    /// Returns whether its programmed feed is known.
    pub(in crate::transform::optimize_feed) fn has_known_feed(&self) -> bool {
        self.programmed.is_finite() && self.programmed > 0.0
    }
}
