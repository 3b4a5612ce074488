//! The modal state of a CL program.

use crate::program::geometry::Pose;
use crate::program::motion_class::MotionClass;
use crate::program::record::{CutterCompensation, DrillingCycle, Spindle, ToolData};
use crate::program::{Feed, LengthUnit};
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

/// The tool in force.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ActiveTool {
    /// Its number, once a record has said it.
    pub number: Option<u32>,
    /// Its name, where the file has one (NX: in `TOOL PATH/`).
    pub name: Option<String>,
    /// Its shape, as far as the file says.
    pub data: Option<ToolData>,
    /// Whether a record loaded it (an NX path without LOAD/TOOL only describes it).
    pub loaded: bool,
    /// Whether the shape was told after the last load: it then is of the tool that comes next (CUTTER stands before LOADTL).
    pub(super) shape_is_new: bool,
}

impl ActiveTool {
    /// The tool as people call it: `tool 3`, `tool 3 (MILL_10)`, `tool MILL_10`, `the tool`.
    pub fn display_name(&self) -> String {
        match (self.number, &self.name) {
            (Some(number), Some(name)) => format!("tool {number} ({name})"),
            (Some(number), None) => format!("tool {number}"),
            (None, Some(name)) => format!("tool {name}"),
            (None, None) => "the tool".to_owned(),
        }
    }
}

/// Where the printed coordinates stand: `outside = origin + axes * printed`.
///
/// The direction of CSYS, CAMERA and CATIA0 matrices is the file's own statement; for NX it is measured.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateFrame {
    /// The statement that set it (of a CATIA0 matrix: its mark).
    pub statement: usize,
    /// Origin.
    pub origin: Vector3<f64>,
    /// Axes as columns.
    pub axes: Matrix3<f64>,
}

/// A problem met while motions were resolved, for `check`.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionProblem {
    /// The statement it is about.
    pub statement: usize,
    /// What is wrong.
    pub kind: MotionProblemKind,
}

/// Kinds of [`MotionProblem`].
#[derive(Debug, Clone, PartialEq)]
pub enum MotionProblemKind {
    /// RAPID with no motion after it.
    RapidWithoutMotion,
    /// CIRCLE, MOVARC or INDIRV with no end point after it.
    ArcWithoutEnd,
    /// The end of the arc lies off its circle by this much.
    ArcEndOffCircle(f64),
    /// The start of the arc lies off its circle (printed radius and distance differ) by this much.
    ArcStartOffCircle(f64),
    /// An arc or step from a place that no statement has told.
    UnknownStart,
    /// The start tangent (INDIRV) and the arc do not fit.
    TangentMismatch,
    /// NURBS, KNOT and CNTRL counts or order do not fit.
    BrokenSpline,
    /// A stored sense of an arc was not told and had to be assumed right-hand.
    AssumedSense,
    /// A CATIA0 mark without three rows of four numbers.
    BrokenFrame,
}

/// Everything modal.
#[derive(Debug, Clone)]
pub struct ModalState {
    /// Where the tool is, once known.
    pub pose: Option<Pose>,
    /// The axis in force.
    pub axis: Vector3<f64>,
    /// Whether MULTAX is in force.
    pub multi_axis: bool,
    /// Feed, and the statement that set it.
    pub feed: Option<(Feed, usize)>,
    /// Spindle.
    pub spindle: Option<Arc<Spindle>>,
    /// Tool.
    pub tool: Option<Arc<ActiveTool>>,
    /// Frame.
    pub frame: Option<Arc<CoordinateFrame>>,
    /// TRANS and ORIGIN: the shift that the post will add.
    pub shift: Vector3<f64>,
    /// Cutter compensation, and the statement that set it.
    pub compensation: Option<(CutterCompensation, usize)>,
    /// Cycle, and the statement that set it.
    pub cycle: Option<(Arc<DrillingCycle>, usize)>,
    /// Class of motion that the file has marked.
    pub marked: Option<MotionClass>,
    /// Unit of lengths, where the file says it.
    pub units: Option<LengthUnit>,
    /// Index of the operation.
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
            marked: None,
            units: None,
            operation: 0,
        }
    }
}

impl ModalState {
    /// Changes the tool in force; `change` sees a copy of it.
    pub(super) fn change_tool(&mut self, change: impl FnOnce(&mut ActiveTool)) {
        let mut tool = self.tool.as_deref().cloned().unwrap_or_default();
        change(&mut tool);
        self.tool = Some(Arc::new(tool));
    }
}
