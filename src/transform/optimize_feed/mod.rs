//! `optimize_feed`: block by block, the feed at which the load of the cutter stays within its targets.
//!
//! [`feeds`] decides, and knows nothing of text: blocks with the largest feeds of their pieces go in, feeds of blocks and of
//! parts of blocks come out. [`split`] breaks motions of a program into parts, so that each can have the feed of its part.

pub mod acceleration;
pub mod feeds;
mod geometry;
mod margin;
mod merge;
mod parts;
mod rounding;
pub mod split;
mod split_text;
mod verify;
