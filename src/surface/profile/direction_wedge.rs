//! Directions from a point, and the longest chord that keeps to them.

use super::chain_piece::{ChainPiece, Point};
use super::chords::ChordVertex;

/// Beyond the last vertex that a chord reaches, it looks this much further (and twice as far again as it has come).
const LOOK_AHEAD: usize = 64;

/// The directions from an anchor in which a chord passes all places so far within the tolerance.
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
    /// Directions that pass a place at (du, dz), farther away than the tolerance.
    fn passing_point((du, dz): (f64, f64), distance: f64, tolerance: f64) -> Self {
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

    /// What both allow; `None` when that is nothing, or when they look opposite ways.
    fn intersect(self, other: Self) -> Option<Self> {
        if dot(self.middle_direction(), other.middle_direction()) <= 0.0 {
            return None;
        }
        let right = if cross(self.right, other.right) > 0.0 { other.right } else { self.right };
        let left = if cross(self.left, other.left) < 0.0 { other.left } else { self.left };
        (cross(right, left) >= 0.0).then_some(Self { right, left })
    }
}

/// The place that the longest chord from `anchor` (between place `at` and the next) reaches: index of the place at or
/// before it, and the point.
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
        // A chain that comes back would not be followed to where it turned.
        if distance < far - tolerance {
            break;
        }
        // What lies this close to the anchor is passed in any direction.
        let near = distance <= tolerance;
        let allowed = wedge.is_none_or(|wedge| wedge.contains(to));
        if allowed && (distance >= far || index == at + 1) {
            best = (index, place.point);
            best_wedge = wedge;
        }
        if place.is_corner() || index > best.0 + LOOK_AHEAD + 2 * (best.0 - at) {
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

/// Goes on along an arc beyond the last place for as far as the wedge allows: by halving, to a millionth of the arc.
fn extend_along_arc(
    run: &[ChordVertex],
    best: (usize, Point),
    wedge: Option<DirectionWedge>,
    anchor: Point,
    tolerance: f64,
) -> (usize, Point) {
    let stop = (best.0, best.1);
    let Some(last) = run.get(best.0).filter(|place| !place.is_corner()) else { return stop };
    let Some(arc) = run.get(best.0 + 1).and_then(ChordVertex::incoming_arc) else { return stop };
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
