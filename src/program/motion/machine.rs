//! The state machine that turns statements into motions.

use super::arcs::PendingArc;
use super::state::{Frame, Problem, ProblemKind, State};
use super::{Motion, cycles};
use crate::program::class::MotionClass;
use crate::program::geometry::{Path, Pose, SAME_POINT, Spline};
use crate::program::record::{Cycle, FrameRecord, FrameWord, Goto, is_contact, is_poses};
use crate::program::{Program, Record, operation};
use nalgebra::{Matrix3, Point3, Vector3};
use std::collections::VecDeque;
use std::sync::Arc;

/// Iterator over the motions of a program.
#[derive(Debug, Clone)]
pub struct Motions<'p> {
    program: &'p Program,
    next: usize,
    state: State,
    pending: Pending,
    queue: VecDeque<Motion>,
    problems: Vec<Problem>,
    last_tangent: Option<Vector3<f64>>,
    operations_seen: bool,
    holes: usize,
    /// The cycle that CYCLE/ON switches on again.
    last_cycle: Option<(Arc<Cycle>, usize)>,
    /// The CYCLE that holds the feed of the cycle in force: CYCLE/ON,FEDTO,... takes it over without printing it.
    cycle_feed: Option<usize>,
}

/// What statements have announced for the next motion.
#[derive(Debug, Clone, Default)]
pub(super) struct Pending {
    /// The first statement that belongs to the next motion.
    pub(super) first: Option<usize>,
    /// RAPID.
    pub(super) rapid: Option<usize>,
    /// CIRCLE, MOVARC.
    pub(super) arc: Option<(PendingArc, usize)>,
    /// INDIRV.
    pub(super) direction: Option<(Vector3<f64>, usize)>,
    /// NURBS with what has come of it.
    pub(super) spline: Option<PendingSpline>,
    /// `$$*CATIA0` and its rows.
    pub(super) matrix: Option<(usize, Vec<[f64; 4]>)>,
}

#[derive(Debug, Clone, Default)]
pub(super) struct PendingSpline {
    pub(super) statement: usize,
    pub(super) knots: Vec<f64>,
    pub(super) controls: Vec<Point3<f64>>,
    pub(super) last: usize,
}

/// Where a motion goes, before it is known how.
pub(super) struct Target {
    pub(super) pose: Pose,
    pub(super) normal: Option<Vector3<f64>>,
    pub(super) statement: usize,
}

impl<'p> Motions<'p> {
    pub(super) fn new(program: &'p Program) -> Self {
        Self {
            program,
            next: 0,
            state: State::default(),
            pending: Pending::default(),
            queue: VecDeque::new(),
            problems: Vec::new(),
            last_tangent: None,
            operations_seen: false,
            holes: 0,
            last_cycle: None,
            cycle_feed: None,
        }
    }

    /// The modal state after the statements read so far.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Problems met so far; taken once.
    pub fn take_problems(&mut self) -> Vec<Problem> {
        std::mem::take(&mut self.problems)
    }

    /// Reads one statement and gives its index; motions that it ends are left out. For who asks [`Motions::state`] at every
    /// statement instead of for motions.
    pub fn read_statement(&mut self) -> Option<usize> {
        let index = self.next;
        let statement = self.program.statement(index)?;
        self.next += 1;
        if statement.is_live() {
            self.read(index, statement.record());
        }
        self.queue.clear();
        self.problems.clear();
        Some(index)
    }

    fn problem(&mut self, statement: usize, kind: ProblemKind) {
        self.problems.push(Problem { statement, kind });
    }

    fn read(&mut self, index: usize, record: &Record) {
        if self.pending.spline.is_some()
            && !matches!(record, Record::Knot(_) | Record::Control(_) | Record::Comment)
        {
            self.end_spline();
        }
        if let Some((_, rows)) = &self.pending.matrix
            && !matches!(record, Record::Comment | Record::MatrixRow(_))
            && rows.len() < 3
        {
            self.end_matrix();
        }
        match record {
            Record::Goto(goto) => self.goto(index, goto),
            Record::Points(numbers) => self.points(index, numbers),
            Record::From(goto) => self.from(index, goto),
            Record::GoHome(Some(goto)) => {
                // Whatever cycle is in force, there is no hole at home.
                let cycle = self.state.cycle.take();
                self.goto(index, goto);
                self.state.cycle = cycle;
            }
            Record::GoHome(None) => self.forget_place(),
            Record::GoDelta(step) => self.step(index, step),
            Record::Circle(circle) => self.announce_arc(index, PendingArc::Circle(circle.as_ref().clone())),
            Record::MoveArc(arc) => self.announce_arc(index, PendingArc::MoveArc(arc.as_ref().clone())),
            Record::StartDirection(direction) => {
                if let Some((_, before)) = self.pending.direction {
                    self.problem(before, ProblemKind::ArcWithoutEnd);
                }
                self.pending.first.get_or_insert(index);
                self.pending.direction = Some((**direction, index));
            }
            Record::DriveArc(arc) => {
                let arc = arc.as_ref().clone();
                let pose = Pose { point: arc.end, axis: self.state.axis };
                self.pending.arc = Some((PendingArc::Drive(arc), index));
                self.move_to(Target { pose, normal: None, statement: index });
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
                None => self.problem(index, ProblemKind::BrokenSpline),
            },
            Record::Rapid => {
                if let Some(before) = self.pending.rapid {
                    self.problem(before, ProblemKind::RapidWithoutMotion);
                }
                self.pending.first.get_or_insert(index);
                self.pending.rapid = Some(index);
            }
            _ => self.modal(index, record),
        }
    }

