//! `compensate_z`: the tip of a ball-nose cutter from the points that it shall touch (Dragoi 2009).
//!
//! [`vertical_passes`](self) are found in the motions; a pass becomes a profile and the envelope of the ball over it (`profile`), or the
//! cutter is lowered onto a model along it (`model`), or every point moves by its own normal ([`contact_normals`]). `leads` moves what lies
//! around passes, `write` writes it all, and the step measures what was written by other means.

mod arc_template;
mod by_mesh;
mod by_normals;
mod by_profile;
pub mod contact_normals;
mod cutter_lowering;
mod findings;
mod leads;
mod motion_ends;
mod parameters;
mod pass_profile;
mod pass_writer;
mod report;
mod step;
mod tip_clearance;
mod vertical_passes;
mod written_passes;

pub use parameters::{ArcOutput, CompensateZ, CompensationReference, InputPointKind, OutputPointKind};
pub use report::{CompensateZReport, PassReport};
