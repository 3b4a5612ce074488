//! This module holds the figures of what `optimize_feed` did.

use crate::transform::optimize_feed::measure::LoadCriterion;
use serde::Serialize;

/// The figures of one run of the step.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct OptimizeFeedReport {
    /// The load that the target limits.
    pub criterion: LoadCriterion,
    /// The unit of the load. All figures here are based on millimetres.
    pub unit: &'static str,
    /// The target.
    pub target: f64,
    /// The distance of the simulation's columns in mm, if columns were used.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cell_mm: Option<f64>,
    /// The thickness of the layers in mm, if layers were used.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub layer_mm: Option<f64>,
    /// Whether the bounds of chips come from the motions themselves.
    pub is_certified: bool,
    /// The number of points at which these bounds were tested after the change; none was above them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof_points: Option<u64>,
    /// The largest chip at one of these points, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proof_largest_mm: Option<f64>,
    /// How far the load may be above the reported one, because of the grid or the layers. It is the largest
    /// difference between estimate and bound over all blocks that the step may touch, after the change.
    pub uncertainty: f64,
    /// The change of feed along the path with which times are computed, in (mm/min)/s. With `None`, feeds
    /// change at once.
    pub acceleration: Option<f64>,
    /// The time of the whole program on the machine before the change, with rapids and all that it stands, in s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub machine_seconds_before: Option<f64>,
    /// The same time after the change.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub machine_seconds_after: Option<f64>,
    /// The figures of the whole program.
    pub whole: OperationFeedReport,
    /// The figures of its operations. Operations without feed motions are left out.
    pub operations: Vec<OperationFeedReport>,
    /// The number of FEDRATs that were inserted.
    pub feeds_added: usize,
    /// The number of FEDRATs (and CYCLEs) that got another feed.
    pub feeds_changed: usize,
    /// The number of points that were inserted where blocks were split.
    pub points_added: usize,
}

/// The figures of an operation, or of the whole program.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct OperationFeedReport {
    /// Its name; empty for the whole program.
    pub name: String,
    /// The time at feed before the change, with acceleration, in seconds.
    pub seconds_before: f64,
    /// The time at feed after the change, in seconds.
    pub seconds_after: f64,
    /// The largest load before the change, where the step may change feeds.
    pub largest_before: f64,
    /// The largest load after the change.
    pub largest_after: f64,
    /// The fraction of the length of cutting blocks whose load was within a tenth of the target, before the
    /// change.
    pub at_target_before: f64,
    /// The same fraction after the change.
    pub at_target_after: f64,
}

impl OptimizeFeedReport {
    /// Adds the times on the machine before and after, in s, where they are known.
    #[must_use]
    pub(in crate::transform::optimize_feed) fn with_machine_seconds(
        self,
        seconds: Option<(f64, f64)>,
    ) -> Self {
        let (before, after) = seconds.unzip();
        Self { machine_seconds_before: before, machine_seconds_after: after, ..self }
    }
}

impl OperationFeedReport {
    /// Returns the fraction of the time that is saved. It is negative if the program takes longer.
    pub fn saved_fraction(&self) -> f64 {
        if self.seconds_before > 0.0 { 1.0 - self.seconds_after / self.seconds_before } else { 0.0 }
    }
}
