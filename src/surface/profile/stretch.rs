//! Stretches: graphs z(u) over an interval of u, of which envelopes are made.

use super::piece::{Arc, Piece, Point};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// What is narrower than this (mm) counts as upright: horizontal places differ by no more.
pub(super) const UPRIGHT: f64 = 1e-9;

/// The graph of a straight line or of half a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Graph {
    /// Through two points, the first with the smaller u.
    Line { left: Point, right: Point },
    /// The upper or lower half of a circle.
    Round { centre: Point, radius: f64, upper: bool },
}

/// Which part of a piece a stretch belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Part {
    /// Its inside.
    Body,
    /// One of its ends (or any single point).
    Vertex,
}

/// A graph between two of its points. Their heights are kept: where a circle is upright, u tells a height only to the root of a
/// rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stretch {
    pub left: Point,
    pub right: Point,
    pub graph: Graph,
    /// Index of the piece of the chain that it comes from.
    pub piece: usize,
    pub part: Part,
}

impl Graph {
    /// Height at u; beyond its ends a circle goes on at its middle height.
    pub fn at(&self, u: f64) -> f64 {
        match *self {
            Self::Line { left, right } => left.z + (u - left.u) / (right.u - left.u) * (right.z - left.z),
            Self::Round { centre, radius, upper } => {
                let across = u - centre.u;
                let height = ((radius - across) * (radius + across)).max(0.0).sqrt();
                if upper { centre.z + height } else { centre.z - height }
            }
        }
    }

    /// Steepness at u; not finite where it is upright.
    pub fn steepness(&self, u: f64) -> f64 {
        match *self {
            Self::Line { left, right } => ((right.z - left.z) / (right.u - left.u)).abs(),
            Self::Round { centre, radius, .. } => {
                let across = u - centre.u;
                across.abs() / ((radius - across) * (radius + across)).max(0.0).sqrt()
            }
        }
    }

    /// Where two graphs may cross between `lo` and `hi`: ascending, at most two, possibly some where they do not.
    pub fn crossings(&self, other: &Self, lo: f64, hi: f64) -> [Option<f64>; 2] {
        let found = match (*self, *other) {
            (Self::Line { .. }, Self::Line { .. }) => {
                let (at_lo, at_hi) = (self.at(lo) - other.at(lo), self.at(hi) - other.at(hi));
                [lo + (hi - lo) * (at_lo / (at_lo - at_hi)), f64::NAN]
            }
            (Self::Line { left, right }, Self::Round { centre, radius, .. })
            | (Self::Round { centre, radius, .. }, Self::Line { left, right }) => {
                line_and_circle(left, right, centre, radius)
            }
            (Self::Round { centre: a, radius: ra, .. }, Self::Round { centre: b, radius: rb, .. }) => {
                circles(a, ra, b, rb)
            }
        };
        // Not-a-number falls out here as well.
        let inside = |u: f64| (lo < u && u < hi).then_some(u);
        match found.map(inside) {
            [Some(a), Some(b)] if b < a => [Some(b), Some(a)],
            found => found,
        }
    }
}

fn line_and_circle(left: Point, right: Point, centre: Point, radius: f64) -> [f64; 2] {
    let length = left.distance(right);
    let (du, dz) = ((right.u - left.u) / length, (right.z - left.z) / length);
    let along = (centre.u - left.u) * du + (centre.z - left.z) * dz;
    let off = (centre.z - left.z) * du - (centre.u - left.u) * dz;
    // A line that misses by rounding is a tangent: where it is nearest is the place to look at.
    let half = ((radius - off) * (radius + off)).max(0.0).sqrt();
    [left.u + (along - half) * du, left.u + (along + half) * du]
}

fn circles(a: Point, ra: f64, b: Point, rb: f64) -> [f64; 2] {
    let (du, dz) = (b.u - a.u, b.z - a.z);
    let apart = du.hypot(dz);
    if apart == 0.0 {
        return [f64::NAN; 2];
    }
    let (du, dz) = (du / apart, dz / apart);
    let along = 0.5 * (apart + (ra - rb) * ((ra + rb) / apart));
    let half = ((ra - along) * (ra + along)).max(0.0).sqrt();
    [a.u + along * du - half * dz, a.u + along * du + half * dz]
}

impl Stretch {
    /// Height at u.
    pub fn at(&self, u: f64) -> f64 {
        if u == self.left.u {
            self.left.z
        } else if u == self.right.u {
            self.right.z
        } else {
            self.graph.at(u)
        }
    }

    /// Its point at u.
    pub fn point(&self, u: f64) -> Point {
        Point::new(u, self.at(u))
    }

    /// The part of it from `lo` to `hi`, both inside.
    pub fn part(&self, lo: f64, hi: f64) -> Self {
        Self { left: self.point(lo), right: self.point(hi), ..*self }
    }

    /// The piece of a chain from `lo` to `hi`.
    pub fn as_piece(&self) -> Piece {
        let (from, to) = (self.left, self.right);
        match self.graph {
            Graph::Line { .. } => Piece::line(from, to),
            Graph::Round { centre, radius, upper } => {
                // An upper half goes from pi to 0, a lower one from -pi to 0; an end may lie a rounding beyond.
                let angle = |point: Point| {
                    let angle = (point.z - centre.z).atan2(point.u - centre.u);
                    match upper {
                        true if angle < -FRAC_PI_2 => angle + TAU,
                        false if angle > FRAC_PI_2 => angle - TAU,
                        _ => angle,
                    }
                };
                let (start, end) = (angle(from), angle(to));
                Piece::arc(centre, radius, start, end - start)
            }
        }
    }
}

/// Gives `take` the parts of a piece that are graphs, in the piece's order; an upright part gives its ends to `top`.
pub(super) fn graphs(
    index: usize,
    piece: &Piece,
    mut take: impl FnMut(Stretch, bool),
    mut top: impl FnMut(Point, usize),
) {
    let part = Part::Body;
    match piece {
        Piece::Line(line) => {
            let forward = line.to.u >= line.from.u;
            let (left, right) = if forward { (line.from, line.to) } else { (line.to, line.from) };
            if right.u - left.u > UPRIGHT {
                let graph = Graph::Line { left, right };
                take(Stretch { left, right, graph, piece: index, part }, forward);
            } else {
                top(left, index);
                top(right, index);
            }
        }
        Piece::Arc(arc) => {
            for (from, to) in halves(arc) {
                let (a, b) = (arc.at_angle(from), arc.at_angle(to));
                let upper = (0.5 * (from + to)).sin() > 0.0;
                let (left, right) = if a.u <= b.u { (a, b) } else { (b, a) };
                if right.u - left.u > UPRIGHT {
                    let graph = Graph::Round { centre: arc.centre, radius: arc.radius, upper };
                    take(Stretch { left, right, graph, piece: index, part }, a.u <= b.u);
                } else {
                    top(left, index);
                    top(right, index);
                }
            }
        }
    }
}

/// The angles from..to of an arc's parts between its upright tangents.
fn halves(arc: &Arc) -> impl Iterator<Item = (f64, f64)> {
    let (start, end) = (arc.start, arc.start + arc.sweep);
    let (low, high) = (start.min(end), start.max(end));
    let first = (low / PI).floor() as i64 + 1;
    // At most one turn: no more than three parts.
    let mut cuts = vec![low];
    cuts.extend((first..first + 3).map(|turn| turn as f64 * PI).filter(|cut| *cut < high));
    cuts.push(high);
    if end < start {
        cuts.reverse();
    }
    let next: Vec<f64> = cuts.iter().skip(1).copied().collect();
    cuts.into_iter().zip(next)
}
