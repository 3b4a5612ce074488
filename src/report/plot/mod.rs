//! Quantities of programs along time or path, as a drawing for documents: SVG, and from that PNG ([`render_png`]).
//!
//! Panels stand one above the other, programs are laid over each other. The drawing has a fixed size and whole coordinates, and needs no
//! fonts, so the same curves make the same bytes.

mod curve_drawing;
mod png;
mod program_curves;

pub use curve_drawing::{CurvePanel, PlotCurve, PlotSegment, draw_curve_panels};
pub use png::render_png;
pub use program_curves::{PlotAbscissa, PlotQuantity, PlottedProgram, build_panels, draw_programs};
