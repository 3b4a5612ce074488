//! Writing outputs: never half a file, never over an input.

mod atomic;
mod interrupt;
mod same;

pub use atomic::{write_atomically, write_atomically_unless};
pub use interrupt::{Interrupt, is_interrupt};
pub use same::same_file;
