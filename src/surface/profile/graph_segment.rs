//! This module holds segments of graphs z(u) over an interval of u, of which envelopes are made.

use super::chain_piece::{ArcPiece, ChainPiece, Point};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A piece that is narrower than this (mm) counts as vertical, since horizontal coordinates differ by no
/// more.
pub(super) const UPRIGHT: f64 = 1e-9;

/// A graph is steep where its slope is larger than this: a rounding of u (1e-13 mm at a metre) then moves its
/// height by more than 1e-10 mm. So u does not tell where it crosses another graph, and its upper end may be
/// above the height that is found there.
const STEEP: f64 = 1e3;

/// The graph of a straight line or of half a circle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum HeightGraph {
    /// The line through two points, of which the first has the smaller u.
    Line { left: Point, right: Point },
    /// The upper or lower half of a circle.
    Round { centre: Point, radius: f64, upper: bool },
}

/// The part of a piece that a segment belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PiecePart {
    /// The interior of the piece.
    Body,
    /// One of its ends (or any single point).
    Vertex,
}

/// A graph between two of its points. The heights of both points are stored, because where a circle is
/// vertical, u only determines a height to the square root of a rounding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GraphSegment {
    pub left: Point,
    pub right: Point,
    pub graph: HeightGraph,
    /// The index of the chain's piece that it comes from.
    pub piece: usize,
    pub part: PiecePart,
}

impl HeightGraph {
    /// Returns the height at u. Beyond its ends a circle continues at the height of its centre.
    pub(super) fn height_at(&self, u: f64) -> f64 {
        match *self {
            Self::Line { left, right } => left.z + (u - left.u) / (right.u - left.u) * (right.z - left.z),
            Self::Round { centre, radius, upper } => {
                let across = u - centre.u;
                // R^2 - d^2 as (R - d)(R + d) loses less to rounding.
                let height = ((radius - across) * (radius + across)).max(0.0).sqrt();
                if upper { centre.z + height } else { centre.z - height }
            }
        }
    }

    /// Returns the absolute slope at u; it is not finite where the graph is vertical.
    pub(super) fn steepness_at(&self, u: f64) -> f64 {
        match *self {
            Self::Line { left, right } => ((right.z - left.z) / (right.u - left.u)).abs(),
            Self::Round { centre, radius, .. } => {
                let across = u - centre.u;
                across.abs() / ((radius - across) * (radius + across)).max(0.0).sqrt()
            }
        }
    }

    /// Returns the values of u between `lo` and `hi` at which two graphs may cross. They ascend, are at most
    /// two, and may include some where the graphs do not cross.
    pub(super) fn find_crossings(&self, other: &Self, lo: f64, hi: f64) -> [Option<f64>; 2] {
        let found = match (*self, *other) {
            (Self::Line { .. }, Self::Line { .. }) => {
                let (at_lo, at_hi) =
                    (self.height_at(lo) - other.height_at(lo), self.height_at(hi) - other.height_at(hi));
                [lo + (hi - lo) * (at_lo / (at_lo - at_hi)), f64::NAN]
            }
            (Self::Line { left, right }, Self::Round { centre, radius, .. })
            | (Self::Round { centre, radius, .. }, Self::Line { left, right }) => {
                intersect_line_circle(left, right, centre, radius)
            }
            (Self::Round { centre: a, radius: ra, .. }, Self::Round { centre: b, radius: rb, .. }) => {
                intersect_circles(a, ra, b, rb)
            }
        };
        // Values that are not numbers are removed here as well.
        let inside = |u: f64| (lo < u && u < hi).then_some(u);
        match found.map(inside) {
            [Some(a), Some(b)] if b < a => [Some(b), Some(a)],
            found => found,
        }
    }
}

/// Returns the values of u at which a line and a circle cross.
fn intersect_line_circle(left: Point, right: Point, centre: Point, radius: f64) -> [f64; 2] {
    let length = left.distance(right);
    let (du, dz) = ((right.u - left.u) / length, (right.z - left.z) / length);
    let along = (centre.u - left.u) * du + (centre.z - left.z) * dz;
    let off = (centre.z - left.z) * du - (centre.u - left.u) * dz;
    // A line that misses by rounding is treated as a tangent, with its nearest point as the result.
    let half = ((radius - off) * (radius + off)).max(0.0).sqrt();
    [left.u + (along - half) * du, left.u + (along + half) * du]
}

