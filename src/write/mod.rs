//! Writing: patching statements in the file's own style, and files that appear whole or not at all.

mod atomic;
mod editor;
mod interrupt;
mod patch;
pub mod program;
mod same;
mod style;

pub use atomic::{Temporaries, write_atomically, write_atomically_unless, write_new_atomically};
pub use editor::{Editor, syntax};
pub use interrupt::{Interrupt, is_interrupt};
pub use patch::{FEED_SHARE, copy as copy_with_numbers, numbers as patch_numbers};
pub use same::{FileSet, same_file};
pub use style::Style;
