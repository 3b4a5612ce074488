//! A ramp that is to be written anew, as planned.

use super::ramp_correction::CorrectedRamp;
use super::ramp_limits::RampLimits;
use super::ramp_search::FoundRamp;
use crate::source::Span;

/// A ramp that is to be written anew.
pub(super) struct PlannedRamp {
    pub found: FoundRamp,
    pub limits: RampLimits,
    pub corrected: CorrectedRamp,
    /// Where it begins in the source.
    pub begins: Span,
    /// Its place among the reports.
    pub report: usize,
}
