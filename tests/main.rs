//! One test binary; a folder for each area.

mod check;
mod motion;
mod parse;
mod support;
