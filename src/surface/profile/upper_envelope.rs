//! This module computes the upper envelope of a chain: of all points over one u only the highest can touch a
//! ball from above.

use super::chain::Chain;
use super::chain_piece::Point;
use super::graph_segment::{GraphSegment, PiecePart, split_into_graphs};

/// Neighbouring pieces of one run may overlap by this much (mm), because the ends of arcs are rounded.
const ROUNDING: f64 = 1e-12;

/// The upper envelope: segments with u ascending that do not overlap, and single points that may be above
/// them.
pub(super) struct UpperEnvelope {
    pub stretches: Vec<GraphSegment>,
    /// The ends of vertical pieces and the upper ends of steep ones, with u ascending. Some of them may be below
    /// the envelope.
    pub tops: Vec<(Point, usize)>,
}

/// Computes the upper envelope of a chain. Runs that go in one direction of u are envelopes already; they are
/// merged in pairs, O(n log n).
pub(super) fn find_upper_envelope(chain: &Chain) -> UpperEnvelope {
    let mut runs: Vec<Vec<GraphSegment>> = Vec::new();
    let mut run: Vec<GraphSegment> = Vec::with_capacity(chain.pieces().len());
    let mut run_forward = true;
    let mut tops: Vec<(Point, usize)> = Vec::new();
    for (index, piece) in chain.pieces().iter().enumerate() {
        split_into_graphs(
            index,
            piece,
            |stretch, forward| {
                let overlaps = run.last().is_some_and(|last| {
                    let overlap = last.right.u.min(stretch.right.u) - last.left.u.max(stretch.left.u);
                    forward != run_forward || overlap > ROUNDING
                });
                if overlaps {
                    runs.push(order_run(std::mem::take(&mut run), run_forward));
                }
                run_forward = forward;
                run.push(stretch);
            },
            |top, piece| tops.push((top, piece)),
        );
    }
    runs.push(order_run(run, run_forward));
    while runs.len() > 1 {
        let mut pairs = runs.into_iter();
        let mut merged = Vec::with_capacity(pairs.len().div_ceil(2));
        while let Some(first) = pairs.next() {
            merged.push(match pairs.next() {
                Some(second) => merge_upper(&first, &second),
                None => first,
            });
        }
        runs = merged;
    }
    tops.sort_by(|a, b| a.0.u.total_cmp(&b.0.u));
    UpperEnvelope { stretches: runs.pop().unwrap_or_default(), tops }
}

/// Puts a run in ascending order. If two pieces overlap by a rounding, the second one is shortened.
fn order_run(mut run: Vec<GraphSegment>, forward: bool) -> Vec<GraphSegment> {
    if !forward {
        run.reverse();
    }
    let mut reached = f64::NEG_INFINITY;
    for stretch in &mut run {
        if stretch.left.u < reached {
            stretch.left = stretch.point_at(reached.min(stretch.right.u));
        }
        reached = reached.max(stretch.right.u);
    }
    run.retain(|stretch| stretch.left.u < stretch.right.u);
    run
}

/// Merges two envelopes: the result is the higher one everywhere.
fn merge_upper(first: &[GraphSegment], second: &[GraphSegment]) -> Vec<GraphSegment> {
    let mut high: Vec<GraphSegment> = Vec::with_capacity(first.len() + second.len());
    let (mut firsts, mut seconds) = (first.iter().copied(), second.iter().copied());
    let (mut a, mut b) = (firsts.next(), seconds.next());
    loop {
        match (a, b) {
            (Some(one), Some(two)) => {
                let lo = one.left.u.max(two.left.u);
                let hi = one.right.u.min(two.right.u);
                // The part before the overlap is only covered by one of them.
                let alone = if one.left.u < two.left.u { one } else { two };
                let until = lo.min(alone.right.u);
                push_segment(&mut high, alone, alone.left.u, until);
                if lo < hi {
                    push_higher(&mut high, &one, &two, lo, hi);
                }
                let reached = if lo < hi { hi } else { until };
                a = if one.right.u <= reached { firsts.next() } else { remaining_segment(one, reached) };
                b = if two.right.u <= reached { seconds.next() } else { remaining_segment(two, reached) };
            }
            (Some(one), None) => {
                push_segment(&mut high, one, one.left.u, one.right.u);
                a = firsts.next();
            }
            (None, Some(two)) => {
                push_segment(&mut high, two, two.left.u, two.right.u);
                b = seconds.next();
            }
            (None, None) => return high,
        }
    }
}

fn remaining_segment(stretch: GraphSegment, from: f64) -> Option<GraphSegment> {
    Some(if from > stretch.left.u { stretch.sub_segment(from, stretch.right.u) } else { stretch })
}

/// Adds the higher of two segments between `lo` and `hi`; they cross at most twice.
fn push_higher(high: &mut Vec<GraphSegment>, one: &GraphSegment, two: &GraphSegment, lo: f64, hi: f64) {
    let mut from = lo;
    let cuts = one.graph.find_crossings(&two.graph, lo, hi);
    for to in cuts.into_iter().flatten().chain([hi]) {
        if to > from {
            let middle = 0.5 * (from + to);
            let winner = if one.height_at(middle) >= two.height_at(middle) { one } else { two };
            push_segment(high, *winner, from, to);
            from = to;
        }
    }
}

/// Adds a segment, or extends the last one if both belong to the same graph.
fn push_segment(high: &mut Vec<GraphSegment>, stretch: GraphSegment, lo: f64, hi: f64) {
    if lo >= hi {
        return;
    }
    match high.last_mut() {
        Some(last)
            if last.right.u == lo
                && last.piece == stretch.piece
                && last.graph == stretch.graph
                && last.part == PiecePart::Body =>
        {
            last.right = stretch.point_at(hi);
        }
        _ => high.push(stretch.sub_segment(lo, hi)),
    }
}
