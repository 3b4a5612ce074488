//! This module resolves motions: the tool path with its modal state.
//!
//! [`Program::motions`] is the only state machine that knows modality, the direction of arcs in each dialect,
//! frames and units. Simulation, reports and transforms see motions, never raw points.
//!
//! RAPID holds for the next record only, however many points that has. Feed, spindle and tool stay in force
//! from one operation to the next, as in posts. NX's tool axis starts at z in every `TOOL PATH`, and the
//! tool's position is carried over into a new `MSYS`.

mod arcs;
mod drilling_cycles;
mod modal_records;
mod modal_shares;
mod modal_state;
mod moves;
mod state_machine;
mod surface_speed;
mod suspended_motions;

pub use modal_state::{ActiveTool, CoordinateFrame, ModalState, MotionProblem, MotionProblemKind};
pub use state_machine::Motions;
pub use surface_speed::SurfaceSpindleSpeed;
pub use suspended_motions::SuspendedMotions;

use super::geometry::{MotionPath, Pose};
use super::motion_class::MotionClass;
use super::record::{DrillingCycle, Spindle, SpindleUnit};
use super::{Feed, Program, StatementId, StatementRange};
use std::sync::Arc;

/// One move of the tool.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Motion {
    /// The statements that make it, including deleted ones: from the first one that belongs to this motion
    /// alone (RAPID, CIRCLE, INDIRV, NURBS) to the one that ends it.
    pub statements: StatementRange,
    /// The pose at the start; equal to `to` for a path of [`MotionPath::Start`].
    pub from: Pose,
    /// The pose at the end.
    pub to: Pose,
    /// The path between both.
    pub path: MotionPath,
    /// The contact normal, if the file gives one (GOTO with nine values).
    pub normal: Option<nalgebra::Vector3<f64>>,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// The feed in force; for a rapid, the feed that holds again after it; in the holes of a cycle, the
    /// cycle's own feed.
    pub feed: Option<Feed>,
    /// The FEDRAT (or CYCLE) statement that set the feed.
    pub feed_from: Option<StatementId>,
    /// The spindle in force.
    pub spindle: Option<Arc<Spindle>>,
    /// The spindle speeds that a lathe's surface speed makes on the motion, if they are known.
    pub surface_rpm: Option<SurfaceSpindleSpeed>,
    /// The tool in force.
    pub tool: Option<Arc<ActiveTool>>,
    /// The frame in force.
    pub frame: Option<Arc<CoordinateFrame>>,
    /// The class of the motion.
    pub class: MotionClass,
    /// Whether the motion cuts a thread, tapping or turning: its feed is the pitch times the spindle speed.
    pub cuts_thread: bool,
    /// Whether the file states the class. Otherwise it was found from rapid, axis and direction.
    pub class_is_stated: bool,
    /// The index of the operation, as [`super::operation::find_operations`] counts them.
    pub operation: usize,
    /// In a drilling cycle, the number of the hole and the cycle. A hole is one group of motions: at rapid to
    /// the clearance, at feed to the depth, and back.
    pub hole: Option<(usize, Arc<DrillingCycle>)>,
}

impl Motion {
    /// Returns the statement that ends the motion.
    pub fn last_statement(&self) -> StatementId {
        self.statements.last()
    }

    /// Returns the length of the path in the file's unit.
    pub fn length(&self) -> f64 {
        self.path.length(self.from.point, self.to.point)
    }

    /// Returns the spindle speed in rev/min if the spindle turns: the programmed one, or the mean one of a lathe
    /// that keeps its surface speed.
    pub fn spindle_rpm(&self) -> Option<f64> {
        let spindle = self.spindle.as_deref().filter(|spindle| spindle.on)?;
        match spindle.unit {
            SpindleUnit::RevolutionsPerMinute => spindle.speed,
            SpindleUnit::SurfaceFeet | SpindleUnit::SurfaceMetres => {
                self.surface_rpm.map(|surface| surface.mean)
            }
        }
    }
}

impl Program {
    /// Returns the motions in order.
    ///
    /// ```
    /// use clsmith::parse::parse;
    /// use clsmith::program::MotionClass;
    /// use clsmith::source::Source;
    ///
    /// let text = b"FROM/0,0,50\nRAPID\nGOTO/0,0,2\nFEDRAT/MMPM,300.\nGOTO/0,0,-1\nGOTO/30,0,-1\n";
    /// let program = parse(&Source::new("part.cls", text.to_vec())?, None).program;
    /// let moves: Vec<_> = program.motions().filter(|motion| motion.length() > 0.0).collect();
    /// let lengths: Vec<f64> = moves.iter().map(|motion| motion.length()).collect();
    /// assert_eq!(lengths, [48.0, 3.0, 30.0]);
    /// assert_eq!(moves[0].class, MotionClass::Rapid);
    /// assert_eq!(moves[2].feed.map(|feed| feed.value), Some(300.0));
    /// # Ok::<(), clsmith::source::SourceTooLarge>(())
    /// ```
    pub fn motions(&self) -> Motions<'_> {
        Motions::new(self)
    }
}
