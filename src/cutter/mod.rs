//! This module describes one mill: its meridian, its teeth, and the shank and holder above its flutes.
//!
//! Lengths are in mm from the tip up the axis, angles in radians. [`crate::setup`] makes cutters, and
//! [`crate::engagement`] moves them through stock.

mod cutter_model;
mod dead_middle;
mod meridian;
pub(crate) mod teeth;
mod tool_beam;
mod undercut;

pub use cutter_model::{CutterModel, NonCuttingCylinder, NonCuttingKind};
pub use dead_middle::DeadMiddle;
pub use meridian::{CutterTop, Meridian, MeridianError, MeridianPoint};
pub use teeth::Teeth;
pub use tool_beam::{BeamForces, BeamStep, FLUTE_DIAMETER_FACTOR, ToolBeam};
