//! This module writes files that appear whole or not at all, and tells whether two paths lead to one file.

mod atomic_write;
mod interrupt;
mod output_access;
mod same_file;
mod windows_path;

pub use atomic_write::{TemporaryFiles, write_atomically, write_atomically_unless, write_new_atomically};
pub use interrupt::{Interrupt, WriteError};
pub use output_access::OutputAccess;
pub(crate) use same_file::FileSet;
pub use same_file::is_same_file;
pub use windows_path::WindowsName;
