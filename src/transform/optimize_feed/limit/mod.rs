//! Stage 2 of 5, limit: this module joins pieces to segments of blocks. Each segment has the largest feed
//! that it allows.

mod classed_pieces;
mod feed_rules;
mod feed_segments;
mod segment_merge;
mod window_content;

pub(super) use classed_pieces::classify_pieces;
pub(super) use feed_rules::FeedGoals;
pub use feed_rules::{FeedRules, FeedWindow, SplitRule};
pub(super) use feed_segments::{FeedSegment, build_feed_segments};
