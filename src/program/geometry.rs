//! This module holds paths between two points, lines, arcs, helices and splines, in the program's frame and
//! the file's unit.

use nalgebra::{Point3, Unit, Vector3};
use std::f64::consts::TAU;

/// Points that are closer than this (in the file's unit) are the same. It is half of the fourth decimal, the
/// coarsest that any measured dialect prints.
pub const SAME_POINT: f64 = 5e-5;

/// A pose of the tool: its tip, and its axis as a unit vector from the tip into the holder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// The tip (the cutter location).
    pub point: Point3<f64>,
    /// The tool axis.
    pub axis: Vector3<f64>,
}

/// The path from one pose to the next.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MotionPath {
    /// A straight line. If the axes differ, the axis turns at a constant rate (slerp).
    Line,
    /// An arc or a helix.
    Arc(Box<CircularArc>),
    /// A cubic B-spline.
    Spline(Box<Spline>),
    /// No path: the tool stays at its place (FROM, or a point before which no pose was known).
    Start,
}

/// An arc from `start`, right-hand about `axis`. It is a helix if `rise` is not zero.
///
/// ```
/// use clsmith::program::geometry::CircularArc;
/// use nalgebra::{Point3, Vector3};
/// use std::f64::consts::PI;
///
/// let (start, end) = (Point3::new(10.0, 0.0, 0.0), Point3::new(-10.0, 0.0, 0.0));
/// let half = CircularArc::from_endpoints(start, end, Point3::origin(), Vector3::z_axis(), 0);
/// assert!((half.length() - 10.0 * PI).abs() < 1e-9);
/// assert!((half.point_at(0.5) - Point3::new(0.0, 10.0, 0.0)).norm() < 1e-9);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CircularArc {
    /// The start of the arc.
    pub start: Point3<f64>,
    /// A point on its axis.
    pub center: Point3<f64>,
    /// The axis; the sweep is positive about it.
    pub axis: Unit<Vector3<f64>>,
    /// The radius, which is the distance of the start from the axis.
    pub radius: f64,
    /// The sweep in radians, positive.
    pub sweep: f64,
    /// The travel along the axis over the whole sweep.
    pub rise: f64,
}

impl CircularArc {
    /// Makes the arc from `start` to `end` about `axis` (right-hand). Equal start and end make a full turn;
    /// `turns_more` full turns are added.
    pub fn from_endpoints(
        start: Point3<f64>,
        end: Point3<f64>,
        center: Point3<f64>,
        axis: Unit<Vector3<f64>>,
        turns_more: u32,
    ) -> Self {
        let from = project_to_plane(start - center, &axis);
        let to = project_to_plane(end - center, &axis);
        // The signed angle from one spoke to the other about the axis.
        let mut sweep = axis.dot(&from.cross(&to)).atan2(from.dot(&to));
        let full = (from - to).norm() <= SAME_POINT;
        if full {
            sweep = TAU;
        } else if sweep <= 0.0 {
            sweep += TAU;
        }
        sweep += TAU * f64::from(turns_more);
        let rise = axis.dot(&(end - start));
        Self { start, center, axis, radius: from.norm(), sweep, rise }
    }

    /// Returns how far start and end are apart across the axis, and the angle between their spokes, if the arc counts as
    /// a full turn because they are so near.
    pub(crate) fn closing_gap(&self, end: Point3<f64>) -> Option<(f64, f64)> {
        let from = project_to_plane(self.start - self.center, &self.axis);
        let to = project_to_plane(end - self.center, &self.axis);
        let gap = (from - to).norm();
        (gap <= SAME_POINT).then(|| (gap, self.axis.dot(&from.cross(&to)).atan2(from.dot(&to))))
    }

    /// Returns the point at a fraction `t` (0 to 1) of the arc.
    pub fn point_at(&self, t: f64) -> Point3<f64> {
        let rotation = nalgebra::Rotation3::from_axis_angle(&self.axis, self.sweep * t);
        self.center + rotation * (self.start - self.center) + self.axis.into_inner() * (self.rise * t)
    }

