//! This module holds the modal state of a CL program.

use crate::program::geometry::Pose;
use crate::program::motion_class::MotionClass;
use crate::program::record::{CutterCompensation, DrillingCycle, Spindle, StatedPitch, ToolData};
use crate::program::{Feed, LengthUnit, StatementId};
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

/// The tool in force.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ActiveTool {
    /// The number, once a record has given it.
    pub number: Option<u32>,
    /// The name, if the file has one (NX: in `TOOL PATH/`).
    pub name: Option<String>,
    /// The shape, as far as the file gives it.
    pub data: Option<ToolData>,
    /// Whether a record loaded the tool (an NX path without LOAD/TOOL only describes it).
    pub loaded: bool,
    /// Whether the shape was given after the last load. Then it belongs to the tool that comes next (CUTTER
    /// comes before LOADTL).
    pub(super) shape_is_new: bool,
}

impl ActiveTool {
    /// Returns the name of the tool for people: `tool 3`, `tool 3 (MILL_10)`, `tool MILL_10` or `the tool`.
    pub fn display_name(&self) -> String {
        match (self.number, &self.name) {
            (Some(number), Some(name)) => format!("tool {number} ({name})"),
            (Some(number), None) => format!("tool {number}"),
            (None, Some(name)) => format!("tool {name}"),
            (None, None) => "the tool".to_owned(),
        }
    }
}

/// The frame of the printed coordinates: `outside = origin + axes * printed`.
///
/// For CSYS, CAMERA and CATIA0 matrices the file itself states this direction; for NX it is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateFrame {
    /// The statement that set the frame (for a CATIA0 matrix, its mark).
    pub statement: StatementId,
    /// The origin.
    pub origin: Vector3<f64>,
    /// The axes as columns.
    pub axes: Matrix3<f64>,
}

/// A problem that was found while motions were resolved, for `check`.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionProblem {
    /// The statement that it is about.
    pub statement: StatementId,
    /// The kind of the problem.
    pub kind: MotionProblemKind,
}

/// The kinds of [`MotionProblem`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MotionProblemKind {
    /// No motion follows a RAPID.
    RapidWithoutMotion,
    /// No end point follows a CIRCLE, MOVARC or INDIRV.
    ArcWithoutEnd,
    /// The end of the arc is this far from its circle.
    ArcEndOffCircle(f64),
    /// The start of the arc is this far from its circle (the printed radius and the distance differ).
    ArcStartOffCircle(f64),
    /// An arc or a step starts at a position that no statement has given.
    UnknownStart,
    /// The start tangent (INDIRV) and the arc do not fit.
    TangentMismatch,
    /// Points of an arc, which all lie on it in this dialect, are up to this far from its circle.
    ArcPointsOffCircle(f64),
    /// The points of an arc go back and forth on it.
    ArcPointsOutOfOrder,
    /// The turns of an arc (ROUND) and its angle in degrees (ANGLE) are not the same.
    TurnsDiffer {
        /// The turns.
        turns: f64,
        /// The angle in degrees.
        degrees: f64,
    },
    /// The counts or the order of NURBS, KNOT and CNTRL do not fit.
    BrokenSpline,
    /// The direction of an arc is not given and was assumed to be right-hand.
    AssumedSense,
    /// The angle of a MOVARC tells the other sense than its axis, and was followed.
    SenseFromAngle,
    /// Three rows of four numbers do not follow a CATIA0 mark.
    BrokenFrame,
}

/// The whole modal state.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ModalState {
    /// The pose of the tool, once it is known.
    pub pose: Option<Pose>,
    /// The tool axis in force.
    pub axis: Vector3<f64>,
    /// Whether MULTAX is in force.
    pub multi_axis: bool,
    /// The feed, and the statement that set it.
    pub feed: Option<(Feed, StatementId)>,
    /// The spindle.
    pub spindle: Option<Arc<Spindle>>,
    /// The tool.
    pub tool: Option<Arc<ActiveTool>>,
    /// The frame.
    pub frame: Option<Arc<CoordinateFrame>>,
    /// The shift that the post will add, from TRANS and ORIGIN.
    pub shift: Vector3<f64>,
    /// The cutter compensation, and the statement that set it.
    pub compensation: Option<(CutterCompensation, StatementId)>,
    /// The cycle, and the statement that set it.
    pub cycle: Option<(Arc<DrillingCycle>, StatementId)>,
    /// The pitch of threads, if the file gives it.
    pub pitch: Option<StatedPitch>,
    /// Whether the motions at feed cut a thread.
    pub threading: bool,
    /// The class of motions that the file has marked.
    pub marked: Option<MotionClass>,
    /// The unit of lengths, if the file states it.
    pub units: Option<LengthUnit>,
    /// The index of the operation.
    pub operation: usize,
}

impl Default for ModalState {
    fn default() -> Self {
        Self {
            pose: None,
            axis: Vector3::z(),
            multi_axis: false,
            feed: None,
            spindle: None,
            tool: None,
            frame: None,
            shift: Vector3::zeros(),
            compensation: None,
            cycle: None,
            pitch: None,
            threading: false,
            marked: None,
            units: None,
            operation: 0,
        }
    }
}

impl ModalState {
    /// Changes the tool in force; `change` gets a copy of it.
    pub(super) fn change_tool(&mut self, change: impl FnOnce(&mut ActiveTool)) {
        let mut tool = self.tool.as_deref().cloned().unwrap_or_default();
        change(&mut tool);
        self.tool = Some(Arc::new(tool));
    }
}
