//! Profiles and meshes under cutters.

mod drop;
mod profile;
mod section;
pub(crate) mod solids;
