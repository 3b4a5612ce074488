//! This module holds what an editor sets: a setup file, and where the documentation of codes stands.

use serde_json::Value;
use std::path::PathBuf;

/// The settings of the server.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct ServerSettings {
    /// A setup file, by which programs are judged.
    pub setup: Option<PathBuf>,
    /// The address of the page of codes, as `scripts/book` makes it: findings then link to it.
    pub documentation: Option<String>,
}

impl ServerSettings {
    /// Takes over what is given: `{ "setup": "shop.yaml", "documentation": "https://..." }`, also under the key
    /// `clsmith`. An empty text takes a setting back.
    pub(super) fn update(&mut self, given: &Value) {
        let given = given.get("clsmith").unwrap_or(given);
        let text = |key: &str| given.get(key).and_then(Value::as_str).map(str::to_owned);
        if let Some(setup) = text("setup") {
            self.setup = Some(PathBuf::from(setup)).filter(|path| !path.as_os_str().is_empty());
        }
        if let Some(documentation) = text("documentation") {
            self.documentation = Some(documentation).filter(|address| !address.is_empty());
        }
    }
}
