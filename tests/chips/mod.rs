//! Undeformed chips.

mod area;
mod brute;
mod cover;
mod diagram;
mod engagement;
mod frame;
mod sections;
mod solid;
mod stack;
mod whole;
