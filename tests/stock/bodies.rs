//! Stock of all kinds of bodies.

use super::shapes::{columns, cube, mesh, sphere};
use clsmith::stock::{DexelGrid, Dexels, SolidBody, Stock, StockError};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::sync::Arc;

const MOST: usize = 1_000_000;

fn block(from: [f64; 3], to: [f64; 3]) -> SolidBody {
    SolidBody::Block { from, to }
}

fn dexels(bodies: Vec<SolidBody>, allowance: f64, cell: f64) -> Dexels {
    Stock::new(bodies, allowance).unwrap().to_dexels(cell, MOST).unwrap()
}

fn near(found: f64, expected: f64, share: f64) {
    assert!((found - expected).abs() <= share * expected, "{found} is not {expected}");
}

#[test]
fn a_block_of_whole_cells_is_exact() {
    let stock = Stock::new(vec![block([-1.3, 0.7, -20.0], [8.7, 6.7, 0.0])], 0.0).unwrap();
    assert_eq!(stock.count_columns(0.1), 6000);
    assert_eq!(stock.bounds(), ([-1.3, 0.7, -20.0], [8.7, 6.7, 0.0]));
    let dexels = stock.to_dexels(0.1, 6000).unwrap();
    near(dexels.volume_mm3(), 1200.0, 1e-12);
    assert_eq!(dexels.column_spans(0, 0), [[0.0, 20.0]]);
    assert_eq!(dexels.column_spans(99, 59), [[0.0, 20.0]]);
    let most = stock.to_dexels(0.1, 5999);
    assert_eq!(most, Err(StockError::TooMany { cell: 0.1, columns: 6000, most: 5999 }));
}

#[test]
fn an_allowance_moves_sides() {
    near(dexels(vec![block([0.0; 3], [4.0, 3.0, 2.0])], 0.5, 0.25).volume_mm3(), 60.0, 1e-9);
    let bar = SolidBody::Cylinder { diameter: 10.0, from: [0.0; 3], to: [0.0, 0.0, 20.0] };
    near(dexels(vec![bar], 1.0, 0.1).volume_mm3(), PI * 36.0 * 22.0, 2e-3);
}

#[test]
fn an_allowance_rolls_a_ball_over_meshes_and_remains() {
    let ball = Arc::new(mesh(&sphere([0.0; 3], 5.0, 48)));
    let expected = 4.0 / 3.0 * PI * 216.0;
    near(dexels(vec![SolidBody::Mesh(Arc::clone(&ball))], 1.0, 0.125).volume_mm3(), expected, 0.01);
    let small = dexels(vec![SolidBody::Mesh(ball)], 0.0, 0.125);
    let grown = dexels(vec![SolidBody::Remains(Arc::new(small.clone()))], 1.0, 0.125);
    near(grown.volume_mm3(), expected, 0.01);
    assert_eq!(grown.grid().columns, small.grid().columns + 16, "the same columns, and more around");
    // A plate with rounded edges, by Steiner's formula.
    let plate = SolidBody::Mesh(Arc::new(mesh(&cube([0.0; 3], [8.0, 6.0, 2.0]))));
    let steiner = 96.0 + 2.0 * (48.0 + 16.0 + 12.0) + PI * (8.0 + 6.0 + 2.0) + 4.0 / 3.0 * PI;
    // Its roundings begin at the last centre instead of the wall, so each quarter of a circle lacks 0.06 mm2.
    let found = dexels(vec![plate], 1.0, 0.1);
    near(found.volume_mm3(), steiner, 0.02);
    assert_eq!(found.grid().columns, 100);
    assert_eq!(found.column_spans(0, 40).len(), 1, "the wall is where it shall be");
    assert_eq!(found.column_spans(50, 40), [[0.0, 4.0]]);
}

