//! What holds for every path.

use clsmith::internals::transform::optimize_feed::path_time_s;
use clsmith::internals::transform::optimize_feed::{
    BlockFeeds, FeedBlock, FeedLimit, FeedRules, FeedWindow, LimitedPiece, SplitRule, plan_block_feeds,
};
use proptest::prelude::*;

fn load() -> impl Strategy<Value = FeedLimit> {
    prop_oneof![
        3 => Just(FeedLimit::Air),
        6 => (50.0..4000.0f64).prop_map(FeedLimit::Limit),
        1 => Just(FeedLimit::Limit(f64::INFINITY)),
    ]
}

fn blocks() -> impl Strategy<Value = Vec<FeedBlock>> {
    let piece = (0.05..3.0f64, load()).prop_map(|(length, limit)| LimitedPiece { length, limit });
    let block = (
        prop::collection::vec(piece, 1..8),
        prop_oneof![Just(1000.0), 100.0..3000.0f64],
        prop::bool::weighted(0.9),
        any::<bool>(),
        prop::bool::weighted(0.1),
        prop::bool::weighted(0.05),
    );
    let block = block.prop_map(|(pieces, programmed, touched, splittable, breaks_chain, empty)| {
        let length = if empty { 0.0 } else { pieces.iter().map(|piece| piece.length).sum() };
        FeedBlock { length, programmed, touched, splittable, axis_limit: f64::INFINITY, breaks_chain, pieces }
    });
    prop::collection::vec(block, 1..25)
}

fn rules() -> impl Strategy<Value = FeedRules> {
    let feeds = (prop_oneof![Just(0.0), 10.0..300.0f64], prop::option::of(2000.0..6000.0f64));
    let way = (prop_oneof![Just(0.0), 0.1..2.0f64], prop::option::of(500.0..20000.0f64), any::<bool>());
    let change =
        (prop_oneof![Just(0.0), 0.01..0.3f64], prop_oneof![Just(0.0), Just(1.0), Just(0.1), Just(25.0)]);
    (feeds, way, change, prop::option::of((0.3..2.0f64, 2..9usize))).prop_map(
        |((min_feed, air_feed), (margin, max_acceleration, half), (min_change, round_down_to), split)| {
            FeedRules {
                window: if half { FeedWindow::HalfBlocks } else { FeedWindow::Block },
                min_feed,
                max_feed: 5000.0,
                min_ratio: None,
                max_ratio: None,
                air_feed,
                margin,
                max_acceleration,
                split: split.map(|(shortest, at_most)| SplitRule { above: 1.0, shortest, at_most }),
                min_change,
                round_down_to,
            }
        },
    )
}

/// Pieces of a block with their places in it, in mm.
fn places(block: &FeedBlock) -> Vec<(f64, f64, FeedLimit)> {
    let mut start = 0.0;
    let place = |piece: &LimitedPiece| {
        let from = start;
        start += piece.length;
        (from, start, piece.limit)
    };
    block.pieces.iter().map(place).collect()
}

/// Parts of a block with their places in it, in mm, and feeds.
fn parts(block: &FeedBlock, found: &BlockFeeds, index: usize) -> Vec<(f64, f64, f64)> {
    let mut start = 0.0;
    let part = |part: &clsmith::internals::transform::optimize_feed::PlannedSegment| {
        let from = start;
        start = part.end * block.length;
        (from, start, part.feed)
    };
    found.segments[index].iter().map(part).collect()
}

/// Feeds that are what they were, whether or not a block was without any say in them.
fn changed(block: &FeedBlock, feed: f64) -> bool {
    block.touched && block.length > 0.0 && feed != block.programmed
}

