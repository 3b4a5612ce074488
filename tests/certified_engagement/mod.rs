//! Certified engagement: closed forms, the shared cases, and random programs against a cloud of points whose membership
//! is told by other means.

mod arcs;
pub mod cases;
mod cases_reader;
mod closed_forms;
mod cloud;
mod contact_sections;
mod loads;
mod mills;
mod oracle;
mod proof;
mod random_programs;
mod short_moves;
mod stocks;
