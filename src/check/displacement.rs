//! What a step did to the points: moved, raised, turned, scaled, mirrored; found by comparing with the file as it was read.

use crate::number;
use crate::program::geometry::SAME_POINT;
use crate::program::{Change, Program, Record, Statement, StepId};
use nalgebra::{Point3, Vector3};

/// What happened to the points that a step signed.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Displacement {
    /// At least one point is elsewhere.
    pub(super) moved: bool,
    /// At least one z is another.
    pub(super) raised: bool,
    /// Not all points moved alike: turned, scaled or bent.
    pub(super) uneven: bool,
    /// Distances between points are others.
    pub(super) scaled: bool,
    /// Left and right are swapped.
    pub(super) mirrored: bool,
}

/// A point before and after.
#[derive(Clone, Copy)]
struct Pair {
    old: Point3<f64>,
    new: Point3<f64>,
}

impl Displacement {
    /// Compares every point that `step` edited with the file's bytes. Linear, and without the grammar.
    pub(super) fn of(program: &Program, step: StepId) -> Self {
        let mut result = Self::default();
        let (mut old_axis, mut new_axis) = (Vector3::z(), Vector3::z());
        let mut first: Option<Vector3<f64>> = None;
        let mut last: [Option<Pair>; 2] = [None; 2];
        // Turns to the same side, and to the other.
        let (mut same, mut swapped) = (0.0, 0.0);
        for statement in program.statements() {
            let Record::Goto(goto) = statement.record() else { continue };
            if statement.change() != Change::Edited(step) {
                continue;
            }
            let Some((old, axis)) = as_read(program, statement) else {
                // It cannot be compared; a shift is the least it can be.
                (result.moved, result.raised) = (true, true);
                continue;
            };
            old_axis = axis.unwrap_or(old_axis);
            new_axis = goto.axis.unwrap_or(new_axis);
            let pair = Pair { old, new: goto.point };
            let shift = pair.new - pair.old;
            result.moved |= shift.norm() > 0.0;
            result.raised |= shift.z != 0.0;
            let even = first.get_or_insert(shift);
            result.uneven |= (shift - *even).norm() > 4.0 * SAME_POINT;
            if let [before, Some(one)] = last {
                let (a, b) = (pair.old - one.old, pair.new - one.new);
                result.scaled |= (a.norm() - b.norm()).abs() > 4.0 * SAME_POINT + 1e-6 * a.norm();
                if let Some(start) = before {
                    let old = old_axis.dot(&(one.old - start.old).cross(&a));
                    let new = new_axis.dot(&(one.new - start.new).cross(&b));
                    if old * new > 0.0 { same += old.abs() } else { swapped += old.abs() }
                }
            }
            last = [last[1], Some(pair)];
        }
        // Weighed by area: the turns of nearly straight triples are rounding.
        result.mirrored = swapped > same;
        result
    }
}

/// Point and axis of a GOTO as the file has it.
fn as_read(program: &Program, statement: &Statement) -> Option<(Point3<f64>, Option<Vector3<f64>>)> {
    let text = program.source().slice(statement.origin());
    let slash = memchr::memchr(b'/', text)?;
    let mut numbers = [0.0; 6];
    let mut count = 0;
    let fields =
        text.get(slash + 1..)?.split(|byte| matches!(byte, b',' | b' ' | b'\t' | b'\r' | b'\n' | b'$'));
    for field in fields.filter(|field| !field.is_empty()) {
        *numbers.get_mut(count)? = number::parse(field)?;
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
