//! This module fits arcs through runs of short chords.

use super::chain_piece::{ArcPiece, Point};
use super::chord_vertex::ChordVertex;
use std::f64::consts::TAU;

/// An arc whose sagitta is less than this many tolerances stays chords, since two chords would be enough.
const WORTH: f64 = 4.0;

/// Arcs with a larger radius (mm) are written as chords, because controls refuse or round them.
const FLATTEST: f64 = 1e5;

/// Finds the longest arc from `anchor` (at or after vertex `at`) through the run's vertices within the
/// tolerance. Returns the index of the vertex that it reaches, and the arc. Returns `None` if it reaches no
/// further than a chord does (vertex `chord`) or is too flat to be worth it.
///
/// The reach is doubled and then bisected, each time with the circle through both ends and the vertex in the
/// middle. All vertices and the midpoints between them are tested, so the cost is O(n log n).
pub(super) fn fit_longest_arc(
    run: &[ChordVertex],
    at: usize,
    anchor: Point,
    chord: usize,
    tolerance: f64,
) -> Option<(usize, ArcPiece)> {
    let last = run.len().checked_sub(1)?;
    let bound =
        run.iter().enumerate().skip(at + 1).find(|(_, place)| place.corner).map_or(last, |(index, _)| index);
    let fit = |end: usize| fit_arc(run, at, anchor, end, tolerance);
    // No arc worth it fits within a chord's reach, so the first trial goes twice as far.
    let mut good: Option<(usize, ArcPiece)> = None;
    let mut reach = (2 * (chord.max(at + 1) - at)).max(4);
    let mut bad = bound + 1;
    loop {
        let end = (at + reach).min(bound);
        match fit(end) {
            Some(arc) => good = Some((end, arc)),
            None => {
                bad = end;
                break;
            }
        }
        if end == bound {
            break;
        }
        reach *= 2;
    }
    let (mut low, arc) = good?;
    let mut best = arc;
    while bad > low + 1 {
        let middle = low + (bad - low) / 2;
        match fit(middle) {
            Some(arc) => (low, best) = (middle, arc),
            None => bad = middle,
        }
    }
    (low > chord && best.sagitta_mm() >= WORTH * tolerance).then_some((low, best))
}

/// Returns the arc from `anchor` to vertex `end` if it stays within the tolerance of all points between.
fn fit_arc(run: &[ChordVertex], at: usize, anchor: Point, end: usize, tolerance: f64) -> Option<ArcPiece> {
    let places = run.get(at + 1..=end)?;
    let middle = places.get(places.len() / 2)?.point;
    let stop = places.last()?.point;
    let arc = arc_through_points(anchor, middle, stop)?;
    let mut before = anchor;
    let mut turned = 0.0;
    let sense = arc.sweep_rad.signum();
    for place in places {
        let half = before.lerp(place.point, 0.5);
        for point in [half, place.point] {
            if (arc.centre.distance(point) - arc.radius_mm).abs() > tolerance * (1.0 + 1e-9) {
                return None;
            }
        }
        // The run must go around in the direction of the arc, never back, and not past the arc's end.
        let (a, b) = (vector_from_centre(&arc, before), vector_from_centre(&arc, place.point));
        let step = (a.0 * b.1 - a.1 * b.0).atan2(a.0 * b.0 + a.1 * b.1) * sense;
        if step * arc.radius_mm < -tolerance {
            return None;
        }
        turned += step;
        before = place.point;
    }
    ((turned - arc.sweep_rad.abs()).abs() < 1e-6).then_some(arc)
}

fn vector_from_centre(arc: &ArcPiece, point: Point) -> (f64, f64) {
    (point.u - arc.centre.u, point.z - arc.centre.z)
}

/// Returns the arc through three points in their order, or `None` if they are on a line or on a circle that
/// is too flat.
fn arc_through_points(a: Point, b: Point, c: Point) -> Option<ArcPiece> {
    let (bu, bz, cu, cz) = (b.u - a.u, b.z - a.z, c.u - a.u, c.z - a.z);
    // The circumcentre relative to a, from the two equations |m|^2 = |m - b|^2 = |m - c|^2.
    let double = 2.0 * (bu * cz - bz * cu);
    let (b2, c2) = (bu * bu + bz * bz, cu * cu + cz * cz);
    let centre = Point::new(a.u + (cz * b2 - bz * c2) / double, a.z + (bu * c2 - cu * b2) / double);
    let radius = centre.distance(a);
    if !(radius <= FLATTEST && radius > 0.0) {
        return None;
    }
    let angle = |point: Point| (point.z - centre.z).atan2(point.u - centre.u);
    let start = angle(a);
    // The arc is counter-clockwise if the middle point is to the right of the chord.
    let left = (angle(c) - start).rem_euclid(TAU);
    let sweep = if double > 0.0 { left } else { left - TAU };
    Some(ArcPiece { centre, radius_mm: radius, start_rad: start, sweep_rad: sweep })
}
