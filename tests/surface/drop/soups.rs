//! Any tetrahedra, in and through each other, against a search of all of their triangles.

use super::super::solids::{Triangles, mesh, tetrahedron};
use super::{over, searched_all};
use clsmith::internals::surface::drop_cutter::{DropCutterShape, measure_deviation};
use proptest::prelude::*;

/// Corners on a coarse grid, where much is upright, level or in line, or anywhere.
fn corner() -> impl Strategy<Value = [f64; 3]> {
    prop_oneof![
        [-8..8_i32, -8..8_i32, -8..8_i32].prop_map(|at| at.map(f64::from)),
        [-8.0..8.0_f64, -8.0..8.0_f64, -8.0..8.0_f64],
    ]
}

fn soup() -> impl Strategy<Value = Triangles> {
    let tetrahedra = proptest::collection::vec([corner(), corner(), corner(), corner()], 1..5);
    tetrahedra
        .prop_map(|all| all.into_iter().flat_map(tetrahedron).collect::<Triangles>())
        .prop_filter("a corner twice", |all| all.iter().all(|[a, b, c]| a != b && b != c && c != a))
}

fn cutter() -> impl Strategy<Value = DropCutterShape> {
    let corner = prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0_f64];
    (prop_oneof![Just(4.0), 0.5..12.0_f64], corner)
        .prop_map(|(diameter, corner)| DropCutterShape::new(diameter, corner * diameter / 2.0).unwrap())
}

fn place() -> impl Strategy<Value = [f64; 2]> {
    prop_oneof![
        [-10..10_i32, -10..10_i32].prop_map(|at| at.map(f64::from)),
        [-10.0..10.0_f64, -10.0..10.0_f64]
    ]
}

proptest! {
    #![proptest_config(crate::support::property(150))]

    #[test]
    fn heights_are_those_of_a_search(solid in soup(), cutter in cutter(), place in place()) {
        let found = over(&solid, cutter).drop_at(place[0], place[1]).map(|drop| drop.tip_z_mm);
        let expected = searched_all(&cutter, place, &solid);
        match (found, expected) {
            (Some(found), Some(expected)) => {
                prop_assert!(found >= expected - 1e-9, "{found} below {expected}");
                // The search ends a little before the rim, where steep cutters and facets count much.
                prop_assert!(found <= expected + 1e-4, "{found} above {expected}");
            }
            (None, None) => {}
            _ => prop_assert!(false, "{found:?} {expected:?}"),
        }
    }

    #[test]
    fn nothing_is_cut_into_and_more_never_lowers(one in soup(), other in soup(), cutter in cutter(), place in place()) {
        let both: Triangles = one.iter().chain(&other).copied().collect();
        let [alone, joined] = [&one, &both].map(|solid| over(solid, cutter).drop_at(place[0], place[1]));
        let [low, high] = [alone, joined].map(|drop| drop.map_or(-99.0, |drop| drop.tip_z_mm));
        prop_assert!(high >= low - 1e-12);
        if let Some(found) = joined {
            let looked = measure_deviation(&mesh(&both), cutter, &[[place[0], place[1], found.tip_z_mm]], 1e-4).unwrap();
            prop_assert!(looked.gouge_mm <= 1.1e-4 && looked.gap_mm <= 1.1e-4, "{looked:?}");
        }
    }
}

proptest! {
    // Looking at whole paths takes a while.
    #![proptest_config(crate::support::property(15))]

    #[test]
    fn paths_keep_their_tolerance(solid in soup(), cutter in cutter(), from in place(), to in place()) {
        prop_assume!(from != to);
        let tolerance = 0.05;
        let drop = over(&solid, cutter);
        let mesh = mesh(&solid);
        for run in drop.follow_line(&[from, to], tolerance) {
            let looked = measure_deviation(&mesh, cutter, &run, 0.01).unwrap();
            prop_assert!(looked.gouge_mm <= tolerance + looked.error_mm, "{looked:?}");
        }
    }
}
