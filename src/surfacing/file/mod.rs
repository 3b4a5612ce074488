//! Profile files: YAML that describes a profile piece by piece, each piece from where the one before ends.

mod curves;
mod text;

use super::Profile;
use crate::diagnostic::Diagnostic;
use crate::source::Source;
use std::sync::Arc;

/// Reads a profile file.
///
/// # Errors
/// Everything that is wrong with the file, each at its place.
pub fn load(source: &Arc<Source>) -> Result<Profile, Vec<Diagnostic>> {
    text::load(source)
}

/// JSON schema of a profile file, for editors.
pub fn schema() -> serde_json::Value {
    text::schema()
}
