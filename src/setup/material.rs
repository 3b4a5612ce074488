//! This module holds the work material: its cutting law, and where its numbers come from and hold. It is given in the setup
//! or in a file of its own.

use super::Setup;
use super::material_text::MaterialText;
use super::stock::FileRef;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::CuttingLaw;
use crate::source::{Source, SourceReadError};
use crate::yaml::YamlDocument;
use serde_json::{Value, json};
use std::path::Path;
use std::sync::Arc;

/// A work material.
///
/// ```
/// use clsmith::engagement::CuttingLaw;
/// use clsmith::setup::WorkMaterial;
/// use clsmith::source::Source;
///
/// let text = b"name: AlCu4Mg1\nk_tc: 796\nk_te: 27.7\n";
/// let material = WorkMaterial::load(&Source::new("alcu4mg1.yaml", text.to_vec())?)?;
/// assert!(matches!(material.law, CuttingLaw::Linear(found) if found.k_tc == 796.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct WorkMaterial {
    /// The name of the material.
    pub name: Option<String>,
    /// What it asks of an edge, in N and mm.
    pub law: CuttingLaw,
    /// Where the numbers come from, and in which cuts they hold.
    pub origin: MaterialOrigin,
}

/// Where the numbers of a material come from, and in which cuts they hold.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct MaterialOrigin {
    /// Where all numbers come from that have no source of their own: a paper, a measurement, an estimate.
    pub source: Option<String>,
    /// Numbers with sources of their own: the key and the source.
    pub sources: Vec<(&'static str, String)>,
    /// When they were found, as it was written.
    pub date: Option<String>,
    /// The tool with which they were found, in words.
    pub tool: Option<String>,
    /// The thickest chips of the cuts in which they were found, mm: least and largest.
    pub chip_range_mm: Option<[f64; 2]>,
    /// The cutting speeds of these cuts, m/min.
    pub speed_range_m_min: Option<[f64; 2]>,
    /// The axial depths of these cuts, mm.
    pub depth_range_mm: Option<[f64; 2]>,
    /// The standard errors of numbers: the key and the error, in the number's unit.
    pub errors: Vec<(&'static str, f64)>,
    /// The root of the mean square by which forces of these cuts differ from the law, as a part of them.
    pub residual_part: Option<f64>,
}

impl MaterialOrigin {
    /// Returns the source of the number at a key.
    pub fn source_of(&self, key: &str) -> Option<&str> {
        let own = self.sources.iter().find(|(named, _)| *named == key);
        own.map(|(_, source)| source.as_str()).or(self.source.as_deref())
    }

    /// Returns the standard error of the number at a key.
    pub fn error_of(&self, key: &str) -> Option<f64> {
        self.errors.iter().find(|(named, _)| *named == key).map(|(_, error)| *error)
    }
}

/// The material as the setup gives it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MaterialChoice {
    /// Its law.
    Given(Box<WorkMaterial>),
    /// A file with the law, which was not read yet; see [`Setup::read_material_file`].
    File(FileRef),
}

impl WorkMaterial {
    /// Reads a material file.
    ///
    /// # Errors
    /// Returns all faults of the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Failure> {
        let document = YamlDocument::parse(source)?;
        let text: MaterialText = document.deserialize_checked(|_| None)?;
        text.into_material(&Arc::new(document))
    }

    /// Returns the JSON schema of a material file, for editors.
    pub fn schema() -> serde_json::Value {
        let mut schema = crate::yaml::make_file_schema::<MaterialText>("material");
        // A file of its own has the keys of the setup's material but the one that names a file.
        if let Some(root) = schema.as_object_mut() {
            root.insert("title".to_owned(), "clsmith material file".into());
            root.insert(
                "description".to_owned(),
                "A material file: what an edge needs to cut. An edge element of length dl that cuts a chip of thickness h takes \
                 the tangential force (k_tc h + k_te) dl, and the radial and axial forces alike; or, by Kienzle, \
                 k11 h^(1-m) dl. The numbers are in N and mm, whatever `units:` is elsewhere."
                    .into(),
            );
            root.insert("oneOf".to_owned(), json!([{ "required": ["k_tc"] }, { "required": ["kienzle"] }]));
            if let Some(keys) = root.get_mut("properties").and_then(Value::as_object_mut) {
                keys.remove("file");
            }
        }
        schema
    }
}

impl Setup {
    /// Reads the material file if the setup names one. `read` gets the path as seen from where clsmith runs.
    ///
    /// # Errors
    /// Returns [`codes::MATERIAL_FILE`] where the file is named, or the faults of the file.
    pub fn read_material_file(
        mut self,
        read: impl FnOnce(&Path) -> Result<Arc<Source>, SourceReadError>,
    ) -> Result<Self, Failure> {
        if let Some(MaterialChoice::File(file)) = &self.material {
            let source = read(&file.path).map_err(|reason| {
                let message = format!("the material file `{}` cannot be read: {reason}", file.written);
                file.make_finding(codes::MATERIAL_FILE, message)
            })?;
            self.material = Some(MaterialChoice::Given(Box::new(WorkMaterial::load(&source)?)));
        }
        Ok(self)
    }

    /// Returns the material.
    ///
    /// # Errors
    /// Returns [`codes::MATERIAL_MISSING`] if the setup has none, and [`codes::MATERIAL_FILE`] if it names a
    /// file that was not read.
    pub fn require_material(&self) -> Result<&WorkMaterial, Failure> {
        match &self.material {
            Some(MaterialChoice::Given(material)) => Ok(material),
            Some(MaterialChoice::File(file)) => {
                let message = format!("the material file `{}` has not been read", file.written);
                Err(file.make_finding(codes::MATERIAL_FILE, message).into())
            }
            None => {
                let message = "cutting forces need the material that is cut";
                let help = "Add `material: { file: steel-c45.yaml }` or `material: { k_tc: 1900 }` under `setup:`; \
                            `clsmith materials` lists those of `configs/materials`.";
                Err(Diagnostic::new(codes::MATERIAL_MISSING, message).with_help(help).into())
            }
        }
    }
}
