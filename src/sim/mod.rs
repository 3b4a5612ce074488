//! Simulation: stock as dexels, cutters as convex profiles, sweeps that remove material, and what each piece of the path
//! engages.
//!
//! Everything here is in millimetres, radians and the workpiece frame, in which dexels stand along z. The simulation never
//! sees text; [`crate::setup`] makes cutters and stock, [`crate::transform`] and [`crate::report`] ask it.

mod body;
pub mod compare;
pub mod cutter;
pub mod dexel;
mod dilate;
pub mod engagement;
pub mod export;
mod interval;
pub mod material;
pub mod mesh;
pub mod profile;
pub mod remains;
pub mod stock;
pub mod teeth;

pub use body::Body;
pub use compare::{CompareError, Difference};
pub use cutter::{Collar, CollarKind, Cutter};
pub use dexel::{Band, Dexels, Interval, Layout};
pub use engagement::{Bin, Engagement};
pub use material::Material;
pub use mesh::{Mesh, MeshError};
pub use profile::{Profile, ProfileError, ProfilePoint};
pub use remains::RemainsError;
pub use stock::{Stock, StockError};
pub use teeth::Teeth;
