//! Units of length.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The unit of the lengths in a file; feeds are in this unit per minute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LengthUnit {
    /// Millimetres.
    #[default]
    Mm,
    /// Inches of 25.4 mm.
    Inch,
}

impl LengthUnit {
    /// How many millimetres one unit is.
    pub fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Inch => 25.4,
        }
    }
}
