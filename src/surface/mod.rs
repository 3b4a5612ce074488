//! Surfaces that a cutter follows: profiles in vertical planes and meshes, and where the cutter's tip stands on them.
//!
//! Everything is in millimetres, with z along the tool axis. Nothing here knows CL text or recipes.

pub mod drop_cutter;
pub mod mesh_section;
pub mod profile;
