//! This module reduces the points of a line of (length, height): it finds the longest chords within a
//! tolerance.

/// Keeps some of the points, so that the line through them is at most `tolerance` above or below every point
/// that is left out. The first and last point and both ends of vertical steps are kept. From each point that
/// is kept, the chord goes to the furthest point that all points between allow.
pub(super) fn simplify_polyline(points: &[[f64; 2]], tolerance: f64) -> Vec<[f64; 2]> {
    let mut kept = Vec::new();
    let mut rest = points;
    while let [from, others @ ..] = rest {
        kept.push(*from);
        let reached = farthest_reachable(*from, others, tolerance);
        match others.get(reached..) {
            Some(next) if !next.is_empty() => rest = next,
            _ => break,
        }
    }
    kept
}

/// Returns the index in `others` of the end of the longest chord from a point, or 0 if there is none.
fn farthest_reachable([u0, z0]: [f64; 2], others: &[[f64; 2]], tolerance: f64) -> usize {
    // The slopes between `least` and `most` pass all points so far within the tolerance.
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut reached = 0;
    for (index, [u, z]) in others.iter().enumerate() {
        let across = u - u0;
        if across <= 0.0 {
            // A vertical step ends the chord; it is a chord of its own if it starts here.
            return reached;
        }
        let slope = (z - z0) / across;
        if least <= slope && slope <= most {
            reached = index;
        }
        least = least.max((z - tolerance - z0) / across);
        most = most.min((z + tolerance - z0) / across);
        if least > most {
            break;
        }
        // Before a step, the chord must meet the point beside the step.
        if others.get(index + 1).is_some_and(|[next, _]| next <= u) {
            break;
        }
    }
    reached
}
