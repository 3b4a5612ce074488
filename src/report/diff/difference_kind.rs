//! This module classifies how two corresponding statements differ.

use super::alignment_keys::have_same_meaning;
use crate::parse;
use crate::program::RecordKind;
use crate::program::{Feed, LengthUnit, NumberRole, Program, Record, Statement};
use serde::Serialize;

/// Where numbers were converted to another unit and rounded, half of a millimetre's fourth decimal is no way, mm.
const ROUNDING_MM: f64 = 0.000_05;

/// The kind of a difference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum DifferenceKind {
    /// The statement is written differently, but has the same meaning.
    Layout,
    /// A comment, an empty line or text for people differs.
    Text,
    /// A point that moved.
    Moved,
    /// An axis that turned.
    Turned,
    /// A feed differs.
    Feed,
    /// Something else differs.
    Changed,
    /// The statement is only in the second program.
    Added,
    /// The statement is only in the first program.
    Removed,
}

/// The statements of a pair and the units of their files.
#[derive(Clone, Copy)]
pub(super) struct StatementPair<'p> {
    pub(super) a: (&'p Program, &'p Statement),
    pub(super) b: (&'p Program, &'p Statement),
    pub(super) units: (LengthUnit, LengthUnit),
}

impl StatementPair<'_> {
    /// Returns how the statements differ, and by how much: a distance in the second file's unit for a moved
    /// point, percent for a feed. Returns `None` if they are equal byte for byte.
    pub(super) fn classify_difference(&self) -> Option<(DifferenceKind, Option<f64>)> {
        let (text_a, text_b) = (self.a.0.statement_text(self.a.1), self.b.0.statement_text(self.b.1));
        if text_a == text_b {
            return None;
        }
        let (a, b) = (self.a.1.record(), self.b.1.record());
        Some(if have_same_meaning(self.a, self.b) {
            (DifferenceKind::Layout, None)
        } else if RecordKind::from_record(a) == RecordKind::Comment
            && RecordKind::from_record(b) == RecordKind::Comment
        {
            (DifferenceKind::Text, None)
        } else if let (Record::Feed(a), Record::Feed(b)) = (a, b) {
            (DifferenceKind::Feed, self.feed_change_percent(*a, *b))
        } else {
            self.classify_by_roles(text_a, text_b)
        })
    }

    /// Returns how far a point may lie off, in the second file's unit, and still be where it was: nothing in files of
    /// one unit.
    fn rounding(&self) -> f64 {
        if self.units.0 == self.units.1 { 0.0 } else { ROUNDING_MM / self.units.1.mm_per_unit() }
    }

    /// Classifies the difference by the roles of the numbers that differ, so no record needs a rule of its
    /// own.
    fn classify_by_roles(&self, text_a: &[u8], text_b: &[u8]) -> (DifferenceKind, Option<f64>) {
        let (a, b) = (self.a.1.record(), self.b.1.record());
        let scale = self.units.0.mm_per_unit() / self.units.1.mm_per_unit();
        if let (Record::Goto(a), Record::Goto(b)) = (a, b) {
            let distance = (b.point - a.point * scale).norm();
            return if distance > self.rounding() {
                (DifferenceKind::Moved, Some(distance))
            } else if a.axis != b.axis {
                (DifferenceKind::Turned, None)
            } else {
                // The same point in the other unit.
                (DifferenceKind::Layout, None)
            };
        }
        let (numbers_a, numbers_b) = (parse::statement_numbers(text_a), parse::statement_numbers(text_b));
        let roles = parse::number_roles(b, text_b);
        if numbers_a.len() != numbers_b.len() || parse::number_roles(a, text_a) != roles {
            return (DifferenceKind::Changed, None);
        }
        let (mut largest, mut square) = (0.0_f64, 0.0);
        let (mut turned, mut fed, mut other) = (false, false, false);
        for (((_, old), (_, new)), role) in numbers_a.iter().zip(&numbers_b).zip(&roles) {
            let differs = old != new;
            match role {
                NumberRole::Point(coordinate) | NumberRole::Step(coordinate) => {
                    // Coordinate 0 begins a point. `square` is the squared distance of its coordinates so
                    // far.
                    square = if *coordinate == 0 { 0.0 } else { square } + (new - old * scale).powi(2);
                    largest = largest.max(square);
                }
                NumberRole::Direction(_) | NumberRole::ArcAxis(_) => turned |= differs,
                NumberRole::Feed => fed |= differs,
                _ => other |= differs,
            }
        }
        match (largest.sqrt() > self.rounding(), turned, fed, other) {
            (true, ..) => (DifferenceKind::Moved, Some(largest.sqrt())),
            (_, true, _, _) => (DifferenceKind::Turned, None),
            (_, _, true, false) => (DifferenceKind::Feed, self.cycle_feed_change_percent(a, b)),
            _ => (DifferenceKind::Changed, None),
        }
    }

    fn cycle_feed_change_percent(&self, a: &Record, b: &Record) -> Option<f64> {
        match (a, b) {
            (Record::Cycle(a), Record::Cycle(b)) => self.feed_change_percent(a.feed?, b.feed?),
            _ => None,
        }
    }

    fn feed_change_percent(&self, old: Feed, new: Feed) -> Option<f64> {
        let rate = |feed: Feed, unit| feed.mm_per_minute(unit, None, None);
        let (old, new) = match (rate(old, self.units.0), rate(new, self.units.1)) {
            (Some(old), Some(new)) => (old, new),
            _ if old.unit == new.unit => (old.value, new.value),
            _ => return None,
        };
        Some((new / old - 1.0) * 100.0).filter(|percent| percent.is_finite())
    }
}
