//! This module holds poses and ways of cutters, moving points, and the questions that are asked about them.

use nalgebra::{Rotation3, Unit, Vector3};

/// A pose of a cutter: its tip in mm and the unit vector from the tip along the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CutterPose {
    /// The tip.
    pub tip: Vector3<f64>,
    /// The axis.
    pub axis: Vector3<f64>,
}

/// The arc of a tip's path: a centre, a unit normal, and the angle from the start to the end, radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipArc {
    /// A point on the arc's axis.
    pub center: Vector3<f64>,
    /// The direction of the arc's axis, about which the angle is counted counter-clockwise.
    pub normal: Vector3<f64>,
    /// The angle, positive or negative. The part of the motion along the normal is even (a helix).
    pub angle: f64,
}

impl TipArc {
    /// Returns a point turned about the arc's axis by a share of its angle.
    pub(super) fn turned(&self, point: Vector3<f64>, share: f64) -> Vector3<f64> {
        let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(self.normal), self.angle * share);
        self.center + turn * (point - self.center)
    }

    /// Returns the arc through both ends whose centre is nearest to this one's. Files round centres and
    /// ends. Where that would move the centre far, the arc stays as it is.
    pub(super) fn fitted(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> Self {
        let across = |vector: Vector3<f64>| vector - self.normal * vector.dot(&self.normal);
        let chord = across(to - from);
        let slip = across(self.turned(*from, 1.0) - to).norm();
        let Some(direction) = chord.try_normalize(1e-9) else { return *self };
        let moved = direction * ((from + to) / 2.0 - self.center).dot(&direction);
        if moved.norm() > 2.0 * slip {
            return *self;
        }
        let center = self.center + moved;
        let (first, last) = (across(from - center), across(to - center));
        let angle = self.normal.dot(&first.cross(&last)).atan2(first.dot(&last));
        let turns = ((self.angle - angle) / std::f64::consts::TAU).round();
        Self { center, angle: angle + turns * std::f64::consts::TAU, ..*self }
    }

    /// Returns in how many parts an arc is divided whose sweep is exact: about a parallel to a fixed axis,
    /// without a rise. `None` if it is not exact. Where a cutter reaches over the centre, its front may come
    /// to where it began, so parts are short.
    pub(super) fn flat_parts(&self, from: &CutterPose, to: &CutterPose, radius: f64) -> Option<f64> {
        let is_along = self.normal.cross(&from.axis).norm() < 1e-12;
        let rise = (to.tip - from.tip).dot(&from.axis).abs();
        let offset = from.tip - self.center;
        let offset = offset - self.normal * offset.dot(&self.normal);
        let slip = (self.turned(from.tip, 1.0) - to.tip).norm();
        let is_exact = is_along && rise < 1e-12 && slip < 1e-11 && offset.norm() > 1e-6;
        let largest = if offset.norm() > radius { 1.58 } else { 0.6 };
        is_exact.then(|| (self.angle.abs() / largest).ceil().max(1.0))
    }
}

/// A point that moves evenly from time 0 to time 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointLine {
    /// The place at time 0, mm.
    pub start: Vector3<f64>,
    /// The way from time 0 to time 1.
    pub travel: Vector3<f64>,
}

impl PointLine {
    /// Makes a point that stays.
    pub fn still(at: Vector3<f64>) -> Self {
        Self { start: at, travel: Vector3::zeros() }
    }

    /// Returns the place at a time.
    pub fn at(&self, time: f64) -> Vector3<f64> {
        self.start + self.travel * time
    }
}

/// A point that moves evenly on an arc from time 0 to time 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointArc {
    /// The centre of the point's own circle, mm.
    pub center: Vector3<f64>,
    /// From the centre to the place at time 0.
    pub first: Vector3<f64>,
    /// The same a quarter turn later.
    pub second: Vector3<f64>,
    /// The angle from time 0 to time 1, positive or negative, less than a whole turn.
    pub angle: f64,
}

impl PointArc {
    /// Returns the place at a time.
    pub fn at(&self, time: f64) -> Vector3<f64> {
        let (sin, cos) = (self.angle * time).sin_cos();
        self.center + self.first * cos + self.second * sin
    }

    /// Returns the length of the arc, mm.
    pub fn length(&self) -> f64 {
        self.first.norm() * self.angle.abs()
    }

    /// Returns the chord between two times as a line that is right at both.
    pub fn chord(&self, [from, to]: [f64; 2]) -> PointLine {
        let start = self.at(from);
        let part = to - from;
        if part <= 0.0 {
            return PointLine::still(start);
        }
        let travel = (self.at(to) - start) / part;
        PointLine { start: start - travel * from, travel }
    }
}

/// How one point of a moving cutter moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PointPath {
    /// Evenly on a line.
    Line(PointLine),
    /// Evenly on an arc.
    Arc(PointArc),
}

impl PointPath {
    /// Returns the place at a time.
    pub(super) fn at(&self, time: f64) -> Vector3<f64> {
        self.as_ref().at(time)
    }

    /// Returns the path as one of a list.
    pub(super) fn as_ref(&self) -> PathRef<'_> {
        match self {
            Self::Line(line) => PathRef::Line(line),
            Self::Arc(arc) => PathRef::Arc(arc),
        }
    }

    /// Returns the path as a list of one.
    pub(super) fn as_slice(&self) -> PathSlice<'_> {
        match self {
            Self::Line(line) => PathSlice::Lines(std::slice::from_ref(line)),
            Self::Arc(arc) => PathSlice::Arcs(std::slice::from_ref(arc)),
        }
    }
}

/// One path of a list.
#[derive(Debug, Clone, Copy)]
pub(super) enum PathRef<'a> {
    /// A line.
    Line(&'a PointLine),
    /// An arc.
    Arc(&'a PointArc),
}

impl PathRef<'_> {
    /// Returns the place at a time.
    pub(super) fn at(&self, time: f64) -> Vector3<f64> {
        match self {
            Self::Line(line) => line.at(time),
            Self::Arc(arc) => arc.at(time),
        }
    }

    /// Returns the length of the way from time 0 to time 1, mm.
    pub(super) fn speed(&self) -> f64 {
        match self {
            Self::Line(line) => line.travel.norm(),
            Self::Arc(arc) => arc.length(),
        }
    }
}

/// The paths of several points with one motion.
#[derive(Debug, Clone, Copy)]
pub(super) enum PathSlice<'a> {
    /// All on lines.
    Lines(&'a [PointLine]),
    /// All on arcs about one axis.
    Arcs(&'a [PointArc]),
}

/// Which way what is uncertain counts: towards too little covered, or towards too much.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CoverSide {
    /// All times returned are covered.
    Inner,
    /// All times not returned are uncovered.
    Outer,
}

/// A question about a moving point: whether its gap is at most a bound, to a precision, at the times of
/// `need`. `diameter` is the size of the patch that the point belongs to.
#[derive(Debug, Clone, Copy)]
pub(super) struct CoverQuery {
    pub side: CoverSide,
    pub need: [f64; 2],
    pub bound: f64,
    pub precision: f64,
    pub diameter: f64,
    /// The largest distance of the hull's corners from its middle, mm.
    pub spread: f64,
    /// How far the patch's points may be from the lines across the own axis, mm, and that axis.
    pub aside: f64,
    /// How far they may be in any direction, where the axes differ.
    pub skew: f64,
    pub axis: Vector3<f64>,
}