    fn modal(&mut self, index: usize, record: &Record) {
        let state = &mut self.state;
        match record {
            Record::Feed(feed) => {
                let unit = feed.unit.or(state.feed.and_then(|(before, _)| before.unit));
                state.feed = Some((crate::program::Feed { value: feed.value, unit }, index));
                // CAM systems write no FEDRAT between RAPID and its motion; APT says a feed ends a rapid.
                if let Some(rapid) = self.pending.rapid.take() {
                    self.problem(rapid, ProblemKind::RapidWithoutMotion);
                }
            }
            Record::Spindle(spindle) => {
                let spindle = spindle.after(state.spindle.as_deref());
                state.spindle = Some(Arc::new(spindle));
            }
            Record::CutterCompensation(compensation) => state.compensation = Some((*compensation, index)),
            Record::ToolCall(call) => state.change_tool(|tool| {
                let another = tool.number.is_some_and(|number| number != call.number);
                if another && tool.loaded && call.loads {
                    tool.name = None;
                    // A tool that nothing describes must not pass for the one before it.
                    tool.data = tool.data.take().filter(|_| tool.shape_is_new);
                }
                tool.number = Some(call.number);
                tool.loaded |= call.loads;
                tool.shape_is_new &= !call.loads;
            }),
            Record::ToolData(data) => state.change_tool(|tool| {
                tool.data = Some(data.as_ref().clone());
                tool.shape_is_new = true;
            }),
            Record::ToolAxis(axis) if !self.program.dialect().axis_is_of_setup() => state.axis = unit(**axis),
            Record::MultiAxis(on) => state.multi_axis = *on,
            Record::Frame(frame) => self.frame(index, frame),
            Record::FrameMark => self.pending.matrix = Some((index, Vec::new())),
            Record::MatrixRow(row) => {
                if let Some((_, rows)) = &mut self.pending.matrix
                    && rows.len() < 3
                {
                    rows.push(**row);
                    if rows.len() == 3 {
                        self.end_matrix();
                    }
                }
            }
            Record::Cycle(cycle) => {
                let before = state.cycle.as_ref().map(|(before, _)| before.as_ref());
                let cycle_in_force = cycle.after(before);
                let own = cycle.feed.map(|_| index);
                self.cycle_feed = own.or(self.cycle_feed.filter(|_| cycle_in_force.feed.is_some()));
                state.cycle = Some((Arc::new(cycle_in_force), index));
            }
            Record::CycleOff => self.last_cycle = state.cycle.take().or(self.last_cycle.take()),
            Record::CycleOn => state.cycle = state.cycle.take().or_else(|| self.last_cycle.clone()),
            Record::Marked(mark) => state.marked = mark.class,
            Record::OperationStart(_) => self.start_operation(index),
            Record::OperationEnd => state.marked = None,
            Record::Units(units) => state.units = Some(*units),
            _ => {}
        }
    }

