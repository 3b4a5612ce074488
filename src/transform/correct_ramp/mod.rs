//! `correct_ramp`: ramp approaches that an indexable cutter survives (Zhou 2020).
//!
//! `find` reads ramps from motions; what follows knows no text: [`ramp`] is a ramp as geometry, [`limits`] what the cutter allows,
//! [`correct()`] makes it keep them ([`circle`], [`layers`], detours, inside a [`region`]). `write` puts the new points into the CL
//! text, and the step measures them again.

pub mod circle;
mod correct;
mod cutter;
mod detour;
mod find;
pub mod kind;
pub mod layers;
mod level;
pub mod limits;
pub mod milled;
mod parameters;
mod prove;
pub mod ramp;
pub mod region;
mod report;
mod step;
mod words;
mod write;

pub use correct::{Corrected, Impossible, Lengthened, Task, correct};
pub use parameters::{CorrectRamp, IfImpossible, Plunges, RampRegion, RampTool};
pub use report::{Outcome, RampReport, Report};
