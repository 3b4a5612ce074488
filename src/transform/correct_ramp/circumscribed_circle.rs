//! This module lengthens legs on a circumscribed circle (Zhou 2020, "ramp length correction").

use nalgebra::{Point2, Rotation2, Vector2};
use std::f64::consts::{PI, TAU};

/// The side of the chord P1-Pn on which the circle bulges.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BulgeSide {
    /// Left of P1 -> Pn. A closed ramp then runs counter-clockwise.
    Left,
    /// Right of P1 -> Pn. A closed ramp then runs clockwise.
    Right,
}

impl BulgeSide {
    /// Returns the other side.
    #[must_use]
    pub fn mirrored(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// Returns the angle of the arc P1..Pn (radians, in `(0, 2 pi)`) on which `legs` equal chords have the length
/// `leg`, over a chord of length `s`.
///
/// With e as the signed distance of the centre from the chord, the arc is 180 deg + 2 atan(2e/s). The two
/// cases of the paper then become one equation, `leg = s sin(arc / 2 legs) / sin(arc / 2)`. Its right side
/// grows with the arc from `s / legs` to infinity. Returns `None` if `leg` is not above `s / legs`, because
/// then the points lie on the chord.
pub fn find_arc_angle(s: f64, leg: f64, legs: usize) -> Option<f64> {
    let count = legs as f64;
    // Legs that just reach from end to end lie on the chord. Any arc that was found for them would be nothing
    // but rounding.
    if leg * count <= s * (1.0 + 1e-12) {
        return None;
    }
    // The equation is multiplied by sin(arc / 2), which is 0 at both ends of the interval.
    let too_short = |arc: f64| s * (arc / (2.0 * count)).sin() < leg * (arc / 2.0).sin();
    let (mut low, mut high) = (0.0, TAU);
    // The right side grows with the arc, so bisection finds it. After 60 steps no double lies between the
    // bounds.
    for _ in 0..64 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if too_short(middle) { low = middle } else { high = middle }
    }
    Some(high)
}

/// Places P2..Pn-1 on a circle through P1 and Pn, so that every leg is as long as `leg` (mm).
///
/// `points` are P1..Pn across the tool axis. There have to be at least three, because a single leg cannot be
/// lengthened. If `leg` is `s / legs` or less, the points lie on the chord itself.
pub fn place_on_circle(
    points: &[Point2<f64>],
    leg: f64,
    side: BulgeSide,
    closed: bool,
) -> Option<Vec<Point2<f64>>> {
    let (first, last) = (*points.first()?, *points.last()?);
    let legs = points.len().checked_sub(1).filter(|legs| *legs > 1)?;
    let chord = if closed { Vector2::zeros() } else { last - first };
    let s = chord.norm();
    let along = |fraction: f64| first + (last - first) * fraction;
    let (sweep, centre) = if closed {
        // A closed ramp is a regular polygon of `legs` sides, whose side is 2 R sin(pi / legs).
        let radius = leg / (2.0 * (PI / legs as f64).sin());
        let (towards, side) = find_centre_direction(points, side)?;
        (if side == BulgeSide::Left { TAU } else { -TAU }, first + towards * radius)
    } else {
        let Some(arc) = find_arc_angle(s, leg, legs) else {
            return Some((0..=legs).map(|index| along(index as f64 / legs as f64)).collect());
        };
        // A leg is the chord of arc / legs.
        let radius = leg / (2.0 * (arc / (2.0 * legs as f64)).sin());
        let left = Vector2::new(-chord.y, chord.x) / s;
        let (bulge, sweep) = match side {
            // When the arc bulges to the left of P1 -> Pn, the path along it turns right.
            BulgeSide::Left => (left, -arc),
            BulgeSide::Right => (-left, arc),
        };
        // The centre lies on the perpendicular bisector at e = -R cos(arc / 2), which is positive on the
        // bulge's side if the arc is more than half a turn.
        (sweep, along(0.5) - bulge * (radius * (arc / 2.0).cos()))
    };
    let spoke = first - centre;
    let inner = (1..legs).map(|index| centre + Rotation2::new(sweep * index as f64 / legs as f64) * spoke);
    Some(std::iter::once(first).chain(inner).chain([last]).collect())
}

/// Returns the direction of the centre from P1 for a closed ramp, and the side. It points towards the mean of
/// P2..Pn-1 if the ramp keeps its own sense. Otherwise both are mirrored.
fn find_centre_direction(points: &[Point2<f64>], side: BulgeSide) -> Option<(Vector2<f64>, BulgeSide)> {
    let first = *points.first()?;
    let inner = points.get(1..points.len().checked_sub(1)?)?;
    let mean = inner.iter().map(|point| point - first).sum::<Vector2<f64>>() / inner.len() as f64;
    let towards = mean
        .try_normalize(1e-9)
        .or_else(|| inner.iter().find_map(|point| (point - first).try_normalize(1e-9)))?;
    Some(if side == find_own_side(points, true) { (towards, side) } else { (-towards, side) })
}

/// Returns the side on which a ramp's own points P2..Pn-1 lie; for a closed ramp, its sense of rotation. If
/// they lie on both sides, the sign of the area of P1..Pn decides. Collinear points bulge to the left.
pub fn find_own_side(points: &[Point2<f64>], closed: bool) -> BulgeSide {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return BulgeSide::Left };
    let chord = last - first;
    if !closed {
        // The cross product with the chord, divided by its length, is the signed distance from it, positive
        // on the left.
        let aside = |point: &Point2<f64>| chord.perp(&(point - first)) / chord.norm();
        let inner = points.get(1..points.len().saturating_sub(1)).unwrap_or_default();
        let (left, right) = (inner.iter().any(|p| aside(p) > 1e-6), inner.iter().any(|p| aside(p) < -1e-6));
        match (left, right) {
            (true, false) | (false, false) => return BulgeSide::Left,
            (false, true) => return BulgeSide::Right,
            (true, true) => {}
        }
    }
    // The shoelace formula: the signed triangles from P1 to each pair of neighbours add up to the area.
    let area: f64 = points.windows(2).map(|pair| twice_area(first, pair)).sum();
    // A counter-clockwise path runs on the right of its chord, but a closed ramp that is counter-clockwise
    // turns left.
    match (area > 0.0, closed) {
        (true, false) => BulgeSide::Right,
        (true, true) => BulgeSide::Left,
        (false, false) => BulgeSide::Left,
        (false, true) if area < 0.0 => BulgeSide::Right,
        (false, true) => BulgeSide::Left,
    }
}

fn twice_area(origin: &Point2<f64>, pair: &[Point2<f64>]) -> f64 {
    match pair {
        [a, b] => (a - origin).perp(&(b - origin)),
        _ => 0.0,
    }
}
