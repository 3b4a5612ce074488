//! This module holds a ramp that is to be rewritten, as planned.

use super::ramp_correction::CorrectedRamp;
use super::ramp_limits::RampLimits;
use super::ramp_search::FoundRamp;
use crate::source::Span;

/// A ramp that is to be rewritten.
pub(super) struct PlannedRamp {
    pub found: FoundRamp,
    pub limits: RampLimits,
    pub corrected: CorrectedRamp,
    /// The place where it begins in the source.
    pub begins: Span,
    /// The index of its report.
    pub report: usize,
}
