//! This module holds the state machine that converts statements to motions.

use super::Motion;
use super::arcs::PendingArc;
use super::modal_shares::ModalShares;
use super::modal_state::{ModalState, MotionProblem, MotionProblemKind};
use crate::program::TurningPlane;
use crate::program::geometry::{PathEnd, Pose};
use crate::program::record::DrillingCycle;
use crate::program::turning::UndescribedTool;
use crate::program::{LengthUnit, Program, Record, StatementId};
use nalgebra::{Point3, Vector3};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// An iterator over the motions of a program.
#[derive(Debug, Clone)]
pub struct Motions<'p> {
    pub(super) program: &'p Program,
    pub(super) next: usize,
    pub(super) state: ModalState,
    pub(super) pending: PendingMotion,
    pub(super) queue: VecDeque<Motion>,
    /// What a motion that was given back shared with the modal state.
    pub(super) spent: ModalShares,
    pub(super) problems: Vec<MotionProblem>,
    /// The end of the last feed motion, until a rapid comes.
    pub(super) last_end: Option<PathEnd>,
    pub(super) operations_seen: bool,
    pub(super) holes: usize,
    /// The file's unit of lengths, once it was asked for.
    pub(super) length_unit: Option<LengthUnit>,
    /// The plane in which a lathe's tool moves, once it was asked for.
    pub(super) turning_plane: Option<Option<TurningPlane>>,
    /// What tools are that nothing describes, once it was asked for.
    pub(super) undescribed: Option<UndescribedTool>,
    /// The channel in force, and the states of the others.
    pub(super) channel: Option<u32>,
    pub(super) channels: BTreeMap<u32, ModalState>,
    /// The cycle that CYCLE/ON switches on again.
    pub(super) last_cycle: Option<(Arc<DrillingCycle>, StatementId)>,
    /// The CYCLE statement that has the feed of the cycle in force: CYCLE/ON,FEDTO,... takes the feed over
    /// without printing it.
    pub(super) cycle_feed: Option<StatementId>,
}

/// The announcements of statements for the next motion.
#[derive(Debug, Clone, Default)]
pub(super) struct PendingMotion {
    /// The first statement that belongs to the next motion.
    pub(super) first: Option<StatementId>,
    /// The statement of a RAPID.
    pub(super) rapid: Option<StatementId>,
    /// The arc of a CIRCLE or MOVARC, and its statement.
    pub(super) arc: Option<(PendingArc, StatementId)>,
    /// Points of a CIRCLE that were read before its last one, with their statements.
    pub(super) arc_points: Vec<(Pose, StatementId)>,
    /// Points on the arc between its start and its end, while it is resolved.
    pub(super) arc_through: Vec<Point3<f64>>,
    /// The direction of an INDIRV, and its statement.
    pub(super) direction: Option<(Vector3<f64>, StatementId)>,
    /// The spline of a NURBS as far as it has been read.
    pub(super) spline: Option<PendingSpline>,
    /// The statement of a `$$*CATIA0`, and the rows of its matrix.
    pub(super) matrix: Option<(StatementId, Vec<[f64; 4]>)>,
}

/// A spline whose control points are being read.
#[derive(Debug, Clone)]
pub(super) struct PendingSpline {
    pub(super) statement: StatementId,
    pub(super) knots: Vec<f64>,
    pub(super) controls: Vec<Point3<f64>>,
    pub(super) last: StatementId,
}

/// The target of a motion before its path is known.
pub(super) struct MotionTarget {
    pub(super) pose: Pose,
    pub(super) normal: Option<Vector3<f64>>,
    pub(super) statement: StatementId,
}

impl<'p> Motions<'p> {
    pub(super) fn new(program: &'p Program) -> Self {
        Self {
            program,
            next: 0,
            state: ModalState::default(),
            pending: PendingMotion::default(),
            queue: VecDeque::new(),
            spent: ModalShares::default(),
            problems: Vec::new(),
            last_end: None,
            operations_seen: false,
            holes: 0,
            length_unit: None,
            turning_plane: None,
            undescribed: None,
            channel: None,
            channels: BTreeMap::new(),
            last_cycle: None,
            cycle_feed: None,
        }
    }

    /// Returns the modal state after the statements read so far.
    pub fn state(&self) -> &ModalState {
        &self.state
    }

    /// Takes back a motion that nobody needs any more: what it shares with the modal state goes to the next
    /// motion, which is faster than counting who shares it.
    pub fn give_back(&mut self, motion: Motion) {
        self.spent = ModalShares::from_motion(motion);
    }

    /// Shows all motions in their order to `see`. It is the fastest way through a program.
    pub fn for_each_motion(mut self, mut see: impl FnMut(&Motion)) {
        while let Some(motion) = self.next() {
            see(&motion);
            self.give_back(motion);
        }
    }

    /// Returns the problems found so far and forgets them.
    pub fn take_problems(&mut self) -> Vec<MotionProblem> {
        std::mem::take(&mut self.problems)
    }

