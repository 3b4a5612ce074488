//! This module processes statements that move the tool. It makes a [`Motion`] with the modal state from the
//! announced arc, spline or point.

use super::arcs::PendingArc;
use super::modal_records::normalize_axis;
use super::modal_state::MotionProblemKind;
use super::state_machine::{MotionTarget, Motions, PendingMotion};
use super::{Motion, drilling_cycles};
use crate::program::geometry::{MotionPath, Pose, SAME_POINT, Spline};
use crate::program::motion_class::MotionClass;
use crate::program::record::{Goto, has_contact_normal, has_tool_axes};
use crate::program::{StatementId, StatementRange};
use nalgebra::Vector3;
use std::sync::Arc;

impl Motions<'_> {
    /// Keeps an arc until its end point follows.
    pub(super) fn announce_arc(&mut self, id: StatementId, arc: PendingArc) {
        if let Some((_, before)) = self.pending.arc.replace((arc, id)) {
            self.report_problem(before, MotionProblemKind::ArcWithoutEnd);
        }
        self.pending.first.get_or_insert(id);
    }

    /// Moves to the point of a GOTO.
    pub(super) fn process_goto(&mut self, id: StatementId, goto: &Goto) {
        let axis = goto.axis.map_or(self.state.axis, normalize_axis);
        self.move_to(MotionTarget { pose: Pose { point: goto.point, axis }, normal: None, statement: id });
    }

    /// Moves to the points of a long GOTO or of a line of numbers: one point with axis and normal, points
    /// with axes, or points alone.
    pub(super) fn process_points(&mut self, id: StatementId, numbers: &[f64]) {
        let at = |index: usize| Vector3::from_iterator(numbers.iter().skip(index).take(3).copied());
        if has_contact_normal(numbers) {
            let pose = Pose { point: at(0).into(), axis: normalize_axis(at(3)) };
            return self.move_to(MotionTarget { pose, normal: Some(at(6)), statement: id });
        }
        let with_axes = self.state.multi_axis && has_tool_axes(numbers);
        let step = if with_axes { 6 } else { 3 };
        // RAPID holds for the next record, however many points it has.
        let rapid = self.pending.rapid;
        for start in (0..numbers.len()).step_by(step) {
            self.pending.rapid = rapid;
            let axis = if with_axes { normalize_axis(at(start + 3)) } else { self.state.axis };
            let pose = Pose { point: at(start).into(), axis };
            self.move_to(MotionTarget { pose, normal: None, statement: id });
        }
    }

    /// Sets the tool's pose at a FROM.
    pub(super) fn process_from(&mut self, id: StatementId, goto: &Goto) {
        let axis = goto.axis.map_or(self.state.axis, normalize_axis);
        let pose = Pose { point: goto.point, axis };
        self.state.axis = axis;
        self.state.pose = Some(pose);
        self.last_tangent = None;
        // The tool does not move, so an announced RAPID or CIRCLE is for the motion after this one.
        let announced = std::mem::take(&mut self.pending);
        let motion = self.build_motion(pose, pose, MotionPath::Start, id);
        self.pending = announced;
        self.queue.push_back(motion);
    }

    /// Moves by a step (GODLTA); a single number is a step along the tool axis.
    pub(super) fn process_delta(&mut self, id: StatementId, step: &[f64]) {
        let delta = match step {
            [x, y, z, ..] => Vector3::new(*x, *y, *z),
            [along] => self.state.axis * *along,
            _ => Vector3::zeros(),
        };
        match self.state.pose {
            Some(pose) => {
                let axis = match step {
                    [_, _, _, i, j, k] => normalize_axis(Vector3::new(*i, *j, *k)),
                    _ => self.state.axis,
                };
                let to = Pose { point: pose.point + delta, axis };
                self.move_to(MotionTarget { pose: to, normal: None, statement: id });
            }
            None => self.report_problem(id, MotionProblemKind::UnknownStart),
        }
    }

    /// Forgets the pose at a GOHOME without a point: only the post knows where the machine goes.
    pub(super) fn forget_pose(&mut self) {
        self.state.pose = None;
        self.last_tangent = None;
        self.pending = PendingMotion { matrix: self.pending.matrix.take(), ..PendingMotion::default() };
    }

    /// Moves to a target: as a hole if a cycle is in force, along the announced arc, or straight.
    pub(super) fn move_to(&mut self, target: MotionTarget) {
        self.pending.first.get_or_insert(target.statement);
        self.state.axis = target.pose.axis;
        if self.state.cycle.is_some() && self.pending.rapid.is_none() && self.pending.arc.is_none() {
            return self.drill_hole(&target);
        }
        let Some(from) = self.state.pose else {
            // At the first point of a file it is not known where the tool comes from.
            if let Some((_, statement)) = self.pending.arc.take() {
                self.report_problem(statement, MotionProblemKind::UnknownStart);
            }
            return self.push_motion(target.pose, target.pose, MotionPath::Start, &target);
        };
        let path = match self.pending.arc.take() {
            Some((arc, statement)) => self.resolve_arc_path(arc, statement, from, &target),
            None => {
                if let Some((_, statement)) = self.pending.direction {
                    self.report_problem(statement, MotionProblemKind::ArcWithoutEnd);
                }
                MotionPath::Line
            }
        };
        self.push_motion(from, target.pose, path, &target);
    }

    /// Resolves an announced arc and reports its problems. An arc that cannot be resolved becomes a line.
    pub(super) fn resolve_arc_path(
        &mut self,
        arc: PendingArc,
        statement: StatementId,
        from: Pose,
        target: &MotionTarget,
    ) -> MotionPath {
        let direction = self.pending.direction.map(|(direction, _)| direction);
        let rule = self.program.dialect().arc_rule();
        let resolved = arc.resolve(rule, from.point, target.pose.point, direction, self.last_tangent);
        for kind in resolved.problems {
            self.report_problem(statement, kind);
        }
        resolved.arc.map_or(MotionPath::Line, |arc| MotionPath::Arc(Box::new(arc)))
    }

    /// Adds a motion and updates the pose. The tangent only continues through feed motions.
    pub(super) fn push_motion(&mut self, from: Pose, to: Pose, path: MotionPath, target: &MotionTarget) {
        let tangent = path.end_tangent(from.point, to.point);
        let mut motion = self.build_motion(from, to, path, target.statement);
        motion.normal = target.normal;
        // Many machines do not go straight at rapid, so a rapid tells nothing about the direction in which an
        // arc begins.
        self.last_tangent = if motion.rapid { None } else { tangent.or(self.last_tangent) };
        self.state.pose = Some(to);
        self.queue.push_back(motion);
    }

    /// Adds the motions of one hole.
    pub(super) fn drill_hole(&mut self, target: &MotionTarget) {
        let Some((cycle, _)) = self.state.cycle.clone() else { return };
        let hole = self.holes;
        self.holes += 1;
        let first = self.pending.first.take().unwrap_or(target.statement);
        let nx = self.program.dialect() == crate::program::Dialect::Nx;
        for leg in drilling_cycles::plan_hole_moves(&cycle, nx, self.state.pose, target.pose) {
            self.pending.first = Some(first);
            let mut motion = self.build_motion(leg.from, leg.to, leg.path, target.statement);
            motion.rapid = leg.rapid;
            motion.class = MotionClass::Drill;
            if let Some(feed) = cycle.feed {
                motion.feed = Some(feed);
                motion.feed_from = self.cycle_feed;
            }
            motion.hole = Some((hole, Arc::clone(&cycle)));
            self.state.pose = Some(motion.to);
            self.queue.push_back(motion);
        }
        self.last_tangent = None;
    }

    /// Adds the motion of a spline when its last control point has been read.
    pub(super) fn finish_spline(&mut self) {
        let Some(spline) = self.pending.spline.take() else { return };
        let (Some(&end), Some(from)) = (spline.controls.last(), self.state.pose) else {
            let unknown = spline.controls.is_empty();
            let kind =
                if unknown { MotionProblemKind::BrokenSpline } else { MotionProblemKind::UnknownStart };
            return self.report_problem(spline.statement, kind);
        };
        let path = match Spline::from_knots(from.point, &spline.knots, &spline.controls) {
            Some(curve) => MotionPath::Spline(Box::new(curve)),
            None => {
                self.report_problem(spline.statement, MotionProblemKind::BrokenSpline);
                MotionPath::Line
            }
        };
        let pose = Pose { point: end, axis: self.state.axis };
        self.push_motion(from, pose, path, &MotionTarget { pose, normal: None, statement: spline.last });
    }

    /// Builds the motion that ends with `statement`, with the modal state. The pending announcements are used
    /// up.
    pub(super) fn build_motion(
        &mut self,
        from: Pose,
        to: Pose,
        path: MotionPath,
        statement: StatementId,
    ) -> Motion {
        let first = self.pending.first.take().unwrap_or(statement);
        let rapid = self.pending.rapid.take().is_some();
        self.pending.direction = None;
        let (class, class_is_told) = self.classify_motion(rapid, &from, &to, &path);
        let state = &self.state;
        Motion {
            statements: StatementRange::new(first, statement),
            from,
            to,
            path,
            normal: None,
            rapid,
            feed: state.feed.map(|(feed, _)| feed),
            feed_from: state.feed.map(|(_, statement)| statement),
            spindle: state.spindle.clone(),
            tool: state.tool.clone(),
            frame: state.frame.clone(),
            class,
            class_is_told,
            operation: state.operation,
            hole: None,
        }
    }

    /// Returns the class that the file marked. Without a mark, rapids are rapid, a straight feed motion down
    /// the tool axis engages, one up the axis retracts, and everything else cuts. A rapid is never a cut and
    /// a feed motion is never a rapid, whatever the mark says (NX colour 37 has both).
    pub(super) fn classify_motion(
        &self,
        rapid: bool,
        from: &Pose,
        to: &Pose,
        path: &MotionPath,
    ) -> (MotionClass, bool) {
        let told = self.state.marked.filter(|class| match class {
            MotionClass::Cut | MotionClass::Engage => !rapid,
            MotionClass::Rapid => rapid,
            _ => true,
        });
        if let Some(class) = told {
            return (class, true);
        }
        if rapid {
            return (MotionClass::Rapid, false);
        }
        let travel = to.point - from.point;
        let along = travel.dot(&to.axis);
        let straight = matches!(path, MotionPath::Line) && travel.norm() > SAME_POINT;
        // 0.999 is the cosine of 2.6 degrees: a motion that is so close to the tool axis goes straight in or
        // out.
        let class = if straight && along.abs() > travel.norm() * 0.999 {
            if along < 0.0 { MotionClass::Engage } else { MotionClass::Retract }
        } else {
            MotionClass::Cut
        };
        (class, false)
    }
}
