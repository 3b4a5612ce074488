//! `compensate_z`: moves the tip of a ball-nose cutter to where the ball touches the programmed points
//! (Dragoi 2009).
//!
//! [`vertical_passes`](self) finds the passes in the motions. A pass becomes a profile, and the tip follows
//! the envelope of the ball over it (`pass_profile`). Or the cutter is lowered onto a model along the pass.
//! Or every point is displaced along its own normal (`contact_normals`). `leads` moves the motions around
//! passes, `pass_writer` writes everything, and the step measures what was written by another method.
//!
//! Nothing is guessed around a pass. Leads at feed are displaced like their end, points straight above an end
//! stay above it, and no rapid ends lower than before. Other operations and cuts that `where` leaves out
//! stay. Where that is impossible, the step stops and reports the place.

mod arc_template;
mod by_mesh;
mod by_normals;
mod by_profile;
mod compensation_job;
mod contact_normals;
mod cutter_lowering;
mod findings;
mod lead_conflict;
mod leads;
mod motion_ends;
mod parameters;
mod pass_profile;
mod pass_writer;
mod report;
mod report_text;
mod step;
mod tip_clearance;
mod vertical_passes;
mod written_passes;

pub use parameters::{ArcOutput, CompensateZ, CompensationReference, InputPointKind, OutputPointKind};
pub use report::{CompensateZReport, PassReport};
