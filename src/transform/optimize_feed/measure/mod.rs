//! Stage 1 of 5, measure: this module simulates the program and makes blocks of it, whose pieces have their
//! largest feeds.

mod block_measurement;
mod certified_blocks;
mod feed_block;
mod load_criterion;
mod load_limits;
mod machine_stops;
mod same_motions;
mod short_pieces;

pub(super) use block_measurement::{
    BlockMeasurement, MeasureOptions, MeasuredBlocks, MeasuredProgram, measure_blocks,
};
pub(super) use certified_blocks::{BlockDivision, ChipProof};
pub use feed_block::{FeedBlock, FeedLimit, LimitedPiece};
pub use load_criterion::LoadCriterion;
pub(super) use load_limits::LoadLimits;
pub(super) use machine_stops::has_machine_stop;
