//! Stage 4 of 5, write: this module splits motions of several segments and writes FEDRATs.

mod feed_writer;
mod load_notes;
mod motion_pose;
mod motion_split;
mod split_read_back;
mod split_statements;

pub(super) use feed_writer::{OptimizedProgram, plan_and_write_feeds};
pub(super) use load_notes::add_load_notes;
pub use motion_split::{SplitProgram, UnsplitReason, split_motions};
