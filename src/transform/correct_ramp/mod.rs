//! `correct_ramp`: ramp approaches that an indexable cutter survives (Zhou 2020).
//!
//! `find` reads ramps from motions; what follows knows no text: [`ramp`] is a ramp as geometry, [`ramp_limits`] what the cutter allows,
//! [`correct_ramp()`] makes it keep them ([`circumscribed_circle`], [`ramp_passes`], detours, inside a [`tool_region`]). `write` puts the new points into the CL
//! text, and the step measures them again.

pub mod circumscribed_circle;
mod detour;
mod findings;
mod level_motions;
pub mod milled_area;
mod parameters;
pub mod ramp;
mod ramp_correction;
mod ramp_cutter;
pub mod ramp_kind;
pub mod ramp_limits;
pub mod ramp_passes;
mod ramp_proof;
mod ramp_search;
mod ramp_writer;
mod report;
mod step;
pub mod tool_region;

pub use parameters::{CorrectRamp, ImpossibleRampHandling, PlungeHandling, RampRegionSpec, RampToolSpec};
pub use ramp_correction::{CorrectedRamp, ImpossibleCorrection, LengtheningMethod, RampTask, correct_ramp};
pub use report::{CorrectRampReport, RampOutcome, RampReport};
