//! The exact undeformed chips of a flat end mill between two places of the cutter, layer by layer, in three and five axes.
//!
//! The workpiece is a stack of layers z = const. Between two places the tip goes straight and the axis turns evenly; on a layer
//! the cutter is a family of [`section`]s, and what the family covers is bounded by its first and last edge and its envelope, which
//! the boundary construction [`diagram`] finds ("An accurate and efficient approach to geometric modeling of undeformed chips in
//! five-axis CNC milling", Computer-Aided Design 88, 2017). [`cover`] turns the diagram into areas, [`stack`] keeps the
//! workpiece, [`chip`] is what one piece of path removes, and [`engagement()`] what feeds are made from.
//!
//! Everything is in millimetres, radians and the workpiece frame.

pub mod area;
pub mod chip;
pub mod cover;
pub mod diagram;
pub mod ellipse;
mod engagement;
pub mod family;
mod interval;
mod jet;
pub mod section;
pub mod solid;
pub mod stack;
mod trig;

pub use area::Polygon;
pub use chip::{Chip, LayerChip, cut};
pub use cover::{Cover, Rim};
pub use diagram::Diagram;
pub use engagement::{engagement, largest_share};
pub use family::Family;
pub use section::{FlatMill, Refusal, Step};
pub use stack::{Layer, Removed, Stack, StackError};
