//! This module holds what people are shown as data and plain text, before a report decides where it appears:
//! numbers and tables as text, text that is safe to show, and line drawings as points.
//!
//! Transforms describe themselves with it (`transform::TransformReport`), and `report` draws and prints it.

pub(crate) mod path_panel;
pub(crate) mod safe_text;
pub(crate) mod text_format;