/// Returns the values of u at which two circles cross.
fn intersect_circles(a: Point, ra: f64, b: Point, rb: f64) -> [f64; 2] {
    let (du, dz) = (b.u - a.u, b.z - a.z);
    let apart = du.hypot(dz);
    if apart == 0.0 {
        return [f64::NAN; 2];
    }
    let (du, dz) = (du / apart, dz / apart);
    // The distance of the common chord from the first centre: (d^2 + ra^2 - rb^2) / (2 d).
    let along = 0.5 * (apart + (ra - rb) * ((ra + rb) / apart));
    let half = ((ra - along) * (ra + along)).max(0.0).sqrt();
    [a.u + along * du - half * dz, a.u + along * du + half * dz]
}

impl GraphSegment {
    /// Returns the height at u.
    pub(super) fn height_at(&self, u: f64) -> f64 {
        if u == self.left.u {
            self.left.z
        } else if u == self.right.u {
            self.right.z
        } else {
            self.graph.height_at(u)
        }
    }

    /// Returns the point at u.
    pub(super) fn point_at(&self, u: f64) -> Point {
        Point::new(u, self.height_at(u))
    }

    /// Returns the part from `lo` to `hi`, which are both inside.
    pub(super) fn sub_segment(&self, lo: f64, hi: f64) -> Self {
        Self { left: self.point_at(lo), right: self.point_at(hi), ..*self }
    }

    /// Converts the segment to a piece of a chain.
    pub(super) fn to_piece(self) -> ChainPiece {
        let (from, to) = (self.left, self.right);
        match self.graph {
            HeightGraph::Line { .. } => ChainPiece::line(from, to),
            HeightGraph::Round { centre, radius, upper } => {
                // An upper half goes from pi to 0, a lower one from -pi to 0; an end may be slightly beyond
                // by rounding.
                let angle = |point: Point| {
                    let angle = (point.z - centre.z).atan2(point.u - centre.u);
                    match upper {
                        true if angle < -FRAC_PI_2 => angle + TAU,
                        false if angle > FRAC_PI_2 => angle - TAU,
                        _ => angle,
                    }
                };
                let (start, end) = (angle(from), angle(to));
                ChainPiece::arc(centre, radius, start, end - start)
            }
        }
    }
}

/// Gives the parts of a piece that are graphs to `take`, in the order of the piece. A vertical part gives its
/// ends to `top`, and a part that is steep at its upper end gives this end to `top` as well.
pub(super) fn split_into_graphs(
    index: usize,
    piece: &ChainPiece,
    mut take: impl FnMut(GraphSegment, bool),
    mut top: impl FnMut(Point, usize),
) {
    let mut give = |from: Point, to: Point, graph_between: &dyn Fn(Point, Point) -> HeightGraph| {
        let forward = from.u <= to.u;
        let (left, right) = if forward { (from, to) } else { (to, from) };
        if right.u - left.u <= UPRIGHT {
            top(left, index);
            top(right, index);
            return;
        }
        let graph = graph_between(left, right);
        take(GraphSegment { left, right, graph, piece: index, part: PiecePart::Body }, forward);
        let upper = if left.z > right.z { left } else { right };
        if graph.steepness_at(upper.u) > STEEP {
            top(upper, index);
        }
    };
    match piece {
        ChainPiece::Line(line) => {
            give(line.from, line.to, &|left, right| HeightGraph::Line { left, right });
        }
        ChainPiece::Arc(arc) => {
            for (from, to) in split_at_vertical_tangents(arc) {
                let upper = (0.5 * (from + to)).sin() > 0.0;
                give(arc.point_at_angle(from), arc.point_at_angle(to), &|_, _| HeightGraph::Round {
                    centre: arc.centre,
                    radius: arc.radius_mm,
                    upper,
                });
            }
        }
    }
}

/// Returns the angles (from, to) of the parts of an arc between its vertical tangents.
fn split_at_vertical_tangents(arc: &ArcPiece) -> impl Iterator<Item = (f64, f64)> {
    let (start, end) = (arc.start_rad, arc.start_rad + arc.sweep_rad);
    let (low, high) = (start.min(end), start.max(end));
    let first = (low / PI).floor() as i64 + 1;
    // An arc has at most one turn, so there are at most three parts.
    let mut cuts = vec![low];
    cuts.extend((first..first + 3).map(|turn| turn as f64 * PI).filter(|cut| *cut < high));
    cuts.push(high);
    if end < start {
        cuts.reverse();
    }
    let next: Vec<f64> = cuts.iter().skip(1).copied().collect();
    cuts.into_iter().zip(next)
}
