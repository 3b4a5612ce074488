//! How two statements that stand for each other differ.

use super::keys::same_meaning;
use crate::parse;
use crate::program::{Feed, LengthUnit, Program, Record, Role, Statement};
use crate::report::kind::Kind;
use serde::Serialize;

/// How a statement differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum What {
    /// Written differently, the same meaning.
    Layout,
    /// A comment, an empty line or text for people.
    Text,
    /// A point that moved.
    Moved,
    /// An axis that turned.
    Turned,
    /// A feed.
    Feed,
    /// Anything else.
    Changed,
    /// Only in the second program.
    Added,
    /// Only in the first program.
    Removed,
}

/// The statements of a pair and the units of their files.
#[derive(Clone, Copy)]
pub(super) struct Pair<'p> {
    pub(super) a: (&'p Program, &'p Statement),
    pub(super) b: (&'p Program, &'p Statement),
    pub(super) units: (LengthUnit, LengthUnit),
}

impl Pair<'_> {
    /// How the statements differ, and by how much; `None` when they are the same bytes.
    pub(super) fn difference(&self) -> Option<(What, Option<f64>)> {
        let (text_a, text_b) = (self.a.0.text(self.a.1), self.b.0.text(self.b.1));
        if text_a == text_b {
            return None;
        }
        let (a, b) = (self.a.1.record(), self.b.1.record());
        Some(if same_meaning(self.a, self.b) {
            (What::Layout, None)
        } else if Kind::of(a) == Kind::Comment && Kind::of(b) == Kind::Comment {
            (What::Text, None)
        } else if let (Record::Feed(a), Record::Feed(b)) = (a, b) {
            (What::Feed, self.percent(*a, *b))
        } else {
            self.by_roles(text_a, text_b)
        })
    }

    /// From what the numbers are that differ: no record needs a rule of its own.
    fn by_roles(&self, text_a: &[u8], text_b: &[u8]) -> (What, Option<f64>) {
        let (a, b) = (self.a.1.record(), self.b.1.record());
        let scale = self.units.0.in_mm() / self.units.1.in_mm();
        if let (Record::Goto(a), Record::Goto(b)) = (a, b) {
            let distance = (b.point - a.point * scale).norm();
            return if distance > 0.0 { (What::Moved, Some(distance)) } else { (What::Turned, None) };
        }
        let (numbers_a, numbers_b) = (parse::numbers(text_a), parse::numbers(text_b));
        let roles = parse::roles(b, text_b);
        if numbers_a.len() != numbers_b.len() || parse::roles(a, text_a) != roles {
            return (What::Changed, None);
        }
        let (mut largest, mut square) = (0.0_f64, 0.0);
        let (mut turned, mut fed, mut other) = (false, false, false);
        for (((_, old), (_, new)), role) in numbers_a.iter().zip(&numbers_b).zip(&roles) {
            let differs = old != new;
            match role {
                Role::Point(coordinate) | Role::Step(coordinate) => {
                    square = if *coordinate == 0 { 0.0 } else { square } + (new - old * scale).powi(2);
                    largest = largest.max(square);
                }
                Role::Direction(_) | Role::ArcAxis(_) => turned |= differs,
                Role::Feed => fed |= differs,
                _ => other |= differs,
            }
        }
        match (largest > 0.0, turned, fed, other) {
            (true, ..) => (What::Moved, Some(largest.sqrt())),
            (_, true, _, _) => (What::Turned, None),
            (_, _, true, false) => (What::Feed, self.cycle_percent(a, b)),
            _ => (What::Changed, None),
        }
    }

    fn cycle_percent(&self, a: &Record, b: &Record) -> Option<f64> {
        match (a, b) {
            (Record::Cycle(a), Record::Cycle(b)) => self.percent(a.feed?, b.feed?),
            _ => None,
        }
    }

    fn percent(&self, old: Feed, new: Feed) -> Option<f64> {
        let rate = |feed: Feed, unit| feed.mm_per_minute(unit, None, None);
        let (old, new) = match (rate(old, self.units.0), rate(new, self.units.1)) {
            (Some(old), Some(new)) => (old, new),
            _ if old.unit == new.unit => (old.value, new.value),
            _ => return None,
        };
        Some((new / old - 1.0) * 100.0).filter(|percent| percent.is_finite())
    }
}
