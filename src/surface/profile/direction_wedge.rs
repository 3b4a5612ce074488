//! This module holds the directions from a point that pass some vertices, and finds the longest chord in
//! them.

use super::chain_piece::{ChainPiece, Point};
use super::chord_vertex::ChordVertex;

/// The search continues by this many vertices beyond the last one that a chord reaches, and by twice as many
/// as the chord has.
const LOOK_AHEAD: usize = 64;

/// The wedge of directions from an anchor in which a chord passes all vertices so far within the tolerance.
#[derive(Clone, Copy)]
struct DirectionWedge {
    right: (f64, f64),
    left: (f64, f64),
}

fn cross(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

fn dot(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

impl DirectionWedge {
    /// Makes the wedge of directions that pass a point at (du, dz), which is further away than the tolerance.
    fn passing_point((du, dz): (f64, f64), distance: f64, tolerance: f64) -> Self {
        // The wedge has the half angle asin(tolerance / distance) around the direction of the point.
        let (du, dz) = (du / distance, dz / distance);
        let sin = tolerance / distance;
        let cos = (1.0 - sin * sin).max(0.0).sqrt();
        Self {
            right: (du * cos + dz * sin, dz * cos - du * sin),
            left: (du * cos - dz * sin, dz * cos + du * sin),
        }
    }

    fn middle_direction(&self) -> (f64, f64) {
        (self.right.0 + self.left.0, self.right.1 + self.left.1)
    }

    fn contains(&self, direction: (f64, f64)) -> bool {
        dot(self.middle_direction(), direction) > 0.0
            && cross(self.right, direction) >= 0.0
            && cross(direction, self.left) >= 0.0
    }

    /// Returns the intersection, or `None` if it is empty or the wedges have opposite directions.
    fn intersect(self, other: Self) -> Option<Self> {
        if dot(self.middle_direction(), other.middle_direction()) <= 0.0 {
            return None;
        }
        let right = if cross(self.right, other.right) > 0.0 { other.right } else { self.right };
        let left = if cross(self.left, other.left) < 0.0 { other.left } else { self.left };
        (cross(right, left) >= 0.0).then_some(Self { right, left })
    }
}

/// Finds the point that the longest chord from `anchor` (between vertex `at` and the next) reaches. Returns
/// the index of the vertex at or before that point, and the point.
pub(super) fn find_longest_chord(
    run: &[ChordVertex],
    at: usize,
    anchor: Point,
    tolerance: f64,
) -> (usize, Point) {
    let mut wedge: Option<DirectionWedge> = None;
    let mut best = (at + 1, run.get(at + 1).map_or(anchor, |place| place.point));
    let mut best_wedge = None;
    let mut far = 0.0_f64;
    for (index, place) in run.iter().enumerate().skip(at + 1) {
        let to = (place.point.u - anchor.u, place.point.z - anchor.z);
        let distance = dot(to, to).sqrt();
        // A chord to a chain that comes back would not reach the point where the chain turned.
        if distance < far - tolerance {
            break;
        }
        // A vertex this close to the anchor is passed by chords in any direction.
        let near = distance <= tolerance;
        let allowed = wedge.is_none_or(|wedge| wedge.contains(to));
        if allowed && (distance >= far || index == at + 1) {
            best = (index, place.point);
            best_wedge = wedge;
        }
        if place.corner || index > best.0 + LOOK_AHEAD + 2 * (best.0 - at) {
            break;
        }
        far = far.max(distance);
        if !near {
            let past = DirectionWedge::passing_point(to, distance, tolerance);
            match wedge.map_or(Some(past), |wedge| wedge.intersect(past)) {
                Some(both) => wedge = Some(both),
                None => break,
            }
        }
    }
    extend_along_arc(run, best, best_wedge, anchor, tolerance)
}

/// Extends the chord along an arc beyond the last vertex as far as the wedge allows, by bisection to a
/// millionth of the arc.
fn extend_along_arc(
    run: &[ChordVertex],
    best: (usize, Point),
    wedge: Option<DirectionWedge>,
    anchor: Point,
    tolerance: f64,
) -> (usize, Point) {
    let stop = (best.0, best.1);
    let Some(last) = run.get(best.0).filter(|place| !place.corner) else { return stop };
    let Some(arc) = run.get(best.0 + 1).and_then(|vertex| vertex.arc) else { return stop };
    let to = (last.point.u - anchor.u, last.point.z - anchor.z);
    let distance = dot(to, to).sqrt();
    let wedge = if distance > tolerance {
        let past = DirectionWedge::passing_point(to, distance, tolerance);
        match wedge.map_or(Some(past), |wedge| wedge.intersect(past)) {
            Some(both) => both,
            None => return stop,
        }
    } else {
        return stop;
    };
    let piece = ChainPiece::Arc(arc);
    let allowed = |share: f64| {
        let point = piece.point_at(share);
        let to = (point.u - anchor.u, point.z - anchor.z);
        wedge.contains(to) && dot(to, to).sqrt() >= distance
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if allowed(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    if low > 0.0 { (best.0, piece.point_at(low)) } else { stop }
}
