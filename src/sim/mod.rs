//! Simulation: stock as dexels, cutters as convex profiles, sweeps that remove material, and what each piece of the path
//! engages.
//!
//! Everything here is in millimetres, radians and the workpiece frame, in which dexels stand along z. The simulation never
//! sees text; [`crate::setup`] makes cutters and stock, [`crate::transform`] and [`crate::report`] ask it.

pub mod angles;
pub mod chip;
pub mod chip_load;
pub mod cutter;
mod edges;
pub mod engagement;
pub mod exact;
pub mod force;
pub mod load_feed;
pub mod material;
pub mod profile;
pub mod teeth;

pub use cutter::{Collar, Cutter};
pub use engagement::{Bin, Engagement};
pub use exact::{ExactChips, Fineness, ToothMotion, exact_chips};
pub use force::{LoadModel, Loads};
pub use material::Material;
pub use profile::{Profile, ProfileError, ProfilePoint};
pub use teeth::Teeth;
