//! This module computes the time of motions at feed: look-ahead with acceleration and jerk along the path, and the time
//! that corners cost.
//!
//! The corner law: a kink costs `c sqrt(|dv|)`, with `dv` the change of the velocity vector. A jerk-limited control
//! that passes a corner needs a time that grows with the root of the change of speed; `c` is a property of the
//! machine. A tangent junction costs nothing. A step of the feed on one is made inside the faster motion.

use super::axis_time::{peak_speed, reachable_speed, speed_change_s, speed_change_way};
use nalgebra::Vector3;

/// The angle in radians below which a junction is tangent.
const TANGENT_ANGLE: f64 = 1e-6;

/// A motion at feed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeedMotion {
    /// Its length in mm, above 0.
    pub length: f64,
    /// Its speed in mm/s, above 0.
    pub speed: f64,
    /// The unit tangents at its start and end.
    pub tangents: [Vector3<f64>; 2],
    /// The acceleration along the path in mm/s2; `None` where speeds change at once.
    pub acceleration: Option<f64>,
    /// The jerk along the path in mm/s3.
    pub jerk: Option<f64>,
    /// Whether the machine stands before it: at the start, and after a rapid, a stop or a tool change.
    pub is_from_rest: bool,
}

/// What the time at feed consists of, in s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FeedTimeParts {
    /// Length by feed.
    pub feed: f64,
    /// Lost at corners.
    pub corners: f64,
    /// Lost by starting and stopping.
    pub start_stop: f64,
    /// Lost by changes of the feed.
    pub feed_steps: f64,
}

impl FeedTimeParts {
    /// Returns the sum.
    pub fn total(&self) -> f64 {
        self.feed + self.corners + self.start_stop + self.feed_steps
    }
}

/// Motions in a row at one speed without a kink.
#[derive(Debug, Clone, Copy)]
struct PathStretch {
    first: usize,
    count: usize,
    length: f64,
    speed: f64,
    acceleration: Option<f64>,
    jerk: Option<f64>,
    entry: f64,
    exit: f64,
    /// Whether a kink lies before it.
    after_kink: bool,
}

/// Computes the time of each motion. `add` gets the number of a motion and its time in s; the time that a corner costs
/// belongs to the motion after it.
pub fn time_feed_motions(
    motions: &[FeedMotion],
    corner_constant: f64,
    mut add: impl FnMut(usize, f64),
) -> FeedTimeParts {
    let mut parts = FeedTimeParts::default();
    let mut stretches: Vec<PathStretch> = Vec::new();
    let mut start = 0;
    while start < motions.len() {
        stretches.clear();
        let end = collect_stretches(motions, start, &mut stretches);
        look_ahead(&mut stretches);
        let mut before: Option<&PathStretch> = None;
        for (number, stretch) in stretches.iter().enumerate() {
            if let Some(before) = before.filter(|_| stretch.after_kink) {
                let tangent = |place: usize, side: usize| {
                    motions
                        .get(place)
                        .and_then(|motion| motion.tangents.get(side))
                        .copied()
                        .unwrap_or_default()
                };
                let change = tangent(stretch.first, 0) * stretch.entry
                    - tangent(stretch.first.saturating_sub(1), 1) * before.exit;
                let lost = corner_constant * change.norm().sqrt();
                parts.corners += lost;
                add(stretch.first, lost);
            }
            let is_last = number + 1 == stretches.len();
            time_stretch(stretch, motions, [number == 0, is_last], &mut parts, &mut add);
            before = Some(stretch);
        }
        start = end;
    }
    parts
}

/// Divides the motions up to the next rest into stretches. Returns where the next chain begins.
fn collect_stretches(motions: &[FeedMotion], start: usize, stretches: &mut Vec<PathStretch>) -> usize {
    let mut before: Option<&FeedMotion> = None;
    for (number, motion) in motions.iter().enumerate().skip(start) {
        if number > start && motion.is_from_rest {
            return number;
        }
        let is_kink = before.is_some_and(|before| {
            (motion.tangents[0] - before.tangents[1]).norm_squared() > TANGENT_ANGLE * TANGENT_ANGLE
        });
        match stretches.last_mut() {
            Some(last)
                if !is_kink
                    && last.speed == motion.speed
                    && last.acceleration == motion.acceleration
                    && last.jerk == motion.jerk =>
            {
                last.count += 1;
                last.length += motion.length;
            }
            _ => stretches.push(PathStretch {
                first: number,
                count: 1,
                length: motion.length,
                speed: motion.speed,
                acceleration: motion.acceleration,
                jerk: motion.jerk,
                entry: 0.0,
                exit: 0.0,
                after_kink: is_kink,
            }),
        }
        before = Some(motion);
    }
    motions.len()
}

/// Finds the speeds at the ends of the stretches of a chain, which begins and ends at rest. A tangent junction is
/// passed at the lower feed, a kink at both, in proportion where they cannot be reached.
fn look_ahead(stretches: &mut [PathStretch]) {
    let reach = |stretch: &PathStretch, from: f64| match stretch.acceleration {
        Some(acceleration) => {
            reachable_speed(from, stretch.length, acceleration, stretch.jerk).min(stretch.speed)
        }
        None => stretch.speed,
    };
    let mut before: Option<PathStretch> = None;
    for stretch in stretches.iter_mut() {
        stretch.entry = match before {
            None if stretch.acceleration.is_none() => stretch.speed,
            None => 0.0,
            Some(before) if stretch.after_kink => before.exit * stretch.speed / before.speed,
            Some(before) => before.exit.min(stretch.speed),
        };
        stretch.exit = reach(stretch, stretch.entry);
        before = Some(*stretch);
    }
    let mut after: Option<PathStretch> = None;
    for stretch in stretches.iter_mut().rev() {
        let exit = match after {
            None if stretch.acceleration.is_none() => stretch.speed,
            None => 0.0,
            Some(after) if after.after_kink => after.entry * stretch.speed / after.speed,
            Some(after) => after.entry,
        };
        stretch.exit = stretch.exit.min(exit);
        stretch.entry = stretch.entry.min(reach(stretch, stretch.exit));
        after = Some(*stretch);
    }
    // What the second pass took from an entry was the exit of the stretch before, which it then saw.
}

