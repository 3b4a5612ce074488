//! This module simulates milling: it holds the stock as dexels, the cutters as convex solids of revolution,
//! the sweeps that remove material, and what each piece of the path engages.
//!
//! All lengths are in mm, all angles in radians, and all points in the workpiece frame, in which the dexels
//! stand along z. The simulation never sees text: [`crate::setup`] makes cutters and stock, and
//! [`crate::transform`] and [`crate::report`] read the results.

mod bin_filling;
mod body;
pub mod chip_load;
pub mod chip_thickness;
pub mod cutter;
pub mod cutting_coefficients;
pub mod cutting_force;
pub mod dexel;
mod dexel_spans;
mod dilate;
mod edge_elements;
pub mod engagement;
pub mod exact_tooth_paths;
pub mod immersion;
pub mod load_limited_feed;
pub mod meridian;
pub mod mesh;
pub mod path_linearizer;
pub mod simulation;
pub mod stl_export;
pub mod stock;
pub mod stock_file;
mod sweep;
pub mod target_deviation;
pub mod teeth;

pub use body::SolidBody;
pub use cutter::{CutterModel, NonCuttingCylinder, NonCuttingKind};
pub use cutting_coefficients::CuttingCoefficients;
pub use cutting_force::{CuttingLoads, LoadModel};
pub use dexel::{DexelBand, DexelGrid, DexelSpan, Dexels};
pub use engagement::{Engagement, EngagementBin};
pub use exact_tooth_paths::{ExactChipThickness, ToothMotion, ToothSampling, measure_exact_chips};
pub use meridian::{Meridian, MeridianError, MeridianPoint};
pub use mesh::{Mesh, MeshError};
pub use path_linearizer::{MotionPiece, PathLinearizer};
pub use simulation::{PathPiece, Simulation, ToolPose};
pub use stock::{Stock, StockError};
pub use stock_file::StockFileError;
pub use target_deviation::{GridMismatch, TargetDeviation};
pub use teeth::Teeth;
