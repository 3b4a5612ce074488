//! All integration tests, in one binary.

// clippy.toml allows these in tests, but does not see that helpers of integration tests are tests too.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

mod recipe;
mod support;
