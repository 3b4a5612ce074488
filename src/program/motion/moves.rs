//! Statements that move the tool: from the announced arc, spline or point to a [`Motion`] with everything modal.

use super::arcs::PendingArc;
use super::machine::{Motions, Pending, Target};
use super::modal::unit;
use super::state::ProblemKind;
use super::{Motion, cycles};
use crate::program::class::MotionClass;
use crate::program::geometry::{Path, Pose, SAME_POINT, Spline};
use crate::program::record::{Goto, is_contact, is_poses};
use nalgebra::Vector3;
use std::sync::Arc;

impl Motions<'_> {
    pub(super) fn announce_arc(&mut self, index: usize, arc: PendingArc) {
        if let Some((_, before)) = self.pending.arc.replace((arc, index)) {
            self.problem(before, ProblemKind::ArcWithoutEnd);
        }
        self.pending.first.get_or_insert(index);
    }

    pub(super) fn goto(&mut self, index: usize, goto: &Goto) {
        let axis = goto.axis.map_or(self.state.axis, unit);
        self.move_to(Target { pose: Pose { point: goto.point, axis }, normal: None, statement: index });
    }

    pub(super) fn points(&mut self, index: usize, numbers: &[f64]) {
        let at = |index: usize| Vector3::from_iterator(numbers.iter().skip(index).take(3).copied());
        if is_contact(numbers) {
            let pose = Pose { point: at(0).into(), axis: unit(at(3)) };
            return self.move_to(Target { pose, normal: Some(at(6)), statement: index });
        }
        let with_axes = self.state.multi_axis && is_poses(numbers);
        let step = if with_axes { 6 } else { 3 };
        // RAPID is for the next record, however many points it has.
        let rapid = self.pending.rapid;
        for start in (0..numbers.len()).step_by(step) {
            self.pending.rapid = rapid;
            let axis = if with_axes { unit(at(start + 3)) } else { self.state.axis };
            let pose = Pose { point: at(start).into(), axis };
            self.move_to(Target { pose, normal: None, statement: index });
        }
    }

    pub(super) fn from(&mut self, index: usize, goto: &Goto) {
        let axis = goto.axis.map_or(self.state.axis, unit);
        let pose = Pose { point: goto.point, axis };
        self.state.axis = axis;
        self.state.pose = Some(pose);
        self.last_tangent = None;
        // The tool does not move: what RAPID or CIRCLE announced is for the motion after it.
        let announced = std::mem::take(&mut self.pending);
        let motion = self.motion(pose, pose, Path::Start, index);
        self.pending = announced;
        self.queue.push_back(motion);
    }

    pub(super) fn step(&mut self, index: usize, step: &[f64]) {
        let delta = match step {
            [x, y, z] => Vector3::new(*x, *y, *z),
            [along] => self.state.axis * *along,
            _ => Vector3::zeros(),
        };
        match self.state.pose {
            Some(pose) => {
                let to = Pose { point: pose.point + delta, axis: self.state.axis };
                self.move_to(Target { pose: to, normal: None, statement: index });
            }
            None => self.problem(index, ProblemKind::UnknownStart),
        }
    }

    /// GOHOME without a point: the machine goes where only its post knows.
    pub(super) fn forget_place(&mut self) {
        self.state.pose = None;
        self.last_tangent = None;
        self.pending = Pending { matrix: self.pending.matrix.take(), ..Pending::default() };
    }

    pub(super) fn move_to(&mut self, target: Target) {
        self.pending.first.get_or_insert(target.statement);
        self.state.axis = target.pose.axis;
        if self.state.cycle.is_some() && self.pending.rapid.is_none() && self.pending.arc.is_none() {
            return self.drill(&target);
        }
        let Some(from) = self.state.pose else {
            // The first point of a file: where the tool comes from is not told.
            if let Some((_, statement)) = self.pending.arc.take() {
                self.problem(statement, ProblemKind::UnknownStart);
            }
            return self.push(target.pose, target.pose, Path::Start, &target);
        };
        let path = match self.pending.arc.take() {
            Some((arc, statement)) => self.resolve(arc, statement, from, &target),
            None => {
                if let Some((_, statement)) = self.pending.direction {
                    self.problem(statement, ProblemKind::ArcWithoutEnd);
                }
                Path::Line
            }
        };
        self.push(from, target.pose, path, &target);
    }

    pub(super) fn resolve(&mut self, arc: PendingArc, statement: usize, from: Pose, target: &Target) -> Path {
        let direction = self.pending.direction.map(|(direction, _)| direction);
        let rule = self.program.dialect().arc_rule();
        let resolved = arc.resolve(rule, from.point, target.pose.point, direction, self.last_tangent);
        for kind in resolved.problems {
            self.problem(statement, kind);
        }
        resolved.arc.map_or(Path::Line, |arc| Path::Arc(Box::new(arc)))
    }

    pub(super) fn push(&mut self, from: Pose, to: Pose, path: Path, target: &Target) {
        let tangent = path.end_tangent(from.point, to.point);
        let mut motion = self.motion(from, to, path, target.statement);
        motion.normal = target.normal;
        self.last_tangent = if motion.rapid { None } else { tangent.or(self.last_tangent) };
        self.state.pose = Some(to);
        self.queue.push_back(motion);
    }

    pub(super) fn drill(&mut self, target: &Target) {
        let Some((cycle, _)) = self.state.cycle.clone() else { return };
        let hole = self.holes;
        self.holes += 1;
        let first = self.pending.first.take().unwrap_or(target.statement);
        let nx = self.program.dialect() == crate::program::Dialect::Nx;
        for leg in cycles::legs(&cycle, nx, self.state.pose, target.pose) {
            self.pending.first = Some(first);
            let mut motion = self.motion(leg.from, leg.to, leg.path, target.statement);
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

    pub(super) fn end_spline(&mut self) {
        let Some(spline) = self.pending.spline.take() else { return };
        let (Some(&end), Some(from)) = (spline.controls.last(), self.state.pose) else {
            let unknown = spline.controls.is_empty();
            let kind = if unknown { ProblemKind::BrokenSpline } else { ProblemKind::UnknownStart };
            return self.problem(spline.statement, kind);
        };
        let path = match Spline::clamped(from.point, &spline.knots, &spline.controls) {
            Some(curve) => Path::Spline(Box::new(curve)),
            None => {
                self.problem(spline.statement, ProblemKind::BrokenSpline);
                Path::Line
            }
        };
        let pose = Pose { point: end, axis: self.state.axis };
        self.push(from, pose, path, &Target { pose, normal: None, statement: spline.last });
    }

    /// The motion that ends with `statement`, with everything modal; what was pending is used up.
    pub(super) fn motion(&mut self, from: Pose, to: Pose, path: Path, statement: usize) -> Motion {
        let first = self.pending.first.take().unwrap_or(statement);
        let rapid = self.pending.rapid.take().is_some();
        self.pending.direction = None;
        let (class, class_is_told) = self.class(rapid, &from, &to, &path);
        let state = &self.state;
        Motion {
            statements: first..statement + 1,
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

    /// The marked class; without a mark: rapids are rapid, a straight feed move down the tool axis engages, one up it
    /// retracts, everything else cuts. A rapid is never a cut and a feed move never rapid, whatever the
    /// mark says (NX colour 37 holds both).
    pub(super) fn class(&self, rapid: bool, from: &Pose, to: &Pose, path: &Path) -> (MotionClass, bool) {
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
        let straight = matches!(path, Path::Line) && travel.norm() > SAME_POINT;
        let class = if straight && along.abs() > travel.norm() * 0.999 {
            if along < 0.0 { MotionClass::Engage } else { MotionClass::Retract }
        } else {
            MotionClass::Cut
        };
        (class, false)
    }
}
