//! This module describes a ramp as geometry: its start, and its steps down to the floor.
//!
//! Everything is in millimetres and in the tool's frame: z runs along the tool axis, and the ramp descends.

use geo::{ConvexHull, LineString, MultiPoint};
use nalgebra::{Point2, Point3, Vector2};
use std::f64::consts::TAU;
use std::ops::Range;

/// Directions that differ by more than this (degrees) make a turning point. A smaller difference is the bend
/// of a curve that chords approximate.
const CORNER: f64 = 20.0;

/// Steps shorter than this across the axis (mm) go straight down.
pub(super) const NOTHING: f64 = 1e-3;

/// A leg is straight if its points lie this close to its chord (mm).
const STRAIGHT: f64 = 0.01;

/// Coordinates beyond this (mm) belong to no machine. Their squares and hulls would not be reliable.
const FARTHEST: f64 = 1e9;

/// A ramp: its start P1 and the steps to P2..Pn.
#[derive(Debug, Clone, PartialEq)]
pub struct Ramp {
    /// P1, where the tool begins to descend in the material.
    pub start: Point3<f64>,
    /// The steps down. A ramp that was found has at least one.
    pub steps: Vec<RampStep>,
}

/// A straight step, or an arc about the tool axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RampStep {
    /// The end of the step.
    pub to: Point3<f64>,
    /// The arc of the step. It is `None` for a straight step.
    pub bend: Option<RampArc>,
}

/// The arc of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RampArc {
    /// The centre of the arc.
    pub centre: Point2<f64>,
    /// The sweep in radians, positive counter-clockwise.
    pub sweep: f64,
}

/// A leg: the steps between two turning points.
#[derive(Debug, Clone, PartialEq)]
pub struct RampLeg {
    /// The indices of its steps.
    pub steps: Range<usize>,
    /// The largest distance between two of its points across the axis. For a straight leg it is the length.
    pub extent: f64,
    /// Whether it is straight.
    pub straight: bool,
}

impl RampStep {
    /// Makes a straight step.
    pub fn straight_to(to: Point3<f64>) -> Self {
        Self { to, bend: None }
    }

    /// Returns the length across the axis, from where the step starts.
    pub fn length_across_mm(&self, from: Point3<f64>) -> f64 {
        match self.bend {
            None => (self.to.xy() - from.xy()).norm(),
            Some(bend) => (from.xy() - bend.centre).norm() * bend.sweep.abs(),
        }
    }

    /// Returns the directions across the axis in which the step starts and ends. Returns `None` if it goes
    /// straight down.
    fn end_directions(&self, from: Point3<f64>) -> Option<[Vector2<f64>; 2]> {
        match self.bend {
            None => {
                let offset = self.to.xy() - from.xy();
                (offset.norm() > NOTHING).then(|| [offset.normalize(); 2])
            }
            Some(bend) => {
                let tangent = |at: Point2<f64>| {
                    // The spoke turned by 90 degrees is the tangent of a counter-clockwise arc. The sign of
                    // the sweep reverses it for a clockwise one.
                    let spoke = at - bend.centre;
                    Vector2::new(-spoke.y, spoke.x).try_normalize(0.0).map(|side| side * bend.sweep.signum())
                };
                Some([tangent(from.xy())?, tangent(self.to.xy())?])
            }
        }
    }

    /// Returns points along the step across the axis, without its start. Arcs have a point every 5 degrees.
    /// An arc of many turns is sampled for one turn and the remainder, because the other turns repeat the
    /// same points.
    pub fn sample_points_across(&self, from: Point3<f64>) -> Vec<Point2<f64>> {
        let Some(bend) = self.bend else { return vec![self.to.xy()] };
        let turns = bend.sweep.abs();
        // One turn and the remainder reach the same points as all turns do.
        let sweep = bend.sweep.signum() * if turns > TAU { TAU + wrap_angle(turns) } else { turns };
        let count = (sweep.abs() / 5f64.to_radians()).ceil().max(1.0) as usize;
        let spoke = from.xy() - bend.centre;
        let inner = (1..count).map(|index| {
            let angle = sweep * index as f64 / count as f64;
            bend.centre + nalgebra::Rotation2::new(angle) * spoke
        });
        inner.chain([self.to.xy()]).collect()
    }
}

impl Ramp {
    /// Makes a ramp of straight steps through points. Returns `None` for fewer than two points.
    pub fn from_points(points: &[Point3<f64>]) -> Option<Self> {
        let (start, rest) = points.split_first()?;
        (!rest.is_empty()).then(|| Self {
            start: *start,
            steps: rest.iter().map(|to| RampStep::straight_to(*to)).collect(),
        })
    }

    /// Returns Pn.
    pub fn end_point(&self) -> Point3<f64> {
        self.steps.last().map_or(self.start, |step| step.to)
    }

    /// Returns how far the ramp descends.
    pub fn height_mm(&self) -> f64 {
        self.start.z - self.end_point().z
    }

    /// Returns each step with its start.
    pub fn steps_with_starts(&self) -> impl Iterator<Item = (Point3<f64>, &RampStep)> {
        let starts = std::iter::once(self.start).chain(self.steps.iter().map(|step| step.to));
        starts.zip(&self.steps)
    }

    /// Returns P1..Pn and the points between them.
    pub fn points(&self) -> impl Iterator<Item = Point3<f64>> {
        std::iter::once(self.start).chain(self.steps.iter().map(|step| step.to))
    }

    /// Returns the point before the step with an index. For index 0 it is P1, and after the last step it is
    /// Pn.
    pub(super) fn point_before_step(&self, index: usize) -> Point3<f64> {
        index
            .checked_sub(1)
            .map_or(self.start, |before| self.steps.get(before).map_or(self.end_point(), |step| step.to))
    }

