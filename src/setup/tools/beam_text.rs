//! This module holds what an entry of `tools:` says about how far the tool bends.

use crate::diagnostic::codes;
use crate::parameters::{Positive, PositiveFraction};
use crate::setup::YamlLocation;
use crate::setup::setup_reader::SetupReader;
use schemars::JsonSchema;
use serde::Deserialize;

/// What a tool is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(rename = "ToolMaterial")]
pub(super) enum ToolMaterialText {
    /// Cemented carbide: 580 GPa, that of tungsten carbide with about 10 % cobalt, of which most solid mills are made. Data
    /// sheets say 550 to 620 GPa for 12 to 6 %.
    Carbide,
    /// High-speed steel: 210 GPa, the lower end of what data sheets of rolled and powder steels say (up to 240).
    Hss,
}

impl ToolMaterialText {
    fn youngs_modulus_gpa(self) -> f64 {
        match self {
            Self::Carbide => 580.0,
            Self::Hss => 210.0,
        }
    }
}

/// How stiff a tool is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ToolStiffness {
    /// The length from the tip to the clamp, mm.
    pub stick_out_mm: Option<f64>,
    /// Young's modulus, GPa.
    pub youngs_modulus_gpa: Option<f64>,
    /// The diameter of the cylinder that bends like the flutes, by theirs; [`crate::cutter::FLUTE_DIAMETER_FACTOR`] where it
    /// is not given.
    pub flute_diameter_factor: Option<f64>,
}

/// The keys about stiffness.
pub(super) struct StiffnessText {
    pub stick_out: Option<Positive>,
    pub tool_material: Option<ToolMaterialText>,
    pub youngs_modulus: Option<Positive>,
    pub flute_diameter_factor: Option<PositiveFraction>,
}

impl StiffnessText {
    /// Returns the stiffness in millimetres, and reports a modulus that is given twice.
    pub(super) fn check_stiffness(&self, reader: &mut SetupReader, place: &YamlLocation) -> ToolStiffness {
        if self.tool_material.is_some() && self.youngs_modulus.is_some() {
            let message =
                "Young's modulus is given twice, by `tool_material` and by `youngs_modulus`".to_owned();
            let help = "Keep the number if you know it.";
            let keys = [
                (place.at_key("youngs_modulus"), "given again here"),
                (place.at_key("tool_material"), "and here"),
            ];
            reader.add_key_fault(codes::BAD_VALUE, message, help, &keys);
        }
        let of_material = self.tool_material.map(ToolMaterialText::youngs_modulus_gpa);
        ToolStiffness {
            stick_out_mm: reader.optional_size_mm(self.stick_out, place, "stick_out"),
            youngs_modulus_gpa: self.youngs_modulus.map(Positive::get).or(of_material),
            flute_diameter_factor: self.flute_diameter_factor.map(PositiveFraction::get),
        }
    }
}
