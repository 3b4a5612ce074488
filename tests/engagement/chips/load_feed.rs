//! Feeds at which loads reach their limits.

use super::{close, cutter, milling};
use clsmith::cutter::Teeth;
use clsmith::engagement::{CuttingCoefficients, CuttingLoads, Engagement, LoadModel};
use clsmith::program::record::SpindleDirection::Clockwise;
use proptest::prelude::*;

const RPM: f64 = 3000.0;

const STEEL: CuttingCoefficients =
    CuttingCoefficients { k_tc: 1800.0, k_te: 25.0, k_rc: 600.0, k_re: 30.0, k_ac: 200.0, k_ae: 5.0 };

const FREE: CuttingLoads =
    CuttingLoads { force_n: f64::INFINITY, torque_nm: f64::INFINITY, power_kw: f64::INFINITY };

#[test]
fn torque_in_closed_form() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(1, 0.0).unwrap());
    let model = LoadModel::new(&profile, &teeth, STEEL, Clockwise);
    let slot = milling(&profile, 3.0, -90.0, 90.0);
    let feed = model.feed_for_load_mm_min(&slot, RPM, CuttingLoads { torque_nm: 3.0, ..FREE });
    // 3 N m = (1800 h + 25) 15e-3.
    close(feed, (3.0 / 15e-3 - 25.0) / 1800.0 * RPM, 4e-4);
    assert!(model.cutting_loads(&slot, feed, RPM).torque_nm <= 3.0);
}

#[test]
fn limits_that_hold_nothing_or_everything() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.4).unwrap());
    let model = LoadModel::new(&profile, &teeth, STEEL, Clockwise);
    let mut slot = milling(&profile, 3.0, -90.0, 90.0);
    let air = Engagement::empty_along(1.0, 0.0, 5.0);
    let tight = CuttingLoads { force_n: 1.0, ..FREE };
    assert_eq!(model.feed_for_load_mm_min(&air, RPM, tight), f64::INFINITY);
    assert_eq!(model.feed_for_load_mm_min(&slot, RPM, FREE), f64::INFINITY);
    assert_eq!(model.feed_for_load_mm_min(&slot, RPM, tight), 0.0);
    // Material of 0.01 mm: at most (1800 x 0.01 + 25) 15 N mm for each tooth, whatever the feed.
    slot.bins.iter_mut().for_each(|bin| bin.thickness = 0.01);
    assert_eq!(
        model.feed_for_load_mm_min(&slot, RPM, CuttingLoads { torque_nm: 1.4, ..FREE }),
        f64::INFINITY
    );
    let held = model.feed_for_load_mm_min(&slot, RPM, CuttingLoads { torque_nm: 0.6, ..FREE });
    assert!(held.is_finite() && held > 0.0);
}

proptest! {
    #![proptest_config(crate::support::property(40))]
    #[test]
    fn the_limit_is_reached_and_not_passed(
        corner in 0.0..5.0,
        depth in 0.1..8.0,
        from in 0..20,
        count in 1_u32..5,
        runout in 0.0..0.02,
        part in 0.3..3.0,
        which in 0..3,
    ) {
        let profile = cutter(10.0, corner);
        let pitch = vec![1.0; count as usize];
        let teeth = Teeth::with_eccentricity(pitch, if runout < 0.01 { 0.0 } else { runout }, 0.3, 0.6).unwrap();
        let model = LoadModel::new(&profile, &teeth, STEEL, Clockwise);
        let cut = milling(&profile, depth, f64::from(from) * 3.0, 90.0);
        let base = model.cutting_loads(&cut, 600.0, RPM);
        let limits = match which {
            0 => CuttingLoads { force_n: base.force_n * part, ..FREE },
            1 => CuttingLoads { torque_nm: base.torque_nm * part, ..FREE },
            _ => CuttingLoads { power_kw: base.power_kw * part, ..FREE },
        };
        let feed = model.feed_for_load_mm_min(&cut, RPM, limits);
        if feed > 0.0 {
            let at = model.cutting_loads(&cut, feed, RPM);
            prop_assert!(at.force_n <= limits.force_n);
            prop_assert!(at.torque_nm <= limits.torque_nm && at.power_kw <= limits.power_kw);
        }
        let more = model.cutting_loads(&cut, feed.max(1e-6) * (1.0 + 2e-6), RPM);
        prop_assert!(
            more.force_n > limits.force_n || more.torque_nm > limits.torque_nm || more.power_kw > limits.power_kw
        );
    }
}
