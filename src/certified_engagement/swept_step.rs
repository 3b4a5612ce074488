//! This module holds one step of a cutter: a part of a block on which the tip moves on a line or a short
//! arc, and on which the axis stays or turns by a small angle. It tells when a moving point is inside the
//! step's sweep.

use super::convex_times::PointFamily;
use super::cutter_pose::{CutterPose, PointArc, PointLine, PointPath, TipArc};
use super::flat_arc::FlatArc;
use super::level_times::PlaneSegment;
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

/// A step and what is prepared for many questions. The first fields, two lines of a processor's cache, answer most of
/// them.
#[derive(Debug, Clone)]
#[repr(C)]
pub(super) struct SweptStep {
    pub tips: [Vector3<f64>; 2],
    /// The axis at half the step.
    pub middle_axis: Vector3<f64>,
    pub turn_axis: Vector3<f64>,
    pub turn: f64,
    /// The distance of the tip's path from its chord, at the most.
    pub path_deviation: f64,
    /// The same where it is known to be across the axis, which then does not count as `path_deviation`.
    pub side_deviation: f64,
    pub cutter: usize,
    pub is_level: bool,
    is_upright: bool,
    pub axes: [Vector3<f64>; 2],
    pub block: usize,
    pub slide: Vector3<f64>,
    to_body: [Matrix3<f64>; 2],
    /// The frame at half the step, if the axis turns.
    middle_to_body: Matrix3<f64>,
    pub segment: PlaneSegment,
    pub arc: Option<TipArc>,
    /// What is left between the arc's end and the step's; it is spread evenly over the step.
    pub slip: Vector3<f64>,
    /// The arc in the cutter's frame, if it is flat and about a parallel to the axis. Then the sweep is
    /// exact, and the points of the own cutter are followed around the arc's axis: the cutter looks alike
    /// from all sides, so they are those of its surface at all times, and their shares stay.
    pub flat: Option<Box<FlatArc>>,
}

/// Parts along an axis below this (mm) count as none; it is less than the guard that every comparison keeps.
pub(super) const LEVEL: f64 = 1e-12;
/// An arc that misses its end by more than this (mm) is not exact; it is less than the guard, too.
const EXACT_MM: f64 = 2e-11;
/// The largest angle of an exact arc, radians.
const MOST_FLAT_RAD: f64 = 1.6;

impl SweptStep {
    /// Makes a step. The poses' axes must be less than half a turn apart.
    pub(super) fn new(
        from: CutterPose,
        to: CutterPose,
        arc: Option<TipArc>,
        cutter: usize,
        block: usize,
    ) -> Self {
        let cross = from.axis.cross(&to.axis);
        let turn = cross.norm().atan2(from.axis.dot(&to.axis));
        let start = basis_of(from.axis);
        let turn_axis = cross.try_normalize(1e-12);
        let (turn, turn_axis) = match turn_axis {
            Some(axis) if turn > 1e-10 => (turn, axis),
            _ => (0.0, Vector3::x()),
        };
        let turned_by = |angle: f64| {
            Rotation3::from_axis_angle(&Unit::new_unchecked(turn_axis), angle).into_inner() * start
        };
        let end = turned_by(turn);
        let to_body = [start.transpose(), end.transpose()];
        let travel = to_body[0] * (to.tip - from.tip);
        let slip = arc.map_or(Vector3::zeros(), |arc| {
            let rise = arc.normal * (to.tip - from.tip).dot(&arc.normal);
            to.tip - (arc.turned(from.tip, 1.0) + rise)
        });
        let path_deviation = arc.map_or(0.0, |arc| {
            let offset = from.tip - arc.center;
            let radius = (offset - arc.normal * offset.dot(&arc.normal)).norm();
            radius * arc.angle * arc.angle / 8.0 + slip.norm() * arc.angle.abs()
        });
        let is_beside = arc.is_some_and(|arc| turn == 0.0 && arc.normal.cross(&from.axis).norm() < 1e-12);
        let flat = arc.filter(|arc| {
            is_beside && slip.norm() <= EXACT_MM && travel.z.abs() < LEVEL && arc.angle.abs() <= MOST_FLAT_RAD
        });
        let flat = flat.and_then(|arc| {
            let center = to_body[0] * (arc.center - from.tip);
            let sense = arc.normal.dot(&from.axis).signum();
            FlatArc::new(center.xy(), nalgebra::Vector2::zeros(), arc.angle * sense).map(Box::new)
        });
        let (path_deviation, side_deviation) = match (&flat, is_beside) {
            (Some(_), _) => (0.0, 0.0),
            (None, true) => (0.0, path_deviation),
            (None, false) => (path_deviation, 0.0),
        };
        let slip = if flat.is_some() { Vector3::zeros() } else { slip };
        Self {
            tips: [from.tip, to.tip],
            axes: [from.axis, if turn > 0.0 { to.axis } else { from.axis }],
            cutter,
            block,
            arc,
            path_deviation,
            side_deviation,
            slip,
            to_body,
            middle_to_body: turned_by(turn / 2.0).transpose(),
            turn,
            turn_axis,
            middle_axis: if turn > 0.0 { (from.axis + to.axis).normalize() } else { from.axis },
            is_upright: turn == 0.0 && start == Matrix3::identity(),
            is_level: turn == 0.0 && travel.z.abs() < LEVEL,
            slide: -travel,
            segment: PlaneSegment::new(travel.xy()),
            flat,
        }
    }

