//! Walks the alignment and collects what differs.

use super::align::{Run, align};
use super::classify::{Pair, What};
use super::keys::Keys;
use super::{Counts, Diff, Difference, MOST_LISTED, OperationDiff, Side, path};
use crate::program::geometry::SAME_POINT;
use crate::program::{LengthUnit, Program, Record, Statement, operation};
use crate::report::kind::Kind;
use crate::report::line_of;
use crate::report::stats::{Range, Totals, Units};
use std::collections::BTreeMap;

/// Longest text of a statement that is listed.
const LONGEST_TEXT: usize = 300;

pub(super) fn gather(a: &Program, b: &Program) -> Diff {
    let (units_a, units_b) = (Units::of(a, None), Units::of(b, None));
    let (keys_a, keys_b) = (Keys::of(a), Keys::of(b));
    let sides = Sides { a, b, keys_a, keys_b, units: (units_a.unit, units_b.unit) };
    let runs = align(&sides.keys_a, &sides.keys_b, |in_a, in_b| sides.shifted(in_a.zip(in_b)));
    let mut found = Found::default();
    for run in runs {
        match run {
            Run::Pairs(in_a, in_b) => in_a.zip(in_b).for_each(|(at_a, at_b)| found.pair(&sides, at_a, at_b)),
            Run::Removed(in_a, _) => {
                in_a.for_each(|at| found.lonely(a, sides.statement_a(at), What::Removed))
            }
            Run::Added(_, in_b) => in_b.for_each(|at| found.lonely(b, sides.statement_b(at), What::Added)),
        }
    }
    let (geometry, totals_a, totals_b) = path::compare((a, units_a.unit), (b, units_b.unit));
    found.finish(geometry, side(a, units_a, totals_a), side(b, units_b, totals_b))
}

fn side(program: &Program, units: Units, totals: Totals) -> Side {
    Side { file: program.source().name().to_owned(), dialect: program.dialect().into(), units, totals }
}

struct Sides<'p> {
    a: &'p Program,
    b: &'p Program,
    keys_a: Keys,
    keys_b: Keys,
    units: (LengthUnit, LengthUnit),
}

impl<'p> Sides<'p> {
    fn statement_a(&self, at: usize) -> Option<&'p Statement> {
        self.keys_a.index.get(at).and_then(|index| self.a.statement(*index as usize))
    }

    fn statement_b(&self, at: usize) -> Option<&'p Statement> {
        self.keys_b.index.get(at).and_then(|index| self.b.statement(*index as usize))
    }

    /// Whether all points of a stretch are the other's, moved by one distance.
    fn shifted(&self, pairs: impl Iterator<Item = (usize, usize)>) -> bool {
        let mut first = None;
        for (at_a, at_b) in pairs {
            let records = (self.statement_a(at_a), self.statement_b(at_b));
            let (Some(a), Some(b)) = records else { return false };
            let (Record::Goto(a), Record::Goto(b)) = (a.record(), b.record()) else { continue };
            let move_by = b.point - a.point;
            let before = *first.get_or_insert(move_by);
            if (move_by - before).amax() > 4.0 * SAME_POINT {
                return false;
            }
        }
        first.is_some()
    }
}

#[derive(Default)]
struct Found {
    counts: Counts,
    largest_move: Option<f64>,
    feed_change: Option<Range>,
    operations: Vec<OperationDiff>,
    changes: Vec<Difference>,
    listed: BTreeMap<What, usize>,
    not_listed: usize,
    /// The operation that statements stand in now; it joins the list with its first difference.
    name: String,
    is_listed: bool,
}

impl Found {
    fn pair(&mut self, sides: &Sides<'_>, at_a: usize, at_b: usize) {
        let (Some(a), Some(b)) = (sides.statement_a(at_a), sides.statement_b(at_b)) else { return };
        self.enter(sides.b, b);
        let pair = Pair { a: (sides.a, a), b: (sides.b, b), units: sides.units };
        match pair.difference() {
            None => self.counts.same += 1,
            Some((what, by)) => self.record(what, by, Some((sides.a, a)), Some((sides.b, b))),
        }
    }

    fn lonely(&mut self, program: &Program, statement: Option<&Statement>, what: What) {
        let Some(statement) = statement else { return };
        self.enter(program, statement);
        let side = Some((program, statement));
        let (a, b) = if what == What::Removed { (side, None) } else { (None, side) };
        let is_text = Kind::of(statement.record()) == Kind::Comment;
        self.record(if is_text { What::Text } else { what }, None, a, b);
    }

    fn enter(&mut self, program: &Program, statement: &Statement) {
        if let Some(name) = operation::name(program, statement) {
            self.name = name;
            self.is_listed = false;
        }
    }

    fn record(
        &mut self,
        what: What,
        by: Option<f64>,
        a: Option<(&Program, &Statement)>,
        b: Option<(&Program, &Statement)>,
    ) {
        let Some((_, statement)) = b.or(a) else { return };
        let kind = Kind::of(statement.record());
        if !self.is_listed {
            let name = std::mem::take(&mut self.name);
            self.operations.push(OperationDiff { name, counts: Counts::default() });
            self.is_listed = true;
        }
        let operation = self.operations.len().saturating_sub(1);
        count(&mut self.counts, what, kind);
        if let Some(last) = self.operations.last_mut() {
            count(&mut last.counts, what, kind);
        }
        match (what, by) {
            (What::Moved, Some(by)) => self.largest_move = Some(self.largest_move.unwrap_or(0.0).max(by)),
            (What::Feed, Some(by)) => Range::extend(&mut self.feed_change, by),
            _ => {}
        }
        let listed = self.listed.entry(what).or_default();
        if *listed >= MOST_LISTED {
            self.not_listed += 1;
            return;
        }
        *listed += 1;
        let line = |(program, statement): (&Program, &Statement)| line_of(program, statement);
        self.changes.push(Difference {
            what,
            kind,
            operation,
            line_a: a.and_then(line),
            line_b: b.and_then(line),
            old: a.map(|(program, statement)| shown(program, statement)),
            new: b.map(|(program, statement)| shown(program, statement)),
            by,
        });
    }

    fn finish(self, geometry: path::Geometry, a: Side, b: Side) -> Diff {
        Diff {
            version: 1,
            a,
            b,
            identical: self.counts.is_empty(),
            same_meaning: self.counts.same_meaning() && geometry.same,
            geometry,
            counts: self.counts,
            largest_move: self.largest_move,
            feed_change: self.feed_change,
            operations: self.operations,
            changes: self.changes,
            not_listed: self.not_listed,
        }
    }
}

fn count(counts: &mut Counts, what: What, kind: Kind) {
    match what {
        What::Layout => counts.layout += 1,
        What::Text => counts.text += 1,
        What::Moved => counts.moved += 1,
        What::Turned => counts.turned += 1,
        What::Feed => counts.feeds += 1,
        What::Changed => *counts.changed.entry(kind).or_default() += 1,
        What::Added => *counts.added.entry(kind).or_default() += 1,
        What::Removed => *counts.removed.entry(kind).or_default() += 1,
    }
}

fn shown(program: &Program, statement: &Statement) -> String {
    let text = program.text(statement).trim_ascii_end();
    match text.get(..LONGEST_TEXT) {
        Some(start) if text.len() > LONGEST_TEXT => format!("{} ...", operation::text(start)),
        _ => operation::text(text),
    }
}
