//! What may load the cutter.

use crate::presentation::display_units::ColumnUnit;
use schemars::JsonSchema;
use serde::Deserialize;

/// What loads the cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum LoadCriterion {
    /// Largest local uncut chip thickness, in the recipe's unit.
    #[default]
    ChipThickness,
    /// Volume removed per minute, in the recipe's unit cubed.
    RemovalRate,
    /// Largest resultant cutting force over a revolution, in N.
    Force,
    /// Largest torque over a revolution, in Nm.
    Torque,
    /// Mean power, in kW.
    Power,
}

impl LoadCriterion {
    /// Its unit, in millimetres.
    pub fn unit(self) -> &'static str {
        match self {
            Self::ChipThickness => "mm",
            Self::RemovalRate => "mm3/min",
            Self::Force => "N",
            Self::Torque => "Nm",
            Self::Power => "kW",
        }
    }

    /// Its unit for people, who may see inches.
    pub(in crate::transform::optimize_feed) fn column_unit(self) -> ColumnUnit {
        match self {
            Self::ChipThickness => ColumnUnit::Length,
            Self::RemovalRate => ColumnUnit::RemovalRate,
            Self::Force => ColumnUnit::Force,
            Self::Torque => ColumnUnit::Torque,
            Self::Power => ColumnUnit::Power,
        }
    }

    /// Its name for people.
    pub fn display_name(self) -> &'static str {
        match self {
            Self::ChipThickness => "chip thickness",
            Self::RemovalRate => "removal rate",
            Self::Force => "force",
            Self::Torque => "torque",
            Self::Power => "power",
        }
    }

    /// Whether it needs the material's coefficients.
    pub fn needs_material(self) -> bool {
        matches!(self, Self::Force | Self::Torque | Self::Power)
    }

    /// Whether it needs the teeth.
    pub fn needs_teeth(self) -> bool {
        self != Self::RemovalRate
    }
}
