//! This module holds a material as it is written: in the setup, and in a file of its own.

use super::YamlLocation;
use super::material::{MaterialChoice, MaterialOrigin, WorkMaterial};
use super::material_origin_text::{
    CoefficientErrorsText, CoefficientSourcesText, KienzleTermText, KienzleText, MaterialRangesText,
};
use super::setup_reader::SetupReader;
use super::stock::FileRef;
use crate::diagnostic::{Failure, codes};
use crate::engagement::{CuttingCoefficients, CuttingLaw, KienzleTerm};
use crate::parameters::{FilePath, Finite, LengthUnit, NonNegative, Positive};
use crate::yaml::YamlDocument;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// The ratio of the radial to the tangential cutting coefficient, when only the tangential one is known. It
/// holds for steel and usual rake angles.
const RADIAL: f64 = 0.3;
/// The ratio of the axial to the tangential cutting coefficient, under the same conditions.
const AXIAL: f64 = 0.2;

/// The work material, in the setup and in a file of its own: a `file` with its numbers, which only the setup may name, or the
/// numbers themselves, of which only `k_tc` or `kienzle` is required. They are in N and mm, whatever `units` is.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Material")]
#[schemars(extend("oneOf" = [{ "required": ["file"] }, { "required": ["k_tc"] }, { "required": ["kienzle"] }]))]
pub(super) struct MaterialText {
    /// A file with the other keys, relative to this file's folder, or the name of a built-in material (`clsmith materials`).
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
    /// The axial cutting coefficient in N/mm2; 0.2 k_tc when it is left out. Above 0 it draws an end mill out of its holder
    /// and lifts the workpiece.
    k_ac: Option<Finite>,
    /// The axial edge coefficient in N/mm; 0 when it is left out.
    k_ae: Option<Finite>,
    /// The Kienzle law instead of the coefficients k.
    kienzle: Option<KienzleText>,
    /// Where the numbers come from: a paper, a measurement, an estimate.
    source: Option<String>,
    /// Where single numbers come from, if not from `source`.
    sources: Option<CoefficientSourcesText>,
    /// When they were found.
    date: Option<String>,
    /// The tool with which they were found.
    tool: Option<String>,
    /// In which cuts they were found; a run outside of these warns.
    ranges: Option<MaterialRangesText>,
    /// The standard errors of single numbers, in their units.
    errors: Option<CoefficientErrorsText>,
    /// The root of the mean square by which measured forces differ from the law, as a part of them.
    residual: Option<NonNegative>,
}

impl MaterialText {
    /// Returns the material of a file of its own.
    ///
    /// # Errors
    /// Returns what contradicts each other.
    pub(super) fn into_material(self, document: &Arc<YamlDocument>) -> Result<WorkMaterial, Failure> {
        let place = YamlLocation::new(document, &[]);
        let mut reader = SetupReader::new(LengthUnit::Mm);
        if self.file.is_some() {
            let message = "a material file has its numbers itself";
            let help = "Only the setup names a `file`; write `k_tc` or `kienzle` here.";
            reader.add_fault(|| place.at_key("file"), message, "names another file", help);
        }
        let made = self.check_numbers(&mut reader, &place);
        let made = reader.finish_value(made)?;
        debug_assert!(made.is_some(), "a material without faults is made");
        Ok(made.unwrap_or_else(|| WorkMaterial {
            name: None,
            law: CuttingLaw::Linear(CuttingCoefficients::NONE),
            origin: MaterialOrigin::default(),
        }))
    }

