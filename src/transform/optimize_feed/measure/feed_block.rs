//! Blocks: what feed motions become once they were simulated.

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
    /// The largest feed here.
    pub limit: FeedLimit,
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

impl FeedBlock {
    /// Whether it takes part in chains.
    pub(in crate::transform::optimize_feed) fn has_length(&self) -> bool {
        self.length.is_finite() && self.length > 0.0
    }

    /// Whether the programmed feed of it is known.
    pub(in crate::transform::optimize_feed) fn has_known_feed(&self) -> bool {
        self.programmed.is_finite() && self.programmed > 0.0
    }
}
