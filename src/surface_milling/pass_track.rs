//! This module holds passes in space, in the rounded numbers that the program will have.

use super::pass_planes::PassPlanes;
use crate::program::{Dialect, LengthUnit};
use crate::surface::profile::{Chain, ChainPiece, Point};
use crate::write::new_program::{round_coordinate, round_feed};
use nalgebra::{Point3, Vector3};

/// The largest sweep of an arc, radians; longer arcs are divided. An arc of half a turn or more does not
/// define its plane.
const MOST_SWEEP: f64 = 2.6;

/// An arc whose ends are nearer to each other than this many last decimals becomes a line.
const SHORT: f64 = 50.0;

/// The way in which numbers are rounded when they are written.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProgramRounding {
    pub dialect: Dialect,
    pub units: LengthUnit,
}

/// A pass of the tip, in the unit of the program.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PassTrack {
    pub start: Point3<f64>,
    pub steps: Vec<TrackStep>,
}

/// A line, or an arc around a centre and a unit axis in the right-hand direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TrackStep {
    pub to: Point3<f64>,
    pub arc: Option<(Point3<f64>, Vector3<f64>)>,
}

impl ProgramRounding {
    /// Converts a point from mm to the rounded numbers of the program.
    pub(super) fn round_point(&self, [x, y, z]: [f64; 3]) -> Point3<f64> {
        Point3::new(self.round_length(x), self.round_length(y), self.round_length(z))
    }

    /// Converts a length from mm to the rounded number of the program.
    pub(super) fn round_length(&self, length_mm: f64) -> f64 {
        round_coordinate(length_mm / self.units.mm_per_unit(), self.dialect)
    }

    /// Converts a feed from mm/min to the rounded number of the program.
    pub(super) fn round_feed(&self, feed_mm_min: f64) -> f64 {
        round_feed(feed_mm_min / self.units.mm_per_unit(), self.dialect)
    }

    /// Returns one unit of the last decimal, mm.
    pub(super) fn last_decimal_mm(&self) -> f64 {
        10f64.powi(-(crate::write::new_program::coordinate_decimals(self.dialect) as i32))
            * self.units.mm_per_unit()
    }

    /// Converts a point of the program to mm.
    pub(super) fn point_in_mm(&self, point: Point3<f64>) -> [f64; 3] {
        (point * self.units.mm_per_unit()).into()
    }
}

impl PassTrack {
    /// Converts a tip path in the plane at an offset to a track. Lines of at most `least_mm` between other
    /// pieces are left out, because a control would stop there. Returns `None` if nothing of the path is left
    /// in the program's decimals.
    pub(super) fn new(
        tip: &Chain,
        planes: &PassPlanes,
        offset_mm: f64,
        least_mm: f64,
        print: ProgramRounding,
    ) -> Option<Self> {
        let space = |at: Point| print.round_point(planes.point_at(offset_mm, at.u, at.z));
        let [cos, sin] = planes.direction();
        let mut track = Self { start: space(tip.start()), steps: Vec::new() };
        let last = tip.pieces().len().saturating_sub(1);
        for (index, piece) in tip.pieces().iter().enumerate() {
            if matches!(piece, ChainPiece::Line(_))
                && index != 0
                && index != last
                && piece.length_mm() <= least_mm
            {
                continue;
            }
            let count = match piece {
                ChainPiece::Line(_) => 1,
                ChainPiece::Arc(arc) => (arc.sweep_rad.abs() / MOST_SWEEP).ceil().max(1.0) as u32,
            };
            for part in 1..=count {
                let to = space(piece.point_at(f64::from(part) / f64::from(count)));
                let from = track.end_point();
                if to == from {
                    continue;
                }
                let long = (to - from).norm() * print.units.mm_per_unit() > SHORT * print.last_decimal_mm();
                let arc = match piece {
                    ChainPiece::Arc(arc) if long => {
                        let [from, to] = [from, to].map(|point| point_in_plane(point, planes, print));
                        let off = (from.distance(arc.centre) - to.distance(arc.centre)).abs();
                        // The centre must be equally far from both printed ends. A difference within rounding
                        // does not need a correction.
                        let near = if off <= 2.0 * print.last_decimal_mm() {
                            arc.centre
                        } else {
                            nearest_equidistant_point(from, to, arc.centre)
                        };
                        let centre = space(near);
                        // The axis is that of a turn from +u towards +z.
                        Some((centre, Vector3::new(sin, -cos, 0.0) * arc.sweep_rad.signum()))
                    }
                    _ => None,
                };
                track.steps.push(TrackStep { to, arc });
            }
        }
        (!track.steps.is_empty()).then_some(track)
    }

