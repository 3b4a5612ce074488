//! This module processes statements that move the tool. It makes a [`Motion`] with the modal state from the
//! announced arc, spline or point.

use super::arcs::PendingArc;
use super::modal_records::normalize_axis;
use super::modal_state::MotionProblemKind;
use super::state_machine::{MotionTarget, Motions, PendingMotion};
use super::{Motion, drilling_cycles};
use crate::program::geometry::{CircularArc, MotionPath, PathEnd, Pose, SAME_POINT, Spline};
use crate::program::motion_class::MotionClass;
use crate::program::record::{Goto, StatedPitch, has_contact_normal, has_tool_axes};
use crate::program::{Dialect, Record, StatementId, StatementRange};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// How far a point may be from a circle that it lies on, in the file's unit: its decimals and those of the centre.
const POINT_ON_ARC: f64 = 2e-3;

/// How far a point may be from its circle to be a bad point of the arc and no other point, in mm.
const NEAR_ARC_MM: f64 = 1.0;

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
        let pose = Pose { point: goto.point, axis };
        if self.collects_arc_points(id, 1) {
            return self.collect_arc_points(id, &[pose]);
        }
        self.move_to(MotionTarget { pose, normal: None, statement: id });
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
        let axis = |start| if with_axes { normalize_axis(at(start + 3)) } else { self.state.axis };
        let pose = |start| Pose { point: at(start).into(), axis: axis(start) };
        let poses: Vec<Pose> = (0..numbers.len()).step_by(step).map(pose).collect();
        if self.collects_arc_points(id, poses.len()) {
            return self.collect_arc_points(id, &poses);
        }
        // RAPID holds for the next record, however many points it has.
        let rapid = self.pending.rapid;
        for pose in poses {
            self.pending.rapid = rapid;
            self.move_to(MotionTarget { pose, normal: None, statement: id });
        }
    }

    /// Returns whether the points of a statement belong to an announced arc that has several: Creo writes points
    /// on the arc before its end, in lines of bare numbers.
    fn collects_arc_points(&self, id: StatementId, points: usize) -> bool {
        let takes = self.pending.arc.as_ref().is_some_and(|(arc, _)| arc.takes_points());
        takes && (points > 1 || !self.pending.arc_points.is_empty() || self.has_more_points(id))
    }

    /// Returns whether a line of bare numbers follows a statement.
    fn has_more_points(&self, id: StatementId) -> bool {
        let Some(next) = self.program.next_live_statement(id) else { return false };
        let next = self.program.statement(next);
        // Few statements hold points, and a look at a text takes longer than one at a record.
        if !matches!(next.record(), Record::Points(_)) {
            return false;
        }
        let text = self.program.statement_text(next).trim_ascii_start();
        text.first().is_some_and(|first| first.is_ascii_digit() || b".-+".contains(first))
    }

    /// Keeps points of an arc; with the last one the tool moves along the arc through all of them. Points that lie
    /// elsewhere are points after the arc, as in dialects where only the first one belongs to it.
    fn collect_arc_points(&mut self, id: StatementId, poses: &[Pose]) {
        self.pending.arc_points.extend(poses.iter().map(|pose| (*pose, id)));
        if self.has_more_points(id) {
            return;
        }
        let points = std::mem::take(&mut self.pending.arc_points);
        let on_arc = self.lie_on_arc(&points);
        let rapid = self.pending.rapid;
        let (through, ends) = points.split_at(if on_arc { points.len().saturating_sub(1) } else { 0 });
        self.pending.arc_through = through.iter().map(|(pose, _)| pose.point).collect();
        for (pose, statement) in ends {
            self.pending.rapid = rapid;
            self.move_to(MotionTarget { pose: *pose, normal: None, statement: *statement });
        }
        self.pending.arc_through.clear();
    }

    /// Returns whether points lie on the announced arc. Creo puts all of them on it, so there points that are nearly on it
    /// are so, too, and are reported.
    fn lie_on_arc(&mut self, points: &[(Pose, StatementId)]) -> bool {
        let (Some((arc, statement)), Some(from)) = (&self.pending.arc, self.state.pose) else { return false };
        let statement = *statement;
        let mut farthest: f64 = 0.0;
        let mut exact = true;
        for (pose, _) in points {
            let Some(off) = arc.distance_of(from.point, pose.point) else { return false };
            exact &= off < POINT_ON_ARC * (1.0 + pose.point.coords.amax() * 1e-4);
            farthest = farthest.max(off);
        }
        let all_are = matches!(self.program.dialect(), Dialect::Creo | Dialect::CreoGpost);
        if exact || !all_are {
            return exact;
        }
        self.report_problem(statement, MotionProblemKind::ArcPointsOffCircle(farthest));
        farthest * self.file_length_unit().mm_per_unit() <= NEAR_ARC_MM
    }

    /// Sets the tool's pose at a FROM.
    pub(super) fn process_from(&mut self, id: StatementId, goto: &Goto) {
        let axis = goto.axis.map_or(self.state.axis, normalize_axis);
        let pose = Pose { point: goto.point, axis };
        self.state.axis = axis;
        self.state.pose = Some(pose);
        self.last_end = None;
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
        self.last_end = None;
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
        let tells_turns = arc.tells_turns();
        let rule = self.program.dialect().arc_rule();
        let before = || self.last_end.map(PathEnd::tangent);
        let resolved = arc.resolve(rule, from.point, target.pose.point, direction, before);
        for kind in resolved.problems {
            self.report_problem(statement, kind);
        }
        let mut resolved_arc = resolved.arc;
        if let Some(arc) = resolved_arc.as_mut().filter(|_| !tells_turns) {
            self.open_short_arc(arc, target);
        }
        if let Some(arc) = resolved_arc.as_mut().filter(|_| !self.pending.arc_through.is_empty()) {
            // The points between tell how far the arc turns, also beyond a full turn.
            let stations = self.pending.arc_through.iter().copied().chain([target.pose.point]);
            let mut last = from.point;
            let parts: Vec<f64> = stations
                .map(|next| {
                    let part = CircularArc::from_endpoints(last, next, arc.center, arc.axis, 0).sweep;
                    last = next;
                    part
                })
                .collect();
            let sweep: f64 = parts.iter().sum();
            // Points in order are less than half a turn apart where an arc has several turns; one that is behind the last
            // would take nearly another turn.
            if sweep > TAU + 1e-3 && parts.iter().any(|part| *part > PI) {
                self.report_problem(statement, MotionProblemKind::ArcPointsOutOfOrder);
            } else {
                arc.sweep = sweep;
            }
        }
        resolved_arc.map_or(MotionPath::Line, |arc| MotionPath::Arc(Box::new(arc)))
    }

    /// Makes a short arc of a full turn whose ends are apart by more than the decimals of a file in inches: the same
    /// distance would open it in millimetres.
    fn open_short_arc(&mut self, arc: &mut CircularArc, target: &MotionTarget) {
        let Some((gap, angle)) = arc.closing_gap(target.pose.point) else { return };
        if gap > 0.0 && angle > 0.0 && gap * self.file_length_unit().mm_per_unit() > SAME_POINT {
            arc.sweep += angle - TAU;
        }
    }

    /// Adds a motion and updates the pose. The tangent only continues through feed motions.
    pub(super) fn push_motion(&mut self, from: Pose, to: Pose, path: MotionPath, target: &MotionTarget) {
        let end = path.end_direction(from.point, to.point);
        let mut motion = self.build_motion(from, to, path, target.statement);
        motion.normal = target.normal;
        // Many machines do not go straight at rapid, so a rapid tells nothing about the direction in which an
        // arc begins.
        self.last_end = if motion.rapid { None } else { end.or(self.last_end) };
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
            motion.cuts_thread = cycle.cuts_thread && !leg.rapid;
            if let Some(feed) = cycle.feed {
                motion.feed = Some(feed);
                motion.feed_from = self.cycle_feed;
            } else if let Some(pitch) = cycle.pitch.filter(|_| cycle.cuts_thread) {
                motion.feed = pitch.to_feed();
                motion.feed_from = None;
            }
            motion.hole = Some((hole, Arc::clone(&cycle)));
            self.state.pose = Some(motion.to);
            self.queue.push_back(motion);
        }
        self.last_end = None;
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
        let (class, class_is_stated) = self.classify_motion(rapid, &from, &to, &path);
        let state = &self.state;
        // A pitch that is stated, but not understood, leaves the feed of a thread open.
        let thread = state.pitch.filter(|_| state.threading && !rapid);
        let surface_rpm = self.find_surface_speed(&from, &to, &path);
        let state = &self.state;
        let shares = self.spent.share_state(state);
        Motion {
            statements: StatementRange::new(first, statement),
            from,
            to,
            path,
            normal: None,
            rapid,
            feed: thread.map_or(state.feed.map(|(feed, _)| feed), StatedPitch::to_feed),
            feed_from: state.feed.map(|(_, statement)| statement).filter(|_| thread.is_none()),
            cuts_thread: state.threading && !rapid,
            spindle: shares.spindle,
            surface_rpm,
            tool: shares.tool,
            frame: shares.frame,
            class,
            class_is_stated,
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
