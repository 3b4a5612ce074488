//! This module holds the times and ways of changes of speed: trapezoids, and S-curves where the jerk is limited.

/// Returns the time in s of a change of speed by `change` (mm/s or deg/s).
pub(super) fn speed_change_s(change: f64, acceleration: f64, jerk: Option<f64>) -> f64 {
    match jerk {
        // The full acceleration is reached where the change is at least a2/j.
        Some(jerk) if change < acceleration * acceleration / jerk => 2.0 * (change / jerk).sqrt(),
        Some(jerk) => change / acceleration + acceleration / jerk,
        None => change / acceleration,
    }
}

/// Returns the way in mm or degrees of a change between two speeds. A change that is symmetric in time has the mean
/// speed of its ends.
pub(super) fn speed_change_way(from: f64, to: f64, acceleration: f64, jerk: Option<f64>) -> f64 {
    (from + to) / 2.0 * speed_change_s((to - from).abs(), acceleration, jerk)
}

/// Returns the largest speed that can be reached from `from` within a way.
pub(super) fn reachable_speed(from: f64, way: f64, acceleration: f64, jerk: Option<f64>) -> f64 {
    // Without a limit of jerk it is v2 = u2 + 2 a s, and with one it is never more.
    let most = (from * from + 2.0 * acceleration * way).sqrt();
    if jerk.is_none() {
        return most;
    }
    bisect_speed(from, most, |speed| speed_change_way(from, speed, acceleration, jerk) <= way)
}

/// Returns the largest speed that can be reached within a way, from one speed and down to another.
pub(super) fn peak_speed(entry: f64, exit: f64, way: f64, acceleration: f64, jerk: Option<f64>) -> f64 {
    let most = ((entry * entry + exit * exit) / 2.0 + acceleration * way).sqrt();
    if jerk.is_none() {
        return most;
    }
    let ways = |peak: f64| {
        speed_change_way(entry, peak, acceleration, jerk) + speed_change_way(exit, peak, acceleration, jerk)
    };
    bisect_speed(entry.max(exit), most, |peak| ways(peak) <= way)
}

/// Returns the largest speed between two that fits. The way of a change grows with its end.
fn bisect_speed(low: f64, high: f64, fits: impl Fn(f64) -> bool) -> f64 {
    if high <= low || fits(high) {
        return high.max(low);
    }
    let (mut low, mut high) = (low, high);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if fits(middle) { low = middle } else { high = middle }
    }
    low
}

/// Returns the time in s of a way from rest to rest at a speed per second. Without an acceleration the speed is there
/// at once.
pub fn rest_to_rest_s(way: f64, speed: f64, acceleration: Option<f64>, jerk: Option<f64>) -> f64 {
    let Some(acceleration) = acceleration else { return way / speed };
    if way <= 0.0 {
        return 0.0;
    }
    let peak = speed.min(peak_speed(0.0, 0.0, way, acceleration, jerk));
    let ramps = 2.0 * speed_change_way(0.0, peak, acceleration, jerk);
    let even = if peak > 0.0 { (way - ramps).max(0.0) / peak } else { 0.0 };
    2.0 * speed_change_s(peak, acceleration, jerk) + even
}
