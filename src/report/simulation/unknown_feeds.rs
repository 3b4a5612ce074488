//! This module reports cuts whose feed or spindle speed is not known, with one finding for each statement
//! that is the cause.

use crate::diagnostic::{Diagnostic, codes};
use crate::program::Program;
use crate::program::motion::Motion;
use crate::source::Span;
use std::collections::BTreeSet;

/// Collects such findings.
#[derive(Debug, Default)]
pub(super) struct UnknownFeedCollector {
    found: Vec<Diagnostic>,
    /// The statements that have a finding.
    blamed: BTreeSet<Span>,
    /// The number of such cuts.
    pub count: usize,
}

impl UnknownFeedCollector {
    /// Checks a motion that cuts. `feed` is its feed in mm/min and `rpm` its spindle speed in rev/min, if
    /// they are known. A spindle that does not turn is reported elsewhere.
    pub(super) fn check_motion(
        &mut self,
        program: &Program,
        motion: &Motion,
        feed: Option<f64>,
        rpm: Option<f64>,
    ) {
        let speed = motion.spindle.as_deref().and_then(|spindle| spindle.speed);
        let turns = motion.spindle.as_deref().is_some_and(|spindle| spindle.on);
        let label_of_feed = motion.feed_from.unwrap_or_else(|| motion.last_statement());
        let per_turn = motion.feed.is_some_and(|feed| feed.unit_or_default().is_per_revolution());
        let (message, statement, label) = if motion.rapid {
            return;
        } else if motion.feed.is_none() {
            ("this motion cuts, and no feed is in force", motion.last_statement(), "cuts")
        } else if motion.feed.is_some_and(|feed| feed.value <= 0.0) {
            ("this feed is no speed, and motions cut with it", label_of_feed, "in force where the tool cuts")
        } else if turns && rpm.is_none() && speed.is_some_and(|speed| speed <= 0.0) {
            ("the spindle has a speed of 0 rev/min while the tool cuts", motion.last_statement(), "cuts")
        } else if turns && rpm.is_none() && per_turn {
            (
                "the feed is per revolution, and no spindle speed in rev/min is in force",
                motion.last_statement(),
                "cuts",
            )
        } else if turns && rpm.is_none() {
            ("the tool cuts, and no spindle speed in rev/min is in force", motion.last_statement(), "cuts")
        } else if feed.is_none() && !per_turn {
            ("the feed of this cut is not known", motion.last_statement(), "cuts")
        } else {
            return;
        };
        self.count += 1;
        let span = program.statement(statement).origin();
        // A feed with which many motions cut is reported only once.
        if self.blamed.insert(span) {
            let found = Diagnostic::new(codes::FEED_UNKNOWN, message);
            self.found.push(found.with_label(program.source(), span, label));
        }
    }

    /// Returns all findings.
    pub(super) fn into_findings(self) -> Vec<Diagnostic> {
        self.found
    }
}