    /// Checks the numbers. Returns `None` if they have a fault, which the reader then holds.
    fn check_numbers(self, reader: &mut SetupReader, place: &YamlLocation) -> Option<WorkMaterial> {
        let law = match (&self.kienzle, self.k_tc) {
            (Some(_), _) if self.first_coefficient().is_some() => {
                let key = self.first_coefficient().unwrap_or("k_tc");
                let message = format!("the forces are given twice, by `kienzle` and by `{key}`");
                let keys = [(place.at_key(key), "given again here"), (place.at_key("kienzle"), "and here")];
                reader.add_key_fault(codes::BAD_VALUE, message, "Keep one of the two laws.", &keys);
                return None;
            }
            (Some(kienzle), _) => {
                let term = |text: &Option<KienzleTermText>| {
                    text.as_ref().map_or(KienzleTerm { k11: 0.0, m: 0.0 }, KienzleTermText::to_term)
                };
                let terms = [
                    ("tangential", Some(&kienzle.tangential)),
                    ("radial", kienzle.radial.as_ref()),
                    ("axial", kienzle.axial.as_ref()),
                ];
                let flat = terms.into_iter().find(|(_, term)| term.is_some_and(|term| term.m.get() >= 1.0));
                if let Some((key, _)) = flat {
                    let help = "A power of 1 is a force that no chip changes; usual ones are 0.15 to 0.4.";
                    let at = || place.at_key("kienzle").at_key(key).at_key("m");
                    reader.add_fault(at, "the power of Kienzle's law must be below 1", "not below 1", help);
                    return None;
                }
                let tangential = kienzle.tangential.to_term();
                if tangential.k11 <= 0.0 {
                    let help = "The edge is pushed back by what it cuts: write a number above 0.";
                    let at = || place.at_key("kienzle").at_key("tangential").at_key("k11");
                    reader.add_fault(at, "the tangential force must be above 0", "not above 0", help);
                    return None;
                }
                CuttingLaw::Kienzle { tangential, radial: term(&kienzle.radial), axial: term(&kienzle.axial) }
            }
            (None, Some(k_tc)) => CuttingLaw::Linear(self.complete_coefficients(k_tc.get())),
            (None, None) => {
                let message = "the material needs `k_tc`, or `kienzle`".to_owned();
                let help =
                    "Add `k_tc: …`, the tangential cutting coefficient in N/mm2, or the law of Kienzle.";
                let keys = [(place.clone(), "`k_tc` is missing")];
                reader.add_key_fault(codes::MISSING_KEY, message, help, &keys);
                return None;
            }
        };
        let ranges = self.ranges.unwrap_or_default();
        let mut range = |range: Option<[NonNegative; 2]>, key: &'static str| {
            let range = range.map(|ends| ends.map(NonNegative::get));
            if range.is_some_and(|[from, to]| from > to) {
                let help = "Write the least value first.";
                let at = || place.at_key("ranges").at_key(key);
                reader.add_fault(at, "this range ends before it begins", "ends before it begins", help);
            }
            range
        };
        let (chip_range_mm, speed_range_m_min, depth_range_mm) = (
            range(ranges.chip, "chip"),
            range(ranges.cutting_speed, "cutting_speed"),
            range(ranges.axial_depth, "axial_depth"),
        );
        Some(WorkMaterial {
            name: self.name,
            law,
            origin: MaterialOrigin {
                source: self.source,
                sources: self.sources.unwrap_or_default().into_list(),
                date: self.date,
                tool: self.tool,
                chip_range_mm,
                speed_range_m_min,
                depth_range_mm,
                errors: self.errors.unwrap_or_default().into_list(),
                residual_part: self.residual.map(NonNegative::get),
            },
        })
    }

    /// Returns the coefficients, with what is left out.
    fn complete_coefficients(&self, k_tc: f64) -> CuttingCoefficients {
        let k_te = self.k_te.map_or(0.0, NonNegative::get);
        CuttingCoefficients {
            k_tc,
            k_te,
            k_rc: self.k_rc.map_or(RADIAL * k_tc, NonNegative::get),
            k_re: self.k_re.map_or(k_te, NonNegative::get),
            k_ac: self.k_ac.map_or(AXIAL * k_tc, Finite::get),
            k_ae: self.k_ae.map_or(0.0, Finite::get),
        }
    }

    /// Returns the first coefficient of the linear law that is given.
    fn first_coefficient(&self) -> Option<&'static str> {
        let keys = [
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

impl MaterialText {
    /// Checks the material. Returns `None` if it has a fault, which the reader then holds.
    pub(super) fn check_material(
        self,
        reader: &mut SetupReader,
        place: &YamlLocation,
    ) -> Option<MaterialChoice> {
        let given = self.first_given_key();
        match (&self.file, given) {
            (Some(_), Some(key)) => {
                let message = format!("the material is given twice, by `file` and by `{key}`");
                let help = "Keep the file, or copy its numbers here and change them.";
                let keys = [(place.at_key(key), "given again here"), (place.at_key("file"), "and here")];
                reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
                None
            }
            (Some(file), None) => match WorkMaterial::find_shipped(file.as_str()) {
                Some(shipped) => {
                    debug_assert!(shipped.is_ok(), "built-in materials are right: {shipped:?}");
                    shipped.ok().map(|material| MaterialChoice::Given(Box::new(material)))
                }
                None => Some(MaterialChoice::File(FileRef::new(file, place.at_key("file")))),
            },
            (None, None) => {
                let message = "`material` needs `k_tc`, or a `file`".to_owned();
                let help = "Add `k_tc: …`, the tangential cutting coefficient in N/mm2, or `file: …`.";
                let keys = [(place.clone(), "`k_tc` is missing")];
                reader.add_key_fault(codes::MISSING_KEY, message, help, &keys);
                None
            }
            (None, Some(_)) => {
                self.check_numbers(reader, place).map(|material| MaterialChoice::Given(Box::new(material)))
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
            (self.kienzle.is_some(), "kienzle"),
            (self.source.is_some(), "source"),
            (self.sources.is_some(), "sources"),
            (self.date.is_some(), "date"),
            (self.tool.is_some(), "tool"),
            (self.ranges.is_some(), "ranges"),
            (self.errors.is_some(), "errors"),
            (self.residual.is_some(), "residual"),
        ];
        keys.into_iter().find_map(|(given, key)| given.then_some(key))
    }
}
