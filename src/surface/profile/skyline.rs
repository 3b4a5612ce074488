//! What is seen of a chain from straight above: of all points over one u only the highest can touch a ball from above.

use super::chain::Chain;
use super::piece::Point;
use super::stretch::{Part, Stretch, graphs};

/// Pieces of one run may overlap by this much (mm): the ends of arcs are rounded.
const ROUNDING: f64 = 1e-12;

/// The skyline: stretches by ascending u that do not overlap, and single points that stand above them.
pub(super) struct Skyline {
    pub stretches: Vec<Stretch>,
    /// Ends of upright pieces, ascending; not all of them are seen.
    pub tops: Vec<(Point, usize)>,
}

/// The skyline of a chain: runs that go one way in u are skylines already and are merged by halves, O(n log n).
pub(super) fn skyline(chain: &Chain) -> Skyline {
    let mut runs: Vec<Vec<Stretch>> = Vec::new();
    let mut run: Vec<Stretch> = Vec::with_capacity(chain.pieces().len());
    let mut run_forward = true;
    let mut tops: Vec<(Point, usize)> = Vec::new();
    for (index, piece) in chain.pieces().iter().enumerate() {
        graphs(
            index,
            piece,
            |stretch, forward| {
                let overlaps = run.last().is_some_and(|last| {
                    let overlap = last.right.u.min(stretch.right.u) - last.left.u.max(stretch.left.u);
                    forward != run_forward || overlap > ROUNDING
                });
                if overlaps {
                    runs.push(ordered(std::mem::take(&mut run), run_forward));
                }
                run_forward = forward;
                run.push(stretch);
            },
            |top, piece| tops.push((top, piece)),
        );
    }
    runs.push(ordered(run, run_forward));
    while runs.len() > 1 {
        let mut pairs = runs.into_iter();
        let mut merged = Vec::with_capacity(pairs.len().div_ceil(2));
        while let Some(first) = pairs.next() {
            merged.push(match pairs.next() {
                Some(second) => upper(&first, &second),
                None => first,
            });
        }
        runs = merged;
    }
    tops.sort_by(|a, b| a.0.u.total_cmp(&b.0.u));
    Skyline { stretches: runs.pop().unwrap_or_default(), tops }
}

/// A run in ascending order. Where two pieces overlap by a rounding, the second one gives way.
fn ordered(mut run: Vec<Stretch>, forward: bool) -> Vec<Stretch> {
    if !forward {
        run.reverse();
    }
    let mut reached = f64::NEG_INFINITY;
    for stretch in &mut run {
        if stretch.left.u < reached {
            stretch.left = stretch.point(reached.min(stretch.right.u));
        }
        reached = reached.max(stretch.right.u);
    }
    run.retain(|stretch| stretch.left.u < stretch.right.u);
    run
}

/// The higher of two skylines, everywhere.
fn upper(first: &[Stretch], second: &[Stretch]) -> Vec<Stretch> {
    let mut high: Vec<Stretch> = Vec::with_capacity(first.len() + second.len());
    let (mut firsts, mut seconds) = (first.iter().copied(), second.iter().copied());
    let (mut a, mut b) = (firsts.next(), seconds.next());
    loop {
        match (a, b) {
            (Some(one), Some(two)) => {
                let lo = one.left.u.max(two.left.u);
                let hi = one.right.u.min(two.right.u);
                // What only one of them covers.
                let alone = if one.left.u < two.left.u { one } else { two };
                let until = lo.min(alone.right.u);
                push(&mut high, alone, alone.left.u, until);
                if lo < hi {
                    higher(&mut high, &one, &two, lo, hi);
                }
                let reached = if lo < hi { hi } else { until };
                a = if one.right.u <= reached { firsts.next() } else { rest(one, reached) };
                b = if two.right.u <= reached { seconds.next() } else { rest(two, reached) };
            }
            (Some(one), None) => {
                push(&mut high, one, one.left.u, one.right.u);
                a = firsts.next();
            }
            (None, Some(two)) => {
                push(&mut high, two, two.left.u, two.right.u);
                b = seconds.next();
            }
            (None, None) => return high,
        }
    }
}

fn rest(stretch: Stretch, from: f64) -> Option<Stretch> {
    Some(if from > stretch.left.u { stretch.part(from, stretch.right.u) } else { stretch })
}

/// Adds the higher of two stretches between `lo` and `hi`; they cross at most twice.
fn higher(high: &mut Vec<Stretch>, one: &Stretch, two: &Stretch, lo: f64, hi: f64) {
    let mut from = lo;
    let cuts = one.graph.crossings(&two.graph, lo, hi);
    for to in cuts.into_iter().flatten().chain([hi]) {
        if to > from {
            let middle = 0.5 * (from + to);
            let winner = if one.at(middle) >= two.at(middle) { one } else { two };
            push(high, *winner, from, to);
            from = to;
        }
    }
}

/// Adds a stretch, or makes the last one longer when it is the same.
fn push(high: &mut Vec<Stretch>, stretch: Stretch, lo: f64, hi: f64) {
    if lo >= hi {
        return;
    }
    match high.last_mut() {
        Some(last)
            if last.right.u == lo
                && last.piece == stretch.piece
                && last.graph == stretch.graph
                && last.part == Part::Body =>
        {
            last.right = stretch.point(hi);
        }
        _ => high.push(stretch.part(lo, hi)),
    }
}
