//! What stands around the program: the machine and its limits.
//!
//! The same keys come from the recipe's `setup:`, from a setup file, or both; whoever is closer to the job wins, field by
//! field ([`Setup::over`]).

use crate::diagnostic::Diagnostic;
use crate::source::Source;
use crate::values::{LengthUnit, Positive};
use crate::yaml::Document;
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// The setup of a job. Lengths in millimetres, whatever the unit of the file it came from.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Setup {
    /// The machine.
    pub machine: Machine,
}

/// A machine's limits; what is not known is `None`, and does not limit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Machine {
    /// Highest programmed feed, in mm/min.
    pub max_feed: Option<Positive>,
    /// Speed of rapid motions, in mm/min.
    pub rapid_feed: Option<Positive>,
}

impl Setup {
    /// Reads a setup file: `units:` and the keys of a recipe's `setup:` beside it.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each at its place.
    pub fn load(source: &Arc<Source>) -> Result<Self, Vec<Diagnostic>> {
        let document = Document::read(source).map_err(|diagnostic| vec![*diagnostic])?;
        let text: SetupFileText = document.check(|_| None)?;
        Ok(SetupText { machine: text.machine }.checked(text.units))
    }

    /// This setup where it says something, `base` where it does not.
    #[must_use]
    pub fn over(self, base: Self) -> Self {
        Self {
            machine: Machine {
                max_feed: self.machine.max_feed.or(base.machine.max_feed),
                rapid_feed: self.machine.rapid_feed.or(base.machine.rapid_feed),
            },
        }
    }

    /// JSON schema of a setup file, for editors.
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(SetupFileText).to_value()
    }
}

/// A setup file as it is written.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
#[schemars(title = "clsmith setup file")]
struct SetupFileText {
    /// The unit of every length in this file; feeds are in this unit per minute.
    #[serde(default)]
    units: LengthUnit,
    /// The machine and its limits.
    #[serde(default)]
    machine: MachineText,
}

/// What stands around the program: the machine and its limits.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Setup")]
pub(crate) struct SetupText {
    /// The machine and its limits.
    #[serde(default)]
    machine: MachineText,
}

/// A machine's limits, in the file's unit.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Machine")]
struct MachineText {
    /// Highest programmed feed, in the file's unit per minute.
    max_feed: Option<Positive>,
    /// Speed of rapid motions, in the file's unit per minute.
    rapid_feed: Option<Positive>,
}

impl SetupText {
    /// The setup in millimetres. Only feeds near the largest `f64` leave the range when converted; they limit nothing.
    pub(crate) fn checked(self, units: LengthUnit) -> Setup {
        let mm = |feed: Option<Positive>| feed.and_then(|feed| Positive::new(feed.get() * units.in_mm()));
        Setup {
            machine: Machine { max_feed: mm(self.machine.max_feed), rapid_feed: mm(self.machine.rapid_feed) },
        }
    }
}
