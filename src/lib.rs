//! Reads, checks, corrects and writes cutter-location data without losing a byte of what it does not change.
//!
//! The pipeline is the order of the modules: bytes ([`source`]) are parsed ([`parse`]) into a [`program`] of statements,
//! whose motions are a view; a [`recipe`] lists [`transform`]s; [`mod@write`] copies untouched bytes and patches changed
//! numbers; [`report`] says what changed. ARCHITECTURE.md follows one GOTO through all of it.

pub mod batch;
pub mod check;
pub mod cutter;
pub mod diagnostic;
pub mod engagement;
pub mod fingerprint;
pub mod job;
pub mod layered_chips;
pub mod number;
pub mod parameters;
pub mod parse;
pub mod presentation;
pub mod program;
pub mod provenance;
pub mod recipe;
pub mod recipe_rules;
pub mod report;
pub mod setup;
pub mod simulation_run;
pub mod source;
pub mod stock;
pub mod surface;
pub mod surface_milling;
pub mod transform;
pub mod undo;
pub mod write;
mod yaml;

#[cfg(test)]
#[path = "../tests/support/property.rs"]
mod property;

/// The examples of CONTRIBUTING.md, so that they compile and run as tests.
#[cfg(doctest)]
#[doc = include_str!("../CONTRIBUTING.md")]
pub struct ContributingExamples;