#[test]
fn cylinders_lie_as_they_like() {
    let volume = PI * 4.0 * 12.0;
    for to in [[0.0, 0.0, 12.0], [12.0, 0.0, 0.0], [0.0, -12.0, 0.0], [4.0, 8.0, 8.0], [1e-13, 0.0, -12.0]] {
        let bar = SolidBody::Cylinder { diameter: 4.0, from: [0.0; 3], to };
        let stock = Stock::new(vec![bar], 0.0).unwrap();
        near(stock.to_dexels(0.05, MOST).unwrap().volume_mm3(), volume, 4e-3);
        let ([x0, y0, z0], [x1, y1, z1]) = stock.bounds();
        let found = stock.to_dexels(0.05, MOST).unwrap();
        assert!((found.highest_z_mm().unwrap() - z1).abs() < 0.02 * (z1 - z0), "{to:?}");
        assert!(x0 < x1 && y0 < y1);
    }
}

#[test]
fn remains_alone_keep_their_columns() {
    let layout = DexelGrid { origin_mm: [0.1, 0.2], base_mm: 0.3, cell_mm: 0.7, columns: 3, rows: 2 };
    let mut kept = Dexels::with_empty_columns(layout);
    kept.set_column(1, 1, &[[3.0, 4.0], [1.0, 2.0]]);
    let kept = Arc::new(kept);
    assert_eq!(dexels(vec![SolidBody::Remains(Arc::clone(&kept))], 0.0, 0.7), *kept);
    // Finer and on other borders, every column is the nearest one.
    let fine = dexels(vec![SolidBody::Remains(Arc::clone(&kept))], 0.0, 0.1);
    near(fine.volume_mm3(), kept.volume_mm3(), 1e-5);
    assert!(
        fine.contains([0.8, 0.9, 3.8]) && !fine.contains([0.8, 0.9, 2.9]) && !fine.contains([0.1, 0.9, 3.8])
    );
    // With another body, both.
    let both = vec![SolidBody::Remains(kept), block([-0.25, -0.15, 0.0], [1.85, 1.25, 0.7])];
    near(dexels(both, 0.0, 0.1).volume_mm3(), 2.1 * 1.4 * 0.7 + 2.0 * 0.49, 1e-5);
    let empty = SolidBody::Remains(Arc::new(Dexels::with_empty_columns(layout)));
    assert_eq!(Stock::new(vec![empty], 0.0), Err(StockError::Empty));
}

#[test]
fn nonsense_is_refused() {
    let good = || block([0.0; 3], [1.0; 3]);
    let bar = |diameter, to| SolidBody::Cylinder { diameter, from: [0.0; 3], to };
    let refused = |body| Stock::new(vec![body], 0.0).unwrap_err();
    assert_eq!(Stock::new(vec![], 0.0), Err(StockError::NoBody));
    assert_eq!(Stock::new(vec![good()], -0.1), Err(StockError::Allowance));
    assert_eq!(Stock::new(vec![good()], f64::NAN), Err(StockError::NotFinite));
    assert_eq!(refused(block([0.0; 3], [1.0, 0.0, 1.0])), StockError::Block);
    assert_eq!(refused(block([0.0; 3], [1.0, f64::NAN, 1.0])), StockError::NotFinite);
    assert_eq!(refused(block([0.0; 3], [1.0, f64::INFINITY, 1.0])), StockError::NotFinite);
    assert_eq!(refused(bar(0.0, [1.0; 3])), StockError::Cylinder);
    assert_eq!(refused(bar(1.0, [0.0; 3])), StockError::Cylinder);
    let stock = Stock::new(vec![good()], 0.0).unwrap();
    for cell in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(stock.to_dexels(cell, MOST), Err(StockError::Cell));
    }
    assert_eq!(stock.count_columns(1e-300), usize::MAX);
    assert!(matches!(stock.to_dexels(1e-300, MOST), Err(StockError::TooMany { .. })));
    let thread = Stock::new(vec![block([0.0; 3], [1e-11, 1e8, 1.0])], 0.0).unwrap();
    assert_eq!(thread.to_dexels(1.0, MOST), Err(StockError::Empty));
}

