//! All integration tests, in one binary so that the library is linked once; a folder for each area.

// In a test a panic is the message; clippy's own exception covers `#[test]` functions but not their helpers.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)]

mod batch;
mod book;
mod browser;
mod certified_engagement;
mod check;
mod chips;
mod cli;
mod documents;
mod editor;
mod engagement;
mod examples;
mod fingerprint;
mod layers;
mod machine;
mod machining;
mod motion;
mod parse;
mod provenance;
mod real_text;
mod recipe;
mod release;
mod report;
mod setup;
mod stock;
mod support;
mod surface;
mod surfacing;
mod transform;
mod undo;
mod write_files;