    /// Returns the end of the track.
    pub(super) fn end_point(&self) -> Point3<f64> {
        self.steps.last().map_or(self.start, |step| step.to)
    }

    /// Returns the track in its plane, mm. It consists of the printed numbers, not of those that were
    /// intended.
    pub(super) fn to_plane_chain(&self, planes: &PassPlanes, print: ProgramRounding) -> Option<Chain> {
        let flat = |point: Point3<f64>| point_in_plane(point, planes, print);
        let up = |axis: &Vector3<f64>| {
            let [cos, sin] = planes.direction();
            axis.dot(&Vector3::new(sin, -cos, 0.0)) > 0.0
        };
        let mut from = flat(self.start);
        let mut pieces = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let to = flat(step.to);
            pieces.push(match &step.arc {
                Some((centre, axis)) => arc_between(from, to, flat(*centre), up(axis)),
                None => ChainPiece::line(from, to),
            });
            from = to;
        }
        Chain::new(pieces).ok()
    }

    /// Returns points along the track in mm; arcs become chords that are at most `tolerance_mm` from them.
    pub(super) fn sample_points(
        &self,
        planes: &PassPlanes,
        print: ProgramRounding,
        offset_mm: f64,
        tolerance_mm: f64,
    ) -> Vec<[f64; 3]> {
        let mut points = vec![print.point_in_mm(self.start)];
        let flat = self.to_plane_chain(planes, print);
        let pieces = flat.iter().flat_map(|chain| chain.pieces());
        for (step, piece) in self.steps.iter().zip(pieces) {
            if let ChainPiece::Arc(arc) = piece {
                // The chord whose sagitta is the tolerance: 2 sqrt(2 r tolerance).
                let chord = 2.0 * (2.0 * arc.radius_mm * tolerance_mm).sqrt();
                let count = (piece.length_mm() / chord).ceil().max(1.0) as u32;
                points.extend((1..count).map(|part| {
                    let at = piece.point_at(f64::from(part) / f64::from(count));
                    planes.point_at(offset_mm, at.u, at.z)
                }));
            }
            points.push(print.point_in_mm(step.to));
        }
        points
    }
}

/// Converts a point of the program to coordinates of the plane, mm.
fn point_in_plane(point: Point3<f64>, planes: &PassPlanes, print: ProgramRounding) -> Point {
    let [x, y, z] = print.point_in_mm(point);
    Point::new(planes.distance_along([x, y]), z)
}

/// Returns the point nearest to `centre` that is equally far from both ends.
fn nearest_equidistant_point(from: Point, to: Point, centre: Point) -> Point {
    let length = from.distance(to);
    let middle = from.lerp(to, 0.5);
    // The centre is projected on the perpendicular bisector of the chord.
    let (nu, nz) = (-(to.z - from.z) / length, (to.u - from.u) / length);
    let off = (centre.u - middle.u) * nu + (centre.z - middle.z) * nz;
    Point::new(middle.u + nu * off, middle.z + nz * off)
}

/// Returns the arc between two points around the point nearest to `centre` that is equally far from both.
fn arc_between(from: Point, to: Point, centre: Point, counter_clockwise: bool) -> ChainPiece {
    let centre = nearest_equidistant_point(from, to, centre);
    let angle = |point: Point| (point.z - centre.z).atan2(point.u - centre.u);
    let (start, end) = (angle(from), angle(to));
    let sweep = (end - start).rem_euclid(std::f64::consts::TAU);
    let sweep = if counter_clockwise { sweep } else { sweep - std::f64::consts::TAU };
    ChainPiece::arc(centre, centre.distance(from), start, sweep)
}
