//! This module finds out what a step did to the points (moved, raised, rotated, scaled or mirrored) by
//! comparing them with the file as it was read.

use crate::number;
use crate::program::geometry::SAME_POINT;
use crate::program::record::Goto;
use crate::program::{Program, Record, Statement, StatementChange, StepId};
use nalgebra::{Point3, Vector3};

/// What happened to the points that a step has signed.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Displacement {
    /// The program, or a part of it, was moved. A correction of some points, each in its own manner, is no
    /// such move.
    pub(super) moved: bool,
    /// It was moved, and at least one z has changed.
    pub(super) raised: bool,
    /// Not all points moved alike: they were rotated, scaled or bent.
    pub(super) uneven: bool,
    /// Most distances between points have changed.
    pub(super) scaled: bool,
    /// Left and right are swapped.
    pub(super) mirrored: bool,
}

impl Displacement {
    /// Compares every point that `step` edited with the bytes of the file. It takes linear time and does
    /// without the grammar.
    pub(super) fn measure_step(program: &Program, step: StepId) -> Self {
        let mut tally = DisplacementTally {
            old_axis: Vector3::z(),
            new_axis: Vector3::z(),
            ..DisplacementTally::default()
        };
        for (_, statement) in program.live_statements() {
            let edited = statement.change() == StatementChange::Edited(step);
            match statement.record() {
                Record::Goto(goto) => {
                    tally.points += 1;
                    if edited {
                        tally.add_point(goto, original_point(program, statement));
                    }
                }
                record => tally.others |= edited && record.is_motion(),
            }
        }
        tally.to_displacement()
    }
}

/// A point before and after the step.
#[derive(Clone, Copy)]
struct PointPair {
    old: Point3<f64>,
    new: Point3<f64>,
}

/// The counts of the comparison so far.
#[derive(Default)]
struct DisplacementTally {
    /// The number of points in the program.
    points: usize,
    /// The number of points that have moved.
    moved: usize,
    /// Whether there are points that cannot be compared, or records other than GOTO. These were shifted at
    /// least.
    others: bool,
    raised: bool,
    uneven: bool,
    first: Option<Vector3<f64>>,
    last: [Option<PointPair>; 2],
    old_axis: Vector3<f64>,
    new_axis: Vector3<f64>,
    /// The length of the moves that kept their length, and of those that did not.
    kept: f64,
    stretched: f64,
    /// The area of the turns that kept their side, and of those that did not.
    same: f64,
    swapped: f64,
}

impl DisplacementTally {
    fn add_point(&mut self, goto: &Goto, as_read: Option<(Point3<f64>, Option<Vector3<f64>>)>) {
        let Some((old, axis)) = as_read else {
            self.others = true;
            return;
        };
        self.old_axis = axis.unwrap_or(self.old_axis);
        self.new_axis = goto.axis.unwrap_or(self.new_axis);
        let pair = PointPair { old, new: goto.point };
        let shift = pair.new - pair.old;
        self.moved += usize::from(shift.norm_squared() > 0.0);
        self.raised |= shift.z != 0.0;
        let first = *self.first.get_or_insert(shift);
        self.uneven |= (shift - first).norm() > 4.0 * SAME_POINT;
        let [before, last] = self.last;
        if let Some(last) = last {
            let (old, new) = (pair.old - last.old, pair.new - last.new);
            let differ = (old.norm() - new.norm()).abs() > 4.0 * SAME_POINT + 1e-6 * old.norm();
            *(if differ { &mut self.stretched } else { &mut self.kept }) += old.norm();
            if let Some(before) = before {
                self.add_turn((last.old - before.old).cross(&old), (last.new - before.new).cross(&new));
            }
        }
        self.last = [last, Some(pair)];
    }

    /// A mirror reverses the sign of axis · (a × b), and a rotation does not. The turns are weighted by their
    /// area, because the turns of nearly straight moves are rounding.
    fn add_turn(&mut self, old: Vector3<f64>, new: Vector3<f64>) {
        let (old, new) = (self.old_axis.dot(&old), self.new_axis.dot(&new));
        let area = old.abs().min(new.abs());
        if old * new > 0.0 {
            self.same += area;
        } else if old * new < 0.0 {
            self.swapped += area;
        }
    }

    fn to_displacement(&self) -> Displacement {
        let compared = self.moved > 0;
        let placed = compared && (!self.uneven || self.moved * 2 >= self.points);
        let moved = placed || !compared && self.others;
        Displacement {
            moved,
            raised: moved && (self.raised || !compared),
            uneven: self.uneven,
            scaled: self.stretched > self.kept,
            mirrored: self.swapped > self.same,
        }
    }
}

/// Returns point and axis of a GOTO as the file has them.
fn original_point(program: &Program, statement: &Statement) -> Option<(Point3<f64>, Option<Vector3<f64>>)> {
    let text = program.source().slice(statement.origin());
    let slash = memchr::memchr(b'/', text)?;
    let mut numbers = [0.0; 6];
    let mut count = 0;
    let fields =
        text.get(slash + 1..)?.split(|byte| matches!(byte, b',' | b' ' | b'\t' | b'\r' | b'\n' | b'$'));
    for field in fields.filter(|field| !field.is_empty()) {
        *numbers.get_mut(count)? = number::parse_number(field)?;
        count += 1;
    }
    let [x, y, z, i, j, k] = numbers;
    let axis = match count {
        3 => None,
        6 => Some(Vector3::new(i, j, k)),
        _ => return None,
    };
    Some((Point3::new(x, y, z), axis))
}
