//! This module finds units of lengths and feeds that contradict each other.

use super::{Lint, LintFindings};
use crate::diagnostic::codes;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, NumberRole, Record, Statement, StatementId};

/// Checks UNITS records.
#[derive(Default)]
pub(super) struct LengthUnitLint {
    stated: Option<(LengthUnit, StatementId)>,
    moved: bool,
}

impl Lint for LengthUnitLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        let Record::Units(units) = statement.record() else { return };
        match self.stated {
            Some((before, at)) if before != *units => {
                let message = "the unit of lengths changes here";
                let first = (found.statement_span(id), "this unit");
                found.report_at_two_spans(
                    codes::UNITS_DIFFER,
                    message,
                    first,
                    (found.statement_span(at), "the unit before"),
                );
            }
            None if self.moved => {
                found.report(
                    codes::UNITS_LATE,
                    found.statement_span(id),
                    "motions stand before this unit",
                    "",
                );
            }
            _ => {}
        }
        self.stated = Some((*units, id));
    }

    fn check_motion(&mut self, _motion: &Motion, _found: &mut LintFindings<'_>) {
        self.moved = true;
    }
}

/// Reports feeds in another unit than the lengths, or than the feeds before.
#[derive(Default)]
pub(super) struct FeedUnitLint {
    first: Option<LengthUnit>,
    reported: bool,
}

impl Lint for FeedUnitLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        let feed = match statement.record() {
            Record::Feed(feed) => Some(*feed),
            Record::Cycle(cycle) => cycle.feed,
            _ => None,
        };
        let Some(unit) = feed.and_then(|feed| feed.unit) else { return };
        // PERMIN and PERREV have the file's unit and cannot contradict it.
        let (Some(mm), Some(inch)) = (unit.length_unit(LengthUnit::Mm), unit.length_unit(LengthUnit::Inch))
        else {
            return;
        };
        if mm != inch || self.reported {
            return;
        }
        let expected = found.facts.units.unwrap_or(*self.first.get_or_insert(mm));
        if mm != expected {
            self.reported = true;
            let name = |unit| if unit == LengthUnit::Mm { "millimetres" } else { "inches" };
            let whose = if found.facts.units.is_some() {
                "the program's lengths are"
            } else {
                "the feeds before are"
            };
            let message = format!("this feed is in {}, but {whose} in {}", name(mm), name(expected));
            found.report(
                codes::FEED_UNITS_MIXED,
                found.role_span(id, NumberRole::Feed),
                message,
                unit.word(),
            );
        }
    }
}