    /// Reads one statement and returns its id. Motions that it ends are dropped. This is for callers who need
    /// [`Motions::state`] at every statement instead of motions.
    pub fn read_statement(&mut self) -> Option<StatementId> {
        let id = self.process_next_statement()?;
        self.queue.clear();
        self.problems.clear();
        Some(id)
    }

    fn process_next_statement(&mut self) -> Option<StatementId> {
        let statement = self.program.statements().get(self.next)?;
        let id = StatementId::new(self.next, self.program.stamp);
        self.next += 1;
        if statement.is_live() {
            self.process_record(id, statement.record());
        }
        Some(id)
    }

    /// Adds a problem.
    pub(super) fn report_problem(&mut self, statement: StatementId, kind: MotionProblemKind) {
        self.problems.push(MotionProblem { statement, kind });
    }

    /// Processes one record: moves the tool, announces something, or changes the modal state.
    pub(super) fn process_record(&mut self, id: StatementId, record: &Record) {
        // A spline or matrix ends at the first record that cannot belong to it.
        if self.pending.spline.is_some()
            && !matches!(record, Record::Knot(_) | Record::Control(_) | Record::Comment | Record::Blank)
        {
            self.finish_spline();
        }
        if let Some((_, rows)) = &self.pending.matrix
            && !matches!(record, Record::Comment | Record::MatrixRow(_))
            && rows.len() < 3
        {
            self.finish_matrix();
        }
        match record {
            Record::Goto(goto) => self.process_goto(id, goto),
            Record::Points(numbers) => self.process_points(id, numbers),
            Record::From(goto) => self.process_from(id, goto),
            Record::GoHome(Some(goto)) => {
                // There is no hole at home, whatever cycle is in force.
                let cycle = self.state.cycle.take();
                self.process_goto(id, goto);
                self.state.cycle = cycle;
            }
            Record::GoHome(None) => self.forget_pose(),
            Record::GoDelta(step) => self.process_delta(id, step),
            Record::Circle(circle) => self.announce_arc(id, PendingArc::Circle(circle.as_ref().clone())),
            Record::MoveArc(arc) => self.announce_arc(id, PendingArc::MoveArc(arc.as_ref().clone())),
            Record::StartDirection(direction) => {
                if let Some((_, before)) = self.pending.direction {
                    self.report_problem(before, MotionProblemKind::ArcWithoutEnd);
                }
                self.pending.first.get_or_insert(id);
                self.pending.direction = Some((**direction, id));
            }
            Record::DriveArc(arc) => {
                let arc = arc.as_ref().clone();
                let pose = Pose { point: arc.end, axis: self.state.axis };
                self.pending.arc = Some((PendingArc::Drive(arc), id));
                self.move_to(MotionTarget { pose, normal: None, statement: id });
            }
            Record::AxialArc(arc) => {
                let arc = arc.as_ref().clone();
                let pose = Pose { point: arc.end, axis: self.state.axis };
                self.pending.arc = Some((PendingArc::Axial(arc), id));
                self.move_to(MotionTarget { pose, normal: None, statement: id });
            }
            Record::Nurbs => {
                self.pending.first.get_or_insert(id);
                self.pending.spline =
                    Some(PendingSpline { statement: id, last: id, knots: Vec::new(), controls: Vec::new() });
            }
            Record::Knot(knots) => {
                if let Some(spline) = &mut self.pending.spline {
                    spline.knots.extend_from_slice(knots);
                }
            }
            Record::Control(point) => match &mut self.pending.spline {
                Some(spline) => {
                    spline.controls.push(**point);
                    spline.last = id;
                }
                None => self.report_problem(id, MotionProblemKind::BrokenSpline),
            },
            Record::Rapid => {
                if let Some(before) = self.pending.rapid {
                    self.report_problem(before, MotionProblemKind::RapidWithoutMotion);
                }
                self.pending.first.get_or_insert(id);
                self.pending.rapid = Some(id);
            }
            _ => self.process_modal_record(id, record),
        }
    }

    /// Finishes what is pending at the end of the program, and reports announcements without a motion.
    pub(super) fn finish(&mut self) {
        self.finish_spline();
        self.finish_pending_matrix();
        if let Some(rapid) = self.pending.rapid.take() {
            self.report_problem(rapid, MotionProblemKind::RapidWithoutMotion);
        }
        if let Some((_, arc)) = self.pending.arc.take() {
            self.report_problem(arc, MotionProblemKind::ArcWithoutEnd);
        }
        if let Some((_, direction)) = self.pending.direction.take() {
            self.report_problem(direction, MotionProblemKind::ArcWithoutEnd);
        }
    }

    fn finish_pending_matrix(&mut self) {
        if self.pending.matrix.is_some() {
            self.finish_matrix();
        }
    }
}

impl Iterator for Motions<'_> {
    type Item = Motion;

    fn next(&mut self) -> Option<Motion> {
        loop {
            if let Some(motion) = self.queue.pop_front() {
                return Some(motion);
            }
            if self.process_next_statement().is_some() {
                continue;
            }
            if self.next > self.program.statements().len() {
                return None;
            }
            self.next += 1;
            self.finish();
        }
    }
}
