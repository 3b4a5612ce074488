//! Feeds: missing, zero, implausible, per revolution of a spindle that stands, inverse time.

use super::{Findings, Lint};
use crate::diagnostic::{Code, codes};
use crate::program::motion::Motion;
use crate::program::{Feed, FeedUnit, Role};
use std::collections::HashSet;

pub(super) const CODES: &[Code] = &[
    codes::CUT_WITHOUT_FEED,
    codes::ZERO_FEED,
    codes::IMPLAUSIBLE_FEED,
    codes::FEED_PER_REVOLUTION_WITHOUT_SPINDLE,
    codes::INVERSE_TIME,
];

/// mm/min: rapids are below it on every machine.
const FASTEST: f64 = 100_000.0;
/// mm/min: a feed per revolution is below it, a feed per minute above.
const SLOWEST: f64 = 0.5;
/// mm/rev: coarser than any thread.
const COARSEST: f64 = 25.0;

/// Each FEDRAT (and each cycle's feed) is looked at once, at the first cut that uses it.
#[derive(Default)]
pub(super) struct Feeds {
    missing: bool,
    last: Option<usize>,
    seen: HashSet<usize>,
}

impl Lint for Feeds {
    fn motion(&mut self, motion: &Motion, found: &mut Findings<'_>) {
        if motion.feed.is_some() && motion.feed_from == self.last || !found.cuts(motion) {
            return;
        }
        let (Some(feed), Some(from)) = (motion.feed, motion.feed_from) else {
            if !self.missing && !found.facts.wire {
                self.missing = true;
                let span = found.end_point(motion);
                found.report(codes::CUT_WITHOUT_FEED, span, "no feed is in force at this motion", "");
            }
            return;
        };
        self.last = Some(from);
        if self.seen.insert(from) {
            look(feed, from, motion, found);
        }
    }
}

fn look(feed: Feed, from: usize, motion: &Motion, found: &mut Findings<'_>) {
    let unit = feed.unit_or_default();
    if feed.value == 0.0 {
        let at = (found.role(from, Role::Feed), "a feed of zero");
        let cut = (found.end_point(motion), "the first cut with it");
        return found.report_two(codes::ZERO_FEED, "a cut is programmed with a feed of zero", at, cut);
    }
    if unit == FeedUnit::InverseTime {
        let span = found.role(from, Role::Feed);
        return found.report(codes::INVERSE_TIME, span, "this feed is inverse time (1/min)", "");
    }
    if let Some(what) = implausible(feed, found) {
        let span = found.role(from, Role::Feed);
        found.report(codes::IMPLAUSIBLE_FEED, span, format!("a feed of {what} is hardly meant"), "");
    }
    if unit.per_revolution() && !motion.spindle.as_ref().is_some_and(|spindle| spindle.on) {
        let at = (found.role(from, Role::Feed), "per revolution");
        let cut = (found.end_point(motion), "no spindle turns at this motion");
        let message = "the feed is per revolution, but the spindle stands";
        found.report_two(codes::FEED_PER_REVOLUTION_WITHOUT_SPINDLE, message, at, cut);
    }
}

fn implausible(feed: Feed, found: &Findings<'_>) -> Option<String> {
    let unit = feed.unit_or_default();
    let value = feed.value * unit.length(found.facts.units.unwrap_or_default())?.in_mm();
    let (slow, fast, word) =
        if unit.per_revolution() { (0.0, COARSEST, "mm/rev") } else { (SLOWEST, FASTEST, "mm/min") };
    (value < slow || value > fast).then(|| format!("{} {word}", (value * 1e4).round() / 1e4))
}
