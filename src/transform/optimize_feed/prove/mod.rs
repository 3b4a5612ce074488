//! Stage 5 of 5, prove: this module simulates the corrected program again, compares its loads with the
//! targets and reports them.

mod report;
mod report_builder;
mod report_text;
mod target_proof;

pub use report::{OperationFeedReport, OptimizeFeedReport};
pub(super) use report_builder::build_report;
pub(super) use target_proof::prove_targets;
