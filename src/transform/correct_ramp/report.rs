//! This module holds the figures of what `correct_ramp` found and did.

use super::ramp_correction::LengtheningMethod;
use super::ramp_limits::RampMeasurement;
use crate::engagement::PillarContact;
use serde::Serialize;

/// The figures of one run of the step.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CorrectRampReport {
    /// All ramps that the step means, in the order of the program.
    pub ramps: Vec<RampReport>,
}

/// The figures of one ramp.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RampReport {
    /// The name of its operation, which may be empty.
    pub operation: String,
    /// The line of its first statement in the file.
    pub line: u64,
    /// Its kind.
    pub kind: &'static str,
    /// l_min: the shortest leg that the cutter allows, in mm.
    pub limit_leg_mm: f64,
    /// a_lim: the steepest angle that the cutter allows, in degrees.
    pub limit_degrees: f64,
    /// The measurements before the correction.
    pub before: RampMeasurement,
    /// The pillar that the body of the cutter runs into, on a block of stock, before the correction. It is `None` where
    /// that is not asked for (`limit: paper`).
    pub pillar_before: Option<RampPillar>,
    /// The pillar after the correction. It is `None` if the ramp was not changed, or that is not asked for.
    pub pillar_after: Option<RampPillar>,
    /// The outcome of the correction.
    pub outcome: RampOutcome,
    /// The measurements of what was written. It is `None` if the ramp was not changed.
    pub after: Option<RampMeasurement>,
    /// How it was lengthened.
    pub lengthened: LengtheningMethod,
    /// The ratio of the compression; 1 if it was not compressed.
    pub compression: f64,
    /// The number of passes. For a helix it is 1 plus the number of added turns.
    pub passes: usize,
    /// The length of the added path in mm. A motion down to a lower start counts.
    pub added_mm: f64,
    /// The added time at the ramp's feed, in seconds. It is `None` if the feed is not known.
    pub added_seconds: Option<f64>,
    /// The path before the correction in the tool's frame, in mm.
    #[serde(skip)]
    pub path_before: Vec<[f64; 3]>,
    /// The path after the correction.
    #[serde(skip)]
    pub path_after: Vec<[f64; 3]>,
}

/// The pillar under the middle of a cutter, as far as its body runs into it. All is 0 where it does not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RampPillar {
    /// The height above the tip, mm.
    pub height_mm: f64,
    /// What is left over above what the inserts clear, mm.
    pub left_over_mm: f64,
    /// The volume that the body meets on one of the ramp's steps, mm3; the largest.
    pub volume_mm3: f64,
}

impl RampPillar {
    /// Returns the figures of what a body runs into.
    pub(super) fn from_contact(found: PillarContact) -> Self {
        Self { height_mm: found.height_mm, left_over_mm: found.depth_mm(), volume_mm3: found.volume_mm3 }
    }
}

/// The outcome for a ramp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RampOutcome {
    /// It keeps the limits without a change.
    Fits,
    /// It was corrected.
    Corrected,
    /// It violates the limits and stays.
    Kept,
}