    /// Returns the unit tangent at a fraction `t`, or zero if the arc has no length.
    pub fn tangent_at(&self, t: f64) -> Vector3<f64> {
        let rotation = nalgebra::Rotation3::from_axis_angle(&self.axis, self.sweep * t);
        let spoke = rotation * project_to_plane(self.start - self.center, &self.axis);
        // The derivative of start rotated by sweep t plus rise t along the axis.
        let derivative = self.axis.cross(&spoke) * self.sweep + self.axis.into_inner() * self.rise;
        derivative.try_normalize(0.0).unwrap_or_default()
    }

    /// Returns the length.
    pub fn length(&self) -> f64 {
        (self.radius * self.sweep).hypot(self.rise)
    }

    /// Returns the distance of the end from the circle: the difference between its distance from the axis and
    /// the radius.
    pub fn end_deviation(&self, end: Point3<f64>) -> f64 {
        (project_to_plane(end - self.center, &self.axis).norm() - self.radius).abs()
    }
}

/// Returns the part of a vector across an axis.
fn project_to_plane(vector: Vector3<f64>, axis: &Unit<Vector3<f64>>) -> Vector3<f64> {
    vector - axis.into_inner() * axis.dot(&vector)
}

/// A clamped cubic B-spline as NX prints it. The first control point is the tool's position, and the leading
/// zero knots and the repeated last knot are left out (measured: the number of CNTRL is that of knots + 2 in
/// 70 of 70).
#[derive(Debug, Clone, PartialEq)]
pub struct Spline {
    /// The control points, including the start.
    pub controls: Vec<Point3<f64>>,
    /// The full knot vector; it has four more entries than there are control points.
    pub knots: Vec<f64>,
}

impl Spline {
    /// Makes the spline of printed knots and control points. Returns `None` if the counts or the order of the
    /// knots do not fit.
    pub fn from_knots(start: Point3<f64>, printed_knots: &[f64], controls: &[Point3<f64>]) -> Option<Self> {
        let last = *printed_knots.last()?;
        let ascending = printed_knots.windows(2).all(|pair| matches!(pair, [a, b] if a <= b));
        if controls.len() != printed_knots.len() + 2
            || !ascending
            || last <= 0.0
            || printed_knots.first()? < &0.0
        {
            return None;
        }
        let knots = [&[0.0; 4], printed_knots, &[last; 3]].concat();
        let controls = std::iter::once(start).chain(controls.iter().copied()).collect();
        Some(Self { controls, knots })
    }

    /// Returns the point at a fraction `t` (0 to 1) of the parameter range, by de Boor's algorithm.
    pub fn point_at(&self, t: f64) -> Point3<f64> {
        let count = self.controls.len();
        let knot = |index: usize| self.knots.get(index).copied().unwrap_or_default();
        let last = knot(self.knots.len().saturating_sub(1));
        let u = t.clamp(0.0, 1.0) * last;
        // The knot span that contains u; the end belongs to the last span that has a length.
        let after = self.knots.partition_point(|&knot| if u < last { knot <= u } else { knot < last });
        let span = after.saturating_sub(1).clamp(3, count.saturating_sub(1).max(3));
        let mut points: Vec<Vector3<f64>> =
            self.controls.iter().skip(span - 3).take(4).map(|point| point.coords).collect();
        // Each level replaces neighbouring points by their weighted means; the last point is the spline's.
        for level in 1..=3 {
            for index in (level..=3).rev() {
                let low = knot(span + index - 3);
                let high = knot(span + index + 1 - level);
                let share = if high > low { (u - low) / (high - low) } else { 0.0 };
                if let (Some(&left), Some(right)) = (points.get(index - 1), points.get(index).copied())
                    && let Some(place) = points.get_mut(index)
                {
                    *place = left * (1.0 - share) + right * share;
                }
            }
        }
        points.get(3).copied().map(Point3::from).unwrap_or_else(Point3::origin)
    }

