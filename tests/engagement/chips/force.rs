//! Forces against closed forms.

use super::{close, cutter, milling, plunge};
use clsmith::cutter::{Meridian, Teeth};
use clsmith::engagement::{CuttingCoefficients, CuttingLoads, Engagement, LoadModel};
use clsmith::program::record::SpindleDirection::{Clockwise, CounterClockwise};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const RPM: f64 = 3000.0;

const STEEL: CuttingCoefficients =
    CuttingCoefficients { k_tc: 1800.0, k_te: 25.0, k_rc: 600.0, k_re: 30.0, k_ac: 200.0, k_ae: 5.0 };

/// Feed for a feed per tooth.
fn feed(teeth: &Teeth, per_tooth: f64) -> f64 {
    per_tooth * teeth.count() as f64 * RPM
}

fn loads(
    profile: &Meridian,
    teeth: &Teeth,
    material: CuttingCoefficients,
    engagement: &Engagement,
    fz: f64,
) -> CuttingLoads {
    LoadModel::new(profile, teeth, material, Clockwise).cutting_loads(engagement, feed(teeth, fz), RPM)
}

#[test]
fn a_straight_tooth_in_a_slot() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(1, 0.0).unwrap());
    let slot = milling(&profile, 3.0, -90.0, 90.0);
    let found = loads(&profile, &teeth, STEEL, &slot, 0.1);
    // Straight ahead the chip is the feed per tooth; the looks stand up to 1.5 degrees beside it.
    let forces =
        [STEEL.k_tc * 0.1 + STEEL.k_te, STEEL.k_rc * 0.1 + STEEL.k_re, STEEL.k_ac * 0.1 + STEEL.k_ae];
    let [tangential, radial, axial] = forces.map(|force| force * 3.0);
    close(found.force_n, (tangential * tangential + radial * radial + axial * axial).sqrt(), 4e-4);
    close(found.torque_nm, tangential * 5.0 * 1e-3, 4e-4);
    // Mean torque a_p R / (2 pi) (2 k_tc f_z + pi k_te).
    let mean = 3.0 * 5.0 / TAU * (2.0 * STEEL.k_tc * 0.1 + PI * STEEL.k_te) * 1e-3;
    close(found.power_kw, mean * TAU * RPM / 60.0 * 1e-3, 1e-6);
}

#[test]
fn two_opposite_teeth_in_a_half_slot_take_turns() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.0).unwrap());
    let half = milling(&profile, 3.0, -90.0, 0.0);
    let found = loads(&profile, &teeth, STEEL, &half, 0.1);
    close(found.torque_nm, (STEEL.k_tc * 0.1 + STEEL.k_te) * 3.0 * 5.0 * 1e-3, 4e-4);
    let mean = 2.0 * 3.0 * 5.0 / TAU * (STEEL.k_tc * 0.1 + FRAC_PI_2 * STEEL.k_te) * 1e-3;
    close(found.power_kw, mean * TAU * RPM / 60.0 * 1e-3, 1e-6);
}

#[test]
fn a_long_helix_evens_the_torque() {
    // The edge winds through a whole pitch over the depth: at every moment the same length is cut, and torque is its mean.
    let (profile, depth) = (cutter(10.0, 0.0), 10.0);
    let helix = (FRAC_PI_2 * 5.0 / depth).atan();
    let teeth = Teeth::evenly_spaced(4, helix).unwrap();
    let found = loads(&profile, &teeth, STEEL, &milling(&profile, depth, -90.0, 90.0), 0.1);
    let mean = found.power_kw * 1e3 / (TAU * RPM / 60.0);
    close(found.torque_nm, mean, 4e-3);
}

