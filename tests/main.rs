//! One test binary; a folder for each area.

// clippy.toml allows these in test functions; here the helpers beside them are meant too: a test that fails may panic.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

mod motion;
mod parse;
mod support;
