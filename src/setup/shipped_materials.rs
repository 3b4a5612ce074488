//! This module holds the materials that are built in: the files of `configs/materials`.

use super::WorkMaterial;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::source::Source;

/// The names by which setups take them, and their files.
const SHIPPED: [(&str, &str); 5] = [
    ("aluminium-7075", include_str!("../../configs/materials/aluminium-7075.yaml")),
    ("cast-iron-gjl250", include_str!("../../configs/materials/cast-iron-gjl250.yaml")),
    ("steel-42crmo4", include_str!("../../configs/materials/steel-42crmo4.yaml")),
    ("steel-c45", include_str!("../../configs/materials/steel-c45.yaml")),
    ("titanium-6al4v", include_str!("../../configs/materials/titanium-6al4v.yaml")),
];

impl WorkMaterial {
    /// Reads all materials that are built in, each with the name by which a setup takes it.
    ///
    /// # Errors
    /// Returns the faults of a file, which a test excludes.
    pub fn load_shipped() -> Result<Vec<(&'static str, Self)>, Failure> {
        let all = SHIPPED.iter().map(|(key, text)| Ok((*key, load_text(key, text)?)));
        all.collect()
    }

    /// Reads the material of a name; `None` if none is built in by that name.
    pub(super) fn find_shipped(name: &str) -> Option<Result<Self, Failure>> {
        let (key, text) = SHIPPED.iter().find(|(key, _)| *key == name)?;
        Some(load_text(key, text))
    }
}

fn load_text(key: &str, text: &str) -> Result<WorkMaterial, Failure> {
    let source = Source::new(format!("{key}.yaml"), text.as_bytes().to_vec()).map_err(|error| {
        Diagnostic::new(
            codes::MATERIAL_FILE,
            format!("the built-in material `{key}` cannot be read: {error}"),
        )
    })?;
    WorkMaterial::load(&source)
}
