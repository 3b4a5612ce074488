//! Feeds from loads, rule by rule.

use clsmith::internals::transform::optimize_feed::{
    BlockFeeds, FeedBlock, FeedLimit, FeedRules, FeedWindow, LimitedPiece, SplitRule, plan_block_feeds,
};

const AIR: f64 = -1.0;

/// A touched block of pieces of one length; a negative limit is air.
fn block(piece: f64, limits: &[f64]) -> FeedBlock {
    let load = |limit: f64| if limit < 0.0 { FeedLimit::Air } else { FeedLimit::Limit(limit) };
    let pieces: Vec<_> =
        limits.iter().map(|limit| LimitedPiece { length: piece, limit: load(*limit) }).collect();
    let length = piece * limits.len() as f64;
    FeedBlock {
        length,
        programmed: 1000.0,
        touched: true,
        splittable: true,
        axis_limit: f64::INFINITY,
        breaks_chain: false,
        pieces,
    }
}

fn rules() -> FeedRules {
    FeedRules { min_feed: 100.0, max_feed: 6000.0, air_feed: Some(5000.0), ..FeedRules::default() }
}

const SPLIT: SplitRule = SplitRule { above: 1.0, shortest: 0.5, at_most: 8 };

fn splitting() -> FeedRules {
    FeedRules { split: Some(SPLIT), min_change: 0.05, ..rules() }
}

/// Ends in mm and feeds of one block's parts.
fn parts(found: &BlockFeeds, blocks: &[FeedBlock], index: usize) -> Vec<(f64, f64)> {
    let round = |end: f64| (end * blocks[index].length * 1e6).round() / 1e6;
    found.segments[index].iter().map(|part| (round(part.end), part.feed)).collect()
}

fn one_feed_each(found: &BlockFeeds) -> Vec<f64> {
    assert!(found.segments.iter().all(|parts| parts.len() == 1), "{found:?}");
    found.segments.iter().map(|parts| parts[0].feed).collect()
}

#[test]
fn a_block_takes_the_lowest_of_its_pieces() {
    let blocks =
        [block(1.0, &[900.0, 400.0, 700.0]), block(1.0, &[9000.0, f64::INFINITY]), block(1.0, &[30.0])];
    let found = plan_block_feeds(&blocks, &rules());
    assert_eq!(one_feed_each(&found), [400.0, 6000.0, 100.0]);
    assert_eq!(found.below_minimum, [2]);
}

#[test]
fn half_blocks_look_half_a_block_ahead() {
    let halves = FeedRules { window: FeedWindow::HalfBlocks, ..rules() };
    let blocks = [block(1.0, &[900.0, 800.0]), block(1.0, &[300.0, 700.0]), block(1.0, &[650.0, 2000.0])];
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &halves)), [300.0, 650.0, 2000.0]);
    // Its own first half cuts: no air feed, whatever the window holds.
    let leaving = [block(1.0, &[900.0]), block(1.0, &[500.0, AIR]), block(1.0, &[AIR, AIR])];
    assert_eq!(one_feed_each(&plan_block_feeds(&leaving, &halves)), [500.0, 500.0, 5000.0]);
}

#[test]
fn ratios_bound_the_change() {
    let bounded = FeedRules { min_ratio: Some(0.5), max_ratio: Some(1.5), ..rules() };
    let found = plan_block_feeds(&[block(1.0, &[200.0]), block(1.0, &[4000.0])], &bounded);
    assert_eq!(one_feed_each(&found), [500.0, 1500.0]);
    assert_eq!(found.below_minimum, [0]);
}

#[test]
fn air_takes_its_feed_or_keeps_the_programmed_one() {
    let blocks = [block(1.0, &[AIR, AIR]), block(1.0, &[400.0])];
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &rules())), [5000.0, 400.0]);
    let own = FeedRules { air_feed: None, round_down_to: 300.0, ..rules() };
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &own)), [1000.0, 300.0]);
}

#[test]
fn the_margin_keeps_the_cutting_feed_over_block_borders_but_not_over_rapids() {
    let margin = FeedRules { margin: 0.7, ..rules() };
    let mut blocks = [
        block(0.5, &[AIR]),
        block(0.5, &[AIR]),
        block(0.5, &[400.0]),
        block(0.5, &[AIR]),
        block(0.5, &[AIR]),
    ];
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &margin)), [400.0; 5]);
    blocks[3].breaks_chain = true;
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &margin)), [400.0, 400.0, 400.0, 5000.0, 5000.0]);
    let narrow = FeedRules { margin: 0.3, ..rules() };
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &narrow)), [5000.0, 400.0, 400.0, 5000.0, 5000.0]);
}

#[test]
fn air_is_split_where_the_margin_ends() {
    let margin = FeedRules { margin: 0.7, ..splitting() };
    let blocks = [block(10.0, &[AIR]), block(0.8, &[400.0]), block(1.0, &[AIR; 10])];
    let found = plan_block_feeds(&blocks, &margin);
    assert_eq!(parts(&found, &blocks, 0), [(9.3, 5000.0), (10.0, 400.0)]);
    assert_eq!(parts(&found, &blocks, 2), [(0.7, 400.0), (10.0, 5000.0)]);
    // Not splittable: the slower feed for all of it.
    let mut whole = blocks;
    whole.iter_mut().for_each(|block| block.splittable = false);
    assert_eq!(one_feed_each(&plan_block_feeds(&whole, &margin)), [400.0; 3]);
}

