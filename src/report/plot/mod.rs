//! This module plots quantities of programs over time or path for documents: as SVG, and from that as PNG
//! ([`render_png`]).
//!
//! Panels are one above the other, and programs are drawn over each other. The drawing has a fixed size and
//! whole coordinates and needs no fonts, so the same curves give the same bytes.

mod curve_drawing;
mod curve_outline;
mod plot_document;
mod png;
mod program_curves;

pub use curve_drawing::{CurvePanel, PlotCurve, PlotSegment, draw_curve_panels};
pub use plot_document::{PlotSubject, plot_to_json};
pub use png::render_png;
pub use program_curves::{PlotAbscissa, PlotQuantity, PlottedProgram, build_panels, draw_programs};
