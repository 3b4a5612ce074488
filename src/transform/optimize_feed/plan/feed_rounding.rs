//! This module rounds feeds down, and joins feeds that are so close together that one FEDRAT is enough.

use crate::transform::optimize_feed::limit::{FeedRules, FeedSegment};
use crate::transform::optimize_feed::measure::FeedBlock;

/// The relative difference that arithmetic leaves between equal numbers.
const NOISE: f64 = 1e-12;

/// Rounds feeds down and removes small changes.
///
/// Consecutive segments whose feeds differ by less than the fraction `min_change` take the lowest of them. If
/// programmed feeds are at most the same fraction below that, they stay. A rapid between segments does not
/// separate them, because the feed is in force again after it.
pub(super) fn round_and_even_out(segments: &mut [FeedSegment], blocks: &[FeedBlock], rules: &FeedRules) {
    for segment in segments.iter_mut().filter(|segment| !segment.fixed) {
        segment.feed = round_to_step(segment.feed, segment.least, rules.round_down_to);
    }
    let programmed = |segment: &FeedSegment| blocks.get(segment.block).map_or(0.0, |block| block.programmed);
    let keeps = 1.0 - rules.min_change.clamp(0.0, 1.0);
    let mut start = 0;
    while let Some(rest) = segments.get_mut(start..).filter(|rest| !rest.is_empty()) {
        let count = count_sharing_segments(rest, keeps);
        let run = rest.get_mut(..count).unwrap_or_default();
        even_out(run, &programmed, keeps);
        start += count;
    }
}

/// Rounds a feed down to a multiple of the step. The result is not below the lowest feed that the feed kept,
/// and not zero.
fn round_to_step(feed: f64, least: f64, step: f64) -> f64 {
    if step <= 0.0 {
        return feed;
    }
    // A multiple of the step may come out of the division a hair too low. Without the noise it would lose a
    // whole step, and a second run would change the program again.
    let down = ((feed / step * (1.0 + NOISE)).floor() * step).min(feed);
    // Acceleration may have lowered a feed below the lowest one. Raising it again here would ask the machine
    // for a change that it cannot make.
    let down = if feed >= least { down.max(least) } else { down };
    if down > 0.0 { down } else { feed }
}

/// Returns how many segments from the first on can have the same feed. A fixed segment is alone.
fn count_sharing_segments(segments: &[FeedSegment], keeps: f64) -> usize {
    let (mut lowest, mut highest) = (f64::INFINITY, 0.0f64);
    let mut count = 0;
    for segment in segments {
        (lowest, highest) = (lowest.min(segment.feed), highest.max(segment.feed));
        // The whole run is compared, not just neighbours, because many small changes in a row add up to a
        // large one.
        if segment.fixed || lowest < keeps * highest {
            break;
        }
        count += 1;
    }
    count.max(1)
}

fn even_out(run: &mut [FeedSegment], programmed: &impl Fn(&FeedSegment) -> f64, keeps: f64) {
    if run.iter().any(|segment| segment.fixed) {
        return;
    }
    let lowest = run.iter().map(|segment| segment.feed).fold(f64::INFINITY, f64::min);
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
