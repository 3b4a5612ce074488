//! This module bounds the engagement of every block from the motions alone, without a grid: an interval
//! [lower, upper] that contains the true largest share, or the true largest chip, of a block.
//!
//! A point is material when it lies in the initial stock and in no sweep of an earlier block. The cutter's
//! surface is divided in patches; a patch is dropped when the stock's outside and earlier sweeps are proved
//! to cover it at all times of the block, and a point that is proved to be material raises the lower bound.
//! Settings change the width of the interval and the time, never whether it is true.

mod advance;
mod arc_stock;
mod block_bound;
mod block_motion;
mod certified_program;
mod coincident_times;
mod column_gap;
mod contact_grid;
mod contact_ring;
mod contact_section;
mod contour_element;
mod convex_times;
mod cover_test;
mod cutter_contour;
mod cutter_pose;
mod cylinder_gap;
mod engaged_cells;
mod engagement_proof;
mod flat_arc;
mod known_patches;
mod level_times;
mod material_witness;
mod mesh_gap;
mod near_coincidence;
mod near_steps;
mod patch_examination;
mod patch_hull;
mod path_cover;
mod plane_path;
mod possible_cover;
mod proof_geometry;
mod repeated_steps;
mod step_cover;
mod step_extent;
mod step_gap;
mod step_glance;
mod step_index;
mod step_runs;
mod step_search;
mod step_times;
mod stock_gap;
mod surface_patch;
mod swept_step;
mod time_spans;
mod time_union;
mod triangle_tree;
mod witness_climb;

pub use block_bound::{CertifiedEngagement, EngagementOptions, WarmStart};
pub use block_motion::{BlockMotion, CertifiedProgramError, StepLimits};
pub use certified_program::CertifiedProgram;
pub use column_gap::{ColumnGap, FunctionGap};
pub use contact_grid::{ContactGrid, ContactRow, RowContact};
pub use contact_section::{ContactSection, SectionRow};
pub use contour_element::ContourElement;
pub use cover_test::MATERIAL_TOLERANCE_MM;
pub use cutter_contour::{CutterContour, CutterContourError};
pub use cutter_pose::{CutterPose, PointArc, PointLine, TipArc};
pub use cylinder_gap::CylinderGap;
pub use engaged_cells::CONTACT_DIRECTIONS;
pub use engagement_proof::{EngagementProof, ProofClaim, ProofFinding, ProofStock};
pub use material_witness::EngagementWitness;
pub use mesh_gap::{MeshGap, MeshGapError};
pub use proof_geometry::ProofCutter;
pub use step_search::EngagementCriterion;
pub use stock_gap::{BoxGap, HalfSpaceGap, HullMargin, StockGap};