/// Adds the time of a stretch to its motions and to the parts.
fn time_stretch(
    stretch: &PathStretch,
    motions: &[FeedMotion],
    [is_first, is_last]: [bool; 2],
    parts: &mut FeedTimeParts,
    add: &mut impl FnMut(usize, f64),
) {
    let mine = || motions.iter().enumerate().skip(stretch.first).take(stretch.count);
    let at_feed = stretch.length / stretch.speed;
    parts.feed += at_feed;
    let Some(acceleration) = stretch.acceleration else {
        mine().for_each(|(number, motion)| add(number, motion.length / motion.speed));
        return;
    };
    let profile = SpeedProfile::new(stretch, acceleration);
    let [start, end] = [profile.lost_s(stretch, stretch.entry), profile.lost_s(stretch, stretch.exit)];
    let lost = (profile.total_s() - at_feed).max(0.0);
    // Where the speed of the feed is not reached, both losses share what is lost.
    let both = start + end;
    let share = if both > 0.0 && both.is_finite() { start / both } else { 1.0 };
    for (loss, is_rest) in [(lost * share, is_first), (lost * (1.0 - share), is_last)] {
        let part = if is_rest { &mut parts.start_stop } else { &mut parts.feed_steps };
        *part += loss;
    }
    if stretch.count == 1 {
        add(stretch.first, profile.total_s());
        return;
    }
    let (mut way, mut before) = (0.0, 0.0);
    let last = stretch.first + stretch.count - 1;
    for (number, motion) in mine() {
        way += motion.length;
        let now = if number == last { profile.total_s() } else { profile.time_at(way) };
        add(number, (now - before).max(0.0));
        before = now;
    }
}

/// The speed over a stretch: up, even, down.
struct SpeedProfile {
    entry: f64,
    exit: f64,
    peak: f64,
    acceleration: f64,
    jerk: Option<f64>,
    /// Times of the three parts, and ways of the first two.
    times: [f64; 3],
    ways: [f64; 2],
    length: f64,
}

impl SpeedProfile {
    fn new(stretch: &PathStretch, acceleration: f64) -> Self {
        let PathStretch { entry, exit, length, speed, jerk, .. } = *stretch;
        let peak = speed.min(peak_speed(entry, exit, length, acceleration, jerk)).max(entry).max(exit);
        let way = |end: f64| speed_change_way(end, peak, acceleration, jerk);
        let time = |end: f64| speed_change_s(peak - end, acceleration, jerk);
        let even = (length - way(entry) - way(exit)).max(0.0);
        let times = [time(entry), if even > 0.0 && peak > 0.0 { even / peak } else { 0.0 }, time(exit)];
        Self { entry, exit, peak, acceleration, jerk, times, ways: [way(entry), even], length }
    }

    fn total_s(&self) -> f64 {
        self.times.iter().sum()
    }

    /// Returns the time that a change between the feed and a speed at an end costs.
    fn lost_s(&self, stretch: &PathStretch, end: f64) -> f64 {
        let time = speed_change_s(stretch.speed - end, self.acceleration, self.jerk);
        time - speed_change_way(end, stretch.speed, self.acceleration, self.jerk) / stretch.speed
    }

    /// Returns when a way from the start is done.
    fn time_at(&self, way: f64) -> f64 {
        let [up, even] = self.ways;
        let [up_s, even_s, _] = self.times;
        if way < up {
            return self.ramp_time(self.entry, way);
        }
        if way <= up + even {
            return up_s + (way - up) / self.peak;
        }
        // Slowing down is speeding up in the opposite direction.
        let left = (self.length - way).max(0.0);
        self.total_s() - self.ramp_time(self.exit, left).min(self.total_s() - up_s - even_s)
    }

    /// Returns the time from the slow end of a ramp until a way is done.
    fn ramp_time(&self, slow: f64, way: f64) -> f64 {
        let Some(jerk) = self.jerk else {
            let reached = (slow * slow + 2.0 * self.acceleration * way).sqrt();
            return (reached - slow) / self.acceleration;
        };
        let change = self.peak - slow;
        let whole = speed_change_s(change, self.acceleration, self.jerk);
        // The largest acceleration, and the time until it is there.
        let most = self.acceleration.min((change * jerk).sqrt());
        let bend = most / jerk;
        let way_at = |time: f64| {
            let bent = |time: f64| slow * time + jerk * time.powi(3) / 6.0;
            if time <= bend {
                return bent(time);
            }
            let at_bend = slow + most * bend / 2.0;
            if time <= whole - bend {
                let since = time - bend;
                return bent(bend) + at_bend * since + most * since * since / 2.0;
            }
            let left = whole - time;
            (slow + self.peak) / 2.0 * whole - (self.peak * left - jerk * left.powi(3) / 6.0)
        };
        let (mut low, mut high) = (0.0, whole);
        for _ in 0..50 {
            let middle = (low + high) / 2.0;
            if way_at(middle) < way { low = middle } else { high = middle }
        }
        low
    }
}
