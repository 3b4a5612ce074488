//! The division of a path into plateaus, against all divisions and against a plain quadratic one.

use clsmith::internals::transform::optimize_feed::{FreeStretch, partition_into_plateaus};
use proptest::prelude::*;

fn stretches(most: usize) -> impl Strategy<Value = Vec<FreeStretch>> {
    // Feeds and lengths of few values make ties, others none.
    let feed = prop_oneof![(1..6u32).prop_map(|feed| f64::from(feed) * 400.0), 100.0..5000.0f64];
    let length = prop_oneof![Just(1.0), Just(0.25), 0.01..30.0f64];
    let stretch = (length, feed).prop_map(|(length_mm, feed_mm_min)| FreeStretch { length_mm, feed_mm_min });
    prop::collection::vec(stretch, 1..most)
}

/// The cost of a plateau in minutes.
fn cost_min(path: &[FreeStretch], price: f64) -> f64 {
    let lowest = path.iter().map(|stretch| stretch.feed_mm_min).fold(f64::INFINITY, f64::min);
    price + path.iter().map(|stretch| stretch.length_mm / lowest).sum::<f64>()
}

fn whole_cost_min(path: &[FreeStretch], ends: &[usize], price: f64) -> f64 {
    let starts = std::iter::once(&0).chain(ends);
    starts.zip(ends).map(|(start, end)| cost_min(&path[*start..*end], price)).sum()
}

/// The least cost by trying every start of every last plateau.
fn least_cost_min(path: &[FreeStretch], price: f64) -> f64 {
    let mut least = vec![0.0];
    for end in 1..=path.len() {
        let best = (0..end).map(|start| least[start] + cost_min(&path[start..end], price));
        least.push(best.fold(f64::INFINITY, f64::min));
    }
    least[path.len()]
}

fn is_division(ends: &[usize], count: usize) -> bool {
    ends.last() == Some(&count) && ends.first() > Some(&0) && ends.windows(2).all(|pair| pair[0] < pair[1])
}

proptest! {
    #![proptest_config(crate::support::property(300))]

    #[test]
    fn no_other_division_is_cheaper(path in stretches(120), price in prop_oneof![Just(0.0), 1e-5..1e-1f64]) {
        let ends = partition_into_plateaus(&path, price);
        prop_assert!(is_division(&ends, path.len()), "{ends:?}");
        let (found, least) = (whole_cost_min(&path, &ends, price), least_cost_min(&path, price));
        prop_assert!((found - least).abs() <= 1e-9 * least, "{found} {least}");
    }

    #[test]
    fn every_division_of_a_short_path_is_tried(path in stretches(11), price in 1e-5..1e-1f64) {
        let ends = partition_into_plateaus(&path, price);
        let inner = path.len() - 1;
        let all = (0..1_usize << inner).map(|chosen| {
            let mut ends: Vec<usize> = (1..=inner).filter(|end| chosen >> (end - 1) & 1 == 1).collect();
            ends.push(path.len());
            whole_cost_min(&path, &ends, price)
        });
        let least = all.fold(f64::INFINITY, f64::min);
        let found = whole_cost_min(&path, &ends, price);
        prop_assert!((found - least).abs() <= 1e-9 * least, "{found} {least}");
    }
}

/// Feeds that only fall or only rise make as many groups as there are stretches, or one.
#[test]
fn long_monotone_paths_are_divided_as_well() {
    let falling: Vec<FreeStretch> = (0..2000)
        .map(|at| FreeStretch { length_mm: 0.1, feed_mm_min: 5000.0 - 2.0 * f64::from(at) })
        .collect();
    let rising: Vec<FreeStretch> = falling.iter().rev().copied().collect();
    for path in [falling, rising] {
        let ends = partition_into_plateaus(&path, 1e-4);
        let (found, least) = (whole_cost_min(&path, &ends, 1e-4), least_cost_min(&path, 1e-4));
        assert!((found - least).abs() <= 1e-9 * least && ends.len() > 2, "{found} {least} {}", ends.len());
    }
}
