//! The work material: its cutting coefficients, given in the setup or in a file of their own.

use super::setup_reader::SetupReader;
use super::stock::FileRef;
use super::{Setup, YamlLocation};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::CuttingCoefficients;
use crate::parameters::{FilePath, Finite, NonNegative, Positive};
use crate::source::{Source, SourceReadError};
use crate::yaml::YamlDocument;
use schemars::JsonSchema;
use serde::Deserialize;
use std::path::Path;
use std::sync::Arc;

/// A work material.
///
/// ```
/// use clsmith::setup::WorkMaterial;
/// use clsmith::source::Source;
///
/// let text = b"name: AlCu4Mg1\nk_tc: 796\nk_te: 27.7\n";
/// let material = WorkMaterial::load(&Source::new("alcu4mg1.yaml", text.to_vec())?)?;
/// assert_eq!(material.coefficients.k_tc, 796.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct WorkMaterial {
    /// What it is called.
    pub name: Option<String>,
    /// Its cutting coefficients in N/mm2 and N/mm.
    pub coefficients: CuttingCoefficients,
}

/// The material as the setup says it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MaterialChoice {
    /// Its coefficients.
    Given(WorkMaterial),
    /// A file with them, which nobody has read yet: [`Setup::read_material_file`].
    File(FileRef),
}

/// Radial to tangential cutting coefficient where only the tangential one is known: of steel with usual rake angles.
const RADIAL: f64 = 0.3;
/// Axial to tangential cutting coefficient, likewise.
const AXIAL: f64 = 0.2;

impl WorkMaterial {
    /// Reads a material file.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Failure> {
        let document = YamlDocument::parse(source)?;
        let text: MaterialFileText = document.deserialize_checked(|_| None)?;
        Ok(text.into_material())
    }

    /// JSON schema of a material file, for editors.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(MaterialFileText).to_value()
    }
}

impl Setup {
    /// The setup with its material file read, where it names one; `read` gets the path as seen from where clsmith runs.
    ///
    /// # Errors
    /// [`codes::MATERIAL_FILE`] where the file is named, or what is wrong in it.
    pub fn read_material_file(
        mut self,
        read: impl FnOnce(&Path) -> Result<Arc<Source>, SourceReadError>,
    ) -> Result<Self, Failure> {
        if let Some(MaterialChoice::File(file)) = &self.material {
            let source = read(&file.path).map_err(|reason| {
                let message = format!("the material file `{}` cannot be read: {reason}", file.written);
                file.make_finding(codes::MATERIAL_FILE, message)
            })?;
            self.material = Some(MaterialChoice::Given(WorkMaterial::load(&source)?));
        }
        Ok(self)
    }

    /// The material.
    ///
    /// # Errors
    /// [`codes::MATERIAL_MISSING`] when the setup says none, [`codes::MATERIAL_FILE`] when it names a file that nobody
    /// has read.
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
                            `configs/materials` has files for common ones.";
                Err(Diagnostic::new(codes::MATERIAL_MISSING, message).with_help(help).into())
            }
        }
    }
}

/// A material file: cutting coefficients of the mechanistic force model. An edge element of length dl that cuts a chip
/// of thickness h takes the tangential force (k_tc h + k_te) dl, and radial and axial alike. N and mm, whatever
/// `units:` is elsewhere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith material file", rename = "MaterialFile")]
struct MaterialFileText {
    /// What it is called.
    name: Option<String>,
    /// Tangential cutting coefficient in N/mm2.
    k_tc: Positive,
    /// Tangential edge coefficient in N/mm; 0 if not given.
    k_te: Option<NonNegative>,
    /// Radial cutting coefficient in N/mm2; 0.3 k_tc if not given.
    k_rc: Option<NonNegative>,
    /// Radial edge coefficient in N/mm; k_te if not given.
    k_re: Option<NonNegative>,
    /// Axial cutting coefficient in N/mm2; 0.2 k_tc if not given.
    k_ac: Option<Finite>,
    /// Axial edge coefficient in N/mm; 0 if not given.
    k_ae: Option<Finite>,
}

