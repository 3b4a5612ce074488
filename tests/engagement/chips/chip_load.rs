//! What an engagement means for a feed.

use super::{close, cutter, milling, plunge};
use clsmith::cutter::Teeth;
use clsmith::engagement::Engagement;

const RPM: f64 = 5000.0;

fn teeth() -> Teeth {
    Teeth::evenly_spaced(4, 0.6).unwrap()
}

#[test]
fn a_slot_has_the_feed_per_tooth() {
    let slot = milling(&cutter(10.0, 0.0), 3.0, -90.0, 90.0);
    close(slot.chip_thickness_mm(&teeth(), 2000.0, RPM), 0.1, 1e-7);
    close(slot.feed_for_chip_mm_min(&teeth(), RPM, 0.065), 0.065 * 4.0 * RPM, 1e-7);
    close(slot.removal_rate_mm3_min(2000.0), 10.0 * 3.0 * 2000.0, 1e-9);
    close(slot.feed_for_removal_rate_mm_min(30_000.0), 1000.0, 1e-9);
}

#[test]
fn side_milling_has_the_classic_thickness() {
    // From 45 degrees to the side: f_z 2 sqrt(a (1 - a)) with a = (1 - sin 45) / 2.
    let side = milling(&cutter(10.0, 0.0), 3.0, 45.0, 90.0);
    let part = (1.0 - 45_f64.to_radians().sin()) / 2.0;
    let classic = 2.0 * (part * (1.0 - part)).sqrt();
    close(side.chip_thickness_mm(&teeth(), 2000.0, RPM), 0.1 * classic, 1e-7);
    close(side.feed_for_chip_mm_min(&teeth(), RPM, 0.1), 2000.0 / classic, 1e-7);
}

#[test]
fn a_ball_at_small_depth_is_thinned() {
    let ball = milling(&cutter(10.0, 5.0), 0.2, -90.0, 90.0);
    let sin_kappa = (1.0 - (1.0 - 0.2_f64 / 5.0).powi(2)).sqrt();
    close(ball.chip_thickness_mm(&teeth(), 2000.0, RPM), 0.1 * sin_kappa, 1e-6);
}

#[test]
fn a_plunge_has_the_feed_per_tooth() {
    let plunge = plunge(&cutter(10.0, 0.0));
    close(plunge.chip_thickness_mm(&teeth(), 2000.0, RPM), 0.1, 1e-7);
}

#[test]
fn thin_material_limits_the_chip_and_not_the_feed() {
    let mut slot = milling(&cutter(10.0, 0.0), 3.0, -90.0, 90.0);
    slot.bins.iter_mut().for_each(|bin| bin.thickness = 0.03);
    close(slot.chip_thickness_mm(&teeth(), 2000.0, RPM), 0.03, 1e-6);
    // On pieces of 10 mm the thickness is known for up to 10 mm a revolution.
    close(slot.feed_for_chip_mm_min(&teeth(), RPM, 0.065), 10.0 * RPM, 1e-6);
    close(slot.feed_for_chip_mm_min(&teeth(), RPM, 0.02), 400.0, 1e-6);
}

#[test]
fn uncertainty_lowers_the_feed() {
    let mut slot = milling(&cutter(10.0, 0.0), 3.0, 45.0, 90.0);
    let sure = slot.feed_for_chip_mm_min(&teeth(), RPM, 0.05);
    slot.bins.iter_mut().for_each(|bin| bin.advance_ratio_bound *= 1.1);
    let wary = slot.feed_for_chip_mm_min(&teeth(), RPM, 0.05);
    close(wary, sure / 1.1, 1e-6);
    close(slot.chip_thickness_bound_mm(&teeth(), wary, RPM), 0.05, 1e-6);
    slot.graze = 0.9;
    let grazing = slot.feed_for_chip_mm_min(&teeth(), RPM, 0.05);
    close(grazing, 0.05 * 4.0 * RPM / 0.9, 1e-12);
    close(slot.chip_thickness_bound_mm(&teeth(), grazing, RPM), 0.05, 1e-12);
    assert!(slot.chip_thickness_mm(&teeth(), grazing, RPM) < 0.05);
}

#[test]
fn air_limits_nothing() {
    let air = Engagement::empty_along(1.0, 0.0, 5.0);
    assert_eq!(air.chip_thickness_mm(&teeth(), 2000.0, RPM), 0.0);
    assert_eq!(air.chip_thickness_bound_mm(&teeth(), 2000.0, RPM), 0.0);
    assert_eq!(air.feed_for_chip_mm_min(&teeth(), RPM, 0.065), f64::INFINITY);
    assert_eq!(air.removal_rate_mm3_min(2000.0), 0.0);
    assert_eq!(air.feed_for_removal_rate_mm_min(1.0), f64::INFINITY);
    assert_eq!(Engagement::empty_along(1.0, 0.0, 0.0).removal_rate_mm3_min(1.0), 0.0);
}
