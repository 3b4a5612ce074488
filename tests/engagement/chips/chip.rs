//! Chip thickness of teeth from an advance, and its inverse.

use super::close;
use clsmith::cutter::Teeth;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

#[test]
fn even_teeth_share_the_advance() {
    for count in [1_u32, 2, 3, 7] {
        let teeth = Teeth::evenly_spaced(count, 0.5).unwrap();
        assert!(teeth.is_even());
        assert_eq!(teeth.max_chip_thickness_mm(0.3, 1.0), 0.3 / f64::from(count));
        assert_eq!(teeth.edge_chip_thickness_mm(0, 0.3, 0.2), 0.3 / f64::from(count));
        assert_eq!(teeth.max_advance_for_chip_mm(0.1, 1.0), 0.1 * f64::from(count));
        assert_eq!(teeth.max_chip_thickness_mm(-0.3, 1.0), 0.0);
        assert_eq!(teeth.max_advance_for_chip_mm(-0.1, 1.0), 0.0);
    }
    assert_eq!(Teeth::evenly_spaced(2, 0.5).unwrap().edge_chip_thickness_mm(2, 0.3, 1.0), 0.0);
}

#[test]
fn even_numbers_given_one_by_one_are_even_teeth() {
    assert!(Teeth::unevenly_spaced(vec![30.0, 30.0, 30.0], vec![0.01; 3], 0.0).unwrap().is_even());
    assert!(!Teeth::unevenly_spaced(vec![30.0, 31.0, 30.0], vec![0.0; 3], 0.0).unwrap().is_even());
    assert!(Teeth::unevenly_spaced(vec![1.0], vec![0.0, 0.0], 0.0).is_none());
    assert!(Teeth::unevenly_spaced(vec![1.0], vec![0.0], f64::NAN).is_none());
}

#[test]
fn variable_pitch_gives_each_tooth_its_part() {
    let teeth = Teeth::unevenly_spaced(vec![70.0, 110.0, 70.0, 110.0], vec![0.0; 4], 0.6).unwrap();
    for (edge, pitch) in [70.0, 110.0, 70.0, 110.0].into_iter().enumerate() {
        close(teeth.edge_chip_thickness_mm(edge, 0.4, 1.0), 0.4 * pitch / 360.0, 1e-14);
    }
    close(teeth.max_chip_thickness_mm(0.4, 1.0), 0.4 * 110.0 / 360.0, 1e-14);
    close(teeth.max_advance_for_chip_mm(0.05, 1.0), 0.05 * 360.0 / 110.0, 1e-14);
}

#[test]
fn two_teeth_with_runout_in_closed_form() {
    // One tooth 0.02 mm further out: it takes 0.02 more than half, until it takes all and the other nothing.
    let teeth = Teeth::unevenly_spaced(vec![PI, PI], vec![0.01, -0.01], 0.0).unwrap();
    close(teeth.edge_chip_thickness_mm(0, 0.1, 1.0), 0.07, 1e-12);
    close(teeth.edge_chip_thickness_mm(1, 0.1, 1.0), 0.03, 1e-12);
    close(teeth.edge_chip_thickness_mm(0, 0.03, 1.0), 0.03, 1e-12);
    assert_eq!(teeth.edge_chip_thickness_mm(1, 0.03, 1.0), 0.0);
    // On the bottom a radial offset does nothing.
    close(teeth.max_chip_thickness_mm(0.1, 0.0), 0.05, 1e-12);
    close(teeth.max_chip_thickness_mm(0.1, 0.5), 0.06, 1e-12);
    // Below 0.04 mm one tooth cuts the whole advance; above, half and 0.02.
    close(teeth.max_advance_for_chip_mm(0.02, 1.0), 0.02, 1e-12);
    close(teeth.max_advance_for_chip_mm(0.07, 1.0), 0.1, 1e-12);
}

#[test]
fn an_eccentric_cutter_has_a_cosine_of_offsets() {
    let teeth = Teeth::with_eccentricity(vec![1.0; 4], 0.01, 0.0, 0.0).unwrap();
    for (found, expected) in teeth.runout_offsets_mm().iter().zip([0.01, 0.0, -0.01, 0.0]) {
        assert!((found - expected).abs() < 1e-15);
    }
    // 0 follows 3, which stands 0.01 further in; 3 cuts 0.01 more than its quarter after 2.
    close(teeth.max_chip_thickness_mm(0.2, 1.0), 0.06, 1e-12);
}

/// Teeth of all kinds, advance and radial part.
fn cases() -> impl Strategy<Value = (Teeth, f64, f64)> {
    let teeth = (1_usize..7)
        .prop_flat_map(|count| {
            (prop::collection::vec(0.3..1.0, count), prop::collection::vec(-0.03..0.03, count), 0_u8..3)
        })
        .prop_map(|(pitch, runout, kind)| {
            let count = pitch.len();
            match kind {
                0 => Teeth::evenly_spaced(count as u32, 0.3).unwrap(),
                1 => Teeth::unevenly_spaced(pitch, vec![0.0; count], 0.3).unwrap(),
                _ => Teeth::unevenly_spaced(pitch, runout, 0.3).unwrap(),
            }
        });
    (teeth, 0.0..0.5, 0.0..1.0)
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn agrees_with_the_surface_that_the_teeth_leave((teeth, advance, radial) in cases()) {
        // Independent: one place of the surface in one dimension, tooth after tooth for six turns.
        let count = teeth.count();
        let trail = teeth.trail_angles_rad();
        let mut surface = 0.0_f64;
        let mut chips = vec![0.0; count];
        for turn in 0..6 {
            for edge in 0..count {
                let time = f64::from(turn) + trail[edge] / TAU;
                let edge_at = advance * time + teeth.runout_offsets_mm()[edge] * radial;
                let before = if turn == 0 && edge == 0 { edge_at } else { surface };
                chips[edge] = (edge_at - before).max(0.0);
                surface = before.max(edge_at);
            }
        }
        for (edge, chip) in chips.iter().enumerate() {
            let found = teeth.edge_chip_thickness_mm(edge, advance, radial);
            prop_assert!((found - chip).abs() < 1e-12, "edge {edge}: {found} is not {chip}");
        }
    }

    #[test]
    fn one_turn_removes_the_advance((teeth, advance, radial) in cases()) {
        let sum: f64 = (0..teeth.count()).map(|edge| teeth.edge_chip_thickness_mm(edge, advance, radial)).sum();
        prop_assert!((sum - advance).abs() < 1e-12, "{sum} is not {advance}");
    }

    #[test]
    fn the_largest_is_the_largest_of_the_edges((teeth, advance, radial) in cases()) {
        let each = (0..teeth.count()).map(|edge| teeth.edge_chip_thickness_mm(edge, advance, radial));
        prop_assert!((teeth.max_chip_thickness_mm(advance, radial) - each.fold(0.0, f64::max)).abs() < 1e-15);
    }

    #[test]
    fn advance_is_the_inverse_of_thickness((teeth, target, radial) in cases()) {
        let advance = teeth.max_advance_for_chip_mm(target, radial);
        prop_assert!(teeth.max_chip_thickness_mm(advance, radial) <= target * (1.0 + 1e-9) + 1e-16);
        prop_assert!(advance >= target * (1.0 - 1e-12));
        let more = teeth.max_chip_thickness_mm(advance * (1.0 + 1e-6) + 1e-9, radial);
        prop_assert!(more > target, "{advance} could be more: {more} is within {target}");
    }
}
