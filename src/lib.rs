//! Reads, checks, corrects and writes cutter-location data without losing a byte of what it does not change.
//!
//! The pipeline is the order of the modules: bytes ([`source`]) are parsed ([`parse`]) into a [`program`] of statements,
//! whose motions are a view; a [`recipe`] lists [`transform`]s; [`mod@write`] copies untouched bytes and patches changed
//! numbers; [`report`] says what changed. ARCHITECTURE.md follows one GOTO through all of it.

// A room may hold what only rooms of a larger set use; what nobody uses is found with all of them.
#![cfg_attr(not(feature = "cli"), allow(dead_code, unused_imports))]

pub mod check;
pub mod diagnostic;
pub mod number;
pub mod parse;
pub mod program;
pub mod source;
pub mod write;

#[cfg(feature = "files")]
pub mod output_files;

#[cfg(feature = "simulation")]
pub mod cutter;
#[cfg(feature = "simulation")]
pub mod engagement;
#[cfg(feature = "simulation")]
pub mod layered_chips;
#[cfg(feature = "simulation")]
pub mod parameters;
#[cfg(feature = "simulation")]
pub mod presentation;
#[cfg(feature = "simulation")]
pub mod recipe;
#[cfg(feature = "simulation")]
pub mod recipe_rules;
#[cfg(feature = "simulation")]
pub mod setup;
#[cfg(feature = "simulation")]
pub mod simulation_run;
#[cfg(feature = "simulation")]
pub mod stock;
#[cfg(feature = "simulation")]
pub mod surface;
#[cfg(feature = "simulation")]
pub mod surface_milling;
#[cfg(feature = "simulation")]
pub mod transform;
#[cfg(feature = "simulation")]
mod yaml;

#[cfg(feature = "report")]
pub mod fingerprint;
#[cfg(feature = "report")]
pub mod job;
#[cfg(feature = "report")]
pub mod provenance;
#[cfg(feature = "report")]
pub mod report;
#[cfg(feature = "report")]
pub mod undo;

#[cfg(feature = "cli")]
pub mod batch;

#[cfg(test)]
#[path = "../tests/support/property.rs"]
mod property;

/// The examples of CONTRIBUTING.md, so that they compile and run as tests.
#[cfg(all(doctest, feature = "simulation"))]
#[doc = include_str!("../CONTRIBUTING.md")]
pub struct ContributingExamples;