#[test]
fn power_is_coefficient_times_removal_rate() {
    // Without edge forces and with thin chips, all energy goes into the removed volume.
    let clean = CuttingCoefficients { k_te: 0.0, ..STEEL };
    let flat = cutter(10.0, 0.0);
    let ball = cutter(10.0, 5.0);
    let bull = cutter(16.0, 3.0);
    let cases = [
        (&flat, milling(&flat, 4.0, -90.0, 90.0), 1e-6),
        (&flat, milling(&flat, 4.0, 0.0, 90.0), 1e-6),
        (&flat, milling(&flat, 4.0, -90.0, -45.0), 1e-6),
        (&flat, plunge(&flat), 1e-6),
        (&ball, milling(&ball, 0.2, -90.0, 90.0), 3e-4),
        (&ball, milling(&ball, 5.0, -90.0, 90.0), 3e-4),
        (&ball, milling(&ball, 7.0, -90.0, 30.0), 3e-4),
        (&bull, milling(&bull, 1.0, -90.0, 90.0), 3e-4),
        (&bull, milling(&bull, 5.0, -30.0, 90.0), 3e-4),
    ];
    for (profile, engagement, tolerance) in cases {
        for teeth in [Teeth::evenly_spaced(1, 0.0), Teeth::evenly_spaced(5, 0.7)] {
            let teeth = teeth.unwrap();
            let found = loads(profile, &teeth, clean, &engagement, 0.08);
            let rate = engagement.removal_rate_mm3_min(feed(&teeth, 0.08));
            close(found.power_kw, clean.k_tc * rate / 60.0 * 1e-6, tolerance);
        }
    }
}

#[test]
fn uneven_teeth_spend_the_same_energy() {
    let clean = CuttingCoefficients { k_te: 0.0, ..STEEL };
    let profile = cutter(10.0, 2.0);
    let slot = milling(&profile, 4.0, -90.0, 90.0);
    let even = loads(&profile, &Teeth::evenly_spaced(3, 0.5).unwrap(), clean, &slot, 0.1);
    let pitch = Teeth::unevenly_spaced(vec![100.0, 120.0, 140.0], vec![0.0; 3], 0.5).unwrap();
    let runout = Teeth::unevenly_spaced(vec![1.0; 3], vec![0.02, 0.0, -0.01], 0.5).unwrap();
    for teeth in [pitch, runout] {
        let found = loads(&profile, &teeth, clean, &slot, 0.1);
        // Whoever cuts it, an advance is cut once a turn.
        close(found.power_kw, even.power_kw, 1e-9);
        assert!(found.force_n > even.force_n && found.torque_nm > even.torque_nm);
    }
}

#[test]
fn a_plunge_balances_but_for_the_thrust() {
    // On a flat end the normal points down: the radial coefficient acts up the axis, tangential and axial forces of two opposite
    // teeth cancel.
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.0).unwrap());
    let found = loads(&profile, &teeth, STEEL, &plunge(&profile), 0.1);
    close(found.force_n, 2.0 * 5.0 * (STEEL.k_rc * 0.1 + STEEL.k_re), 1e-6);
    close(found.torque_nm, 2.0 * (STEEL.k_tc * 0.1 + STEEL.k_te) * 12.5 * 1e-3, 1e-6);
}

#[test]
fn the_other_sense_of_rotation_mirrors() {
    let (profile, teeth) = (cutter(10.0, 2.0), Teeth::evenly_spaced(3, 0.6).unwrap());
    let of = |spindle, from, to| {
        LoadModel::new(&profile, &teeth, STEEL, spindle).cutting_loads(
            &milling(&profile, 3.0, from, to),
            900.0,
            RPM,
        )
    };
    let (one, other) = (of(Clockwise, -90.0, -30.0), of(CounterClockwise, 30.0, 90.0));
    close(one.force_n, other.force_n, 1e-6);
    close(one.torque_nm, other.torque_nm, 1e-6);
    close(one.power_kw, other.power_kw, 1e-6);
    // Up and down milling take the same power.
    close(one.power_kw, of(Clockwise, 30.0, 90.0).power_kw, 1e-6);
}

#[test]
fn no_chip_no_force() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.0).unwrap());
    let nothing = CuttingLoads { force_n: 0.0, torque_nm: 0.0, power_kw: 0.0 };
    assert_eq!(loads(&profile, &teeth, STEEL, &Engagement::empty_along(1.0, 0.0, 1.0), 0.1), nothing);
    assert_eq!(loads(&profile, &teeth, STEEL, &milling(&profile, 1.0, -90.0, 90.0), 0.0), nothing);
}

#[test]
fn material_thinner_than_the_chip_holds_the_force() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(1, 0.0).unwrap());
    let mut slot = milling(&profile, 3.0, -90.0, 90.0);
    slot.bins.iter_mut().for_each(|bin| bin.thickness = 0.02);
    let found = loads(&profile, &teeth, STEEL, &slot, 0.1);
    close(found.torque_nm, (STEEL.k_tc * 0.02 + STEEL.k_te) * 3.0 * 5.0 * 1e-3, 1e-6);
}
