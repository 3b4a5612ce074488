//! This module holds the draft of a new program.

use crate::program::{LengthUnit, MotionClass};
use nalgebra::{Point3, Vector3};

/// A program of one operation with one tool along z. Lengths are in `units`, feeds in `units` per minute.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramDraft {
    /// The name of the part or program.
    pub name: String,
    /// The name of the operation.
    pub operation: String,
    /// The tool.
    pub tool: DraftTool,
    /// The spindle speed in revolutions per minute, clockwise; `None` leaves it to the machine.
    pub spindle: Option<f64>,
    /// Whether coolant is switched on, and off at the end.
    pub coolant: bool,
    /// The unit of all lengths.
    pub units: LengthUnit,
    /// The tolerance of arcs, for dialects that state it.
    pub tolerance: f64,
    /// The motions. The first one gives the start of the tool.
    pub moves: Vec<DraftMove>,
}

/// The tool of a draft.
#[derive(Debug, Clone, PartialEq)]
pub struct DraftTool {
    /// The number.
    pub number: u32,
    /// The name.
    pub name: String,
    /// The diameter.
    pub diameter: f64,
    /// The corner radius; half the diameter for a ball.
    pub corner_radius: f64,
    /// The length.
    pub length: f64,
}

/// A motion of a draft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DraftMove {
    /// The end point.
    pub to: Point3<f64>,
    /// The path to the end point.
    pub way: DraftMoveKind,
    /// The class.
    pub class: MotionClass,
}

/// The path of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DraftMoveKind {
    /// A rapid.
    Rapid,
    /// A straight line.
    Line {
        /// The feed.
        feed: f64,
    },
    /// An arc of at most half a turn.
    Arc {
        /// The centre.
        centre: Point3<f64>,
        /// The unit vector about which the arc is counter-clockwise.
        axis: Vector3<f64>,
        /// The feed.
        feed: f64,
    },
}

impl DraftMoveKind {
    /// Returns the feed, or `None` for a rapid.
    pub fn feed(&self) -> Option<f64> {
        match self {
            Self::Rapid => None,
            Self::Line { feed } | Self::Arc { feed, .. } => Some(*feed),
        }
    }
}
