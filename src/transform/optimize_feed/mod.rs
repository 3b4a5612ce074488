//! `optimize_feed`: block by block, the feed at which the load of the cutter stays within its targets.
//!
//! `gather` simulates the program and gives each block the largest feeds of its pieces (`limits`). [`feeds`] decides, and knows nothing of text: blocks with the largest feeds of their pieces go in, feeds of blocks and of
//! parts of blocks come out. [`split`] breaks motions of a program into parts, so that each can have the feed of its part.

pub mod acceleration;
mod around;
pub mod feeds;
mod gather;
mod geometry;
mod limits;
mod margin;
mod merge;
mod note;
mod parameters;
mod parts;
mod proof;
mod report;
mod rounding;
pub mod split;
mod split_text;
mod step;
mod verify;

pub use parameters::{Criterion, EngagementName, Limit, OptimizeFeed, Split, WindowName};
pub use report::{OperationReport, Report};
