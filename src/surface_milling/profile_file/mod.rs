//! This module reads profile files: YAML that describes a profile piece by piece, each piece from the end of
//! the one before.

mod curves;
mod piece_fault;
mod profile_reader;
mod text;

use super::SectionProfile;
use crate::diagnostic::Failure;
use crate::source::Source;
use std::sync::Arc;

/// Reads a profile file.
///
/// # Errors
/// Returns a finding for every fault of the file, at its place.
pub fn load_profile(source: &Arc<Source>) -> Result<SectionProfile, Failure> {
    profile_reader::read_profile(source)
}

/// Returns the JSON schema of a profile file, for editors.
pub fn profile_schema() -> serde_json::Value {
    text::make_profile_schema()
}