impl MaterialFileText {
    fn into_material(self) -> WorkMaterial {
        let k_tc = self.k_tc.get();
        let k_te = self.k_te.map_or(0.0, NonNegative::get);
        let coefficients = CuttingCoefficients {
            k_tc,
            k_te,
            k_rc: self.k_rc.map_or(RADIAL * k_tc, NonNegative::get),
            k_re: self.k_re.map_or(k_te, NonNegative::get),
            k_ac: self.k_ac.map_or(AXIAL * k_tc, Finite::get),
            k_ae: self.k_ae.map_or(0.0, Finite::get),
        };
        WorkMaterial { name: self.name, coefficients }
    }
}

/// The material that is cut: a `file` with cutting coefficients, or the coefficients themselves, of which only `k_tc`
/// is required. N and mm, whatever `units` is.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Material", extend("oneOf" = [{ "required": ["file"] }, { "required": ["k_tc"] }]))]
pub(super) struct MaterialText {
    /// A file with the other keys, relative to this file's folder.
    file: Option<FilePath>,
    /// What it is called.
    name: Option<String>,
    /// Tangential cutting coefficient in N/mm2.
    k_tc: Option<Positive>,
    /// Tangential edge coefficient in N/mm; 0 if not given.
    k_te: Option<NonNegative>,
    /// Radial cutting coefficient in N/mm2; 0.3 k_tc if not given.
    k_rc: Option<NonNegative>,
    /// Radial edge coefficient in N/mm; k_te if not given.
    k_re: Option<NonNegative>,
    /// Axial cutting coefficient in N/mm2; 0.2 k_tc if not given.
    k_ac: Option<Finite>,
    /// Axial edge coefficient in N/mm; 0 if not given.
    k_ae: Option<Finite>,
}

impl MaterialText {
    /// The material; `None` when something is wrong, which the reader then knows.
    pub(super) fn check_material(
        self,
        reader: &mut SetupReader,
        place: &YamlLocation,
    ) -> Option<MaterialChoice> {
        let given = self.first_given_key();
        match (self.file, given, self.k_tc) {
            (Some(_), Some(key), _) => {
                let message = format!("the material is given twice, by `file` and by `{key}`");
                let help = "Keep the file, or copy its numbers here and change them.";
                let keys = [(place.at_key(key), "given again here"), (place.at_key("file"), "and here")];
                reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
                None
            }
            (Some(file), None, _) => Some(MaterialChoice::File(FileRef::new(&file, place.at_key("file")))),
            (None, _, Some(k_tc)) => {
                let Self { name, k_te, k_rc, k_re, k_ac, k_ae, .. } = self;
                let text = MaterialFileText { name, k_tc, k_te, k_rc, k_re, k_ac, k_ae };
                Some(MaterialChoice::Given(text.into_material()))
            }
            (None, _, None) => {
                let message = "`material` needs `k_tc`, or a `file`".to_owned();
                let help = "Add `k_tc: …`, the tangential cutting coefficient in N/mm2, or `file: …`.";
                reader.add_key_fault(
                    codes::MISSING_KEY,
                    message,
                    help,
                    &[(place.clone(), "`k_tc` is missing")],
                );
                None
            }
        }
    }

    /// The first key beside `file` that is given.
    fn first_given_key(&self) -> Option<&'static str> {
        let keys = [
            (self.name.is_some(), "name"),
            (self.k_tc.is_some(), "k_tc"),
            (self.k_te.is_some(), "k_te"),
            (self.k_rc.is_some(), "k_rc"),
            (self.k_re.is_some(), "k_re"),
            (self.k_ac.is_some(), "k_ac"),
            (self.k_ae.is_some(), "k_ae"),
        ];
        keys.into_iter().find_map(|(given, key)| given.then_some(key))
    }
}
