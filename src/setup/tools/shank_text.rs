//! This module holds the shank of a tool as it is written: one cylinder, or a list of them where it has steps.

use super::tool_entry::ToolCylinder;
use crate::parameters::Positive;
use crate::setup::YamlLocation;
use crate::setup::setup_reader::SetupReader;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A part of the shank with one diameter.
#[derive(Debug, Clone, Copy, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Shank")]
struct ShankPartText {
    /// The diameter.
    diameter: Positive,
    /// The length from the tip of the tool to the end of this part.
    length: Positive,
}

/// The shank above the flutes: one part, or the parts of a stepped one from the flutes upwards.
#[derive(Debug, Clone)]
pub(super) struct ShankText {
    parts: Vec<ShankPartText>,
    is_list: bool,
}

impl ShankText {
    /// Returns the parts in millimetres, from the flutes upwards, and reports those that end below the part before.
    pub(super) fn check_parts(&self, reader: &mut SetupReader, place: &YamlLocation) -> Vec<ToolCylinder> {
        let mut parts: Vec<ToolCylinder> = Vec::new();
        for (index, part) in self.parts.iter().enumerate() {
            let at = || if self.is_list { place.at_index(index) } else { place.clone() };
            let length_mm = reader.size_mm(part.length, || at().at_key("length"));
            if parts.last().is_some_and(|before| before.length_mm >= length_mm) {
                let message = "this part of the shank ends below the one before it";
                let help = "The length of each part counts from the tip of the tool; write them from the flutes upwards.";
                reader.add_fault(|| at().at_key("length"), message, "not longer than the part before", help);
            }
            let diameter_mm = reader.size_mm(part.diameter, || at().at_key("diameter"));
            parts.push(ToolCylinder { diameter_mm, length_mm });
        }
        parts
    }

    /// Returns where the length of the last part stands.
    pub(super) fn length_place(place: &YamlLocation, parts: usize, is_list: bool) -> YamlLocation {
        let part = if is_list { place.at_index(parts.saturating_sub(1)) } else { place.clone() };
        part.at_key("length")
    }

    /// Returns whether it is written as a list.
    pub(super) fn is_list(&self) -> bool {
        self.is_list
    }
}

impl<'de> Deserialize<'de> for ShankText {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ShankTextVisitor)
    }
}

const SHANK: &str = "`{ diameter: …, length: … }`, or a list of them for a stepped shank";

struct ShankTextVisitor;

impl<'de> Visitor<'de> for ShankTextVisitor {
    type Value = ShankText;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(SHANK)
    }
    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ShankText, A::Error> {
        let part = ShankPartText::deserialize(MapAccessDeserializer::new(map))?;
        Ok(ShankText { parts: vec![part], is_list: false })
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<ShankText, A::Error> {
        let mut parts = Vec::new();
        while let Some(part) = list.next_element::<ShankPartText>()? {
            parts.push(part);
        }
        if parts.is_empty() {
            return Err(de::Error::invalid_length(0, &SHANK));
        }
        Ok(ShankText { parts, is_list: true })
    }
}

impl JsonSchema for ShankText {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "ShankParts".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let part = generator.subschema_for::<ShankPartText>();
        json_schema!({ "anyOf": [part.clone(), { "type": "array", "items": part, "minItems": 1 }] })
    }
}