    /// Makes a step whose path is at most so far from its line.
    pub(super) fn chord(
        from: CutterPose,
        to: CutterPose,
        deviation: f64,
        cutter: usize,
        block: usize,
    ) -> Self {
        Self { path_deviation: deviation, ..Self::new(from, to, None, cutter, block) }
    }

    /// Returns the pose at the start (0) or the end.
    pub(super) fn pose_at_end(&self, end: usize) -> CutterPose {
        let [tip, axis] = if end == 0 { [self.tips[0], self.axes[0]] } else { [self.tips[1], self.axes[1]] };
        CutterPose { tip, axis }
    }

    /// Returns a vector of the cutter's frame at the start (0) or the end (1) in the workpiece frame.
    pub(super) fn to_world(&self, end: usize, vector: &Vector3<f64>) -> Vector3<f64> {
        if self.is_upright {
            return *vector;
        }
        let matrix = if end == 0 { &self.to_body[0] } else { &self.to_body[1] };
        matrix.tr_mul(vector)
    }

    /// Returns a vector of the workpiece frame in the cutter's frame at the start.
    pub(super) fn to_body_vector(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        if self.is_upright { *vector } else { self.to_body[0] * vector }
    }

    /// Returns the way of a point of the cutter between two times as a line that is right at both. Between
    /// them the point is at most [`SweptStep::line_deviation`] off, and `side_deviation` times the square of
    /// the part across the axis.
    pub(super) fn line_of(&self, body: &Vector3<f64>, [from, to]: [f64; 2]) -> PointLine {
        if self.is_straight() {
            let start = self.tips[0] + self.to_world(0, body);
            return PointLine { start, travel: self.tips[1] - self.tips[0] };
        }
        let first = self.place_of(body, from);
        let part = to - from;
        if part <= 0.0 {
            return PointLine { start: first, travel: Vector3::zeros() };
        }
        let travel = (self.place_of(body, to) - first) / part;
        PointLine { start: first - travel * from, travel }
    }

    /// Returns the way of a point of the cutter between two times: an arc about the arc's axis if that is
    /// exact, or else a line as [`SweptStep::line_of`] tells.
    pub(super) fn path_of(&self, body: &Vector3<f64>, need: [f64; 2]) -> PointPath {
        let (Some(_), Some(arc)) = (&self.flat, &self.arc) else {
            return PointPath::Line(self.line_of(body, need));
        };
        let offset = self.tips[0] + self.to_world(0, body) - arc.center;
        let rise = arc.normal * offset.dot(&arc.normal);
        let first = offset - rise;
        let second = arc.normal.cross(&first);
        PointPath::Arc(PointArc { center: arc.center + rise, first, second, angle: arc.angle })
    }

    /// Returns whether the tip stays at one height along the axis, which stays too.
    pub(super) fn is_level(&self) -> bool {
        self.is_level
    }

    /// Returns by how much the tip moves along its fixed axis.
    pub(super) fn rise(&self) -> f64 {
        -self.slide.z
    }

    /// Returns by how much the tip moves along its fixed axis, if it moves nowhere else.
    pub(super) fn plunge_rise(&self) -> Option<f64> {
        let is_along = self.turn == 0.0 && self.arc.is_none() && self.slide.xy().norm() < LEVEL;
        is_along.then_some(-self.slide.z)
    }

    /// Returns whether the axis is that of z.
    pub(super) fn is_upright(&self) -> bool {
        self.is_upright
    }

    /// Returns whether the tip stays on a line or a flat arc while the axis stays.
    pub(super) fn is_exact(&self) -> bool {
        self.is_straight() || self.flat.is_some()
    }

    /// Returns whether every point of the cutter moves evenly on a line.
    pub(super) fn is_straight(&self) -> bool {
        self.turn == 0.0 && self.arc.is_none()
    }

    /// Returns how far a point of the cutter at a distance from the tip is from its line over a part of the
    /// time, at the most: an eighth of its acceleration times the part's square.
    pub(super) fn line_deviation(&self, distance: f64, part: f64) -> f64 {
        (self.path_deviation + self.turn * self.turn * distance / 8.0) * part * part
    }

