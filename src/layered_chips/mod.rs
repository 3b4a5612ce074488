//! This module computes the exact undeformed chips of a flat end mill between two poses, layer by layer, in
//! three and five axes.
//!
//! The workpiece is a stack of layers z = const, of the workpiece frame or of another one (`layer_frame`). Between two poses the tip moves straight and the axis turns
//! evenly. On a layer, the cutter has a family of sections (`section_family`). The area that the family
//! covers is bounded by its first and last edge and by its envelope, which the boundary construction diagram
//! finds (`boundary_diagram`; "An accurate and efficient approach to geometric modeling of undeformed chips
//! in five-axis CNC milling", Computer-Aided Design 88, 2017). `swept_area` turns the diagram into areas,
//! `stack` holds the workpiece, `chip` computes what one piece of path removes, and
//! [`measure_engagement()`] gives the engagement that feeds are made from.
//!
//! Lengths are in mm, angles in radians, and points in the frame of the layers.

pub(crate) mod area;
pub(crate) mod boundary_diagram;
pub(crate) mod chip;
pub(crate) mod engagement;
mod interval;
mod jet;
mod layer_ellipse;
mod layer_frame;
mod mill_step;
pub(crate) mod section_family;
pub(crate) mod stack;
pub(crate) mod stl_export;
pub(crate) mod swept_area;
mod trig_polynomial;

pub use area::{AreaGrid, Polygon};
pub use boundary_diagram::{
    BoundaryDiagram, BranchEnd, EdgeState, EnvelopeBranch, EventProof, TopologyEvent,
};
pub use chip::{Chip, LayerChip, cut_chips};
pub(crate) use engagement::largest_feed_fraction;
pub use engagement::measure_engagement;
pub use layer_ellipse::LayerEllipse;
pub use layer_frame::LayerFrame;
pub use mill_step::{FlatMill, MillStep, MillStepError};
pub use section_family::{DiagramCurve, SectionFamily};
pub use stack::{Layer, LayerRemoval, LayerStack, LayerStackError};
pub use swept_area::{LayerSweptArea, RimDirections, SectionSeam};
