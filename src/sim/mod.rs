//! Simulation: stock as dexels, cutters as convex profiles, sweeps that remove material, and what each piece of the path
//! engages.
//!
//! Everything here is in millimetres, radians and the workpiece frame, in which dexels stand along z. The simulation never
//! sees text; [`crate::setup`] makes cutters and stock, [`crate::transform`] and [`crate::report`] ask it.

pub mod cutter;
pub mod dexel;
pub mod engagement;
pub mod material;
pub mod profile;
pub mod run;
mod sweep;
pub mod teeth;
pub mod trace;

pub use cutter::{Collar, CollarKind, Cutter};
pub use dexel::{Band, Dexels, Interval, Layout};
pub use engagement::{Bin, Engagement};
pub use material::Material;
pub use profile::{Profile, ProfileError, ProfilePoint};
pub use run::{Piece, Place, Simulation};
pub use teeth::Teeth;
pub use trace::{Step, Trace};
