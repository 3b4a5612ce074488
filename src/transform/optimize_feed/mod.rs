//! `optimize_feed` gives each block the feed at which the load of the cutter stays within its targets.
//!
//! Its five stages follow the order of their data. `measure` simulates the program and makes blocks of it,
//! whose pieces have their largest feeds. `limit` joins pieces to segments. `plan` applies acceleration
//! and rounding. `write` splits motions and inserts FEDRATs. `prove` simulates again. A stage
//! imports only those before it. `step` calls them in turn, and `settled_feeds` repeats them where motions were split.
//!
//! Six nouns name a bit of path. A motion is what the CL file programs from one point to the next. A piece is
//! a length of path on which the load is constant. A block is a feed motion with its pieces. A segment is a
//! part of a block that gets one feed. A chain is a run of blocks with no rapid, stop or tool change between
//! them. A motion part is one of the motions that a motion becomes in the CL text where its block has several
//! segments.

mod certification_findings;
pub(crate) mod limit;
pub(crate) mod measure;
mod parameters;
pub(crate) mod plan;
mod prove;
mod settled_feeds;
mod step;
mod target_slips;
pub(crate) mod write;

pub use measure::LoadCriterion;
pub use parameters::{EngagementSpec, LoadLimitSpec, OptimizeFeed, SplitSpec, WindowSpec};
pub(crate) use plan::PathTimer;
pub use prove::{OperationFeedReport, OptimizeFeedReport};
