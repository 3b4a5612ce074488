//! `compensate_z`: the tip of a ball-nose cutter from the points that it shall touch (Dragoi 2009).
//!
//! [`passes`](self) are found in the motions; a pass becomes a profile and the envelope of the ball over it (`profile`), or the
//! cutter is lowered onto a model along it (`model`), or every point moves by its own normal ([`normals`]). `leads` moves what lies
//! around passes, `write` writes it all, and the step measures what was written by other means.

mod by_mesh;
mod by_normals;
mod by_profile;
mod clearance;
mod ends;
mod leads;
mod model;
pub mod normals;
mod parameters;
mod passes;
mod profile;
mod proof;
mod report;
mod step;
mod template;
mod words;
mod write;

pub use parameters::{Against, Arcs, CompensateZ, CutterPoint, PathPoint};
pub use report::{PassReport, Report};
