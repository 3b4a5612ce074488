//! Depths and angles as machinists count them.

use super::{cutter, milling, plunge};
use clsmith::engagement::Engagement;
use clsmith::program::record::SpindleDirection::{Clockwise, CounterClockwise};

#[track_caller]
fn same(found: Option<[f64; 2]>, expected: [f64; 2]) {
    let found = found.unwrap();
    assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?} is not {expected:?}");
}

#[test]
fn a_slot_is_half_a_turn() {
    let profile = cutter(10.0, 0.0);
    let slot = milling(&profile, 3.0, -90.0, 90.0);
    same(slot.immersion_deg(&profile, Clockwise), [0.0, 180.0]);
    same(slot.immersion_deg(&profile, CounterClockwise), [0.0, 180.0]);
    assert_eq!((slot.axial_depth_mm(), slot.radial_depth_mm()), (3.0, 10.0));
}

#[test]
fn material_at_the_left_of_a_clockwise_cutter_is_milled_up() {
    let profile = cutter(10.0, 0.0);
    let left = milling(&profile, 3.0, 30.0, 90.0);
    same(left.immersion_deg(&profile, Clockwise), [0.0, 60.0]);
    same(left.immersion_deg(&profile, CounterClockwise), [120.0, 180.0]);
    let right = milling(&profile, 3.0, -90.0, -30.0);
    same(right.immersion_deg(&profile, Clockwise), [120.0, 180.0]);
    same(right.immersion_deg(&profile, CounterClockwise), [0.0, 60.0]);
    assert!((right.radial_depth_mm() - 2.5).abs() < 1e-9);
}

#[test]
fn the_engaged_radius_counts() {
    let ball = cutter(10.0, 5.0);
    same(milling(&ball, 0.5, -90.0, 90.0).immersion_deg(&ball, Clockwise), [0.0, 180.0]);
}

#[test]
fn a_plunge_is_a_full_turn_and_air_is_none() {
    let profile = cutter(10.0, 0.0);
    same(plunge(&profile).immersion_deg(&profile, Clockwise), [0.0, 360.0]);
    let air = Engagement::empty_along(1.0, 0.0, 5.0);
    assert_eq!(air.immersion_deg(&profile, Clockwise), None);
    assert_eq!((air.axial_depth_mm(), air.radial_depth_mm()), (0.0, 0.0));
}
