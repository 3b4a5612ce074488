//! What is left against the part.

use super::shapes::{cube, mesh};
use clsmith::stock::{DexelGrid, Dexels, GridMismatch, SolidBody, Stock, TargetDeviation};

fn block() -> Dexels {
    let block = SolidBody::Block { from: [0.0; 3], to: [10.0, 8.0, 5.0] };
    Stock::new(vec![block], 0.0).unwrap().to_dexels(0.5, 1000).unwrap()
}

#[test]
fn equal_solids_do_not_differ() {
    assert_eq!(
        TargetDeviation::measure_by_thickness(&block(), &block(), 0.0),
        Ok(TargetDeviation::default())
    );
}

#[test]
fn gouge_and_excess_are_measured_where_they_are() {
    let target = mesh(&cube([0.0; 3], [10.0, 8.0, 3.0])).to_dexels(*block().grid()).unwrap();
    let mut left = target.clone();
    // Two columns too deep, one too high, one with an undercut too.
    left.set_column(3, 4, &[[0.0, 2.5]]);
    left.set_column(4, 4, &[[0.0, 2.9]]);
    left.set_column(19, 15, &[[0.0, 3.25]]);
    left.set_column(0, 0, &[[1.0, 4.0]]);
    let found = TargetDeviation::measure_by_thickness(&left, &target, 0.05).unwrap();
    assert!((found.gouge_mm3 - 0.25 * (0.5 + 0.1 + 1.0)).abs() < 1e-6, "{found:?}");
    assert!((found.excess_mm3 - 0.25 * (0.25 + 1.0)).abs() < 1e-6, "{found:?}");
    assert_eq!((found.columns_gouged, found.columns_in_excess), (3, 2));
    assert_eq!(found.deepest_gouge, Some((1.0, [0.25, 0.25, 0.0])));
    assert_eq!(found.highest_excess, Some((1.0, [0.25, 0.25, 4.0])));
    let coarse = TargetDeviation::measure_by_thickness(&left, &target, 0.3).unwrap();
    assert_eq!((coarse.columns_gouged, coarse.columns_in_excess), (2, 1));
}

#[test]
fn other_columns_are_no_measure() {
    let other = Dexels::with_empty_columns(DexelGrid { rows: 3, ..*block().grid() });
    assert_eq!(TargetDeviation::measure_by_thickness(&block(), &other, 0.0), Err(GridMismatch::Layout));
}
