//! Acceleration along the path: feeds that can be reached, and the time a path takes.
//!
//! `v dv = a ds`: over a length L (mm) the feed (mm/min) changes at `a` ((mm/min)/s) so that `F2^2 - F1^2 = 120 a L`; the 120 is
//! 2 x 60, from minutes and seconds.

use super::path_time::reachable_feed_mm_min;
use crate::transform::optimize_feed::limit::FeedSegment;

/// Lowers feeds to what a part can reach from the one before and leave for the one after, each within its own length. Never raises.
pub(super) fn limit_feed_changes(segments: &mut [FeedSegment], acceleration: f64) {
    let within = |segment: &mut FeedSegment, beside: Option<(usize, f64)>| {
        if let Some((_, feed)) = beside.filter(|(chain, _)| *chain == segment.chain && !segment.fixed) {
            segment.feed = segment.feed.min(reachable_feed_mm_min(feed, acceleration, segment.length));
        }
        Some((segment.chain, segment.feed))
    };
    let mut beside = None;
    for segment in segments.iter_mut() {
        beside = within(segment, beside);
    }
    beside = None;
    for segment in segments.iter_mut().rev() {
        beside = within(segment, beside);
    }
}
