//! This module gives neighbouring segments one feed, so that few FEDRATs are written.
//!
//! `min_change` is the part of the path time that may be given up for that. The time is the one that the machine takes
//! with its acceleration, because feeds that it cannot reach save nothing.

use super::feed_rounding::{NOISE, round_to_step};
use super::path_time::{TimedSegment, path_time_s, reachable_feed_mm_min};
use super::plateau_partition::{FreeStretch, partition_into_plateaus};
use crate::transform::optimize_feed::limit::{FeedRules, FeedSegment};
use crate::transform::optimize_feed::measure::FeedBlock;
use std::ops::Range;

/// Prices of a plateau are tried until two of them differ by less than this ratio.
const NEAR_PRICES: f64 = 1.1;

/// The lowest price of a plateau in minutes. Below it nothing is saved that a machine could tell.
const LEAST_PRICE: f64 = 1e-9;

/// Rounds feeds down and joins segments to plateaus, each at the lowest feed of its segments.
///
/// Where programmed feeds are at most the fraction `min_change` below that, they stay. A rapid between segments does
/// not separate them, because the feed is in force again after it. A plateau that is too short for the machine to slow
/// down for what follows gets the feed from which it can: it would come no faster anyway.
pub(super) fn join_into_plateaus(segments: &mut [FeedSegment], blocks: &[FeedBlock], rules: &FeedRules) {
    for segment in segments.iter_mut().filter(|segment| !segment.fixed) {
        segment.feed = round_to_step(segment.feed, segment.least, rules.round_down_to);
    }
    let plateaus = choose_plateaus(segments, rules);
    let programmed = |segment: &FeedSegment| blocks.get(segment.block).map_or(0.0, |block| block.programmed);
    let keeps = 1.0 - rules.min_change.clamp(0.0, 1.0);
    for plateau in &plateaus {
        even_out(segments.get_mut(plateau.clone()).unwrap_or_default(), &programmed, keeps);
    }
    if let Some(acceleration) = rules.max_acceleration {
        slow_down_in_time(segments, &plateaus, acceleration, rules.round_down_to);
    }
}

/// Returns the plateaus with the fewest FEDRATs whose path time is at most the fraction `min_change` above that of the
/// free feeds. Fixed segments are in none.
fn choose_plateaus(segments: &[FeedSegment], rules: &FeedRules) -> Vec<Range<usize>> {
    let sections = list_sections(segments);
    let partition = |price: f64| -> Vec<Range<usize>> {
        sections.iter().flat_map(|section| partition_section(segments, section, price)).collect()
    };
    let mut timed = list_timed_segments(segments);
    let free = path_time_s(&timed, rules.max_acceleration);
    let allowed = free * (1.0 + rules.min_change) * (1.0 + NOISE);
    let mut is_allowed = |plateaus: &[Range<usize>]| {
        for plateau in plateaus {
            let feed = lowest_feed(segments.get(plateau.clone()).unwrap_or_default());
            let own = timed.get_mut(plateau.clone()).unwrap_or_default();
            own.iter_mut().for_each(|segment| segment.feed = feed);
        }
        path_time_s(&timed, rules.max_acceleration) <= allowed
    };
    let (mut low, mut high) = (LEAST_PRICE, free / 60.0 + LEAST_PRICE);
    let mut best = partition(low);
    while high > low * NEAR_PRICES {
        let price = (low * high).sqrt();
        let plateaus = partition(price);
        if is_allowed(&plateaus) {
            (low, best) = (price, plateaus);
        } else {
            high = price;
        }
    }
    best
}

/// Returns the runs of segments whose feeds may be the same: none is fixed, and the lowest feed of each is allowed in
/// all of them.
fn list_sections(segments: &[FeedSegment]) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    let (mut lowest, mut least) = (f64::INFINITY, 0.0_f64);
    for (index, segment) in segments.iter().enumerate() {
        if segment.fixed {
            continue;
        }
        (lowest, least) = (lowest.min(segment.feed), least.max(segment.least.min(segment.feed)));
        match found.last_mut() {
            Some(last) if last.end == index && lowest >= least => last.end = index + 1,
            _ => {
                (lowest, least) = (segment.feed, segment.least.min(segment.feed));
                found.push(index..index + 1);
            }
        }
    }
    found
}

fn partition_section(segments: &[FeedSegment], section: &Range<usize>, price_min: f64) -> Vec<Range<usize>> {
    let own = segments.get(section.clone()).unwrap_or_default();
    let stretch =
        |segment: &FeedSegment| FreeStretch { length_mm: segment.length, feed_mm_min: segment.feed };
    let stretches: Vec<FreeStretch> = own.iter().map(stretch).collect();
    let mut start = section.start;
    let plateau = |end: usize| {
        let from = std::mem::replace(&mut start, section.start + end);
        from..section.start + end
    };
    partition_into_plateaus(&stretches, price_min).into_iter().map(plateau).collect()
}

fn list_timed_segments(segments: &[FeedSegment]) -> Vec<TimedSegment> {
    let mut chain = None;
    let timed = |segment: &FeedSegment| {
        let breaks_chain = chain.replace(segment.chain) != Some(segment.chain);
        TimedSegment { length: segment.length, feed: segment.feed, breaks_chain }
    };
    segments.iter().map(timed).collect()
}

fn lowest_feed(segments: &[FeedSegment]) -> f64 {
    segments.iter().map(|segment| segment.feed).fold(f64::INFINITY, f64::min)
}

fn even_out(run: &mut [FeedSegment], programmed: &impl Fn(&FeedSegment) -> f64, keeps: f64) {
    let lowest = lowest_feed(run);
    let stays = |feed: f64| (keeps * lowest * (1.0 - NOISE)..=lowest).contains(&feed);
    // A programmed feed that is slightly lower is kept, because it needs no FEDRAT of its own.
    let kept = run.iter().map(programmed).filter(|feed| stays(*feed)).reduce(f64::max);
    // If every programmed feed is close enough, each block keeps its own and nothing has to be written at
    // all.
    let all_stay = run.iter().map(programmed).all(stays);
    for segment in run {
        segment.feed = if all_stay { programmed(segment) } else { kept.unwrap_or(lowest) };
    }
}

/// Lowers plateaus that are too short to slow down for what comes after them in their chain.
fn slow_down_in_time(
    segments: &mut [FeedSegment],
    plateaus: &[Range<usize>],
    acceleration: f64,
    round_down_to: f64,
) {
    for plateau in plateaus.iter().rev() {
        let mut end = plateau.end;
        // The machine may stand still between chains, so each part of a plateau in a chain is for itself.
        while end > plateau.start {
            let Some(chain) = segments.get(end - 1).map(|last| last.chain) else { return };
            let next = segments.get(end).filter(|next| next.chain == chain).map(|next| next.feed);
            let own = segments.get_mut(plateau.start..end).unwrap_or_default();
            let count = own.iter().rev().take_while(|segment| segment.chain == chain).count();
            end -= count;
            let own = segments.get_mut(end..end + count).unwrap_or_default();
            let length: f64 = own.iter().map(|segment| segment.length).sum();
            let Some(next) = next else { continue };
            let reachable = reachable_feed_mm_min(next, acceleration, length);
            for segment in own.iter_mut().filter(|segment| segment.feed > reachable) {
                // Rounding must not go below the feed that follows: no machine has to slow down to that.
                segment.feed = round_to_step(reachable, 0.0, round_down_to).max(next.min(segment.feed));
            }
        }
    }
}
