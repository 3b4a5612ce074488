//! This module follows the modal state during a move: the tool axis before and after it, and which statements
//! belong together.
//!
//! `old` is the axis that is in force in the file. `new` is the axis that would be in force in the changed
//! file if only numbers changed. If a motion states no axis and the transform does not map `old` to `new`,
//! its axis has to be written.

use super::axis_notation::{AxisNotation, RequiredAxis};
use crate::program::record::{CutterCompensation, FrameWord, has_contact_normal, has_tool_axes};
use crate::program::{Dialect, Record, StatementId};
use crate::transform::Affine;
use crate::transform::affine::is_same_vector;
use nalgebra::Vector3;

/// The reason why a program cannot be moved.
#[derive(Debug)]
pub(super) struct MoveRefusal {
    /// The reason.
    pub message: &'static str,
    /// The statement that prevents the move.
    pub statement: StatementId,
    /// The label at that statement.
    pub label: &'static str,
}

/// The state while statements are read in order.
#[derive(Debug)]
pub(super) struct MoveTracker<'p> {
    place: &'p Affine,
    dialect: Dialect,
    form: AxisNotation,
    old: Vector3<f64>,
    new: Vector3<f64>,
    /// Whether this step wrote the axis that is in force.
    written: bool,
    multi_axis: bool,
    first: Option<StatementId>,
    /// Whether a CIRCLE, INDIRV or NURBS that still waits for its end has moved.
    pending: Option<bool>,
    /// Whether the last position of the tool has moved.
    last: Option<bool>,
    compensation: Option<bool>,
    setup_axis: Option<Vector3<f64>>,
    setup: Option<Vector3<f64>>,
    used_setup: Option<Option<Vector3<f64>>>,
    axis_words_ignored: bool,
    moved: usize,
    turned_over: Option<StatementId>,
    keeps_sense: bool,
}

impl<'p> MoveTracker<'p> {
    /// Makes the state before the first statement.
    pub(super) fn new(place: &'p Affine, dialect: Dialect) -> Self {
        Self {
            place,
            dialect,
            form: AxisNotation::for_dialect(dialect),
            old: Vector3::z(),
            new: Vector3::z(),
            written: false,
            multi_axis: false,
            first: None,
            pending: None,
            last: None,
            compensation: None,
            setup_axis: None,
            setup: None,
            used_setup: None,
            axis_words_ignored: false,
            moved: 0,
            turned_over: None,
            keeps_sense: false,
        }
    }

    /// Returns whether MULTAX is in force.
    pub(super) fn is_multi_axis(&self) -> bool {
        self.multi_axis
    }

    /// Returns whether the transform keeps the axis in force.
    pub(super) fn keeps_axis(&self) -> bool {
        self.place.keeps_direction(self.old)
    }

    /// Notes a MULTAX that the step inserts.
    pub(super) fn note_multax(&mut self) {
        self.multi_axis = true;
    }

    /// Reads a statement before it changes. `moved` tells whether it will be moved. Returns the axis that has
    /// to be written there.
    pub(super) fn observe_statement(
        &mut self,
        id: StatementId,
        record: &Record,
        text: &[u8],
        moved: bool,
    ) -> Result<Option<RequiredAxis>, MoveRefusal> {
        match record {
            Record::Goto(goto) => return self.observe_motion(id, moved, goto.axis, false),
            Record::From(goto) => return self.observe_motion(id, moved, goto.axis, false),
            Record::GoHome(Some(goto)) => return self.observe_motion(id, moved, goto.axis, false),
            Record::Points(numbers) => {
                let axis = if has_contact_normal(numbers) {
                    numbers.get(3..6)
                } else if self.multi_axis && has_tool_axes(numbers) {
                    numbers.get(numbers.len() - 3..)
                } else {
                    None
                };
                return self.observe_motion(id, moved, axis.map(Vector3::from_column_slice), false);
            }
            Record::GoDelta(_) | Record::DriveArc(_) | Record::AxialArc(_) | Record::Control(_) => {
                return self.observe_motion(id, moved, None, true);
            }
            Record::Rapid => {
                self.first.get_or_insert(id);
            }
            Record::Circle(_) | Record::MoveArc(_) | Record::StartDirection(_) | Record::Nurbs => {
                self.first.get_or_insert(id);
                self.pending = Some(moved);
            }
            Record::GoHome(None) => (self.first, self.pending, self.last) = (None, None, None),
            Record::ToolAxis(axis) if self.dialect.has_setup_axis() => self.setup = Some(**axis),
            Record::ToolAxis(axis) => self.set_axis(**axis, moved),
            Record::MultiAxis(on) => self.multi_axis = *on,
            Record::OperationStart(_) if self.dialect == Dialect::Nx => {
                (self.old, self.new, self.written) = (Vector3::z(), Vector3::z(), false);
            }
            Record::Frame(frame) if frame.word == FrameWord::Csys && self.dialect == Dialect::SolidWorks => {
                if let [_, _, x, _, _, _, y, _, _, _, z, _] = frame.numbers.as_slice() {
                    self.setup_axis = Some(Vector3::new(*x, *y, *z));
                }
            }
            Record::CutterCompensation(CutterCompensation::Off) => self.compensation = None,
            Record::CutterCompensation(_) => self.compensation = Some(moved),
            Record::Known => self.axis_words_ignored |= hides_tool_axis(text),
            _ => {}
        }
        Ok(None)
    }

