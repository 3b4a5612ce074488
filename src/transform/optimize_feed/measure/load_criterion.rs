//! This module names the loads of the cutter that can be limited.

use crate::presentation::display_units::ColumnUnit;
use schemars::JsonSchema;
use serde::Deserialize;

/// A load of the cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, serde::Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum LoadCriterion {
    /// The largest local uncut chip thickness, in the recipe's unit.
    #[default]
    ChipThickness,
    /// The volume removed per minute, in the recipe's unit cubed.
    RemovalRate,
    /// The largest resultant cutting force over a revolution, in N.
    Force,
    /// The largest torque over a revolution, in Nm.
    Torque,
    /// The mean power, in kW.
    Power,
}

impl LoadCriterion {
    /// Returns its unit, based on millimetres.
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

    /// Returns whether it needs the coefficients of the material.
    pub fn needs_material(self) -> bool {
        matches!(self, Self::Force | Self::Torque | Self::Power)
    }

    /// Returns whether it needs the teeth of the tool.
    pub fn needs_teeth(self) -> bool {
        self != Self::RemovalRate
    }
}
