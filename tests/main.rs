//! One test binary; a folder for each area.

mod motion;
mod parse;
mod support;