    fn start_operation(&mut self, index: usize) {
        if self.operations_seen {
            self.state.operation += 1;
        }
        self.operations_seen = true;
        let Some(statement) = self.program.statement(index) else { return };
        if let Some(name) = operation::tool_name(self.program, statement) {
            // A TOOL PATH describes its tool anew; a number comes with the LOAD that follows, or is the one loaded.
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
        if self.program.dialect() == crate::program::Dialect::Nx {
            self.state.axis = Vector3::z();
        }
    }

    fn frame(&mut self, index: usize, record: &FrameRecord) {
        let at = |index: usize| record.numbers.get(index).copied().unwrap_or_default();
        let three = |start: usize| Vector3::new(at(start), at(start + 1), at(start + 2));
        match record.word {
            FrameWord::Msys => {
                let (x, y) = (three(3), three(6));
                let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
                let frame = Frame { statement: index, origin: three(0), axes };
                self.see_from(&frame);
                self.state.frame = Some(Arc::new(frame));
            }
            FrameWord::Csys => {
                let axes = Matrix3::new(at(0), at(1), at(2), at(4), at(5), at(6), at(8), at(9), at(10));
                let origin = Vector3::new(at(3), at(7), at(11));
                self.state.frame = Some(Arc::new(Frame { statement: index, origin, axes }));
            }
            FrameWord::Trans => self.state.shift = three(0),
            FrameWord::Origin => self.state.shift = -three(0),
            FrameWord::Rotary => {}
        }
    }

    /// NX prints points in MSYS: in a new one the tool stands where it stood, with other coordinates.
    fn see_from(&mut self, new: &Frame) {
        let (Some(pose), Some(old)) = (self.state.pose, self.state.frame.as_deref()) else { return };
        if (old.origin, old.axes) == (new.origin, new.axes) {
            return;
        }
        self.last_tangent = None;
        self.state.pose = new.axes.try_inverse().map(|inverse| Pose {
            point: (inverse * (old.origin + old.axes * pose.point.coords - new.origin)).into(),
            axis: unit(inverse * (old.axes * pose.axis)),
        });
    }

    fn end_matrix(&mut self) {
        let Some((statement, rows)) = self.pending.matrix.take() else { return };
        if let [[a, b, c, x], [d, e, f, y], [g, h, i, z]] = rows.as_slice() {
            let axes = Matrix3::new(*a, *b, *c, *d, *e, *f, *g, *h, *i);
            let origin = Vector3::new(*x, *y, *z);
            self.state.frame = Some(Arc::new(Frame { statement, origin, axes }));
        } else {
            self.problem(statement, ProblemKind::BrokenFrame);
        }
    }

    fn announce_arc(&mut self, index: usize, arc: PendingArc) {
        if let Some((_, before)) = self.pending.arc.replace((arc, index)) {
            self.problem(before, ProblemKind::ArcWithoutEnd);
        }
        self.pending.first.get_or_insert(index);
    }

    fn goto(&mut self, index: usize, goto: &Goto) {
        let axis = goto.axis.map_or(self.state.axis, unit);
        self.move_to(Target { pose: Pose { point: goto.point, axis }, normal: None, statement: index });
    }

    fn points(&mut self, index: usize, numbers: &[f64]) {
        let at = |index: usize| Vector3::from_iterator(numbers.iter().skip(index).take(3).copied());
        if is_contact(numbers) {
            let pose = Pose { point: at(0).into(), axis: unit(at(3)) };
            return self.move_to(Target { pose, normal: Some(at(6)), statement: index });
        }
        let with_axes = self.state.multi_axis && is_poses(numbers);
        let step = if with_axes { 6 } else { 3 };
        for start in (0..numbers.len()).step_by(step) {
            let axis = if with_axes { unit(at(start + 3)) } else { self.state.axis };
            let pose = Pose { point: at(start).into(), axis };
            self.move_to(Target { pose, normal: None, statement: index });
        }
    }

    fn from(&mut self, index: usize, goto: &Goto) {
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

    fn step(&mut self, index: usize, step: &[f64]) {
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
    fn forget_place(&mut self) {
        self.state.pose = None;
        self.last_tangent = None;
        self.pending = Pending { matrix: self.pending.matrix.take(), ..Pending::default() };
    }

    fn move_to(&mut self, target: Target) {
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

    fn resolve(&mut self, arc: PendingArc, statement: usize, from: Pose, target: &Target) -> Path {
        let direction = self.pending.direction.map(|(direction, _)| direction);
        let rule = self.program.dialect().arc_rule();
        let resolved = arc.resolve(rule, from.point, target.pose.point, direction, self.last_tangent);
        for kind in resolved.problems {
            self.problem(statement, kind);
        }
        resolved.arc.map_or(Path::Line, |arc| Path::Arc(Box::new(arc)))
    }

    fn push(&mut self, from: Pose, to: Pose, path: Path, target: &Target) {
        let tangent = path.end_tangent(from.point, to.point);
        let mut motion = self.motion(from, to, path, target.statement);
        motion.normal = target.normal;
        self.last_tangent = if motion.rapid { None } else { tangent.or(self.last_tangent) };
        self.state.pose = Some(to);
        self.queue.push_back(motion);
    }

    fn drill(&mut self, target: &Target) {
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

    fn end_spline(&mut self) {
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
    fn motion(&mut self, from: Pose, to: Pose, path: Path, statement: usize) -> Motion {
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
    fn class(&self, rapid: bool, from: &Pose, to: &Pose, path: &Path) -> (MotionClass, bool) {
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

    fn finish(&mut self) {
        self.end_spline();
        self.end_matrix_if_any();
        if let Some(rapid) = self.pending.rapid.take() {
            self.problem(rapid, ProblemKind::RapidWithoutMotion);
        }
        if let Some((_, arc)) = self.pending.arc.take() {
            self.problem(arc, ProblemKind::ArcWithoutEnd);
        }
        if let Some((_, direction)) = self.pending.direction.take() {
            self.problem(direction, ProblemKind::ArcWithoutEnd);
        }
    }

    fn end_matrix_if_any(&mut self) {
        if self.pending.matrix.is_some() {
            self.end_matrix();
        }
    }
}

/// A printed axis as it is, unless it is more than its rounding away from a unit vector.
fn unit(axis: Vector3<f64>) -> Vector3<f64> {
    if (axis.norm_squared() - 1.0).abs() < 2e-3 { axis } else { axis.try_normalize(1e-6).unwrap_or(axis) }
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
                self.read(index, statement.record());
            }
        }
    }
}
