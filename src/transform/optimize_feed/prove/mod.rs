//! Stage 5 of 5, prove: the corrected program is simulated again, its loads are held against the targets and reported.

mod report;
mod report_builder;
mod report_text;
mod target_proof;

pub use report::{OperationFeedReport, OptimizeFeedReport};
pub(super) use report_builder::build_report;
pub(super) use target_proof::prove_targets;
