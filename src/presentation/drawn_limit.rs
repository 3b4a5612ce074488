//! This module holds limits that drawings show as lines.

/// The quantity that a limit bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LimitedQuantity {
    /// Feed, mm/min.
    Feed,
    /// Thickest chip, mm.
    Chip,
    /// Removal rate, mm3/min.
    Removal,
    /// Cutting force, N.
    Force,
    /// Torque, N m.
    Torque,
    /// Power, kW.
    Power,
    /// Deflection of the tool's tip, mm.
    Deflection,
    /// Bending stress of the tool, MPa.
    BendingStress,
}

/// A limit, or a target that a step steers towards.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnLimit {
    /// What it bounds.
    pub quantity: LimitedQuantity,
    /// Its value, in the unit of the quantity.
    pub value: f64,
    /// Its name for readers: `target of optimize_feed`.
    pub name: String,
}

impl DrawnLimit {
    /// Makes a limit.
    pub fn new(quantity: LimitedQuantity, value: f64, name: impl Into<String>) -> Self {
        Self { quantity, value, name: name.into() }
    }
}
