//! Time and feeds under an acceleration limit, against closed forms and a brute force.

use clsmith::internals::transform::optimize_feed::{
    FeedBlock, FeedLimit, FeedRules, LimitedPiece, plan_block_feeds,
};
use clsmith::internals::transform::optimize_feed::{TimedSegment, path_time_s, speed_change_distance_mm};

fn stretch(length: f64, feed: f64) -> TimedSegment {
    TimedSegment { length, feed, breaks_chain: false }
}

fn block(length: f64, limit: f64) -> FeedBlock {
    let pieces = vec![LimitedPiece { length, limit: FeedLimit::Limit(limit) }];
    FeedBlock {
        length,
        programmed: 50.0,
        touched: true,
        splittable: true,
        axis_limit: f64::INFINITY,
        breaks_chain: false,
        pieces,
    }
}

fn only_feeds(blocks: &[FeedBlock], rules: &FeedRules) -> Vec<f64> {
    plan_block_feeds(blocks, rules).segments.iter().map(|parts| parts[0].feed).collect()
}

#[test]
fn without_a_limit_time_is_length_over_feed() {
    let path = [stretch(10.0, 600.0), stretch(5.0, 100.0), stretch(0.0, 3.0)];
    assert!((path_time_s(&path, None) - (1.0 + 3.0)).abs() < 1e-12);
}

#[test]
fn from_100_to_6000_in_closed_form() {
    // (6000^2 - 100^2) / (120 * 2000) = 149.958 mm, (6000 - 100) / 2000 = 2.95 s.
    let run_up = speed_change_distance_mm(100.0, 6000.0, 2000.0);
    assert!((run_up - 149.958_333_333).abs() < 1e-6);
    let rules = FeedRules { max_acceleration: Some(2000.0), ..FeedRules::default() };
    let reached = only_feeds(&[block(5.0, 100.0), block(run_up, 6000.0)], &rules);
    assert!((reached[1] - 6000.0).abs() < 1e-9);
    let missed = only_feeds(&[block(5.0, 100.0), block(run_up / 2.0, 6000.0)], &rules);
    assert_eq!(missed[1], 6000.0, "how far it comes is left to the machine");
    // It slows down before the slow block.
    let before = only_feeds(&[block(run_up / 2.0, 6000.0), block(5.0, 100.0)], &rules);
    let reached = (18_000_000f64 + 5000.0).sqrt();
    assert!((before[0] - reached).abs() < 1e-9 && before[1] == 100.0, "{before:?}");
    let path = [stretch(5.0, 100.0), stretch(run_up + 10.0, 6000.0)];
    assert!((path_time_s(&path, Some(2000.0)) - (3.0 + 2.95 + 0.1)).abs() < 1e-9);
    // Up and down again inside one stretch, without reaching its feed: v^2 = 100^2 + 120 a L / 2.
    let path = [stretch(5.0, 100.0), stretch(1.0, 6000.0), stretch(5.0, 100.0)];
    let peak = (10_000.0f64 + 120_000.0).sqrt();
    assert!((path_time_s(&path, Some(2000.0)) - (6.0 + 2.0 * (peak - 100.0) / 2000.0)).abs() < 1e-9);
}

#[test]
fn a_chain_ends_at_feed() {
    let mut path = [stretch(5.0, 100.0), stretch(10.0, 6000.0)];
    path[1].breaks_chain = true;
    assert!((path_time_s(&path, Some(2000.0)) - 3.1).abs() < 1e-12);
    let mut blocks = [block(5.0, 100.0), block(10.0, 6000.0)];
    blocks[1].breaks_chain = true;
    let rules = FeedRules { max_acceleration: Some(2000.0), ..FeedRules::default() };
    assert_eq!(only_feeds(&blocks, &rules), [100.0, 6000.0]);
}

#[test]
fn untouched_blocks_are_walls() {
    let rules = FeedRules { max_acceleration: Some(2000.0), ..FeedRules::default() };
    let mut blocks = [block(0.1, 6000.0), block(5.0, 6000.0), block(0.1, 6000.0)];
    blocks[1].touched = false;
    let beside = (2500.0f64 + 24_000.0).sqrt();
    let found = only_feeds(&blocks, &rules);
    assert_eq!(found, [beside, 50.0, 6000.0]);
}

#[test]
fn time_is_that_of_small_steps() {
    let path = [stretch(3.0, 900.0), stretch(0.4, 2500.0), stretch(2.0, 300.0), stretch(6.0, 1800.0)];
    let acceleration = 1500.0;
    // Speed at every micron: the feed there, and what can be reached from both sides.
    let step = 1e-3;
    let mut speeds: Vec<f64> = Vec::new();
    for stretch in &path {
        speeds.extend(std::iter::repeat_n(stretch.feed, (stretch.length / step).round() as usize));
    }
    let reach = |from: f64| (from * from + 120.0 * acceleration * step).sqrt();
    for index in 1..speeds.len() {
        speeds[index] = speeds[index].min(reach(speeds[index - 1]));
    }
    for index in (1..speeds.len()).rev() {
        speeds[index - 1] = speeds[index - 1].min(reach(speeds[index]));
    }
    let brute: f64 = speeds.iter().map(|speed| 60.0 * step / speed).sum();
    let found = path_time_s(&path, Some(acceleration));
    // Steps of a micron, at speeds that differ by a few mm/min within one.
    assert!((found - brute).abs() < 1e-3 * brute, "{found} {brute}");
}
