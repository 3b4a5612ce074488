//! What `optimize_feed` did, in numbers.

use crate::transform::optimize_feed::measure::LoadCriterion;
use serde::Serialize;

/// What the step did.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct OptimizeFeedReport {
    /// What the target is about.
    pub criterion: LoadCriterion,
    /// Its unit: everything here is in millimetres.
    pub unit: &'static str,
    /// The target.
    pub target: f64,
    /// Distance of the simulation's columns, mm, where they told the engagement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell_mm: Option<f64>,
    /// Thickness of layers, mm, where they did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layer_mm: Option<f64>,
    /// How far the criterion may be above what is told, for the grid or the layers: the largest difference between estimate and bound over all
    /// blocks that the step may touch, after.
    pub uncertainty: f64,
    /// Change of feed along the path that times are computed with, (mm/min)/s; `None`: feeds change at once.
    pub acceleration: Option<f64>,
    /// The whole program.
    pub whole: OperationFeedReport,
    /// Its operations, those without feed motions left out.
    pub operations: Vec<OperationFeedReport>,
    /// FEDRATs put in.
    pub feeds_added: usize,
    /// FEDRATs (and CYCLEs) given another feed.
    pub feeds_changed: usize,
    /// Points put in where blocks were split.
    pub points_added: usize,
}

/// An operation, or all of them.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct OperationFeedReport {
    /// Its name; empty for the whole program.
    pub name: String,
    /// Time at feed before, with acceleration, seconds.
    pub seconds_before: f64,
    /// Time at feed after.
    pub seconds_after: f64,
    /// Largest criterion before, where the step may change feeds.
    pub largest_before: f64,
    /// Largest criterion after.
    pub largest_after: f64,
    /// Share of the length of cutting blocks that is within a tenth of the target, before.
    pub at_target_before: f64,
    /// And after.
    pub at_target_after: f64,
}

impl OperationFeedReport {
    /// Share of the time saved; negative when it takes longer.
    pub fn saved_fraction(&self) -> f64 {
        if self.seconds_before > 0.0 { 1.0 - self.seconds_after / self.seconds_before } else { 0.0 }
    }
}
