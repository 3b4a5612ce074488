//! Quantities of programs along time or path, as a drawing for documents: SVG, and from that PNG ([`png`]).
//!
//! Panels stand one above the other, programs are laid over each other. The drawing has a fixed size and whole coordinates, and needs no
//! fonts, so the same curves make the same bytes.

mod chart;
mod curves;
mod png;

pub use chart::{Curve, Panel, Stretch, draw};
pub use curves::{Along, Plotted, Quantity, panels, plot};
pub use png::png;
