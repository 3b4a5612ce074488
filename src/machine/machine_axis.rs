//! This module holds one axis of a machine.

use nalgebra::{Point3, Unit, Vector3};

/// How far a value may lie beyond a limit and still counts as inside, in mm or degrees.
pub(super) const LIMIT_SLACK: f64 = 1e-9;

/// Where an axis stands in the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisMount {
    /// Between the workpiece and the frame: it moves the workpiece.
    Table,
    /// Between the frame and the tool: it moves the tool.
    Head,
}

/// What an axis does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisKind {
    /// It moves along its direction. Its values are in mm.
    Linear,
    /// It turns right-handed about its direction. Its values are in degrees.
    Rotary,
}

/// One axis of a machine. Lengths are in mm and angles in degrees.
///
/// Directions and points are told in the workpiece frame with all axes at 0. A positive value of a table axis moves
/// or turns the workpiece, one of a head axis the tool.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineAxis {
    /// Its name, as on the machine: `X`, `C`.
    pub name: String,
    /// Where it stands.
    pub mount: AxisMount,
    /// What it does.
    pub kind: AxisKind,
    /// Its direction: of its own motion, or of the line about which it turns.
    pub direction: Unit<Vector3<f64>>,
    /// A point on the line about which a rotary axis turns.
    pub point: Point3<f64>,
    /// Its least and its largest value. Without limits a linear axis has any travel, and a rotary axis turns without
    /// end.
    pub limits: Option<[f64; 2]>,
    /// Its largest speed at feed, per minute.
    pub max_speed: f64,
    /// Its speed at rapid, per minute.
    pub rapid: f64,
    /// Its acceleration, per s2.
    pub acceleration: f64,
    /// Its jerk, per s3. Without it, the acceleration changes at once.
    pub jerk: Option<f64>,
}

impl MachineAxis {
    /// Returns whether a value is inside the limits.
    pub fn allows_value(&self, value: f64) -> bool {
        self.limits.is_none_or(|[low, high]| value >= low - LIMIT_SLACK && value <= high + LIMIT_SLACK)
    }

    /// Returns the unit of its values.
    pub fn value_unit(&self) -> &'static str {
        match self.kind {
            AxisKind::Linear => "mm",
            AxisKind::Rotary => "deg",
        }
    }
}
