//! `optimize_feed`: block by block, the feed at which the load of the cutter stays within its targets.
//!
//! `gather` simulates the program and gives each block the largest feeds of its pieces (`limits`). [`block_feeds`] decides, and knows nothing of text: blocks with the largest feeds of their pieces go in, feeds of blocks and of
//! parts of blocks come out. [`motion_split`] breaks motions of a program into parts, so that each can have the feed of its part.

pub mod acceleration;
pub mod block_feeds;
mod block_measurement;
mod classed_pieces;
mod feed_rounding;
mod feed_segments;
mod load_limits;
mod load_notes;
mod motion_pose;
pub mod motion_split;
mod parameters;
mod report;
mod report_text;
mod segment_merge;
mod short_pieces;
mod split_read_back;
mod split_statements;
mod step;
mod target_proof;

pub use parameters::{EngagementSpec, LoadCriterion, LoadLimitSpec, OptimizeFeed, SplitSpec, WindowSpec};
pub use report::{OperationFeedReport, OptimizeFeedReport};
