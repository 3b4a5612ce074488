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
    /// Whether the editor shows previews by itself, from what the command returns.
    pub client_shows_previews: bool,
}

impl ServerSettings {
    /// Takes over what is given: `{ "setup": "shop.yaml", "documentation": "https://..." }`, also under the key
    /// `clsmith`. An empty text takes a setting back.
    pub(super) fn update(&mut self, given: &Value) {
        let given = given.get("clsmith").unwrap_or(given);
        let text = |key: &str| given.get(key).and_then(Value::as_str).map(str::to_owned);
        if let Some(setup) = text("setup") {
            // Standard input carries the protocol, so `-` can only be a file of this name.
            let path = if setup == "-" { PathBuf::from("./-") } else { PathBuf::from(setup) };
            self.setup = Some(path).filter(|path| !path.as_os_str().is_empty());
        }
        if let Some(documentation) = text("documentation") {
            self.documentation = Some(documentation).filter(|address| !address.is_empty());
        }
        if let Some(shows) = given.get("clientShowsPreviews").and_then(Value::as_bool) {
            self.client_shows_previews = shows;
        }
    }
}
