//! This module computes the time that a path takes, with feeds that change no faster than an acceleration.

/// A part of the path at one feed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimedSegment {
    /// Its length in mm.
    pub length: f64,
    /// Its feed in mm/min.
    pub feed: f64,
    /// Whether a rapid, a stop or a tool change lies before it.
    pub breaks_chain: bool,
}

/// Returns the length of path in mm that a change between two feeds (mm/min) needs at an acceleration
/// ((mm/min)/s).
pub fn speed_change_distance_mm(from: f64, to: f64, acceleration: f64) -> f64 {
    // v dv = a ds, with speeds in mm/min and the acceleration in (mm/min)/s: 2 x 60 = 120.
    (to * to - from * from).abs() / (120.0 * acceleration)
}

pub(super) fn reachable_feed_mm_min(from: f64, acceleration: f64, length: f64) -> f64 {
    (from * from + 120.0 * acceleration * length).sqrt()
}

/// Returns the time in seconds that a path takes.
///
/// With an acceleration ((mm/min)/s), the feed changes no faster than that. A segment is entered at the lower
/// one of its own feed and the feed before it. It speeds up within itself, and slows down within itself
/// towards a lower feed after it. If a feed cannot be reached in time, the machine is assumed to look ahead,
/// as every control does. The ends of chains are passed at feed. Segments without length or feed take no
/// time.
///
/// ```
/// use clsmith::internals::transform::optimize_feed::{TimedSegment, path_time_s};
///
/// let at = |feed: f64| TimedSegment { length: 100.0, feed, breaks_chain: false };
/// let path = [at(3000.0), at(6000.0)];
/// assert_eq!(path_time_s(&path, None), 3.0);
/// // At 100 mm/s2 the second half speeds up from 50 to 100 mm/s over its first 37.5 mm.
/// assert!((path_time_s(&path, Some(6000.0)) - 3.125).abs() < 1e-9);
/// ```
pub fn path_time_s(path: &[TimedSegment], acceleration: Option<f64>) -> f64 {
    let Some(acceleration) = acceleration.filter(|acceleration| *acceleration > 0.0) else {
        return path
            .iter()
            .filter(|segment| is_moving(segment))
            .map(|segment| time_at_feed_s(segment.length, segment.feed))
            .sum();
    };
    let mut total = 0.0;
    let mut chain: Vec<TimedSegment> = Vec::new();
    for segment in path {
        if segment.breaks_chain {
            total += chain_time_s(&chain, acceleration);
            chain.clear();
        }
        if is_moving(segment) {
            chain.push(*segment);
        }
    }
    total + chain_time_s(&chain, acceleration)
}

fn is_moving(segment: &TimedSegment) -> bool {
    segment.length > 0.0 && segment.feed > 0.0
}

fn time_at_feed_s(length: f64, feed: f64) -> f64 {
    60.0 * length / feed
}

fn chain_time_s(chain: &[TimedSegment], acceleration: f64) -> f64 {
    // The speed at a boundary is the lower one of both feeds, and no more than what can be reached from
    // either side.
    let first = chain.first().map(|segment| segment.feed);
    let last = chain.last().map(|segment| segment.feed);
    let inner = chain.windows(2).filter_map(|pair| match pair {
        [a, b] => Some(a.feed.min(b.feed)),
        _ => None,
    });
    let mut speeds: Vec<f64> = first.into_iter().chain(inner).chain(last).collect();
    // Forwards: F_k^2 <= F_{k-1}^2 + 120 a L_k. A chain is entered at its feed, so its start has no limit.
    let mut before = f64::INFINITY;
    for (speed, length) in speeds.iter_mut().zip(std::iter::once(0.0).chain(segment_lengths_mm(chain))) {
        *speed = speed.min(reachable_feed_mm_min(before, acceleration, length));
        before = *speed;
    }
    // Slowing down is speeding up in the opposite direction, so the same pass runs backwards.
    let mut after = f64::INFINITY;
    for (speed, length) in
        speeds.iter_mut().rev().zip(std::iter::once(0.0).chain(segment_lengths_mm(chain).rev()))
    {
        *speed = speed.min(reachable_feed_mm_min(after, acceleration, length));
        after = *speed;
    }
    let boundaries = speeds.windows(2);
    let segments = chain.iter().zip(boundaries).map(|(segment, speeds)| match speeds {
        [entry, exit] => trapezoid_time_s(segment, *entry, *exit, acceleration),
        _ => 0.0,
    });
    segments.sum()
}

fn segment_lengths_mm(chain: &[TimedSegment]) -> impl DoubleEndedIterator<Item = f64> {
    chain.iter().map(|segment| segment.length)
}

/// Returns the time of a segment that speeds up from the entry speed to its feed, or as far as its length
/// allows, and slows down to the exit speed.
fn trapezoid_time_s(segment: &TimedSegment, entry: f64, exit: f64, acceleration: f64) -> f64 {
    // Both ramps meet where peak^2 - entry^2 + peak^2 - exit^2 = 120 a L.
    let crossing = ((entry * entry + exit * exit) / 2.0 + 60.0 * acceleration * segment.length).sqrt();
    // Both passes have made the ends reachable, so only rounding can put the peak below one of them.
    let peak = segment.feed.min(crossing).max(entry).max(exit);
    let ramps = speed_change_distance_mm(entry, peak, acceleration)
        + speed_change_distance_mm(exit, peak, acceleration);
    // If the ramps meet, they fill the segment, and rounding alone could make the rest negative.
    let flat = (segment.length - ramps).max(0.0);
    // A speed in mm/min divided by an acceleration in (mm/min)/s gives seconds, without a factor.
    (peak - entry + peak - exit) / acceleration + time_at_feed_s(flat, peak)
}
