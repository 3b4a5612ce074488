//! This module holds the state machine that converts statements to motions.

use super::Motion;
use super::arcs::PendingArc;
use super::modal_state::{ModalState, MotionProblem, MotionProblemKind};
use crate::program::geometry::Pose;
use crate::program::record::DrillingCycle;
use crate::program::{Program, Record};
use nalgebra::{Point3, Vector3};
use std::collections::VecDeque;
use std::sync::Arc;

/// An iterator over the motions of a program.
#[derive(Debug, Clone)]
pub struct Motions<'p> {
    pub(super) program: &'p Program,
    pub(super) next: usize,
    pub(super) state: ModalState,
    pub(super) pending: PendingMotion,
    pub(super) queue: VecDeque<Motion>,
    pub(super) problems: Vec<MotionProblem>,
    pub(super) last_tangent: Option<Vector3<f64>>,
    pub(super) operations_seen: bool,
    pub(super) holes: usize,
    /// The cycle that CYCLE/ON switches on again.
    pub(super) last_cycle: Option<(Arc<DrillingCycle>, usize)>,
    /// The CYCLE statement that has the feed of the cycle in force: CYCLE/ON,FEDTO,... takes the feed over
    /// without printing it.
    pub(super) cycle_feed: Option<usize>,
}

/// The announcements of statements for the next motion.
#[derive(Debug, Clone, Default)]
pub(super) struct PendingMotion {
    /// The first statement that belongs to the next motion.
    pub(super) first: Option<usize>,
    /// The statement of a RAPID.
    pub(super) rapid: Option<usize>,
    /// The arc of a CIRCLE or MOVARC, and its statement.
    pub(super) arc: Option<(PendingArc, usize)>,
    /// The direction of an INDIRV, and its statement.
    pub(super) direction: Option<(Vector3<f64>, usize)>,
    /// The spline of a NURBS as far as it has been read.
    pub(super) spline: Option<PendingSpline>,
    /// The statement of a `$$*CATIA0`, and the rows of its matrix.
    pub(super) matrix: Option<(usize, Vec<[f64; 4]>)>,
}

/// A spline whose control points are being read.
#[derive(Debug, Clone, Default)]
pub(super) struct PendingSpline {
    pub(super) statement: usize,
    pub(super) knots: Vec<f64>,
    pub(super) controls: Vec<Point3<f64>>,
    pub(super) last: usize,
}

/// The target of a motion before its path is known.
pub(super) struct MotionTarget {
    pub(super) pose: Pose,
    pub(super) normal: Option<Vector3<f64>>,
    pub(super) statement: usize,
}

impl<'p> Motions<'p> {
    pub(super) fn new(program: &'p Program) -> Self {
        Self {
            program,
            next: 0,
            state: ModalState::default(),
            pending: PendingMotion::default(),
            queue: VecDeque::new(),
            problems: Vec::new(),
            last_tangent: None,
            operations_seen: false,
            holes: 0,
            last_cycle: None,
            cycle_feed: None,
        }
    }

    /// Returns the modal state after the statements read so far.
    pub fn state(&self) -> &ModalState {
        &self.state
    }

    /// Returns the problems found so far and forgets them.
    pub fn take_problems(&mut self) -> Vec<MotionProblem> {
        std::mem::take(&mut self.problems)
    }

    /// Reads one statement and returns its index. Motions that it ends are dropped. This is for callers who
    /// need [`Motions::state`] at every statement instead of motions.
    pub fn read_statement(&mut self) -> Option<usize> {
        let index = self.next;
        let statement = self.program.statement(index)?;
        self.next += 1;
        if statement.is_live() {
            self.process_record(index, statement.record());
        }
        self.queue.clear();
        self.problems.clear();
        Some(index)
    }

    /// Adds a problem.
    pub(super) fn report_problem(&mut self, statement: usize, kind: MotionProblemKind) {
        self.problems.push(MotionProblem { statement, kind });
    }

    /// Processes one record: moves the tool, announces something, or changes the modal state.
    pub(super) fn process_record(&mut self, index: usize, record: &Record) {
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
            Record::Goto(goto) => self.process_goto(index, goto),
            Record::Points(numbers) => self.process_points(index, numbers),
            Record::From(goto) => self.process_from(index, goto),
            Record::GoHome(Some(goto)) => {
                // There is no hole at home, whatever cycle is in force.
                let cycle = self.state.cycle.take();
                self.process_goto(index, goto);
                self.state.cycle = cycle;
            }
            Record::GoHome(None) => self.forget_pose(),
            Record::GoDelta(step) => self.process_delta(index, step),
            Record::Circle(circle) => self.announce_arc(index, PendingArc::Circle(circle.as_ref().clone())),
            Record::MoveArc(arc) => self.announce_arc(index, PendingArc::MoveArc(arc.as_ref().clone())),
            Record::StartDirection(direction) => {
                if let Some((_, before)) = self.pending.direction {
                    self.report_problem(before, MotionProblemKind::ArcWithoutEnd);
                }
                self.pending.first.get_or_insert(index);
                self.pending.direction = Some((**direction, index));
            }
            Record::DriveArc(arc) => {
                let arc = arc.as_ref().clone();
                let pose = Pose { point: arc.end, axis: self.state.axis };
                self.pending.arc = Some((PendingArc::Drive(arc), index));
                self.move_to(MotionTarget { pose, normal: None, statement: index });
            }
            Record::Nurbs => {
                self.pending.first.get_or_insert(index);
                self.pending.spline =
                    Some(PendingSpline { statement: index, last: index, ..Default::default() });
            }
            Record::Knot(knots) => {
                if let Some(spline) = &mut self.pending.spline {
                    spline.knots.extend_from_slice(knots);
                }
            }
            Record::Control(point) => match &mut self.pending.spline {
                Some(spline) => {
                    spline.controls.push(**point);
                    spline.last = index;
                }
                None => self.report_problem(index, MotionProblemKind::BrokenSpline),
            },
            Record::Rapid => {
                if let Some(before) = self.pending.rapid {
                    self.report_problem(before, MotionProblemKind::RapidWithoutMotion);
                }
                self.pending.first.get_or_insert(index);
                self.pending.rapid = Some(index);
            }
            _ => self.process_modal_record(index, record),
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
            let program = self.program;
            let Some(statement) = program.statement(self.next) else {
                if self.next == program.statements().len() {
                    self.next += 1;
                    self.finish();
                    continue;
                }
                return None;
            };
            let index = self.next;
            self.next += 1;
            if statement.is_live() {
                self.process_record(index, statement.record());
            }
        }
    }
}
