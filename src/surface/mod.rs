//! This module handles the surfaces that a cutter follows, profiles in vertical planes and meshes, and
//! computes where the cutter's tip is when it touches them.
//!
//! Lengths are in mm, with z along the tool axis. Plane geometry beyond profiles (hulls, buffers,
//! intersections) comes from the crate `geo`, nearest points from `rstar`. Nothing here knows CL text or
//! recipes.

pub(crate) mod drop_cutter;
pub(crate) mod mesh_section;
pub(crate) mod profile;
