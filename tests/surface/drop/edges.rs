//! One vertex or one edge under each cutter.

use super::super::solids::{blade, mesh, needle};
use super::{cutters, largest, over, tip};
use clsmith::internals::surface::drop_cutter::{DropCutterShape, measure_deviation};
use proptest::prelude::*;

#[test]
fn a_needle_is_a_vertex() {
    let solid = needle([1.0, 2.0, 3.0]);
    for cutter in cutters() {
        let drop = over(&solid, cutter);
        for r in [0.0, 1.0, 3.4, 3.6, 4.99] {
            let found = drop.drop_at(1.0 + r * 0.6, 2.0 - r * 0.8).unwrap();
            assert!((found.tip_z_mm - (3.0 - cutter.height_at(r))).abs() < 1e-9);
            assert!((found.contact_mm[2] - 3.0).abs() < 1e-9);
            // The normal is the cutter's.
            let across = (r - cutter.flat_radius_mm()).max(0.0);
            let sine = if cutter.corner_radius_mm() > 0.0 { across / cutter.corner_radius_mm() } else { 0.0 };
            let expected = [sine * 0.6, -sine * 0.8, (1.0 - sine * sine).sqrt()];
            for (found, expected) in found.normal.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-6, "{found} {expected}");
            }
        }
        assert_eq!(drop.drop_at(1.0, 7.2), None);
    }
}

#[test]
fn level_and_sloped_edges() {
    for slope in [0.0, 0.3, -0.3, 1.0, -2.5] {
        let at = |s: f64| [s * 0.8, s * 0.6, 10.0 + slope * s];
        let solid = blade(at(-20.0), at(20.0));
        for cutter in cutters() {
            let drop = over(&solid, cutter);
            for (s, d) in [
                (0.0_f64, 0.0_f64),
                (2.0, 1.0),
                (-3.0, 3.2),
                (1.0, 3.499),
                (0.5, 3.501),
                (4.0, -4.9),
                (0.0, 4.999),
            ] {
                let found = tip(&drop, s * 0.8 - d * 0.6, s * 0.6 + d * 0.8);
                let half = (25.0 - d * d).sqrt();
                let foot = 10.0 + slope * s;
                let expected = match cutter.corner_radius_mm() {
                    0.0 => foot + slope.abs() * half,
                    5.0 => foot + half * slope.hypot(1.0) - 5.0,
                    _ => largest(-half, half, |t| foot + slope * t - cutter.height_at(d.hypot(t).min(5.0))),
                };
                // Flat ends reach 1e-6 less, on a slope and where the edge leaves the cutter slantingly.
                let within = if cutter.corner_radius_mm() > 0.0 { 1e-8 } else { 1e-3 * slope.abs() + 1e-9 };
                assert!((found - expected).abs() <= within, "{cutter:?} {slope} {s} {d}: {found} {expected}");
            }
        }
    }
}

proptest! {
    #![proptest_config(crate::support::property(100))]

    /// Against the solid's distance, which knows no contacts: neither gouge nor gap.
    #[test]
    fn any_edge_is_touched(
        corner in 0.0..=1.0_f64, from in -1.0..1.0_f64, length in 0.01..9.0_f64, rise in -12.0..12.0_f64, off in -4.5..4.5_f64,
    ) {
        let cutter = DropCutterShape::new(10.0, 5.0 * corner).unwrap();
        let solid = blade([from, 0.0, 3.0], [from + length, 0.0, 3.0 + rise]);
        let found = over(&solid, cutter).drop_at(0.3, off).unwrap();
        let place = [0.3, off, found.tip_z_mm];
        let looked = measure_deviation(&mesh(&solid), cutter, &[place], 2e-6).unwrap();
        prop_assert!(looked.gouge_mm <= 5e-6, "{looked:?}");
        prop_assert!(looked.gap_mm <= 5e-6, "{looked:?}");
    }
}
