//! Stage 3 of 5, plan: what acceleration cannot reach is lowered, feeds are rounded down, and small changes left out.

mod acceleration;
mod block_feeds;
mod feed_rounding;
mod path_time;

pub use block_feeds::{BlockFeeds, PlannedSegment, plan_block_feeds};
pub use path_time::{TimedSegment, path_time_s, speed_change_distance_mm};
