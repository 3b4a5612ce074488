//! What `correct_ramp` found and did, in numbers.

use super::ramp_correction::LengtheningMethod;
use super::ramp_limits::RampMeasurement;
use serde::Serialize;

/// What the step did.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct CorrectRampReport {
    /// Every ramp that the step means, in the order of the program.
    pub ramps: Vec<RampReport>,
}

/// One ramp.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct RampReport {
    /// Name of its operation; may be empty.
    pub operation: String,
    /// Line of its first statement in the file.
    pub line: u64,
    /// Its kind.
    pub kind: &'static str,
    /// l_min: shortest leg that the cutter allows, mm.
    pub limit_leg_mm: f64,
    /// a_lim: steepest angle that the cutter allows, degrees.
    pub limit_degrees: f64,
    /// As it came.
    pub before: RampMeasurement,
    /// What became of it.
    pub outcome: RampOutcome,
    /// As it was written, measured in what was written; `None` where it was not changed.
    pub after: Option<RampMeasurement>,
    /// How it became longer.
    pub lengthened: LengtheningMethod,
    /// Ratio of the compression; 1 for none.
    pub compression: f64,
    /// Passes; of a helix 1 and the turns put in.
    pub passes: usize,
    /// Length of path put in, mm; a way down to a lower start counts.
    pub added_mm: f64,
    /// Time put in at the ramp's feed, seconds; `None` where the feed is not known.
    pub added_seconds: Option<f64>,
    /// The path before in the tool's frame, mm.
    #[serde(skip)]
    pub path_before: Vec<[f64; 3]>,
    /// The path after.
    #[serde(skip)]
    pub path_after: Vec<[f64; 3]>,
}

/// What became of a ramp.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RampOutcome {
    /// It keeps the limits as it is.
    Fits,
    /// It was corrected.
    Corrected,
    /// It does not keep them and stays.
    Kept,
}
