//! This module finds the feed at which loads reach their limits.

use crate::engagement::Engagement;
use crate::engagement::cutting_force::{BendingLoads, CuttingLoads, LoadModel};

/// The relative width at which the bracket is narrow enough.
const TOLERANCE: f64 = 1e-6;

/// A feed (mm/min) that is so small that only edge forces act.
const NO_FEED: f64 = 1e-6;

/// A feed (mm/min) that is so large that every chip is as thick as its material.
const ANY_FEED: f64 = 1e12;

/// The advance per revolution (mm) of the first trial.
const TRIAL: f64 = 0.1;

/// The most evaluations. Bisection alone needs about 80 from [`NO_FEED`] to [`ANY_FEED`].
const MOST: usize = 200;

impl LoadModel {
    /// Returns the feed in mm/min at which the first load reaches its limit, at a spindle speed in rev/min.
    /// An infinite limit has no effect. The result is infinite if no limit can be reached, as in air and
    /// where the material is thin; it is 0 if the edge forces alone exceed a limit.
    ///
    /// Loads grow with the feed, and are convex in it as long as no chip is as thick as its material. The
    /// equation is solved by secants within a bracket, to 1e-6 of the feed. The loads at the returned feed,
    /// as [`LoadModel::cutting_loads`] computes them, exceed no limit.
    pub fn feed_for_load_mm_min(&self, engagement: &Engagement, rpm: f64, limits: CuttingLoads) -> f64 {
        let contact = self.prepare_engagement(engagement);
        let part = |feed: f64| {
            let loads = self.loads_of_prepared(&contact, feed, rpm);
            let force = loads.force_n / limits.force_n;
            let torque = loads.torque_nm / limits.torque_nm;
            force.max(torque).max(loads.power_kw / limits.power_kw)
        };
        find_feed(rpm, part)
    }

    /// Returns the feed in mm/min at which deflection or stress reaches its limit, as [`LoadModel::feed_for_load_mm_min`]
    /// does for other loads.
    pub fn feed_for_bending_mm_min(&self, engagement: &Engagement, rpm: f64, limits: BendingLoads) -> f64 {
        let contact = self.prepare_engagement(engagement);
        let part = |feed: f64| {
            let loads = self.bending_of_prepared(&contact, feed, rpm);
            (loads.deflection_mm / limits.deflection_mm).max(loads.stress_mpa / limits.stress_mpa)
        };
        find_feed(rpm, part)
    }
}

/// Returns the feed in mm/min at which a load, as a part of its limit, is 1.
fn find_feed(rpm: f64, part: impl Fn(f64) -> f64) -> f64 {
    let start = (NO_FEED, part(NO_FEED));
    if start.1 > 1.0 {
        return 0.0;
    }
    let mut low = start;
    let mut high = (ANY_FEED, part(ANY_FEED));
    if high.1 <= 1.0 || high.1.is_nan() {
        return f64::INFINITY;
    }
    // Where a load is linear in the feed, the first secant already hits it. The next trials are a little
    // beside the secant, so that the bracket closes around it.
    let hair = TOLERANCE / 4.0;
    let mut beside = (TRIAL * rpm, part(TRIAL * rpm));
    for count in 0..MOST {
        if beside.1 <= 1.0 && beside.0 > low.0 {
            low = beside;
        } else if beside.1 > 1.0 && beside.0 < high.0 {
            high = beside;
        }
        if high.0 <= low.0 * (1.0 + TOLERANCE) {
            break;
        }
        // As long as the upper end of the bracket is only the last resort, the secant goes through the
        // two known lower points.
        let far = if high.0 < ANY_FEED { high } else { low };
        let base = if far.0 > low.0 { low } else { start };
        let secant = base.0 + (1.0 - base.1) * (far.0 - base.0) / (far.1 - base.1);
        // Every third trial bisects the bracket on a logarithmic scale, so that it always shrinks.
        let feed = match count % 3 {
            0 => secant * (1.0 - hair),
            1 => secant * (1.0 + hair),
            _ => (low.0 * high.0).sqrt(),
        };
        let inside = feed > low.0 && feed < high.0;
        let feed = if inside { feed } else { (low.0 * high.0).sqrt() };
        beside = (feed, part(feed));
    }
    low.0
}
