//! Stage 3 of 5, plan: this module lowers feeds that acceleration cannot reach, rounds feeds down, and leaves
//! out small changes.

mod block_feeds;
mod feed_plateaus;
mod feed_rounding;
mod path_time;
mod path_timer;
mod plateau_partition;

pub use block_feeds::{BlockFeeds, PlannedSegment, plan_block_feeds};
pub use path_time::{TimedSegment, path_time_s, speed_change_distance_mm};
pub(crate) use path_timer::PathTimer;
pub use plateau_partition::{FreeStretch, partition_into_plateaus};
