//! This module holds the work material with its cutting coefficients, which are given in the setup or in a
//! file of their own.

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
    /// The name of the material.
    pub name: Option<String>,
    /// The cutting coefficients in N/mm2 and N/mm.
    pub coefficients: CuttingCoefficients,
}

/// The material as the setup gives it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MaterialChoice {
    /// Its coefficients.
    Given(WorkMaterial),
    /// A file with the coefficients, which was not read yet; see [`Setup::read_material_file`].
    File(FileRef),
}

/// The ratio of the radial to the tangential cutting coefficient, when only the tangential one is known. It
/// holds for steel and usual rake angles.
const RADIAL: f64 = 0.3;
/// The ratio of the axial to the tangential cutting coefficient, under the same conditions.
const AXIAL: f64 = 0.2;

impl WorkMaterial {
    /// Reads a material file.
    ///
    /// Returns all faults of the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Failure> {
        let document = YamlDocument::parse(source)?;
        let text: MaterialFileText = document.deserialize_checked(|_| None)?;
        Ok(text.into_material())
    }

    /// Returns the JSON schema of a material file, for editors.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(MaterialFileText).to_value()
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
            self.material = Some(MaterialChoice::Given(WorkMaterial::load(&source)?));
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
                            `configs/materials` has files for common ones.";
                Err(Diagnostic::new(codes::MATERIAL_MISSING, message).with_help(help).into())
            }
        }
    }
}

/// A material file: the cutting coefficients of the mechanistic force model. An edge element of length dl
/// that cuts a chip of thickness h takes the tangential force (k_tc h + k_te) dl, and the radial and axial
/// forces alike. The numbers are in N and mm, whatever `units:` is elsewhere.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith material file", rename = "MaterialFile")]
struct MaterialFileText {
    /// The name of the material.
    name: Option<String>,
    /// The tangential cutting coefficient in N/mm2.
    k_tc: Positive,
    /// The tangential edge coefficient in N/mm; 0 when it is left out.
    k_te: Option<NonNegative>,
    /// The radial cutting coefficient in N/mm2; 0.3 k_tc when it is left out.
    k_rc: Option<NonNegative>,
    /// The radial edge coefficient in N/mm; k_te when it is left out.
    k_re: Option<NonNegative>,
    /// The axial cutting coefficient in N/mm2; 0.2 k_tc when it is left out.
    k_ac: Option<Finite>,
    /// The axial edge coefficient in N/mm; 0 when it is left out.
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

/// The work material: a `file` with cutting coefficients, or the coefficients themselves, of which only
/// `k_tc` is required. The numbers are in N and mm, whatever `units` is.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Material", extend("oneOf" = [{ "required": ["file"] }, { "required": ["k_tc"] }]))]
pub(super) struct MaterialText {
    /// A file with the other keys, relative to this file's folder.
    file: Option<FilePath>,
    /// The name of the material.
    name: Option<String>,
    /// The tangential cutting coefficient in N/mm2.
    k_tc: Option<Positive>,
    /// The tangential edge coefficient in N/mm; 0 when it is left out.
    k_te: Option<NonNegative>,
    /// The radial cutting coefficient in N/mm2; 0.3 k_tc when it is left out.
    k_rc: Option<NonNegative>,
    /// The radial edge coefficient in N/mm; k_te when it is left out.
    k_re: Option<NonNegative>,
    /// The axial cutting coefficient in N/mm2; 0.2 k_tc when it is left out.
    k_ac: Option<Finite>,
    /// The axial edge coefficient in N/mm; 0 when it is left out.
    k_ae: Option<Finite>,
}

impl MaterialText {
    /// Checks the material. Returns `None` if it has a fault, which the reader then holds.
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

    /// Returns the first key that is given in addition to `file`.
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
