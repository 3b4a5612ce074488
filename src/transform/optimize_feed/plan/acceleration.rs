//! This module lowers feeds to what acceleration along the path can reach.
//!
//! The equation is `v dv = a ds`. Over a length L (mm), with feeds in mm/min and `a` in (mm/min)/s, it gives
//! `F2^2 - F1^2 = 120 a L`. The 120 is 2 x 60 and comes from minutes and seconds.

use super::path_time::reachable_feed_mm_min;
use crate::transform::optimize_feed::limit::FeedSegment;

/// Lowers each feed to what a segment can reach from the one before it, and to what still lets it slow down
/// for the one after it, within its own length. Feeds are never raised.
pub(super) fn limit_feed_changes(segments: &mut [FeedSegment], acceleration: f64) {
    let within = |segment: &mut FeedSegment, beside: Option<(usize, f64)>| {
        // A fixed segment keeps its programmed feed, but it still bounds its neighbours, because the machine
        // does have that speed there.
        if let Some((_, feed)) = beside.filter(|(chain, _)| *chain == segment.chain && !segment.fixed) {
            segment.feed = segment.feed.min(reachable_feed_mm_min(feed, acceleration, segment.length));
        }
        Some((segment.chain, segment.feed))
    };
    // A pass forwards limits speeding up, a pass backwards limits slowing down. The second pass only lowers
    // feeds, and both directions have the same acceleration, so it cannot break what the first has reached.
    let mut beside = None;
    for segment in segments.iter_mut() {
        beside = within(segment, beside);
    }
    beside = None;
    for segment in segments.iter_mut().rev() {
        beside = within(segment, beside);
    }
}
