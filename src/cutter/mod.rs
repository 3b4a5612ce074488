//! One mill: its meridian, its teeth, and what stands above its flutes.
//!
//! Lengths are in millimetres from the tip up the axis, angles in radians. [`crate::setup`] makes cutters; [`crate::engagement`]
//! moves them through stock.

mod cutter_model;
pub mod meridian;
pub mod teeth;

pub use cutter_model::{CutterModel, NonCuttingCylinder, NonCuttingKind};
pub use meridian::{Meridian, MeridianError, MeridianPoint};
pub use teeth::Teeth;