/// Numbers that no column centre hits: quarters and a bit.
fn at() -> impl Strategy<Value = f64> {
    (-20..20i32).prop_map(|quarters| f64::from(quarters) / 4.0 + 0.03125)
}

/// Whether a point is in a body, by the definition of each.
fn inside(body: &SolidBody, p: [f64; 3]) -> bool {
    match body {
        SolidBody::Block { from, to } => (0..3).all(|i| from[i] <= p[i] && p[i] <= to[i]),
        SolidBody::Cylinder { diameter, from, to } => {
            let axis = [0, 1, 2].map(|i| to[i] - from[i]);
            let v = [0, 1, 2].map(|i| p[i] - from[i]);
            let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let share = dot(v, axis) / dot(axis, axis);
            let across = [0, 1, 2].map(|i| v[i] - share * axis[i]);
            (0.0..=1.0).contains(&share) && dot(across, across) <= diameter * diameter / 4.0
        }
        SolidBody::Mesh(mesh) => {
            let (from, to) = mesh.bounds();
            inside(&block(from, to), p)
        }
        SolidBody::Remains(_) => false,
    }
}

fn body() -> impl Strategy<Value = SolidBody> {
    let size = || [0.25..6.0f64, 0.25..6.0f64, 0.25..6.0f64];
    let boxed = |(from, size): ([f64; 3], [f64; 3])| (from, [0, 1, 2].map(|i| from[i] + size[i]));
    prop_oneof![
        ([at(), at(), at()], size()).prop_map(boxed).prop_map(|(from, to)| block(from, to)),
        ([at(), at(), at()], size())
            .prop_map(boxed)
            .prop_map(|(from, to)| { SolidBody::Mesh(Arc::new(mesh(&cube(from, to)))) }),
        ([at(), at(), at()], [at(), at(), at()], 0.5..5.0f64)
            .prop_filter("two ends", |(from, to, _)| from != to)
            .prop_map(|(from, to, diameter)| SolidBody::Cylinder { diameter, from, to }),
    ]
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn the_union_is_what_is_in_any_body(bodies in proptest::collection::vec(body(), 1..5)) {
        let dexels = dexels(bodies.clone(), 0.0, 0.5);
        let layout = *dexels.grid();
        for index in 0..layout.column_count() {
            let (column, row) = (index % layout.columns, index / layout.columns);
            let [x, y] = layout.column_center(column, row);
            let intervals = dexels.column_spans(column, row);
            prop_assert!(intervals.windows(2).all(|pair| pair[1][1] < pair[0][0]));
            for step in -90..90 {
                let z = f64::from(step) * 0.13 + 0.0071;
                let any = bodies.iter().any(|body| inside(body, [x, y, z]));
                if dexels.contains([x, y, z]) == any {
                    continue;
                }
                let height = z - layout.base_mm;
                // Close to an end, `f32` decides.
                let close = intervals.iter().flatten().any(|end| (f64::from(*end) - height).abs() < 1e-4);
                // So it does beside a face that stands upright.
                let beside = [[1e-6, 0.0], [-1e-6, 0.0], [0.0, 1e-6], [0.0, -1e-6]];
                let near = |[dx, dy]: [f64; 2]| bodies.iter().any(|body| inside(body, [x + dx, y + dy, z])) != any;
                prop_assert!(close || beside.into_iter().any(near), "{} {} {}", x, y, z);
            }
        }
    }

    #[test]
    fn remains_go_through_stock_unchanged(kept in columns()) {
        prop_assume!(kept.highest_z_mm().is_some());
        let kept = Arc::new(kept);
        prop_assert_eq!(dexels(vec![SolidBody::Remains(Arc::clone(&kept))], 0.0, 0.25), (*kept).clone());
    }
}
