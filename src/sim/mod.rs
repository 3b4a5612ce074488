//! Simulation: stock as dexels, cutters as convex profiles, sweeps that remove material, and what each piece of the path
//! engages.
//!
//! Everything here is in millimetres, radians and the workpiece frame, in which dexels stand along z. The simulation never
//! sees text; [`crate::setup`] makes cutters and stock, [`crate::transform`] and [`crate::report`] ask it.

pub mod angles;
pub mod chip;
pub mod chip_load;
pub mod cutter;
pub mod dexel;
mod edges;
pub mod engagement;
pub mod exact;
pub mod force;
pub mod load_feed;
pub mod material;
pub mod profile;
pub mod run;
mod sweep;
pub mod teeth;
pub mod trace;

pub use cutter::{Collar, CollarKind, Cutter};
pub use dexel::{Band, Dexels, Interval, Layout};
pub use engagement::{Bin, Engagement};
pub use exact::{ExactChips, Fineness, ToothMotion, exact_chips};
pub use force::{LoadModel, Loads};
pub use material::Material;
pub use profile::{Profile, ProfileError, ProfilePoint};
pub use run::{Piece, Place, Simulation};
pub use teeth::Teeth;
pub use trace::{Step, Trace};
