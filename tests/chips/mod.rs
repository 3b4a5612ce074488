//! Undeformed chips.

mod brute;
mod cover;
