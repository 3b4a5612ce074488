//! This module merges the intervals of one column and finds where two columns differ.

use crate::stock::DexelSpan;
use crate::stock::dexel::THINNEST;

/// Makes valid column intervals of any intervals: sorts them from above to below, closes overlaps and gaps up
/// to [`THINNEST`], and drops intervals that are not thicker than that.
pub(super) fn join_spans(intervals: &mut Vec<DexelSpan>) {
    intervals.sort_unstable_by(|[_, a], [_, b]| b.total_cmp(a));
    intervals.dedup_by(|[low, top], [low_above, _]| {
        let joins = *top + THINNEST >= *low_above;
        if joins {
            *low_above = low_above.min(*low);
        }
        joins
    });
    intervals.retain(|[low, top]| top - low > THINNEST);
}

/// Merges an interval into a list of intervals that do not touch and have no order.
pub(crate) fn merge_span<T: PartialOrd + Copy>(spans: &mut Vec<[T; 2]>, [mut low, mut high]: [T; 2]) {
    spans.retain(|[from, to]| {
        let apart = *to < low || *from > high;
        if !apart {
            low = if *from < low { *from } else { low };
            high = if *to > high { *to } else { high };
        }
        apart
    });
    spans.push([low, high]);
}

/// Finds where two columns differ, from above to below. The second argument of `found` is true where only
/// column `a` has material.
pub(super) fn find_span_differences(
    a: &[DexelSpan],
    b: &[DexelSpan],
    mut found: impl FnMut(DexelSpan, bool),
) {
    if a == b {
        return;
    }
    let ends = |of: &[DexelSpan], first: bool| -> Vec<(f32, bool)> {
        of.iter().flat_map(|[low, top]| [(*top, first), (*low, first)]).collect()
    };
    let mut all = ends(a, true);
    all.append(&mut ends(b, false));
    all.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    // Walk down through all ends of both columns; each end switches whether its column has material.
    let (mut in_a, mut in_b, mut above) = (false, false, f32::INFINITY);
    for (height, first) in all {
        if in_a != in_b && above > height {
            found([height, above], in_a);
        }
        if first {
            in_a = !in_a;
        } else {
            in_b = !in_b;
        }
        above = height;
    }
}
