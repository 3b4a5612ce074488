//! The exact tooth mode.
