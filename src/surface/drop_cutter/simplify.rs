//! Few points instead of many: the longest chords that stay near a line of (length, height).

/// Keeps points so that the line through them is no farther than `tolerance` above or below any point left out. The first, the last and both
/// ends of upright steps stay. From each point kept, the chord to the farthest point is taken that all between allow.
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

/// Which of `others` the longest chord from a point ends at; the first when there is none.
fn farthest_reachable([u0, z0]: [f64; 2], others: &[[f64; 2]], tolerance: f64) -> usize {
    let (mut least, mut most) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut reached = 0;
    for (index, [u, z]) in others.iter().enumerate() {
        let across = u - u0;
        if across <= 0.0 {
            // An upright step ends the chord, and is one of its own when it starts here.
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
        // A step beside the next point: what is before it must be met.
        if others.get(index + 1).is_some_and(|[next, _]| next <= u) {
            break;
        }
    }
    reached
}
