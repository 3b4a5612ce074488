//! This module writes: it patches statements in the file's own style, and writes whole new programs.

mod asked_numbers;
mod editor;
mod file_style;
mod line_breaks;
mod line_columns;
mod many_edits;
pub mod new_program;
mod number_patch;

pub use editor::{ProgramEditor, statement_syntax};
pub use file_style::FileStyle;
pub(crate) use number_patch::{FEED_SHARE, copy_with_numbers, patch_numbers};