proptest! {
    #![proptest_config(crate::support::property(400))]

    #[test]
    fn limits_hold_and_untouched_blocks_stay(blocks in blocks(), rules in rules()) {
        let rules = FeedRules { window: FeedWindow::Block, ..rules };
        let found = plan_block_feeds(&blocks, &rules);
        for (index, block) in blocks.iter().enumerate() {
            for (from, to, feed) in parts(block, &found, index) {
                if !block.touched {
                    prop_assert_eq!(feed, block.programmed);
                }
                if !changed(block, feed) {
                    continue;
                }
                prop_assert!(feed > 0.0 && feed <= rules.max_feed);
                for (start, end, load) in places(block) {
                    let inside = end.min(to) - start.max(from) > 1e-6;
                    match load {
                        FeedLimit::Limit(limit) if inside => {
                            prop_assert!(feed <= limit.max(rules.min_feed), "{} over {}", feed, limit);
                            prop_assert!(limit >= rules.min_feed || found.below_minimum.contains(&index));
                        }
                        _ => {}
                    }
                }
            }
        }
        let least = |index: &usize| {
            let limits = blocks[*index].pieces.iter().map(|piece| piece.limit);
            limits.filter_map(|load| match load { FeedLimit::Limit(limit) => Some(limit), FeedLimit::Air => None }).fold(f64::INFINITY, f64::min)
        };
        prop_assert!(found.below_minimum.iter().all(|index| least(index) < rules.min_feed));
    }

    #[test]
    fn parts_are_long_enough_and_not_too_many(blocks in blocks(), rules in rules()) {
        let found = plan_block_feeds(&blocks, &rules);
        prop_assert_eq!(found.segments.len(), blocks.len());
        for (index, block) in blocks.iter().enumerate() {
            let parts = parts(block, &found, index);
            prop_assert_eq!(found.segments[index].last().map(|part| part.end), Some(1.0));
            match rules.split.filter(|rule| block.touched && block.splittable && block.length > rule.above) {
                None => prop_assert_eq!(parts.len(), 1),
                Some(rule) => {
                    prop_assert!(parts.len() <= rule.at_most);
                    if parts.len() > 1 {
                        prop_assert!(parts.iter().all(|(from, to, _)| to - from >= rule.shortest - 1e-6));
                    }
                }
            }
            prop_assert!(parts.windows(2).all(|pair| pair[0].2 != pair[1].2));
        }
    }

    /// Speeding up is the machine's matter. It can slow down in time, to the rounding and to what programmed feeds that stay
    /// are lower.
    #[test]
    fn it_slows_down_in_time(blocks in blocks(), rules in rules(), a in 500.0..20000.0f64) {
        let rules = FeedRules { max_acceleration: Some(a), ..rules };
        let exact = FeedRules { min_change: 0.0, round_down_to: 0.0, ..rules };
        for (rules, slack) in [(exact, 1.0), (rules, 1.0 - rules.min_change)] {
            let found = plan_block_feeds(&blocks, &rules);
            // Feed and length of the plateau so far, and whether all of it was decided.
            let mut last: Option<(f64, f64, bool)> = None;
            for (index, block) in blocks.iter().enumerate() {
                if block.breaks_chain {
                    last = None;
                }
                for (from, to, feed) in parts(block, &found, index) {
                    let length = to - from;
                    if length <= 0.0 {
                        continue;
                    }
                    let decided = changed(block, feed);
                    if let Some((before, before_length, true)) = last.filter(|last| last.0 > feed) {
                        let allowed = ((feed / slack).powi(2) + 120.0 * a * before_length).sqrt() * (1.0 + 1e-9);
                        prop_assert!(before <= allowed, "{before} over {before_length} then {feed}");
                    }
                    last = match last {
                        Some((same, before, was)) if same == feed => Some((feed, before + length, was && decided)),
                        _ => Some((feed, length, decided)),
                    };
                }
            }
        }
    }

    #[test]
    fn fewer_feeds_cost_no_more_time_than_allowed(blocks in blocks(), rules in rules()) {
        // What stays as programmed, and what is slowed down, is lower for other reasons.
        let programmed: Vec<FeedBlock> = blocks.into_iter().map(|block| FeedBlock { programmed: 9000.0, ..block }).collect();
        let rules = FeedRules { split: None, min_feed: 0.0, round_down_to: 0.0, ..rules };
        let time = |min_change: f64| {
            let found = plan_block_feeds(&programmed, &FeedRules { min_change, ..rules });
            path_time_s(&found.timed_segments(&programmed), rules.max_acceleration)
        };
        let [free, fewer] = [0.0, rules.min_change].map(time);
        prop_assert!(fewer <= free * (1.0 + rules.min_change) * (1.0 + 1e-9), "{free} {fewer}");
    }

    #[test]
    fn a_second_run_changes_nothing(blocks in blocks(), rules in rules()) {
        let rules = FeedRules { split: None, ..rules };
        let once = plan_block_feeds(&blocks, &rules);
        let mut again = blocks.clone();
        for (block, parts) in again.iter_mut().zip(&once.segments) {
            block.programmed = parts[0].feed;
        }
        let twice = plan_block_feeds(&again, &rules);
        prop_assert_eq!(&once.segments, &twice.segments);
        prop_assert_eq!(&once, &plan_block_feeds(&blocks, &rules));
    }

    #[test]
    fn parts_that_are_blocks_keep_their_feeds(blocks in blocks(), rules in rules()) {
        let split = rules.split.map(|rule| SplitRule { at_most: 1000, shortest: 0.0, ..rule });
        // A smaller change keeps the feed in force, and a part of its own has another one in force than a part of a block.
        let rules = FeedRules { split, window: FeedWindow::Block, max_acceleration: None, min_change: 0.0, ..rules };
        let once = plan_block_feeds(&blocks, &rules);
        let mut again = Vec::new();
        for (index, block) in blocks.iter().enumerate() {
            for (number, (from, to, feed)) in parts(block, &once, index).into_iter().enumerate() {
                let inside = |(start, end, limit): (f64, f64, FeedLimit)| LimitedPiece { length: end.min(to) - start.max(from), limit };
                let pieces = places(block).into_iter().map(inside).filter(|piece| piece.length > 1e-9).collect();
                let breaks_chain = block.breaks_chain && number == 0;
                again.push((feed, FeedBlock { length: to - from, programmed: feed, breaks_chain, pieces, ..block.clone() }));
            }
        }
        let (before, again): (Vec<f64>, Vec<FeedBlock>) = again.into_iter().unzip();
        let twice = plan_block_feeds(&again, &rules);
        for ((feed, parts), block) in before.iter().zip(&twice.segments).zip(&again) {
            let known = block.length == 0.0 || parts.iter().all(|part| (part.feed - feed).abs() < 1e-6);
            prop_assert!(known, "{feed} became {parts:?} {block:?}");
        }
    }

    #[test]
    fn near_material_air_goes_no_faster_than_the_cut(blocks in blocks(), rules in rules()) {
        let rules = FeedRules { window: FeedWindow::Block, max_acceleration: None, min_change: 0.0, round_down_to: 0.0, ..rules };
        let found = plan_block_feeds(&blocks, &rules);
        // Every 0.03 mm along each chain: place, whether it cuts, its feed, and whether it could be decided. A cut in a block that
        // holds air as well may be slowed down by other material near that air: there its limit counts, not its feed.
        let mut chain: Vec<(f64, bool, f64, bool)> = Vec::new();
        let check = |chain: &[(f64, bool, f64, bool)]| -> Result<(), TestCaseError> {
            for (at, cuts, feed, touched) in chain.iter().filter(|sample| !sample.1 && sample.3) {
                for step in [-1.0, 1.0] {
                    let side = chain.iter().filter(|other| (other.0 - at) * step > 0.0 && other.1);
                    let nearest = side.min_by(|a, b| (a.0 - at).abs().total_cmp(&(b.0 - at).abs()));
                    if let Some((place, _, beside, _)) = nearest && (place - at).abs() < rules.margin - 0.07 {
                        prop_assert!(*feed <= beside.max(rules.min_feed) + 1e-9, "{} {} {} {} {}", at, cuts, feed, touched, beside);
                    }
                }
            }
            Ok(())
        };
        let mut travelled = 0.0;
        for (index, block) in blocks.iter().enumerate().filter(|(_, block)| block.length > 0.0 || block.breaks_chain) {
            if block.breaks_chain {
                check(&chain)?;
                chain.clear();
            }
            for (from, to, feed) in parts(block, &found, index).into_iter().filter(|(from, to, _)| to > from) {
                for (start, end, load) in places(block) {
                    let (start, end) = (start.max(from), end.min(to));
                    // Borders of parts are shares: where one falls on a border of pieces, nothing lies between them.
                    if end - start < 1e-6 {
                        continue;
                    }
                    let count = ((end - start) / 0.03).ceil() as usize;
                    for step in 0..count {
                        let at = travelled + start + (end - start) * (step as f64 + 0.5) / count as f64;
                        let has_air = block.pieces.iter().any(|piece| piece.limit == FeedLimit::Air);
                        let beside = match load {
                            FeedLimit::Limit(limit) if block.touched && has_air => limit.min(rules.max_feed).max(feed),
                            _ => feed,
                        };
                        let cuts = load != FeedLimit::Air;
                        chain.push((at, cuts, if cuts { beside } else { feed }, block.touched));
                    }
                }
            }
            travelled += block.length;
        }
        check(&chain)?;
    }

    #[test]
    fn slower_takes_longer_and_acceleration_takes_time(blocks in blocks(), a in 500.0..20000.0f64) {
        let rules = FeedRules { max_feed: 5000.0, air_feed: Some(5000.0), ..FeedRules::default() };
        let free = plan_block_feeds(&blocks, &rules);
        let eased = plan_block_feeds(&blocks, &FeedRules { max_acceleration: Some(a), ..rules });
        let path = free.timed_segments(&blocks);
        prop_assert!(path_time_s(&path, Some(a)) >= path_time_s(&path, None) * (1.0 - 1e-9));
        prop_assert!(path_time_s(&eased.timed_segments(&blocks), None) >= path_time_s(&path, None) * (1.0 - 1e-9));
        let length: f64 = path.iter().map(|stretch| stretch.length).sum();
        let whole: f64 = blocks.iter().map(|block| block.length).sum();
        prop_assert!((length - whole).abs() < 1e-9 * whole.max(1.0));
    }
}
