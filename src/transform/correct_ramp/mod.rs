//! `correct_ramp` makes ramp approaches that an indexable cutter survives (Zhou 2020).
//!
//! `ramp_search` reads ramps from motions. The geometry modules know no text: `ramp` is a ramp,
//! `ramp_limits` holds what the cutter allows, and `ramp_correction` makes the ramp keep these limits
//! (`circumscribed_circle`, `ramp_passes`, detours, inside a `tool_region`). `ramp_writer` writes the
//! new points into the CL text, and the step measures them again.
//!
//! A ramp is recognized by what follows it: it is a descent at feed after which the tool continues to cut at
//! the level that it has reached. Marks of the file (engage) have priority over geometry. Without marks, an
//! operation must mostly cut level, because on a surface any descent may be a cut.
//!
//! A corrected ramp stays where its operation mills anyway: inside the paths at the ramp's level, grown by
//! the tool's radius and shrunk by it again (a closing). The convex hull, which the paper uses, covers
//! islands and, around an outside contour, the part itself.
//!
//! New points are inserted before the old ones, where the feed at the start of the ramp is in force. If the
//! feed decreases during the descent, all new points are inserted where it is lowest. A ramp whose feed
//! increases, or that is under CUTCOM, is not corrected.

pub(crate) mod circumscribed_circle;
mod detour;
mod drilled_entry;
mod findings;
mod level_motions;
mod level_paths;
mod milled_area;
mod parameters;
mod planned_ramp;
mod polygon_containment;
pub(crate) mod ramp;
mod ramp_check;
pub(crate) mod ramp_correction;
mod ramp_cutter;
pub(crate) mod ramp_kind;
pub(crate) mod ramp_limits;
mod ramp_panels;
pub(crate) mod ramp_passes;
pub(crate) mod ramp_pillar;
mod ramp_proof;
mod ramp_search;
mod ramp_writer;
mod report;
mod report_text;
mod step;
pub(crate) mod tool_region;

pub use milled_area::MilledArea;
pub use parameters::{
    CorrectRamp, ImpossibleRampHandling, PlungeHandling, RampLimitRule, RampRegionSpec, RampToolSpec,
};
pub use ramp::{Ramp, RampArc, RampLeg, RampStep};
pub use ramp_check::check_ramps;
pub use ramp_correction::{ImpossibleCorrection, LengtheningMethod};
pub use ramp_limits::RampMeasurement;
pub use report::{CorrectRampReport, RampOutcome, RampPillar, RampReport};
