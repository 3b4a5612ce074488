//! Units of lengths and feeds that contradict each other.

use super::{Findings, Lint};
use crate::diagnostic::codes;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Record, Role, Statement};

/// UNITS records.
#[derive(Default)]
pub(super) struct Lengths {
    stated: Option<(LengthUnit, usize)>,
    moved: bool,
}

impl Lint for Lengths {
    fn statement(&mut self, index: usize, statement: &Statement, found: &mut Findings<'_>) {
        let Record::Units(units) = statement.record() else { return };
        match self.stated {
            Some((before, at)) if before != *units => {
                let message = "the unit of lengths changes here";
                let first = (found.whole(index), "this unit");
                found.report_two(codes::UNITS_DIFFER, message, first, (found.whole(at), "the unit before"));
            }
            None if self.moved => {
                found.report(codes::UNITS_LATE, found.whole(index), "motions stand before this unit", "");
            }
            _ => {}
        }
        self.stated = Some((*units, index));
    }

    fn motion(&mut self, _motion: &Motion, _found: &mut Findings<'_>) {
        self.moved = true;
    }
}

/// Feeds in another unit than the lengths, or than the feeds before.
#[derive(Default)]
pub(super) struct FeedUnits {
    first: Option<LengthUnit>,
    reported: bool,
}

impl Lint for FeedUnits {
    fn statement(&mut self, index: usize, statement: &Statement, found: &mut Findings<'_>) {
        let feed = match statement.record() {
            Record::Feed(feed) => Some(*feed),
            Record::Cycle(cycle) => cycle.feed,
            _ => None,
        };
        let Some(unit) = feed.and_then(|feed| feed.unit) else { return };
        // PERMIN and PERREV take the file's unit and cannot contradict it.
        let (Some(mm), Some(inch)) = (unit.length(LengthUnit::Mm), unit.length(LengthUnit::Inch)) else {
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
            found.report(codes::FEED_UNITS_MIXED, found.role(index, Role::Feed), message, unit.word());
        }
    }
}