    /// Returns the steps from the first one that descends to the last one. The steps before and after them
    /// are level links.
    pub(super) fn descending_steps(&self) -> Range<usize> {
        let down = |index: &usize| self.point_before_step(*index).z > self.point_before_step(index + 1).z;
        let mut found = (0..self.steps.len()).filter(down);
        match found.next() {
            Some(first) => first..found.next_back().unwrap_or(first) + 1,
            None => 0..0,
        }
    }

    /// Returns the path across the axis from P1 to Pn, with sampled arcs.
    pub(super) fn path_across(&self) -> Vec<Point2<f64>> {
        let mut path = vec![self.start.xy()];
        path.extend(self.steps_with_starts().flat_map(|(from, step)| step.sample_points_across(from)));
        path
    }

    /// Returns whether all coordinates and angles are numbers of a plausible size.
    pub(super) fn is_sensible(&self) -> bool {
        let bends = self.steps.iter().filter_map(|step| step.bend);
        let bends = bends.flat_map(|bend| [bend.centre.x, bend.centre.y, bend.sweep]);
        self.points().flat_map(|point| [point.x, point.y, point.z]).chain(bends).all(is_sensible)
    }

    /// Returns whether the ramp ends directly above or below its start.
    pub fn is_closed(&self) -> bool {
        (self.end_point().xy() - self.start.xy()).norm() <= NOTHING
    }

    /// Returns the length of the path.
    pub fn length_mm(&self) -> f64 {
        self.steps_with_starts()
            .map(|(from, step)| step.length_across_mm(from).hypot(step.to.z - from.z))
            .sum()
    }

    /// Returns the tangent of the steepest step's angle. It is infinite if a step goes straight down.
    pub fn steepest_slope(&self) -> f64 {
        let slope = |(from, step): (Point3<f64>, &RampStep)| {
            let (down, across) = (from.z - step.to.z, step.length_across_mm(from));
            if down <= 0.0 {
                0.0
            // Over so short a length the last printed digits alone would decide the slope.
            } else if across <= NOTHING {
                f64::INFINITY
            } else {
                down / across
            }
        };
        self.steps_with_starts().map(slope).fold(0.0, f64::max)
    }

    /// Returns the legs that descend, in order.
    pub fn descending_legs(&self) -> Vec<RampLeg> {
        let mut bounds = vec![0];
        let mut before: Option<Option<Vector2<f64>>> = None;
        for (index, (from, step)) in self.steps_with_starts().enumerate() {
            let directions = step.end_directions(from);
            // A repeated point is no turning point.
            if directions.is_none() && (from.z - step.to.z).abs() <= NOTHING {
                continue;
            }
            let turns = match (before, directions) {
                (None, _) => false,
                // Directions are unit vectors, so their dot product is the cosine of the turn.
                (Some(Some(end)), Some([start, _])) => end.dot(&start) < CORNER.to_radians().cos(),
                (Some(None), None) => false,
                (Some(_), _) => true,
            };
            if turns {
                bounds.push(index);
            }
            before = Some(directions.map(|[_, end]| end));
        }
        bounds.push(self.steps.len());
        let ranges = bounds.windows(2).filter_map(|pair| match pair {
            [start, end] if start < end => Some(*start..*end),
            _ => None,
        });
        ranges.filter(|steps| self.has_descent(steps)).map(|steps| self.build_leg(steps)).collect()
    }

    fn has_descent(&self, steps: &Range<usize>) -> bool {
        steps.clone().any(|index| self.point_before_step(index).z > self.point_before_step(index + 1).z)
    }

    fn build_leg(&self, steps: Range<usize>) -> RampLeg {
        let mut points = vec![self.point_before_step(steps.start).xy()];
        for (index, step) in steps.clone().zip(self.steps.iter().skip(steps.start)) {
            points.extend(step.sample_points_across(self.point_before_step(index)));
        }
        let (first, last) = match (points.first(), points.last()) {
            (Some(first), Some(last)) => (*first, *last),
            _ => (Point2::origin(), Point2::origin()),
        };
        let chord = last - first;
        let beside = |point: &Point2<f64>| {
            let along = chord.try_normalize(NOTHING).unwrap_or_default();
            let offset = point - first;
            (offset - along * along.dot(&offset)).norm()
        };
        let straight = points.iter().all(|point| beside(point) <= STRAIGHT);
        // A curved leg may come back to its start, so its chord says nothing. What counts is how far the
        // middle of the cutter, which does not cut, gets away from where it was.
        let extent = if straight { chord.norm() } else { largest_distance(&points) };
        RampLeg { steps, extent, straight }
    }
}

/// Returns whether a coordinate (mm) or an angle is a number of a plausible size. The convex hull accepts no
/// others.
pub(super) fn is_sensible(value: f64) -> bool {
    value.abs() <= FARTHEST
}

/// Returns the largest distance between two of the points. Only vertices of the convex hull can have it.
fn largest_distance(points: &[Point2<f64>]) -> f64 {
    let sensible = points.iter().filter(|point| is_sensible(point.x) && is_sensible(point.y));
    let all: MultiPoint = sensible.map(|point| geo::Point::new(point.x, point.y)).collect();
    let hull: LineString = all.convex_hull().exterior().clone();
    let vertices: Vec<Point2<f64>> = hull.coords().map(|at| Point2::new(at.x, at.y)).collect();
    let mut widest = 0.0f64;
    for (index, one) in vertices.iter().enumerate() {
        for other in vertices.iter().skip(index + 1) {
            widest = widest.max((other - one).norm());
        }
    }
    widest
}

/// Returns an angle reduced to `[0, 2 pi)`.
pub(super) fn wrap_angle(angle: f64) -> f64 {
    angle.rem_euclid(TAU)
}
