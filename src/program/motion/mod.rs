//! Motions: the tool path with its modal state resolved.
//!
//! [`Program::motions`] is the one state machine that knows modality, the sense of arcs in each dialect, frames and units.
//! Simulation, reports and transforms see motions, never raw points.

mod arcs;
mod drilling_cycles;
mod modal_records;
mod modal_state;
mod moves;
mod state_machine;

pub use modal_state::{ActiveTool, CoordinateFrame, ModalState, MotionProblem, MotionProblemKind};
pub use state_machine::Motions;

use super::geometry::{MotionPath, Pose};
use super::motion_class::MotionClass;
use super::record::{DrillingCycle, Spindle};
use super::{Feed, Program};
use std::ops::Range;
use std::sync::Arc;

/// One move of the tool.
#[derive(Debug, Clone)]
pub struct Motion {
    /// Indices of the statements that make it, the deleted among them included: from the first that belongs to this motion
    /// alone (RAPID, CIRCLE, INDIRV, NURBS) to the one that ends it.
    pub statements: Range<usize>,
    /// Where the tool comes from; the same as `to` for a path of [`MotionPath::Start`].
    pub from: Pose,
    /// Where it goes.
    pub to: Pose,
    /// How.
    pub path: MotionPath,
    /// Contact normal, where the file gives one (nine-value GOTO).
    pub normal: Option<nalgebra::Vector3<f64>>,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// The feed in force (of a rapid: the one that comes back after it); a cycle's own feed in its holes.
    pub feed: Option<Feed>,
    /// The FEDRAT statement (or CYCLE) that set the feed.
    pub feed_from: Option<usize>,
    /// The spindle in force.
    pub spindle: Option<Arc<Spindle>>,
    /// The tool in force.
    pub tool: Option<Arc<ActiveTool>>,
    /// The frame in force.
    pub frame: Option<Arc<CoordinateFrame>>,
    /// What it is for.
    pub class: MotionClass,
    /// Whether the file says the class (else it was found from rapid, axis and direction).
    pub class_is_told: bool,
    /// Index of the operation, as [`super::operation::find_operations`] counts them.
    pub operation: usize,
    /// In a drilling cycle: the number of the hole, and the cycle. A hole is one group of motions: rapid to the clearance,
    /// feed to the depth, and back.
    pub hole: Option<(usize, Arc<DrillingCycle>)>,
}

impl Motion {
    /// Index of the statement that ends the motion.
    pub fn last_statement(&self) -> usize {
        self.statements.end.saturating_sub(1)
    }

    /// Length of the path in the file's unit.
    pub fn length(&self) -> f64 {
        self.path.length(self.from.point, self.to.point)
    }

    /// Spindle speed in rev/min, when it is given so.
    pub fn spindle_rpm(&self) -> Option<f64> {
        let spindle = self.spindle.as_deref().filter(|spindle| spindle.on)?;
        (spindle.unit == super::record::SpindleUnit::RevolutionsPerMinute).then_some(spindle.speed).flatten()
    }
}

impl Program {
    /// The motions in order.
    pub fn motions(&self) -> Motions<'_> {
        Motions::new(self)
    }
}