    /// Returns the velocity of a point of the cutter at a time, in mm over the whole step.
    pub(super) fn velocity_of(&self, body: &Vector3<f64>, time: f64) -> Vector3<f64> {
        let chord = self.tips[1] - self.tips[0];
        let tip = self.arc.map_or(chord, |arc| {
            let tangent = arc.normal.cross(&(self.tip_at(time) - arc.center)) * arc.angle;
            tangent + arc.normal * chord.dot(&arc.normal) + self.slip
        });
        tip + self.turn_axis.cross(&self.turned(&self.to_world(0, body), time)) * self.turn
    }

    /// Returns the exact place of a point of the cutter at a time.
    pub(super) fn place_of(&self, body: &Vector3<f64>, time: f64) -> Vector3<f64> {
        self.tip_at(time) + self.turned(&self.to_world(0, body), time)
    }

    /// Returns a vector that turns with the cutter at a time.
    pub(super) fn turned(&self, vector: &Vector3<f64>, time: f64) -> Vector3<f64> {
        if let (Some(_), Some(arc)) = (&self.flat, &self.arc) {
            return Rotation3::from_axis_angle(&Unit::new_unchecked(arc.normal), arc.angle * time) * vector;
        }
        if self.turn == 0.0 {
            return *vector;
        }
        Rotation3::from_axis_angle(&Unit::new_unchecked(self.turn_axis), self.turn * time) * vector
    }

    /// Returns the tip at a time.
    pub(super) fn tip_at(&self, time: f64) -> Vector3<f64> {
        let Some(arc) = self.arc else {
            return self.tips[0] + (self.tips[1] - self.tips[0]) * time;
        };
        let rise = arc.normal * (self.tips[1] - self.tips[0]).dot(&arc.normal);
        arc.turned(self.tips[0], time) + (rise + self.slip) * time
    }

    /// Returns the points of a line in the frame of the turning cutter as an even family, and how far it is
    /// off.
    ///
    /// In the frame that turns with s a fixed point moves on a curve. The family runs halfway between its chord and the
    /// parallel through its middle, so it is off by half their distance, and by what is left of the third derivative:
    /// at most turn³ times the distance plus 3 turn² times the tip's way, of which 1 part in 124 remains of the parabola
    /// through three points. Along the line both change by at most an eighth of turn² times the way. What is left of the
    /// product of both times is computed. The points of one patch may use different s; from the middle of the step they
    /// are half of it away, so they are apart by at most half the turn times the patch.
    ///
    /// The family's time goes from 0 to 1 while the line's goes over `need`.
    pub(super) fn family_of_turning(
        &self,
        line: &PointLine,
        need: [f64; 2],
        diameter: f64,
    ) -> (PointFamily, f64) {
        let (start, end) = (line.at(need[0]), line.at(need[1]));
        let corner = |matrix: &Matrix3<f64>, point: &Vector3<f64>, tip: &Vector3<f64>| matrix * (point - tip);
        let [first, last] = &self.to_body;
        let (a, b) = (corner(first, &start, &self.tips[0]), corner(last, &start, &self.tips[1]));
        let (c, d) = (corner(first, &end, &self.tips[0]), corner(last, &end, &self.tips[1]));
        let travel = (c - a + d - b) / 2.0;
        let slide = (b - a + d - c) / 2.0;
        let chord = (a + b + c + d) / 4.0;
        let middle = (self.tips[0] + self.tips[1]) / 2.0;
        let bulge = self.middle_to_body * ((start + end) / 2.0 - middle) - chord;
        let base = chord + bulge / 2.0 - travel / 2.0 - slide / 2.0;
        let product = (d - b - c + a).norm() / 4.0;
        let farthest = a.norm_squared().max(b.norm_squared()).max(c.norm_squared()).max(d.norm_squared());
        let way = (self.tips[1] - self.tips[0]).norm();
        let squared = self.turn * self.turn;
        let third = squared * (self.turn * farthest.sqrt() + 3.0 * way) / 124.0;
        let bend = bulge.norm() / 2.0 + squared * travel.norm() / 8.0 + third;
        (PointFamily { base, travel, slide, aside: 0.0 }, product + bend + self.turn * diameter / 2.0)
    }
}

/// Returns a basis whose third vector is the axis, as columns.
fn basis_of(axis: Vector3<f64>) -> Matrix3<f64> {
    if axis == Vector3::z() {
        return Matrix3::identity();
    }
    let helper = if axis.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let across = axis.cross(&helper);
    let first = across.try_normalize(1e-12).unwrap_or_else(Vector3::x);
    Matrix3::from_columns(&[first, axis.cross(&first), axis])
}
