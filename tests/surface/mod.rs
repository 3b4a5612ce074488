//! Profiles and meshes under cutters.

mod drop;
mod profile;
