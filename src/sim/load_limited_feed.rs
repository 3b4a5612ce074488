//! The feed at which loads reach their limits.

use super::Engagement;
use super::cutting_force::{CuttingLoads, LoadModel};

/// Relative width of the last bracket.
const TOLERANCE: f64 = 1e-6;

/// A feed (mm/min) at which only edge forces act.
const NO_FEED: f64 = 1e-6;

/// A feed (mm/min) at which every chip is as thick as its material.
const ANY_FEED: f64 = 1e12;

/// Advance per revolution (mm) of the first trial.
const TRIAL: f64 = 0.1;

/// Most evaluations; bisection alone needs some 80 from [`NO_FEED`] to [`ANY_FEED`].
const MOST: usize = 200;

impl LoadModel {
    /// The feed in mm/min at which the first load reaches its limit, at a spindle speed in rev/min; a limit that is infinite does
    /// not hold. Infinite where no limit can be reached, as in air and where the material is thin; 0 where the edge forces
    /// alone exceed a limit.
    ///
    /// Loads grow with the feed, and are convex in it as long as no chip is as thick as its material; solved by secants within a
    /// bracket to 1e-6 of the feed. The loads at the feed returned, as [`LoadModel::cutting_loads`] computes them, exceed no limit.
    pub fn feed_for_load_mm_min(&self, engagement: &Engagement, rpm: f64, limits: CuttingLoads) -> f64 {
        let contact = self.prepare_engagement(engagement);
        let part = |feed: f64| {
            let loads = self.loads_of_prepared(&contact, feed, rpm);
            let force = loads.force_n / limits.force_n;
            let torque = loads.torque_nm / limits.torque_nm;
            force.max(torque).max(loads.power_kw / limits.power_kw)
        };
        let start = (NO_FEED, part(NO_FEED));
        if start.1 > 1.0 {
            return 0.0;
        }
        let mut low = start;
        let mut high = (ANY_FEED, part(ANY_FEED));
        if high.1 <= 1.0 || high.1.is_nan() {
            return f64::INFINITY;
        }
        // Loads that are affine in the feed are met by the first secant, and the bracket closes a hair beside it.
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
            // While no feed but the last resort is known to be too much, the line through the two known ends leads on.
            let far = if high.0 < ANY_FEED { high } else { low };
            let base = if far.0 > low.0 { low } else { start };
            let secant = base.0 + (1.0 - base.1) * (far.0 - base.0) / (far.1 - base.1);
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
}
