//! This module checks feeds: missing, zero, implausible, per revolution of a spindle at rest, inverse time.

use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::program::motion::Motion;
use crate::program::{Feed, FeedUnit, LengthUnit, NumberRole, StatementId};
use std::collections::HashSet;

pub(super) const CODES: &[DiagnosticCode] = &[
    codes::CUT_WITHOUT_FEED,
    codes::ZERO_FEED,
    codes::IMPLAUSIBLE_FEED,
    codes::FEED_PER_REVOLUTION_WITHOUT_SPINDLE,
    codes::INVERSE_TIME,
];

/// The largest plausible feed in mm/min. Rapids are below it on every machine.
const FASTEST: f64 = 100_000.0;
/// The smallest plausible feed per minute in mm/min. Numbers below it are feeds per revolution.
const SLOWEST: f64 = 0.5;
/// The largest plausible feed in mm/rev. It is coarser than any thread.
const COARSEST: f64 = 25.0;

/// Checks each FEDRAT (and each cycle's feed) once, at the first cut that uses it.
#[derive(Default)]
pub(super) struct FeedLint {
    missing: bool,
    last: Option<StatementId>,
    seen: HashSet<StatementId>,
}

impl Lint for FeedLint {
    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if motion.feed.is_some() && motion.feed_from == self.last || !found.is_cutting_motion(motion) {
            return;
        }
        let (Some(feed), Some(from)) = (motion.feed, motion.feed_from) else {
            // A thread has its pitch, whatever feed is in force.
            if !self.missing && !found.facts.wire && !motion.cuts_thread {
                self.missing = true;
                let span = found.end_point_span(motion);
                found.report(codes::CUT_WITHOUT_FEED, span, "no feed is in force at this motion", "");
            }
            return;
        };
        self.last = Some(from);
        if self.seen.insert(from) {
            check_feed(feed, from, motion, found);
        }
    }
}

fn check_feed(feed: Feed, from: StatementId, motion: &Motion, found: &mut LintFindings<'_>) {
    let unit = feed.unit_or_default();
    if feed.value == 0.0 {
        let at = (found.role_span(from, NumberRole::Feed), "a feed of zero");
        let cut = (found.end_point_span(motion), "the first cut with it");
        return found.report_at_two_spans(
            codes::ZERO_FEED,
            "a cut is programmed with a feed of zero",
            at,
            cut,
        );
    }
    if unit == FeedUnit::InverseTime {
        let span = found.role_span(from, NumberRole::Feed);
        return found.report(codes::INVERSE_TIME, span, "this feed is inverse time (1/min)", "");
    }
    if let Some(what) = describe_implausible(feed, found) {
        let span = found.role_span(from, NumberRole::Feed);
        found.report(codes::IMPLAUSIBLE_FEED, span, format!("a feed of {what} is hardly intended"), "");
    }
    if unit.is_per_revolution() && !motion.spindle.as_ref().is_some_and(|spindle| spindle.on) {
        let at = (found.role_span(from, NumberRole::Feed), "per revolution");
        let cut = (found.end_point_span(motion), "no spindle turns at this motion");
        let message = "the feed is per revolution, but the spindle does not turn";
        found.report_at_two_spans(codes::FEED_PER_REVOLUTION_WITHOUT_SPINDLE, message, at, cut);
    }
}

fn describe_implausible(feed: Feed, found: &LintFindings<'_>) -> Option<String> {
    let unit = feed.unit_or_default();
    // A file that states no unit is measured in millimetres, as everywhere.
    let shown_in = unit.length_unit(found.facts.units.unwrap_or_default())?;
    let value = feed.value * shown_in.mm_per_unit();
    let (slow, fast) = if unit.is_per_revolution() { (0.0, COARSEST) } else { (SLOWEST, FASTEST) };
    let word = match (unit.is_per_revolution(), shown_in) {
        (true, LengthUnit::Mm) => "mm/rev",
        (true, LengthUnit::Inch) => "in/rev",
        (false, LengthUnit::Mm) => "mm/min",
        (false, LengthUnit::Inch) => "in/min",
    };
    let tell = || format!("{} {word}", (feed.value * 1e4).round() / 1e4);
    (value < slow || value > fast).then(tell)
}
