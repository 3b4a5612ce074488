//! This module holds unions of times.

/// Returns the parts of `need` that no interval covers, and sorts the intervals. Gaps of at most `slack`
/// between intervals count as covered.
pub(super) fn find_uncovered(times: &mut [[f64; 2]], need: [f64; 2], slack: f64, out: &mut Vec<[f64; 2]>) {
    out.clear();
    times.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let mut at = need[0];
    let mut is_open = true;
    for [from, to] in times.iter() {
        if *from > at + slack {
            out.push([at, from.min(need[1])]);
            is_open = false;
        }
        if *to >= at || *to >= at - slack && *from <= at {
            at = at.max(*to);
            is_open = false;
        }
        if at >= need[1] {
            break;
        }
    }
    // Closed intervals cover a last moment that they reach; a single moment without any interval is
    // uncovered.
    if at < need[1] - slack || is_open && !times.iter().any(|[from, to]| *from <= at && at <= *to) {
        out.push([at, need[1]]);
    }
    out.retain(|[from, to]| from <= to && *from <= need[1]);
}

/// Returns the span from the first to the last uncovered time, or `None` if everything is covered.
pub(super) fn span_of(uncovered: &[[f64; 2]]) -> Option<[f64; 2]> {
    let (first, last) = (uncovered.first()?, uncovered.last()?);
    Some([first[0], last[1]])
}

/// Replaces two lists of intervals by the intervals of times in both.
pub(super) fn intersect_times(first: &[[f64; 2]], second: &[[f64; 2]], out: &mut Vec<[f64; 2]>) {
    out.clear();
    for [a, b] in first {
        for [c, d] in second {
            if a.max(*c) <= b.min(*d) {
                out.push([a.max(*c), b.min(*d)]);
            }
        }
    }
}
