//! This module holds teeth as they are written: their number, their pitch and their runout.

use crate::cutter::Teeth;
use crate::parameters::{Finite, HelixAngle, NonNegative, Positive, PositiveCount};
use crate::setup::YamlLocation;
use crate::setup::setup_reader::SetupReader;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, SeqAccess, Unexpected, Visitor};
use std::borrow::Cow;
use std::fmt;

/// How far the sum of the pitch angles may differ from 360 degrees. Catalogues print them to a tenth, and a
/// cutter has few teeth.
const TURN_TOLERANCE: f64 = 0.5;

/// No cutter has more teeth. A larger number is a mistake.
const MOST_TEETH: usize = 1000;

/// The angles in degrees from each tooth to the next. Their sum is 360.
#[derive(Debug, Clone)]
pub(super) struct PitchText(Vec<f64>);

impl<'de> Deserialize<'de> for PitchText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let angles: Vec<f64> =
            Vec::<Positive>::deserialize(deserializer)?.into_iter().map(Positive::get).collect();
        if angles.is_empty() {
            return Err(de::Error::invalid_length(0, &"an angle for each tooth"));
        }
        let sum: f64 = angles.iter().sum();
        if (sum - 360.0).abs() > TURN_TOLERANCE {
            let message = format!("the angles between the teeth add up to {sum:.1} degrees\n");
            let help =
                "From each tooth to the next, and from the last to the first, they must add up to 360.";
            return Err(de::Error::custom(message + help));
        }
        Ok(Self(angles))
    }
}

impl JsonSchema for PitchText {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Pitch".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "array", "items": { "type": "number", "exclusiveMinimum": 0 }, "minItems": 1 })
    }
}

/// The runout of the teeth, in the file's unit.
#[derive(Debug, Clone)]
pub(super) enum RunoutText {
    /// The cutter is eccentric by this, towards its first tooth.
    Eccentric(f64),
    /// The radial offset of each tooth.
    EachTooth(Vec<f64>),
}

impl<'de> Deserialize<'de> for RunoutText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RunoutTextVisitor)
    }
}

const RUNOUT: &str = "a number, 0 or more, or a list with one for each tooth";

struct RunoutTextVisitor;

impl RunoutTextVisitor {
    fn check_eccentricity<E: de::Error>(value: f64, found: Unexpected<'_>) -> Result<RunoutText, E> {
        let value = NonNegative::new(value).ok_or_else(|| E::invalid_value(found, &RUNOUT))?;
        Ok(RunoutText::Eccentric(value.get()))
    }
}

impl<'de> Visitor<'de> for RunoutTextVisitor {
    type Value = RunoutText;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(RUNOUT)
    }
    fn visit_f64<E: de::Error>(self, value: f64) -> Result<RunoutText, E> {
        Self::check_eccentricity(value, Unexpected::Float(value))
    }
    fn visit_u64<E: de::Error>(self, value: u64) -> Result<RunoutText, E> {
        Self::check_eccentricity(value as f64, Unexpected::Unsigned(value))
    }
    fn visit_i64<E: de::Error>(self, value: i64) -> Result<RunoutText, E> {
        Self::check_eccentricity(value as f64, Unexpected::Signed(value))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<RunoutText, A::Error> {
        let mut offsets = Vec::new();
        while let Some(offset) = list.next_element::<Finite>()? {
            offsets.push(offset.get());
        }
        if offsets.is_empty() {
            return Err(de::Error::invalid_length(0, &RUNOUT));
        }
        Ok(RunoutText::EachTooth(offsets))
    }
}

impl JsonSchema for RunoutText {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Runout".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "type": "number", "minimum": 0 },
                { "type": "array", "items": { "type": "number" }, "minItems": 1 },
            ],
        })
    }
}

/// The data of an entry about its teeth.
pub(super) struct TeethText<'a> {
    pub teeth: Option<PositiveCount>,
    /// The key that states their number.
    pub teeth_key: &'static str,
    pub pitch: Option<&'a PitchText>,
    pub helix: Option<HelixAngle>,
    pub runout: Option<&'a RunoutText>,
}

/// Checks the teeth of an entry. Returns `None` if their number is missing, or if it has a fault, which the
/// reader then holds.
pub(super) fn check_teeth(
    text: &TeethText<'_>,
    reader: &mut SetupReader,
    place: &YamlLocation,
) -> Option<Teeth> {
    let offsets = match text.runout {
        Some(RunoutText::EachTooth(offsets)) => Some(offsets),
        _ => None,
    };
    let said = [
        (text.teeth.and_then(|count| usize::try_from(count.get()).ok()), text.teeth_key),
        (text.pitch.map(|pitch| pitch.0.len()), "pitch"),
        (offsets.map(Vec::len), "runout"),
    ];
    let mut said = said.into_iter().filter_map(|(count, key)| count.map(|count| (count, key)));
    let (count, first) = said.next()?;
    if count > MOST_TEETH {
        let message = format!("no cutter has {count} teeth");
        reader.add_fault(
            || place.at_key(first),
            message,
            "too many",
            "Write the number of cutting edges around the tool.",
        );
        return None;
    }
    if let Some((other, key)) = said.find(|(other, _)| *other != count) {
        let message = format!("`{first}` is for {count} teeth, but `{key}` is for {other}");
        let help = format!("Write one number for each tooth into `{key}`.");
        reader.add_fault(|| place.at_key(key), message, &format!("{other} here"), help);
        return None;
    }
    let pitch = match text.pitch {
        Some(pitch) => {
            // The angles are written from each tooth to the next, but the simulation counts from each tooth
            // to the previous one.
            let mut angles: Vec<f64> = pitch.0.iter().map(|angle| angle.to_radians()).collect();
            angles.rotate_right(1);
            angles
        }
        None => Teeth::evenly_spaced(u32::try_from(count).ok()?, 0.0)?.pitch_angles_rad().to_vec(),
    };
    let runout = match text.runout {
        None => vec![0.0; count],
        Some(RunoutText::EachTooth(offsets)) => offsets
            .iter()
            .enumerate()
            .map(|(index, offset)| reader.length_mm(*offset, || place.at_key("runout").at_index(index)))
            .collect(),
        Some(RunoutText::Eccentric(offset)) => {
            let offset = reader.length_mm(*offset, || place.at_key("runout"));
            eccentric_runout_mm(offset, &pitch)
        }
    };
    Teeth::unevenly_spaced(pitch, runout, text.helix.map_or(0.0, |helix| helix.radians()))
}

/// Returns the radial offsets of the teeth of a cutter that is eccentric by `offset` towards its first tooth.
fn eccentric_runout_mm(offset: f64, pitch: &[f64]) -> Vec<f64> {
    let mut angle = 0.0;
    pitch
        .iter()
        .enumerate()
        .map(|(index, to_the_one_before)| {
            if index > 0 {
                angle += to_the_one_before;
            }
            offset * f64::cos(angle)
        })
        .collect()
}
