//! Stock: bodies, meshes and columns, files of them, and the comparison with a target part.

mod bodies;
mod compare;
mod export;
mod mesh;
mod remains;
pub mod shapes;
