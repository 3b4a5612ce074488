//! This module holds stock that a closed mesh of triangles bounds.
//!
//! The gap is the distance from the nearest triangle, with the sign of the winding number. A hull of points is
//! outside if its middle is, and if a plane separates it from all triangles that are near enough to matter: the
//! part of the surroundings beyond the plane is convex and without surface, so it is as outside as the middle.

use super::cutter_pose::PointLine;
use super::stock_gap::{HullMargin, StockGap, add_times_beyond};
use super::triangle_tree::TriangleTree;
use nalgebra::Vector3;
use std::collections::HashMap;

/// The reason why triangles do not make a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshGapError {
    /// There is no triangle.
    Empty,
    /// A coordinate is not finite.
    NotFinite,
    /// An edge has no neighbour of the opposite sense. Corners of neighbours must have equal coordinates.
    NotClosed,
    /// The triangles turn inwards.
    TurnedInwards,
}

/// A body within a closed mesh. Triangles turn counter-clockwise as seen from outside.
#[derive(Debug, Clone)]
pub struct MeshGap {
    tree: TriangleTree,
}

/// The most spans of time of one question.
const MOST_SPANS: usize = 160;

impl MeshGap {
    /// Makes the body from triangles, mm.
    ///
    /// # Errors
    /// Returns an error if the triangles do not bound a body.
    pub fn new(triangles: &[[Vector3<f64>; 3]]) -> Result<Self, MeshGapError> {
        if triangles.is_empty() {
            return Err(MeshGapError::Empty);
        }
        if triangles.iter().flatten().flat_map(Vector3::iter).any(|part| !part.is_finite()) {
            return Err(MeshGapError::NotFinite);
        }
        // Every edge has as many neighbours in its own sense as in the opposite one.
        let mut edges: HashMap<[[u64; 3]; 2], i64> = HashMap::new();
        // Adding zero makes a negative zero positive.
        let key = |point: &Vector3<f64>| [point.x, point.y, point.z].map(|part| (part + 0.0).to_bits());
        let mut volume = 0.0;
        for [a, b, c] in triangles {
            volume += a.dot(&b.cross(c));
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (from, to) = (key(from), key(to));
                let (edge, sense) = if from < to { ([from, to], 1) } else { ([to, from], -1) };
                if from != to {
                    *edges.entry(edge).or_insert(0) += sense;
                }
            }
        }
        if edges.values().any(|sum| *sum != 0) {
            return Err(MeshGapError::NotClosed);
        }
        if volume <= 0.0 {
            return Err(MeshGapError::TurnedInwards);
        }
        Ok(Self { tree: TriangleTree::new(triangles) })
    }

    /// Adds the times within a span at which a plane separates a hull from the surface. Returns whether that
    /// is the whole span, or whether nothing is to be found in it.
    fn add_separated(
        &self,
        lines: &[PointLine],
        span: [f64; 2],
        radius: f64,
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) -> bool {
        let Some(middle) = lines.first() else { return true };
        let [from, to] = span;
        let place = middle.at((from + to) / 2.0);
        let half = middle.travel.norm() * (to - from) / 2.0;
        let (distance, nearest) = self.tree.nearest(&place);
        let is_inside = self.tree.winding(&place) > 0.5;
        if is_inside {
            return distance > half;
        }
        if distance > radius + half {
            out.push(span);
            return true;
        }
        let Some(normal) = (place - nearest).try_normalize(1e-9) else { return false };
        let offset = self.tree.farthest_along(&place, radius + half, &normal);
        if normal.dot(&place) <= offset {
            return false;
        }
        let mut found = Vec::new();
        add_times_beyond(lines, &normal, offset, margin, &mut found);
        let clipped = found.iter().map(|[a, b]| [a.max(from), b.min(to)]).filter(|[a, b]| a <= b);
        let before = out.len();
        out.extend(clipped);
        out.get(before..).is_some_and(|new| new.contains(&span))
    }
}

impl StockGap for MeshGap {
    fn gap(&self, point: &Vector3<f64>) -> f64 {
        let (distance, _) = self.tree.nearest(point);
        if self.tree.winding(point) > 0.5 { -distance } else { distance }
    }

    fn bounds(&self) -> [Vector3<f64>; 2] {
        self.tree.bounds()
    }

    fn add_outside_times(
        &self,
        lines: &[PointLine],
        need: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        let Some(middle) = lines.first() else { return };
        let apart = |line: &PointLine, time: f64| (line.at(time) - middle.at(time)).norm();
        let spread = lines.iter().map(|line| apart(line, need[0]).max(apart(line, need[1])));
        let radius = spread.fold(0.0, f64::max) + margin.all + margin.skew;
        let speed = middle.travel.norm();
        let mut waiting = std::collections::VecDeque::from([need]);
        let mut spans = 0;
        while let Some([from, to]) = waiting.pop_front() {
            spans += 1;
            let is_done = self.add_separated(lines, [from, to], radius, margin, out);
            // A span over which nothing moves much is not better known in halves.
            let is_small = speed * (to - from) < (radius * 0.1).max(1e-7);
            if !is_done && !is_small && spans + waiting.len() < MOST_SPANS {
                let middle = (from + to) / 2.0;
                waiting.push_back([from, middle]);
                waiting.push_back([middle, to]);
            }
        }
    }
}
