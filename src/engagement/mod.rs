//! This module simulates milling: sweeps that remove material, and from them chip thickness and forces.
//!
//! Lengths are in mm, angles in radians, and points in the workpiece frame. A motion becomes straight pieces
//! (`path_linearizer`). A [`Simulation`] sweeps the cutter along them, and each piece gets an
//! [`Engagement`]. From that, chip thickness, removal rate and forces follow for any feed and any teeth.
//! [`crate::simulation_run`] runs whole programs.

mod bin_filling;
mod chip_load;
mod chip_thickness;
mod cutting_coefficients;
mod cutting_force;
mod edge_elements;
mod edge_thickness;
pub mod engagement_bins;
mod exact_tooth_paths;
mod immersion;
mod load_bound;
mod load_limited_feed;
mod machine_path;
mod path_linearizer;
mod path_piece;
mod pillar_contact;
mod removal_profile;
mod row_windows;
mod section_forces;
mod section_nodes;
mod simulation;
mod sweep;
mod tool_bending;

pub(crate) use chip_load::{feed_for_chip_of_share_mm_min, thickest_chip_of_share_mm};
pub use cutting_coefficients::{CuttingCoefficients, CuttingLaw, KienzleTerm};
pub use cutting_force::{BendingLoads, CuttingLoads, LoadModel};
pub use edge_thickness::{EdgePoint, EdgeThicknessMap, ToothThickness};
pub use engagement_bins::{Engagement, EngagementBin};
pub use exact_tooth_paths::{ExactChipThickness, ToothMotion, ToothSampling, measure_exact_chips};
pub(crate) use load_bound::edge_lag_rad_per_mm;
pub use load_bound::{LoadBound, bound_swept_area_mm2};
pub use machine_path::{FOLLOWED_HEIGHT_MM, MachinePath, axis_on_shortest_turn, distance_from_chord_mm};
pub(crate) use path_linearizer::PathLinearizer;
pub use path_linearizer::{MOST_PIECES, MotionPiece};
pub use path_piece::PathPiece;
pub use pillar_contact::PillarContact;
pub use removal_profile::RemovalProfile;
pub(crate) use removal_profile::removal_window_mm;
pub use section_forces::{EdgeForceModel, SectionForces};
pub use simulation::Simulation;
pub use tool_bending::ToolBending;
