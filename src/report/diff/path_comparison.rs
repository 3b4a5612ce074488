//! This module checks whether two programs move the tool along the same path.

use crate::program::geometry::{MotionPath, Pose, SAME_POINT};
use crate::program::motion::{Motion, Motions};
use crate::program::{LengthUnit, Program, StatementId};
use crate::report::statement_line;
use crate::report::stats::{MotionLengthAndTime, MotionTotals};
use nalgebra::{Point3, Vector3};
use serde::Serialize;
use std::mem::Discriminant;

/// Axes whose components differ by less are equal. It is half of the fourth decimal, the coarsest with which
/// axes are printed.
const SAME_AXIS: f64 = SAME_POINT;

/// The comparison of the paths of two programs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PathComparison {
    /// Whether every point is where it was, within half of the fourth decimal, including the tool axis and
    /// rapids. A line that is split into several is the same path, and so is a drilling cycle that is written
    /// as motions. An arc that is split into several is not recognized.
    pub same: bool,
    /// The lines in both files at which the paths first separate; `null` if they do not separate. A single
    /// line is `null` where that path has ended, or where a step inserted the statement.
    pub parts_at: Option<(Option<usize>, Option<usize>)>,
}

/// Compares the paths of two programs and sums up their motions, in a single pass over both.
pub(super) fn compare_paths(
    (a, unit_a): (&Program, LengthUnit),
    (b, unit_b): (&Program, LengthUnit),
) -> (PathComparison, MotionTotals, MotionTotals) {
    let mut left = MoveCursor::new(a, unit_a, unit_a.mm_per_unit() / unit_b.mm_per_unit());
    let mut right = MoveCursor::new(b, unit_b, 1.0);
    let mut geometry = PathComparison { same: true, parts_at: None };
    loop {
        let (step_a, step_b) = (left.current_move(), right.current_move());
        let together = match (step_a, step_b) {
            (None, None) => break,
            (Some(a), Some(b)) => find_common_advance(a, b),
            _ => None,
        };
        let Some(together) = together else {
            geometry =
                PathComparison { same: false, parts_at: Some((left.current_line(), right.current_line())) };
            break;
        };
        left.advance_to(together.a);
        right.advance_to(together.b);
    }
    left.sum_remaining_motions();
    right.sum_remaining_motions();
    (geometry, left.totals, right.totals)
}

/// A motion as far as it is compared, in the unit of the second program.
#[derive(Debug, Clone)]
struct ComparedMove {
    from: Pose,
    to: Pose,
    shape: Discriminant<MotionPath>,
    line: bool,
    /// The middle of the path. It is compared because the ends of arcs and splines do not determine their
    /// paths.
    middle: Point3<f64>,
    length: f64,
    rapid: bool,
    statement: StatementId,
}

/// How far each side advances: to a pose within its motion, or with `None` to the end of it.
struct CommonAdvance {
    a: Option<Pose>,
    b: Option<Pose>,
}

fn find_common_advance(a: &ComparedMove, b: &ComparedMove) -> Option<CommonAdvance> {
    if a.rapid != b.rapid || !is_same_point(&a.from.point, &b.from.point) {
        return None;
    }
    let ends = is_same_pose(&a.to, &b.to);
    let lines = a.line && b.line;
    if ends && lines {
        return Some(CommonAdvance { a: None, b: None });
    }
    if ends {
        let same = a.shape == b.shape
            && is_same_point(&a.middle, &b.middle)
            && (a.length == b.length || (a.length - b.length).abs() <= SAME_POINT * 10.0 + a.length * 1e-5);
        return same.then_some(CommonAdvance { a: None, b: None });
    }
    if !lines {
        return None;
    }
    if a.length <= b.length {
        is_pose_on_line(b, &a.to).then_some(CommonAdvance { a: None, b: Some(a.to) })
    } else {
        is_pose_on_line(a, &b.to).then_some(CommonAdvance { a: Some(b.to), b: None })
    }
}

