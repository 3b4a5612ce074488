//! Whether two programs move the tool along the same path.

use crate::program::geometry::{Path, Pose, SAME_POINT};
use crate::program::motion::{Motion, Motions};
use crate::program::{LengthUnit, Program};
use crate::report::line_of;
use crate::report::stats::{Measured, Totals};
use nalgebra::{Point3, Vector3};
use serde::Serialize;
use std::mem::Discriminant;

/// Axes whose components differ by less are one axis: half of the fourth decimal, the coarsest that axes are printed with.
const SAME_AXIS: f64 = SAME_POINT;

/// The paths of two programs, compared.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Geometry {
    /// Whether every point is where it was, within half of the fourth decimal, the tool axis and rapids included. A line cut
    /// into several is the same path, and so is a hole written out; an arc cut into several is not recognized.
    pub same: bool,
    /// Where the paths part first: lines in both files.
    pub parts_at: Option<(Option<usize>, Option<usize>)>,
}

/// Compares the paths of two programs and sums them up, in one pass over both.
pub(super) fn compare(
    (a, unit_a): (&Program, LengthUnit),
    (b, unit_b): (&Program, LengthUnit),
) -> (Geometry, Totals, Totals) {
    let mut left = Walk::new(a, unit_a, unit_a.in_mm() / unit_b.in_mm());
    let mut right = Walk::new(b, unit_b, 1.0);
    let mut geometry = Geometry { same: true, parts_at: None };
    loop {
        let (step_a, step_b) = (left.current(), right.current());
        let together = match (step_a, step_b) {
            (None, None) => break,
            (Some(a), Some(b)) => together(a, b),
            _ => None,
        };
        let Some(together) = together else {
            geometry = Geometry { same: false, parts_at: Some((left.line(), right.line())) };
            break;
        };
        left.advance(together.a);
        right.advance(together.b);
    }
    left.drain();
    right.drain();
    (geometry, left.totals, right.totals)
}

/// A move as far as it is compared, in the unit of the second program.
#[derive(Debug, Clone)]
struct Step {
    from: Pose,
    to: Pose,
    shape: Discriminant<Path>,
    line: bool,
    /// What the ends of arcs and splines do not say.
    middle: Point3<f64>,
    length: f64,
    rapid: bool,
    statement: usize,
}

/// How far each side goes on: to the end of its move, or to a pose within it.
struct Together {
    a: Option<Pose>,
    b: Option<Pose>,
}

fn together(a: &Step, b: &Step) -> Option<Together> {
    if a.rapid != b.rapid || !same_point(&a.from.point, &b.from.point) {
        return None;
    }
    let ends = same_pose(&a.to, &b.to);
    let lines = a.line && b.line;
    if ends && lines {
        return Some(Together { a: None, b: None });
    }
    if ends {
        let same = a.shape == b.shape
            && same_point(&a.middle, &b.middle)
            && (a.length - b.length).abs() <= SAME_POINT * 10.0 + a.length * 1e-5;
        return same.then_some(Together { a: None, b: None });
    }
    if !lines {
        return None;
    }
    if a.length <= b.length {
        within(b, &a.to).then_some(Together { a: None, b: Some(a.to) })
    } else {
        within(a, &b.to).then_some(Together { a: Some(b.to), b: None })
    }
}

fn same_point(a: &Point3<f64>, b: &Point3<f64>) -> bool {
    // Each coordinate was rounded for itself.
    a.iter().zip(b.iter()).all(|(a, b)| (a - b).abs() <= SAME_POINT * (1.0 + 1e-6))
}

fn same_axis(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    a.iter().zip(b.iter()).all(|(a, b)| (a - b).abs() <= SAME_AXIS * (1.0 + 1e-6))
}

fn same_pose(a: &Pose, b: &Pose) -> bool {
    same_point(&a.point, &b.point) && same_axis(&a.axis, &b.axis)
}

/// Whether a pose lies on a line, with the axis that the tool has there.
fn within(line: &Step, at: &Pose) -> bool {
    let travel = line.to.point - line.from.point;
    let share = (at.point - line.from.point).dot(&travel) / travel.norm_squared();
    if !(0.0..=1.0).contains(&share) {
        return false;
    }
    let axis = line.from.axis.lerp(&line.to.axis, share).try_normalize(0.0).unwrap_or(line.to.axis);
    same_point(&(line.from.point + travel * share), &at.point) && same_axis(&axis, &at.axis)
}

/// The moves of one program, those that do nothing left out.
struct Walk<'p> {
    program: &'p Program,
    motions: Motions<'p>,
    unit: LengthUnit,
    scale: f64,
    step: Option<Step>,
    totals: Totals,
}

impl<'p> Walk<'p> {
    fn new(program: &'p Program, unit: LengthUnit, scale: f64) -> Self {
        let totals = Totals::default();
        let mut walk = Self { program, motions: program.motions(), unit, scale, step: None, totals };
        walk.next();
        walk
    }

    fn current(&self) -> Option<&Step> {
        self.step.as_ref()
    }

    /// Line of the move in its file.
    fn line(&self) -> Option<usize> {
        let statement = self.program.statement(self.step.as_ref()?.statement)?;
        line_of(self.program, statement)
    }

    fn next(&mut self) {
        self.step = None;
        for motion in self.motions.by_ref() {
            let measured = Measured::of(&motion, self.unit, None);
            self.totals.add(&measured);
            let step = step(&motion, self.scale, measured.length());
            // A first point has no way to it; both programs must start there all the same.
            let stays = same_point(&step.from.point, &step.to.point)
                && same_axis(&step.from.axis, &step.to.axis)
                && step.length <= SAME_POINT;
            if !stays || motion.path == Path::Start {
                self.step = Some(step);
                return;
            }
        }
    }

    fn advance(&mut self, to: Option<Pose>) {
        match (to, &mut self.step) {
            (Some(pose), Some(step)) => {
                step.from = pose;
                step.length = (step.to.point - pose.point).norm();
            }
            _ => self.next(),
        }
    }

    fn drain(&mut self) {
        for motion in self.motions.by_ref() {
            self.totals.add(&Measured::of(&motion, self.unit, None));
        }
    }
}

fn step(motion: &Motion, scale: f64, length: f64) -> Step {
    let scaled = |pose: &Pose| Pose { point: pose.point * scale, axis: pose.axis };
    let middle = match &motion.path {
        Path::Arc(arc) => arc.point(0.5),
        Path::Spline(spline) => spline.point(0.5),
        Path::Line | Path::Start => motion.to.point,
    };
    Step {
        from: scaled(&motion.from),
        to: scaled(&motion.to),
        shape: std::mem::discriminant(&motion.path),
        line: motion.path == Path::Line,
        middle: middle * scale,
        length: length * scale,
        rapid: motion.rapid,
        statement: motion.last_statement(),
    }
}
