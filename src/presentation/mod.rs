//! What people are shown, as data and plain text, before any report decides where it stands: numbers and tables as
//! text, units that a reader sees, text that is safe to show, and line drawings as points.
//!
//! Transforms describe themselves with it (`transform::TransformReport`), and `report` draws and prints it.

pub(crate) mod display_units;
pub(crate) mod path_panel;
pub mod safe_json;
pub(crate) mod safe_text;
pub(crate) mod text_format;

pub use safe_text::to_safe_line;
