//! What a new program shall do.

use crate::program::{LengthUnit, MotionClass};
use nalgebra::{Point3, Vector3};

/// A program of one operation with one tool along z. Lengths in `units`, feeds in `units` a minute.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramDraft {
    /// Name of the part or program.
    pub name: String,
    /// Name of the operation.
    pub operation: String,
    /// Its tool.
    pub tool: DraftTool,
    /// Spindle speed in revolutions a minute, clockwise; none leaves it to the machine.
    pub spindle: Option<f64>,
    /// Whether coolant is switched on, and off at the end.
    pub coolant: bool,
    /// Unit of everything.
    pub units: LengthUnit,
    /// The tolerance of arcs that a dialect wants to be told.
    pub tolerance: f64,
    /// The motions. The first one says where the tool starts.
    pub moves: Vec<DraftMove>,
}

/// The tool of a draft.
#[derive(Debug, Clone, PartialEq)]
pub struct DraftTool {
    /// Its number.
    pub number: u32,
    /// Its name.
    pub name: String,
    /// Its diameter.
    pub diameter: f64,
    /// Its corner radius: half the diameter of a ball.
    pub corner_radius: f64,
    /// Its length.
    pub length: f64,
}

/// A motion of a draft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DraftMove {
    /// Where it ends.
    pub to: Point3<f64>,
    /// How it goes there.
    pub way: DraftMoveKind,
    /// What it is for.
    pub class: MotionClass,
}

/// How a motion goes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DraftMoveKind {
    /// At rapid.
    Rapid,
    /// Straight.
    Line {
        /// The feed.
        feed: f64,
    },
    /// Along an arc of no more than half a turn.
    Arc {
        /// Its centre.
        centre: Point3<f64>,
        /// A unit vector about which it goes counter-clockwise.
        axis: Vector3<f64>,
        /// The feed.
        feed: f64,
    },
}

impl DraftMoveKind {
    /// The feed; none of a rapid.
    pub fn feed(&self) -> Option<f64> {
        match self {
            Self::Rapid => None,
            Self::Line { feed } | Self::Arc { feed, .. } => Some(*feed),
        }
    }
}
