//! What a run has to say: findings filtered, sorted and rendered.
//!
//! [`policy`] decides which findings stand and how bad they are, [`render`] turns them into text, and [`explain`] answers
//! questions about a code. Everything is written into a writer that the caller hands in, or returned.

pub mod explain;
pub mod policy;
pub mod render;
pub mod steps;
