//! Cutters lowered onto meshes.