fn is_same_point(a: &Point3<f64>, b: &Point3<f64>) -> bool {
    // Each coordinate was rounded by itself. Infinite coordinates have no difference, so equal ones are
    // tested first.
    a.iter().zip(b.iter()).all(|(a, b)| a == b || (a - b).abs() <= SAME_POINT * (1.0 + 1e-6))
}

fn is_same_axis(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    a.iter().zip(b.iter()).all(|(a, b)| (a - b).abs() <= SAME_AXIS * (1.0 + 1e-6))
}

fn is_same_pose(a: &Pose, b: &Pose) -> bool {
    is_same_point(&a.point, &b.point) && is_same_axis(&a.axis, &b.axis)
}

/// Returns whether a pose lies on a line and has the tool axis that the line has there.
fn is_pose_on_line(line: &ComparedMove, at: &Pose) -> bool {
    let travel = line.to.point - line.from.point;
    let share = (at.point - line.from.point).dot(&travel) / travel.norm_squared();
    if !(0.0..=1.0).contains(&share) {
        return false;
    }
    let axis = line.from.axis.lerp(&line.to.axis, share).try_normalize(0.0).unwrap_or(line.to.axis);
    is_same_point(&(line.from.point + travel * share), &at.point) && is_same_axis(&axis, &at.axis)
}

/// The motions of a program, without those that do nothing.
struct MoveCursor<'p> {
    program: &'p Program,
    motions: Motions<'p>,
    unit: LengthUnit,
    scale: f64,
    step: Option<ComparedMove>,
    totals: MotionTotals,
}

impl<'p> MoveCursor<'p> {
    fn new(program: &'p Program, unit: LengthUnit, scale: f64) -> Self {
        let totals = MotionTotals::default();
        let mut walk = Self { program, motions: program.motions(), unit, scale, step: None, totals };
        walk.load_next_move();
        walk
    }

    fn current_move(&self) -> Option<&ComparedMove> {
        self.step.as_ref()
    }

    /// Returns the line of the motion in its file.
    fn current_line(&self) -> Option<usize> {
        let statement = self.program.statement(self.step.as_ref()?.statement);
        statement_line(self.program, statement)
    }

    fn load_next_move(&mut self) {
        self.step = None;
        for motion in self.motions.by_ref() {
            let measured = MotionLengthAndTime::from_motion(&motion, self.unit, None);
            self.totals.add_motion(&measured);
            let step = to_compared_move(&motion, self.scale, measured.length());
            // No path leads to a first point, but both programs must start at the same point.
            let stays = is_same_point(&step.from.point, &step.to.point)
                && is_same_axis(&step.from.axis, &step.to.axis)
                && step.length <= SAME_POINT;
            if !stays || motion.path == MotionPath::Start {
                self.step = Some(step);
                return;
            }
        }
    }

    fn advance_to(&mut self, to: Option<Pose>) {
        match (to, &mut self.step) {
            (Some(pose), Some(step)) => {
                step.from = pose;
                step.length = (step.to.point - pose.point).norm();
            }
            _ => self.load_next_move(),
        }
    }

    fn sum_remaining_motions(&mut self) {
        for motion in self.motions.by_ref() {
            self.totals.add_motion(&MotionLengthAndTime::from_motion(&motion, self.unit, None));
        }
    }
}

fn to_compared_move(motion: &Motion, scale: f64, length: f64) -> ComparedMove {
    let scaled = |pose: &Pose| Pose { point: pose.point * scale, axis: pose.axis };
    let middle = match &motion.path {
        MotionPath::Arc(arc) => arc.point_at(0.5),
        MotionPath::Spline(spline) => spline.point_at(0.5),
        MotionPath::Line | MotionPath::Start => motion.to.point,
    };
    ComparedMove {
        from: scaled(&motion.from),
        to: scaled(&motion.to),
        shape: std::mem::discriminant(&motion.path),
        line: motion.path == MotionPath::Line,
        middle: middle * scale,
        length: length * scale,
        rapid: motion.rapid,
        statement: motion.last_statement(),
    }
}
