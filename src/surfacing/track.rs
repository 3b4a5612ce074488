//! Passes in space, in the numbers that the program will have.

use super::planes::Planes;
use crate::program::{Dialect, LengthUnit};
use crate::surface::profile::{Chain, Piece, Point};
use crate::write::program::{rounded, rounded_feed};
use nalgebra::{Point3, Vector3};

/// Arcs are cut so that none sweeps more, radians: half a turn or more has no plane of its own.
const MOST_SWEEP: f64 = 2.6;

/// Arcs with ends nearer than so many last decimals are lines.
const SHORT: f64 = 50.0;

/// How numbers are written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Print {
    pub dialect: Dialect,
    pub units: LengthUnit,
}

/// A pass of the tip, in the unit of the program.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track {
    pub start: Point3<f64>,
    pub steps: Vec<Step>,
}

/// A line, or an arc about a centre and a unit axis (right-hand).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub to: Point3<f64>,
    pub arc: Option<(Point3<f64>, Vector3<f64>)>,
}

impl Print {
    /// A point in mm as the program will have it.
    pub fn point(&self, [x, y, z]: [f64; 3]) -> Point3<f64> {
        Point3::new(self.length(x), self.length(y), self.length(z))
    }

    /// A length in mm as the program will have it.
    pub fn length(&self, mm: f64) -> f64 {
        rounded(mm / self.units.in_mm(), self.dialect)
    }

    /// A feed in mm/min as the program will have it.
    pub fn feed(&self, mm: f64) -> f64 {
        rounded_feed(mm / self.units.in_mm(), self.dialect)
    }

    /// The last decimal, mm.
    pub fn last_decimal(&self) -> f64 {
        10f64.powi(-(crate::write::program::decimals(self.dialect) as i32)) * self.units.in_mm()
    }

    /// A point of the program in mm.
    pub fn in_mm(&self, point: Point3<f64>) -> [f64; 3] {
        (point * self.units.in_mm()).into()
    }
}

impl Track {
    /// A tip path in the plane at an offset. Lines no longer than `least` mm between other pieces are left out: a control would stop there.
    /// None when nothing of the path is left in the program's decimals.
    pub fn new(tip: &Chain, planes: &Planes, offset: f64, least: f64, print: Print) -> Option<Self> {
        let space = |at: Point| print.point(planes.point(offset, at.u, at.z));
        let [cos, sin] = planes.direction();
        let mut track = Self { start: space(tip.start()), steps: Vec::new() };
        let last = tip.pieces().len().saturating_sub(1);
        for (index, piece) in tip.pieces().iter().enumerate() {
            if matches!(piece, Piece::Line(_)) && index != 0 && index != last && piece.length() <= least {
                continue;
            }
            let count = match piece {
                Piece::Line(_) => 1,
                Piece::Arc(arc) => (arc.sweep.abs() / MOST_SWEEP).ceil().max(1.0) as u32,
            };
            for part in 1..=count {
                let to = space(piece.point(f64::from(part) / f64::from(count)));
                let from = track.end();
                if to == from {
                    continue;
                }
                let long = (to - from).norm() * print.units.in_mm() > SHORT * print.last_decimal();
                let arc = match piece {
                    Piece::Arc(arc) if long => {
                        let [from, to] = [from, to].map(|point| flat(point, planes, print));
                        let off = (from.distance(arc.centre) - to.distance(arc.centre)).abs();
                        // As far from both ends as they are printed; rounding is none of its business.
                        let near = if off <= 2.0 * print.last_decimal() {
                            arc.centre
                        } else {
                            between(from, to, arc.centre)
                        };
                        let centre = space(near);
                        // From +u towards +z.
                        Some((centre, Vector3::new(sin, -cos, 0.0) * arc.sweep.signum()))
                    }
                    _ => None,
                };
                track.steps.push(Step { to, arc });
            }
        }
        (!track.steps.is_empty()).then_some(track)
    }

    /// Where it ends.
    pub fn end(&self) -> Point3<f64> {
        self.steps.last().map_or(self.start, |step| step.to)
    }

    /// The track as it lies in its plane, mm: what the program says, not what was meant.
    pub fn flat(&self, planes: &Planes, print: Print) -> Option<Chain> {
        let flat = |point: Point3<f64>| flat(point, planes, print);
        let up = |axis: &Vector3<f64>| {
            let [cos, sin] = planes.direction();
            axis.dot(&Vector3::new(sin, -cos, 0.0)) > 0.0
        };
        let mut from = flat(self.start);
        let mut pieces = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            let to = flat(step.to);
            pieces.push(match &step.arc {
                Some((centre, axis)) => arc(from, to, flat(*centre), up(axis)),
                None => Piece::line(from, to),
            });
            from = to;
        }
        Chain::new(pieces).ok()
    }

    /// Its points in mm, arcs in chords no farther than `tolerance` from them.
    pub fn points(&self, planes: &Planes, print: Print, offset: f64, tolerance: f64) -> Vec<[f64; 3]> {
        let mut points = vec![print.in_mm(self.start)];
        let flat = self.flat(planes, print);
        let pieces = flat.iter().flat_map(|chain| chain.pieces());
        for (step, piece) in self.steps.iter().zip(pieces) {
            if let Piece::Arc(arc) = piece {
                let chord = 2.0 * (2.0 * arc.radius * tolerance).sqrt();
                let count = (piece.length() / chord).ceil().max(1.0) as u32;
                points.extend((1..count).map(|part| {
                    let at = piece.point(f64::from(part) / f64::from(count));
                    planes.point(offset, at.u, at.z)
                }));
            }
            points.push(print.in_mm(step.to));
        }
        points
    }
}

/// A point of the program in the plane, mm.
fn flat(point: Point3<f64>, planes: &Planes, print: Print) -> Point {
    let [x, y, z] = print.in_mm(point);
    Point::new(planes.along([x, y]), z)
}

/// The point as far from both ends that is nearest to `centre`.
fn between(from: Point, to: Point, centre: Point) -> Point {
    let length = from.distance(to);
    let middle = from.towards(to, 0.5);
    let (nu, nz) = (-(to.z - from.z) / length, (to.u - from.u) / length);
    let off = (centre.u - middle.u) * nu + (centre.z - middle.z) * nz;
    Point::new(middle.u + nu * off, middle.z + nz * off)
}

/// The arc between two points about the point as far from both that is nearest to `centre`.
fn arc(from: Point, to: Point, centre: Point, counter_clockwise: bool) -> Piece {
    let centre = between(from, to, centre);
    let angle = |point: Point| (point.z - centre.z).atan2(point.u - centre.u);
    let (start, end) = (angle(from), angle(to));
    let sweep = (end - start).rem_euclid(std::f64::consts::TAU);
    let sweep = if counter_clockwise { sweep } else { sweep - std::f64::consts::TAU };
    Piece::arc(centre, centre.distance(from), start, sweep)
}
