//! Simulation: stock as dexels, cutters as convex profiles, sweeps that remove material, and what each piece of the path
//! engages.
//!
//! Everything here is in millimetres, radians and the workpiece frame, in which dexels stand along z. The simulation never
//! sees text; [`crate::setup`] makes cutters and stock, [`crate::transform`] and [`crate::report`] ask it.

pub mod angles;
mod body;
pub mod chip;
pub mod chip_load;
pub mod compare;
pub mod cutter;
pub mod dexel;
mod dilate;
mod edges;
pub mod engagement;
pub mod exact;
pub mod export;
mod fill;
pub mod force;
mod interval;
pub mod load_feed;
pub mod material;
pub mod mesh;
pub mod profile;
pub mod remains;
pub mod run;
pub mod stock;
mod sweep;
pub mod teeth;
pub mod trace;

pub use body::Body;
pub use compare::{CompareError, Difference};
pub use cutter::{Collar, CollarKind, Cutter};
pub use dexel::{Band, Dexels, Interval, Layout};
pub use engagement::{Bin, Engagement};
pub use exact::{ExactChips, Fineness, ToothMotion, exact_chips};
pub use force::{LoadModel, Loads};
pub use material::Material;
pub use mesh::{Mesh, MeshError};
pub use profile::{Profile, ProfileError, ProfilePoint};
pub use remains::RemainsError;
pub use run::{Piece, Place, Simulation};
pub use stock::{Stock, StockError};
pub use teeth::Teeth;
pub use trace::{Step, Trace};