    /// Checks the whole program after its last statement. A mirror that reverses the tool axis of every
    /// motion is a mistake.
    pub(super) fn finish(&self) -> Result<(), MoveRefusal> {
        match self.turned_over {
            Some(statement) if !self.keeps_sense => Err(MoveRefusal {
                message: "the mirror plane is normal to the tool axis: the tool would reach the part from its other end. \
                          Mirror in a plane that holds the axis, or turn the part over as well (`rotate` by 180 degrees)",
                statement,
                label: "the tool axis is turned over",
            }),
            _ => Ok(()),
        }
    }

    fn set_axis(&mut self, axis: Vector3<f64>, moved: bool) {
        self.old = axis;
        self.new = if moved { self.place.transform_vector(axis) } else { axis };
        self.written = false;
    }

    fn observe_motion(
        &mut self,
        id: StatementId,
        moved: bool,
        axis: Option<Vector3<f64>>,
        relative: bool,
    ) -> Result<Option<RequiredAxis>, MoveRefusal> {
        let first = self.first.take().unwrap_or(id);
        self.check_moves_together(id, moved, relative)?;
        self.last = Some(moved);
        if let Some(axis) = axis {
            self.set_axis(axis, moved);
        }
        let wanted = if moved { self.place.transform_vector(self.old) } else { self.old };
        if moved {
            self.check_axis(id, wanted)?;
        }
        if axis.is_some() {
            return Ok(None);
        }
        // In such dialects a GOTO of three values means the axis 0,0,1 again.
        let every_line =
            self.form == AxisNotation::EveryLine && self.written && !is_same_vector(wanted, Vector3::z());
        if is_same_vector(wanted, self.new) && !every_line {
            return Ok(None);
        }
        (self.new, self.written) = (wanted, true);
        Ok(Some(RequiredAxis { axis: wanted, first }))
    }

    /// Checks that a motion that starts where the previous one ends is moved with it.
    fn check_moves_together(
        &mut self,
        id: StatementId,
        moved: bool,
        relative: bool,
    ) -> Result<(), MoveRefusal> {
        let announced = self.pending.take();
        let start = self.last.is_some_and(|last| last != moved);
        if announced.is_some_and(|announced| announced != moved || start) || relative && start {
            return Err(MoveRefusal {
                message: "an arc, a spline or a GODLTA starts where another operation ends that is not moved; select both operations",
                statement: id,
                label: "starts in the operation before",
            });
        }
        if self.place.has_mirror() && self.compensation.is_some_and(|compensation| compensation != moved) {
            return Err(MoveRefusal {
                message: "cutter compensation continues from an operation that is not mirrored; select both operations",
                statement: id,
                label: "moves under compensation",
            });
        }
        Ok(())
    }

    fn check_axis(&mut self, id: StatementId, wanted: Vector3<f64>) -> Result<(), MoveRefusal> {
        self.moved += 1;
        let refuse = |message, label| Err(MoveRefusal { message, statement: id, label });
        if self.dialect.has_setup_axis() {
            if self.used_setup.is_some_and(|used| used != self.setup) {
                return refuse(
                    "CAMWorks prints every setup in a frame of its own (TLAXIS, ROTABL): one transform would mean another \
                     place in each. Select the operations of one setup with `where`",
                    "in another setup than the motions before",
                );
            }
            self.used_setup = Some(self.setup);
            if !self.place.keeps_direction(Vector3::z()) {
                return refuse(
                    "CAMWorks prints every setup with the tool along z, and TLAXIS and ROTABL orient it: a rotation that \
                     tilts z cannot be put into the points",
                    "the tool stands along z here",
                );
            }
            return Ok(());
        }
        if !self.place.changes_directions() {
            return Ok(());
        }
        if is_same_vector(wanted, self.old) {
            self.keeps_sense = true;
            return Ok(());
        }
        if self.axis_words_ignored {
            return refuse(
                "the transform rotates the tool axis, but the file makes its post ignore TLAXIS (`SYN/'TLAXIS',...`): the \
                 axis in force is not the one it prints",
                "has a tool axis that would turn",
            );
        }
        if let Some(setup) = self.setup_axis
            && (wanted - setup).norm() > 1e-4
        {
            return refuse(
                "SolidWorks CAM prints the path in world coordinates and the plane of the setup in CSYS, whose third column is \
                 the tool axis. Another axis needs another setup. Rotate about the tool axis, or rotate the part in the CAM \
                 system",
                "has the tool axis of its CSYS",
            );
        }
        if self.place.has_mirror() && is_same_vector(wanted, -self.old) {
            self.turned_over.get_or_insert(id);
        } else {
            self.keeps_sense = true;
        }
        Ok(())
    }
}

/// Returns whether a statement hides tool axes. CATIA with an ICAM table turns all TLAXIS records into
/// comments by `SYN/'TLAXIS','$$*TLAXIS'`.
fn hides_tool_axis(text: &[u8]) -> bool {
    text.trim_ascii_start().starts_with(b"SYN") && memchr::memmem::find(text, b"TLAXIS").is_some()
}
