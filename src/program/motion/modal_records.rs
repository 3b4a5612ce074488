//! This module processes statements that set something until it is set again: feed, spindle, tool, axis,
//! frame, cycle and operation.

use super::modal_state::{CoordinateFrame, ModalState, MotionProblemKind};
use super::state_machine::Motions;
use crate::program::geometry::Pose;
use crate::program::record::{FrameRecord, FrameWord, Spindle, StatedPitch, Threading, ToolCall};
use crate::program::{Record, StatementId, operation};
use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;

impl Motions<'_> {
    /// Processes a record that does not move the tool.
    pub(super) fn process_modal_record(&mut self, id: StatementId, record: &Record) {
        let state = &mut self.state;
        match record {
            Record::Feed(feed) => {
                // A feed without a unit keeps the unit of the feed before.
                let unit = feed.unit.or(state.feed.and_then(|(before, _)| before.unit));
                state.feed = Some((crate::program::Feed { value: feed.value, unit }, id));
                // CAM systems write no FEDRAT between RAPID and its motion. In APT, a feed ends a rapid.
                if let Some(rapid) = self.pending.rapid.take() {
                    self.report_problem(rapid, MotionProblemKind::RapidWithoutMotion);
                }
            }
            Record::Spindle(spindle) => {
                let spindle = spindle.inherit_from(state.spindle.as_deref());
                state.spindle = Some(Arc::new(spindle));
            }
            Record::SpindleLimit(max_rpm) => {
                let limited = Spindle::limit_speed(state.spindle.as_deref(), *max_rpm);
                state.spindle = Some(Arc::new(limited));
            }
            Record::CutterCompensation(compensation) => state.compensation = Some((*compensation, id)),
            Record::ToolCall(call) => {
                if let Some(channel) = call.channel {
                    self.change_channel(channel);
                }
                self.call_tool(call);
            }
            Record::ToolData(data) => state.change_tool(|tool| {
                tool.data = Some(data.as_ref().clone());
                tool.shape_is_new = true;
            }),
            Record::ToolAxis(axis) if !self.program.dialect().has_setup_axis() => {
                state.axis = normalize_axis(**axis)
            }
            Record::MultiAxis(on) => state.multi_axis = *on,
            Record::Frame(frame) => self.process_frame(id, frame),
            Record::FrameMark => self.pending.matrix = Some((id, Vec::new())),
            Record::MatrixRow(row) => {
                if let Some((_, rows)) = &mut self.pending.matrix
                    && rows.len() < 3
                {
                    rows.push(**row);
                    if rows.len() == 3 {
                        self.finish_matrix();
                    }
                }
            }
            Record::Threading(Threading::Pitch(pitch)) => state.pitch = Some(*pitch),
            Record::Threading(Threading::On(pitch)) => {
                state.threading = true;
                // A number that only the post understands takes nothing from a PITCH before it.
                state.pitch = pitch.filter(|pitch| *pitch != StatedPitch::Unknown).or(state.pitch).or(*pitch);
            }
            Record::Threading(Threading::Off) => state.threading = false,
            Record::Cycle(cycle) => {
                // CYCLE/ON with words only changes some values of the cycle in force.
                let before = state.cycle.as_ref().map(|(before, _)| before.as_ref());
                let cycle_in_force = cycle.inherit_from(before);
                let own = cycle.feed.map(|_| id);
                self.cycle_feed = own.or(self.cycle_feed.filter(|_| cycle_in_force.feed.is_some()));
                state.cycle = Some((Arc::new(cycle_in_force), id));
            }
            Record::CycleOff => self.last_cycle = state.cycle.take().or(self.last_cycle.take()),
            Record::CycleOn => state.cycle = state.cycle.take().or_else(|| self.last_cycle.clone()),
            Record::Marked(mark) => state.marked = mark.class,
            Record::OperationStart(_) => self.start_operation(id),
            Record::OperationEnd => state.marked = None,
            Record::Channel(channel) => self.change_channel(*channel),
            Record::Units(units) => state.units = Some(*units),
            _ => {}
        }
    }

    /// Takes a tool by its number.
    fn call_tool(&mut self, call: &ToolCall) {
        self.state.change_tool(|tool| {
            let another = tool.number.is_some_and(|number| number != call.number);
            if another && tool.loaded && call.loads {
                tool.name = None;
                // The shape of the tool before must not be used for a tool that nothing describes.
                tool.data = tool.data.take().filter(|_| tool.shape_is_new);
            }
            tool.number = Some(call.number);
            tool.loaded |= call.loads;
            tool.shape_is_new &= !call.loads;
        });
    }

    /// Goes on with the path of another channel, where it was left. Only what the whole program shares is taken
    /// over: units, the frame, and the count of operations.
    fn change_channel(&mut self, channel: u32) {
        let (units, frame, operation) = (self.state.units, self.state.frame.clone(), self.state.operation);
        let left = std::mem::take(&mut self.state);
        // Before the first channel nothing has moved, and what was set there is for all.
        let fresh = if self.channel.is_none() { left.clone() } else { ModalState::default() };
        if let Some(before) = self.channel {
            self.channels.insert(before, left);
        }
        self.state = self.channels.remove(&channel).unwrap_or(fresh);
        self.state.units = self.state.units.or(units);
        self.state.frame = self.state.frame.take().or(frame);
        self.state.operation = operation;
        self.channel = Some(channel);
        self.last_end = None;
    }

    /// Starts an operation: counts it, and takes over the tool that an NX TOOL PATH names.
    pub(super) fn start_operation(&mut self, id: StatementId) {
        if self.operations_seen {
            self.state.operation += 1;
        }
        self.operations_seen = true;
        let statement = self.program.statement(id);
        if let Some(name) = operation::tool_name(self.program, statement) {
            // A TOOL PATH describes its tool anew. The number comes with the LOAD that follows, or is that of
            // the loaded tool.
            self.state.change_tool(|tool| {
                if tool.name.as_deref() != Some(name.as_str()) {
                    tool.data = None;
                    if tool.name.is_some() {
                        tool.number = None;
                        tool.loaded = false;
                    }
                }
                tool.name = Some(name);
            });
        }
        // In NX every TOOL PATH starts with the axis along z.
        if self.program.dialect() == crate::program::Dialect::Nx {
            self.state.axis = Vector3::z();
        }
    }

    /// Processes a frame or a shift.
    pub(super) fn process_frame(&mut self, id: StatementId, record: &FrameRecord) {
        let at = |index: usize| record.numbers.get(index).copied().unwrap_or_default();
        let three = |start: usize| Vector3::new(at(start), at(start + 1), at(start + 2));
        match record.word {
            FrameWord::Msys => {
                // MSYS prints the origin and two axes; the third one is their cross product.
                let (x, y) = (three(3), three(6));
                let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
                let frame = CoordinateFrame { statement: id, origin: three(0), axes };
                self.express_pose_in(&frame);
                self.state.frame = Some(Arc::new(frame));
            }
            FrameWord::Csys => {
                // CSYS prints three rows with the axes as columns, and the origin in the fourth column.
                let axes = Matrix3::new(at(0), at(1), at(2), at(4), at(5), at(6), at(8), at(9), at(10));
                let origin = Vector3::new(at(3), at(7), at(11));
                self.state.frame = Some(Arc::new(CoordinateFrame { statement: id, origin, axes }));
            }
            FrameWord::Trans => self.state.shift = three(0),
            FrameWord::Origin => self.state.shift = -three(0),
            FrameWord::Rotary => {}
        }
    }

    /// Expresses the tool's pose in a new frame. NX prints points in MSYS, so in a new one the tool has the
    /// same position with other coordinates.
    pub(super) fn express_pose_in(&mut self, new: &CoordinateFrame) {
        let (Some(pose), Some(old)) = (self.state.pose, self.state.frame.as_deref()) else { return };
        if (old.origin, old.axes) == (new.origin, new.axes) {
            return;
        }
        // The last direction is given in the old frame, and would be wrong in the new one.
        self.last_end = None;
        // The tool does not move. Its point p is led out of the old frame (axes O, origin o) and into the new
        // one (N, n): p' = N^-1 (o + O p - n).
        self.state.pose = new.axes.try_inverse().map(|inverse| Pose {
            point: (inverse * (old.origin + old.axes * pose.point.coords - new.origin)).into(),
            axis: normalize_axis(inverse * (old.axes * pose.axis)),
        });
    }

    /// Takes the rows of a CATIA0 matrix as the frame; fewer than three rows are a problem.
    pub(super) fn finish_matrix(&mut self) {
        let Some((statement, rows)) = self.pending.matrix.take() else { return };
        if let [[a, b, c, x], [d, e, f, y], [g, h, i, z]] = rows.as_slice() {
            let axes = Matrix3::new(*a, *b, *c, *d, *e, *f, *g, *h, *i);
            let origin = Vector3::new(*x, *y, *z);
            self.state.frame = Some(Arc::new(CoordinateFrame { statement, origin, axes }));
        } else {
            self.report_problem(statement, MotionProblemKind::BrokenFrame);
        }
    }
}

/// Returns a printed axis unchanged, unless its length differs from 1 by more than rounding.
pub(super) fn normalize_axis(axis: Vector3<f64>) -> Vector3<f64> {
    if (axis.norm_squared() - 1.0).abs() < 2e-3 { axis } else { axis.try_normalize(1e-6).unwrap_or(axis) }
}