    /// Returns the unit tangent at the start. It points to the first control point that differs from the
    /// start.
    pub fn start_tangent(&self) -> Vector3<f64> {
        let first = self.controls.first();
        let next =
            first.and_then(|first| self.controls.iter().find(|point| (*point - first).norm() > SAME_POINT));
        match (first, next) {
            (Some(first), Some(next)) => (next - first).normalize(),
            _ => Vector3::zeros(),
        }
    }

    /// Returns the unit tangent at the end.
    pub fn end_tangent(&self) -> Vector3<f64> {
        let last = self.controls.last();
        let before = last
            .and_then(|last| self.controls.iter().rev().find(|point| (last - *point).norm() > SAME_POINT));
        match (before, last) {
            (Some(before), Some(last)) => (last - before).normalize(),
            _ => Vector3::zeros(),
        }
    }

    /// Returns the length, from 16 chords for each knot span (relative error below 1e-3 for the spans that
    /// CAM systems write).
    pub fn length(&self) -> f64 {
        let steps = 16 * self.controls.len().saturating_sub(3).max(1);
        let mut length = 0.0;
        let mut last = self.point_at(0.0);
        for step in 1..=steps {
            let next = self.point_at(step as f64 / steps as f64);
            length += (next - last).norm();
            last = next;
        }
        length
    }
}

/// The direction in which a path ends. Most paths are lines, and few are asked: so the tangent of a line is
/// computed when it is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum PathEnd {
    /// The end of a line: the way from its start to its end, which are not the same point.
    Line(Vector3<f64>),
    /// The unit tangent at the end of any other path.
    Tangent(Vector3<f64>),
}

impl PathEnd {
    /// Returns the end of a line, or `None` if both points are the same or immeasurably far apart.
    pub fn of_line(from: Point3<f64>, to: Point3<f64>) -> Option<Self> {
        let way = to - from;
        let length = way.norm();
        (length > SAME_POINT && length.is_finite()).then_some(Self::Line(way))
    }

    /// Returns the unit tangent.
    pub fn tangent(self) -> Vector3<f64> {
        match self {
            Self::Line(way) => way.normalize(),
            Self::Tangent(tangent) => tangent,
        }
    }
}

impl MotionPath {
    /// Returns the length of the path from `from` to `to`.
    pub fn length(&self, from: Point3<f64>, to: Point3<f64>) -> f64 {
        match self {
            Self::Start => 0.0,
            Self::Line => (to - from).norm(),
            Self::Arc(arc) => arc.length(),
            Self::Spline(spline) => spline.length(),
        }
    }

    /// Returns the end of the path, or `None` if the path has no length and so ends in no direction.
    pub fn end_direction(&self, from: Point3<f64>, to: Point3<f64>) -> Option<PathEnd> {
        let tangent = match self {
            Self::Start => return None,
            Self::Line => return PathEnd::of_line(from, to),
            Self::Arc(arc) => arc.tangent_at(1.0),
            Self::Spline(spline) => spline.end_tangent(),
        };
        (tangent.norm() > 0.5).then_some(PathEnd::Tangent(tangent))
    }

    /// Returns the unit tangent at the end, or `None` if the path has no length.
    pub fn end_tangent(&self, from: Point3<f64>, to: Point3<f64>) -> Option<Vector3<f64>> {
        self.end_direction(from, to).map(PathEnd::tangent)
    }

    /// Returns points on the path that bound it up to the sagitta of arcs: both ends, points on arcs at every
    /// 15 degrees, and samples of splines. They are for boxes and drawings.
    pub fn sample_points(&self, from: Point3<f64>, to: Point3<f64>) -> Vec<Point3<f64>> {
        match self {
            Self::Start => vec![to],
            Self::Line => vec![from, to],
            Self::Arc(arc) => {
                let steps = (arc.sweep / 15f64.to_radians()).ceil().clamp(1.0, 100_000.0) as usize;
                (0..=steps).map(|step| arc.point_at(step as f64 / steps as f64)).collect()
            }
            Self::Spline(spline) => {
                let steps = 8 * spline.controls.len();
                (0..=steps).map(|step| spline.point_at(step as f64 / steps as f64)).collect()
            }
        }
    }
}
