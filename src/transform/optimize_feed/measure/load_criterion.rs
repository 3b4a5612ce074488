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
    /// The largest deflection of the tool's tip over a revolution, in the recipe's unit. It needs `stick_out`, `tool_material`
    /// and `shank` in the setup's entry for the tool.
    Deflection,
    /// The largest bending stress of the tool over a revolution, in MPa. It needs what `deflection` needs.
    BendingStress,
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
            Self::Deflection => "mm",
            Self::BendingStress => "MPa",
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
            Self::Deflection => ColumnUnit::Length,
            Self::BendingStress => ColumnUnit::Stress,
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
            Self::Deflection => "deflection",
            Self::BendingStress => "bending stress",
        }
    }

    /// Returns whether it needs the coefficients of the material.
    pub fn needs_material(self) -> bool {
        !matches!(self, Self::ChipThickness | Self::RemovalRate)
    }

    /// Returns whether it needs the tool as a beam.
    pub fn needs_stiffness(self) -> bool {
        matches!(self, Self::Deflection | Self::BendingStress)
    }

    /// Returns by how much its limits in a recipe are multiplied for one based on mm, where the recipe's unit is so many mm.
    pub(in crate::transform::optimize_feed) fn unit_factor(self, mm_per_unit: f64) -> f64 {
        match self {
            Self::ChipThickness | Self::Deflection => mm_per_unit,
            Self::RemovalRate => mm_per_unit * mm_per_unit * mm_per_unit,
            Self::Force | Self::Torque | Self::Power | Self::BendingStress => 1.0,
        }
    }

    /// Returns whether it needs the teeth of the tool.
    pub fn needs_teeth(self) -> bool {
        self != Self::RemovalRate
    }
}