#[test]
fn the_margin_is_no_faster_than_the_part_beside_it() {
    let margin = FeedRules { margin: 0.5, ..rules() };
    // The cut beside the air could go 900, but its block goes 300.
    let blocks = [block(1.0, &[300.0, 900.0]), block(0.4, &[AIR])];
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &margin)), [300.0, 300.0]);
}

#[test]
fn a_block_falls_apart_where_its_load_changes() {
    let blocks = [block(0.1, &[[2000.0; 30].as_slice(), &[500.0; 10], &[2000.0; 40]].concat())];
    let found = plan_block_feeds(&blocks, &splitting());
    assert_eq!(parts(&found, &blocks, 0), [(3.0, 2000.0), (4.0, 500.0), (8.0, 2000.0)]);
    // A dip shorter than the shortest part takes as much of its neighbourhood along as it needs.
    let blocks = [block(0.1, &[[2000.0; 30].as_slice(), &[500.0; 2], &[2000.0; 40]].concat())];
    let found = plan_block_feeds(&blocks, &splitting());
    let dip = parts(&found, &blocks, 0);
    assert_eq!(dip.iter().map(|(_, feed)| *feed).collect::<Vec<_>>(), [2000.0, 500.0, 2000.0]);
    assert!((dip[1].0 - dip[0].0 - 0.5).abs() < 1e-6 && dip[0].0 < 3.01 && dip[1].0 > 3.19, "{dip:?}");
    let found = plan_block_feeds(
        &blocks,
        &FeedRules { split: Some(SplitRule { shortest: 0.1, ..SPLIT }), ..splitting() },
    );
    assert_eq!(parts(&found, &blocks, 0), [(3.0, 2000.0), (3.2, 500.0), (7.2, 2000.0)]);
    // Too short a block, and one whose load hardly changes.
    let blocks = [block(0.5, &[2000.0, 500.0]), block(1.0, &[1000.0, 980.0, 1000.0])];
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &splitting())), [500.0, 980.0]);
}

#[test]
fn there_are_no_more_parts_than_allowed() {
    let steps: Vec<f64> = (0..40).map(|step| 300.0 * 1.07f64.powi(step)).collect();
    let blocks = [block(1.0, &steps)];
    for at_most in [1, 2, 5, 8] {
        let found = plan_block_feeds(
            &blocks,
            &FeedRules { split: Some(SplitRule { at_most, ..SPLIT }), min_change: 0.0, ..splitting() },
        );
        assert_eq!(found.segments[0].len(), at_most);
    }
}

#[test]
fn feeds_are_rounded_down_but_not_below_the_lowest_nor_to_nothing() {
    let round = FeedRules { round_down_to: 50.0, min_feed: 120.0, ..rules() };
    let blocks = [block(1.0, &[449.0]), block(1.0, &[450.0]), block(1.0, &[130.0]), block(1.0, &[10.0])];
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &round)), [400.0, 450.0, 120.0, 120.0]);
    let tenth = FeedRules { round_down_to: 0.1, min_feed: 0.0, ..rules() };
    assert_eq!(
        one_feed_each(&plan_block_feeds(&[block(1.0, &[0.3]), block(1.0, &[0.05])], &tenth)),
        [0.3, 0.05]
    );
}

#[test]
fn small_changes_need_no_feedrat() {
    let lazy = FeedRules { min_change: 0.05, ..rules() };
    let blocks = [block(1.0, &[500.0]), block(1.0, &[480.0]), block(1.0, &[510.0]), block(1.0, &[300.0])];
    // At 480 the first three need 0.5 % more time. With 300 all need 34 % more.
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &lazy)), [480.0, 480.0, 480.0, 300.0]);
    let exact = FeedRules { min_change: 0.0, ..rules() };
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &exact)), [500.0, 480.0, 510.0, 300.0]);
    // A programmed feed just below stays.
    let close = [block(1.0, &[1040.0]), block(1.0, &[1020.0])];
    assert_eq!(one_feed_each(&plan_block_feeds(&close, &lazy)), [1000.0, 1000.0]);
    let above = [block(1.0, &[990.0])];
    assert_eq!(one_feed_each(&plan_block_feeds(&above, &lazy)), [990.0]);
}

#[test]
fn what_is_unknown_stays() {
    let nothing = FeedBlock { pieces: Vec::new(), ..block(1.0, &[1.0]) };
    let no_feed = FeedBlock { programmed: 0.0, ..block(1.0, &[1.0]) };
    let no_length = FeedBlock { length: 0.0, pieces: Vec::new(), ..block(1.0, &[1.0]) };
    let blocks = [block(1.0, &[200.0]), no_length, nothing, no_feed];
    assert_eq!(one_feed_each(&plan_block_feeds(&blocks, &rules())), [200.0, 200.0, 1000.0, 0.0]);
    // Nothing limits it: no target, no highest feed.
    let unlimited = FeedRules { max_feed: f64::INFINITY, ..rules() };
    assert_eq!(one_feed_each(&plan_block_feeds(&[block(1.0, &[f64::INFINITY])], &unlimited)), [1000.0]);
}
