//! This module holds the inserts of a tool as they are written.

use super::insert_data::{InsertClearance, InsertData, InsertWidth};
use super::tool_text::LENGTH_TOLERANCE_MM;
use crate::diagnostic::codes;
use crate::parameters::{Positive, Slope};
use crate::setup::YamlLocation;
use crate::setup::setup_reader::SetupReader;
use schemars::JsonSchema;
use serde::Deserialize;

/// The inserts of an indexable cutter: their own measures, or what a catalogue says of the cutter. One of `radius` and
/// `least_bore` says how wide the middle is that does not cut; one of `height`, `AZ`, `ramp_angle` and `RMPX` how high
/// material may stand there.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(
    rename = "Insert",
    extend("allOf" = [
        { "oneOf": [{ "required": ["radius"] }, { "required": ["least_bore"] }] },
        { "oneOf": [
            { "required": ["height"] },
            { "required": ["AZ"] },
            { "required": ["ramp_angle"] },
            { "required": ["RMPX"] },
        ] },
    ])
)]
pub(super) struct InsertText {
    /// The cutting height of an insert.
    height: Option<Positive>,
    /// The radius of the insert's bottom circle. The cutter does not cut within its diameter less twice this.
    radius: Option<Positive>,
    /// The largest ramp angle in degrees, as catalogues give it.
    ramp_angle: Option<Slope>,
    /// The least bore that the cutter mills by helical interpolation, as catalogues give it.
    least_bore: Option<Positive>,
    /// `ramp_angle` by its name in ISO 13399.
    #[serde(rename = "RMPX")]
    iso_ramp_angle: Option<Slope>,
    /// The largest depth of a plunge by its name in ISO 13399, which is the cutting height.
    #[serde(rename = "AZ")]
    iso_plunge_depth: Option<Positive>,
}

/// A key of the inserts, and whether it is written.
type WrittenKey = (&'static str, bool);

/// Finds the one key of several that is written. Reports if none is, or more than one.
fn find_only_key(
    keys: &[WrittenKey],
    what: &str,
    reader: &mut SetupReader,
    place: &YamlLocation,
) -> Option<&'static str> {
    let written: Vec<&'static str> =
        keys.iter().filter(|(_, written)| *written).map(|(key, _)| *key).collect();
    match written.as_slice() {
        [only] => Some(only),
        [] => {
            let names: Vec<String> = keys.iter().map(|(key, _)| format!("`{key}`")).collect();
            let message = format!("nothing says {what}");
            let help = format!("Add one of {}.", names.join(", "));
            reader.add_key_fault(codes::MISSING_KEY, message, &help, &[(place.clone(), "of these inserts")]);
            None
        }
        [first, second, ..] => {
            let message = format!("{what} is given twice, by `{first}` and by `{second}`");
            let keys = [(place.at_key(second), "given again here"), (place.at_key(first), "and here")];
            reader.add_key_fault(codes::BAD_VALUE, message, "Keep one of them.", &keys);
            None
        }
    }
}

impl InsertText {
    /// Returns the inserts in millimetres and radians; `None` if they have a fault, which the reader then holds.
    pub(super) fn check_insert(
        &self,
        diameter_mm: Option<f64>,
        reader: &mut SetupReader,
        place: &YamlLocation,
    ) -> Option<InsertData> {
        let widths = [("radius", self.radius.is_some()), ("least_bore", self.least_bore.is_some())];
        let clearances = [
            ("height", self.height.is_some()),
            ("AZ", self.iso_plunge_depth.is_some()),
            ("ramp_angle", self.ramp_angle.is_some()),
            ("RMPX", self.iso_ramp_angle.is_some()),
        ];
        let width_key = find_only_key(&widths, "how wide the middle is that does not cut", reader, place);
        let clearance_key = find_only_key(&clearances, "how much the inserts clear", reader, place);
        let (width_key, clearance_key) = (width_key?, clearance_key?);
        let length = reader.size_mm(self.radius.or(self.least_bore)?, || place.at_key(width_key));
        let width = match self.radius {
            Some(_) => InsertWidth::RadiusMm(length),
            None => InsertWidth::LeastBoreMm(length),
        };
        let clearance = match self.height.or(self.iso_plunge_depth) {
            Some(height) => InsertClearance::HeightMm(reader.size_mm(height, || place.at_key(clearance_key))),
            None => InsertClearance::RampAngleRad(self.ramp_angle.or(self.iso_ramp_angle)?.radians()),
        };
        if matches!(clearance, InsertClearance::RampAngleRad(angle) if angle <= 0.0) {
            let help = "A cutter that ramps has an angle above 0.";
            reader.add_fault(|| place.at_key(clearance_key), "the ramp angle is 0", "no ramp", help);
        }
        if let (Some(diameter), InsertWidth::RadiusMm(radius)) = (diameter_mm, width)
            && radius > diameter / 2.0 + LENGTH_TOLERANCE_MM
        {
            let help = "The inserts rotate inside the cutter's diameter.";
            let message = "the insert's radius is larger than half the diameter";
            reader.add_fault(|| place.at_key("radius"), message, "too large", help);
        }
        if let (Some(diameter), InsertWidth::LeastBoreMm(bore)) = (diameter_mm, width)
            && !(diameter - LENGTH_TOLERANCE_MM..2.0 * diameter).contains(&bore)
        {
            let help = "A helix mills bores from the diameter of the cutter to less than twice that without leaving a core.";
            let message = "the least bore does not fit the diameter";
            reader.add_fault(|| place.at_key("least_bore"), message, "not from D to 2 D", help);
        }
        Some(InsertData { width, clearance })
    }
}
