//! This module holds a recipe as it is written: what serde reads, and what the JSON schema gives editors.

use super::Provenance;
use super::parameters::LengthUnit;
use crate::setup::SetupText;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Unexpected, Visitor};
use std::borrow::Cow;
use std::fmt;

/// A recipe: the transforms that are applied to CL data in order, with their parameters.
#[derive(Debug, serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "clsmith recipe", rename = "Recipe")]
pub(super) struct RecipeText<S> {
    /// The version of the rules by which this recipe is written: 1.
    pub version: RecipeVersion,
    /// The unit of every length in this recipe. Feeds are in this unit per minute.
    #[serde(default)]
    pub units: LengthUnit,
    /// A file with the keys of `setup`, relative to this recipe's folder. Keys of `setup` override it.
    pub setup_file: Option<String>,
    /// The data around the program: machine, stock, tools and material.
    #[serde(default)]
    pub setup: SetupText,
    /// What the corrected file states about the run that made it.
    #[serde(default)]
    pub provenance: Provenance,
    /// Whether the corrected program is simulated before it is written, where the setup has a stock: rapids through
    /// the stock, collisions and a standing spindle are errors then.
    #[serde(default = "simulate_by_default")]
    #[schemars(extend("x-default" = "true"))]
    pub simulate: bool,
    /// The transforms, which are applied one after the other.
    pub steps: Vec<S>,
}

/// A stock that is described is there to be looked at.
fn simulate_by_default() -> bool {
    true
}

/// Returns the JSON schema of a recipe with steps of type `S`, for editors.
///
/// ```
/// use clsmith::recipe::recipe_schema;
/// use clsmith::transform::Step;
///
/// let schema = recipe_schema::<Step>();
/// assert!(schema["properties"]["steps"].is_object());
/// ```
pub fn recipe_schema<S: JsonSchema>() -> serde_json::Value {
    crate::yaml::make_file_schema::<RecipeText<S>>("recipe")
}

/// A version of the recipe's rules that this clsmith knows.
#[derive(Debug, Clone, Copy)]
pub(super) struct RecipeVersion(u32);

impl RecipeVersion {
    /// The only version so far.
    const KNOWN: u32 = 1;

    pub(super) fn get(self) -> u32 {
        self.0
    }
}

impl<'de> Deserialize<'de> for RecipeVersion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(RecipeVersionVisitor)
    }
}

struct RecipeVersionVisitor;

impl Visitor<'_> for RecipeVersionVisitor {
    type Value = RecipeVersion;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "version {}", RecipeVersion::KNOWN)
    }
    fn visit_u64<E: de::Error>(self, value: u64) -> Result<RecipeVersion, E> {
        if value == u64::from(RecipeVersion::KNOWN) {
            return Ok(RecipeVersion(RecipeVersion::KNOWN));
        }
        Err(E::invalid_value(Unexpected::Unsigned(value), &self))
    }
}

impl JsonSchema for RecipeVersion {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Version".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "const": RecipeVersion::KNOWN })
    }
}
