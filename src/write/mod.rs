//! This module writes: it patches statements in the file's own style, and writes files that appear whole or
//! not at all.

mod atomic_write;
mod editor;
mod file_style;
mod interrupt;
pub mod new_program;
mod number_patch;
mod same_file;

pub use atomic_write::{TemporaryFiles, write_atomically, write_atomically_unless, write_new_atomically};
pub use editor::{ProgramEditor, statement_syntax};
pub use file_style::FileStyle;
pub use interrupt::{Interrupt, WriteError};
pub use number_patch::{FEED_SHARE, copy_with_numbers, patch_numbers};
pub use same_file::{FileSet, is_same_file};
