//! Undeformed chips.

mod area;
mod brute;
mod solid;
mod stack;
