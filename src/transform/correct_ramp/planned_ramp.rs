//! This module holds a ramp that is to be rewritten, as planned.

use super::ramp_correction::CorrectedRamp;
use super::ramp_limits::{IndexableCutter, RampLimits};
use super::ramp_search::FoundRamp;
use crate::source::Span;

/// A ramp that is to be rewritten.
pub(super) struct PlannedRamp {
    pub found: FoundRamp,
    pub limits: RampLimits,
    /// The cutter that must not run into a pillar; `None` where that is not asked for.
    pub cutter: Option<IndexableCutter>,
    pub corrected: CorrectedRamp,
    /// The place where it begins in the source.
    pub begins: Span,
    /// The index of its report.
    pub report: usize,
}
