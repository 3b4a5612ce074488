//! What a step did to the points: moved, raised, turned, scaled, mirrored; found by comparing with the file as it was read.

use crate::number;
use crate::program::geometry::SAME_POINT;
use crate::program::record::Goto;
use crate::program::{Program, Record, Statement, StatementChange, StepId};
use nalgebra::{Point3, Vector3};

/// What happened to the points that a step signed.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Displacement {
    /// The program, or a part of it, was put elsewhere. A correction of some points, each in its own way, is no such move.
    pub(super) moved: bool,
    /// It was, and at least one z is another.
    pub(super) raised: bool,
    /// Not all points moved alike: turned, scaled or bent.
    pub(super) uneven: bool,
    /// Most distances between points are others.
    pub(super) scaled: bool,
    /// Left and right are swapped.
    pub(super) mirrored: bool,
}

impl Displacement {
    /// Compares every point that `step` edited with the file's bytes. Linear, and without the grammar.
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

/// A point before and after.
#[derive(Clone, Copy)]
struct PointPair {
    old: Point3<f64>,
    new: Point3<f64>,
}

/// What the comparison has counted so far.
#[derive(Default)]
struct DisplacementTally {
    /// Points of the program.
    points: usize,
    /// Those that are elsewhere.
    moved: usize,
    /// Points that cannot be compared, and records that are no GOTO: a shift is the least that happened to them.
    others: bool,
    raised: bool,
    uneven: bool,
    first: Option<Vector3<f64>>,
    last: [Option<PointPair>; 2],
    old_axis: Vector3<f64>,
    new_axis: Vector3<f64>,
    /// Length of the moves that kept their length, and of those that did not.
    kept: f64,
    stretched: f64,
    /// Turns (by area) that stayed on their side, and those that did not.
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

    /// A mirror turns the sign of axis · (a × b), a rotation does not. Weighed by area: the turns of nearly straight moves are
    /// rounding.
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

/// Point and axis of a GOTO as the file has it.
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
