//! This module prepares what people are shown, as data and plain text: numbers and tables as text, the units
//! that a reader sees, text that is safe to show, and line drawings as points.
//!
//! It is below `transform` and `report`, because both need it: transforms describe their work with it
//! (`transform::TransformReport`), and `report` draws and prints the result.

pub(crate) mod display_units;
pub(crate) mod drawn_limit;
pub(crate) mod path_panel;
pub mod safe_json;
pub(crate) mod safe_text;
pub(crate) mod text_format;

pub use safe_text::to_safe_line;
