//! This module follows the alignment and collects the differences.

use super::alignment::{AlignmentRun, StatementAlignment, align_statements};
use super::alignment_keys::AlignmentKeys;
use super::difference_kind::{DifferenceKind, StatementPair};
use super::{
    DiffCounts, DiffSide, MOST_LISTED, OperationDiff, ProgramDiff, StatementDifference, path_comparison,
};
use crate::program::RecordKind;
use crate::program::geometry::SAME_POINT;
use crate::program::{LengthUnit, Program, Record, Statement, operation};
use crate::report::statement_line;
use crate::report::stats::{MotionTotals, ReportedRange, ResolvedLengthUnit};
use std::collections::BTreeMap;

/// The largest number of bytes of a statement that are listed. A longer text is cut.
const LONGEST_TEXT: usize = 300;

pub(super) fn collect_diff(a: &Program, b: &Program) -> (ProgramDiff, StatementAlignment) {
    let (units_a, units_b) =
        (ResolvedLengthUnit::from_program(a, None), ResolvedLengthUnit::from_program(b, None));
    let (keys_a, keys_b) = (AlignmentKeys::from_program(a), AlignmentKeys::from_program(b));
    let sides = AlignedPrograms { a, b, keys_a, keys_b, units: (units_a.unit, units_b.unit) };
    let runs = align_statements(&sides.keys_a, &sides.keys_b, |in_a, in_b| sides.is_shifted(in_a.zip(in_b)));
    let mut found = DiffCollector::default();
    for run in &runs {
        match run.clone() {
            AlignmentRun::Pairs(in_a, in_b) => {
                in_a.zip(in_b).for_each(|(at_a, at_b)| found.add_pair(&sides, at_a, at_b))
            }
            AlignmentRun::Removed(in_a, _) => {
                in_a.for_each(|at| found.add_unpaired(a, sides.statement_a(at), DifferenceKind::Removed))
            }
            AlignmentRun::Added(_, in_b) => {
                in_b.for_each(|at| found.add_unpaired(b, sides.statement_b(at), DifferenceKind::Added))
            }
        }
    }
    let alignment = StatementAlignment { runs, ids_a: sides.keys_a.ids, ids_b: sides.keys_b.ids };
    let (geometry, totals_a, totals_b) = path_comparison::compare_paths((a, units_a.unit), (b, units_b.unit));
    let diff =
        found.into_diff(geometry, describe_side(a, units_a, totals_a), describe_side(b, units_b, totals_b));
    (diff, alignment)
}

fn describe_side(program: &Program, units: ResolvedLengthUnit, totals: MotionTotals) -> DiffSide {
    DiffSide { file: program.source().name().to_owned(), dialect: program.dialect().into(), units, totals }
}

struct AlignedPrograms<'p> {
    a: &'p Program,
    b: &'p Program,
    keys_a: AlignmentKeys,
    keys_b: AlignmentKeys,
    units: (LengthUnit, LengthUnit),
}

impl<'p> AlignedPrograms<'p> {
    fn statement_a(&self, at: usize) -> Option<&'p Statement> {
        self.keys_a.ids.get(at).map(|id| self.a.statement(*id))
    }

    fn statement_b(&self, at: usize) -> Option<&'p Statement> {
        self.keys_b.ids.get(at).map(|id| self.b.statement(*id))
    }

    /// Returns whether all points of one range are those of the other one, displaced by the same vector.
    fn is_shifted(&self, pairs: impl Iterator<Item = (usize, usize)>) -> bool {
        let mut first = None;
        for (at_a, at_b) in pairs {
            let records = (self.statement_a(at_a), self.statement_b(at_b));
            let (Some(a), Some(b)) = records else {
                debug_assert!(false, "{at_a} or {at_b} is no statement of its program");
                return false;
            };
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
struct DiffCollector {
    counts: DiffCounts,
    largest_move: Option<f64>,
    feed_change: Option<ReportedRange>,
    operations: Vec<OperationDiff>,
    changes: Vec<StatementDifference>,
    listed: BTreeMap<DifferenceKind, usize>,
    not_listed: usize,
    /// The name of the current operation. It is added to `operations` with its first difference.
    name: String,
    is_listed: bool,
}

impl DiffCollector {
    fn add_pair(&mut self, sides: &AlignedPrograms<'_>, at_a: usize, at_b: usize) {
        let (Some(a), Some(b)) = (sides.statement_a(at_a), sides.statement_b(at_b)) else {
            return debug_assert!(false, "{at_a} or {at_b} is no statement of its program");
        };
        self.enter_operation(sides.b, b);
        let pair = StatementPair { a: (sides.a, a), b: (sides.b, b), units: sides.units };
        match pair.classify_difference() {
            None => self.counts.same += 1,
            Some((what, by)) => self.add_difference(what, by, Some((sides.a, a)), Some((sides.b, b))),
        }
    }

    fn add_unpaired(&mut self, program: &Program, statement: Option<&Statement>, what: DifferenceKind) {
        let Some(statement) = statement else {
            return debug_assert!(false, "an index of the alignment is no statement of its program");
        };
        self.enter_operation(program, statement);
        let side = Some((program, statement));
        let (a, b) = if what == DifferenceKind::Removed { (side, None) } else { (None, side) };
        let is_text = RecordKind::from_record(statement.record()) == RecordKind::Comment;
        self.add_difference(if is_text { DifferenceKind::Text } else { what }, None, a, b);
    }

    fn enter_operation(&mut self, program: &Program, statement: &Statement) {
        if let Some(name) = operation::operation_name(program, statement) {
            self.name = name;
            self.is_listed = false;
        }
    }

    fn add_difference(
        &mut self,
        what: DifferenceKind,
        by: Option<f64>,
        a: Option<(&Program, &Statement)>,
        b: Option<(&Program, &Statement)>,
    ) {
        let Some((_, statement)) = b.or(a) else { return };
        let kind = RecordKind::from_record(statement.record());
        if !self.is_listed {
            let name = std::mem::take(&mut self.name);
            self.operations.push(OperationDiff { name, counts: DiffCounts::default() });
            self.is_listed = true;
        }
        let operation = self.operations.len().saturating_sub(1);
        count_difference(&mut self.counts, what, kind);
        if let Some(last) = self.operations.last_mut() {
            count_difference(&mut last.counts, what, kind);
        }
        match (what, by) {
            (DifferenceKind::Moved, Some(by)) => {
                self.largest_move = Some(self.largest_move.unwrap_or(0.0).max(by))
            }
            (DifferenceKind::Feed, Some(by)) => ReportedRange::include_value(&mut self.feed_change, by),
            _ => {}
        }
        let listed = self.listed.entry(what).or_default();
        if *listed >= MOST_LISTED {
            self.not_listed += 1;
            return;
        }
        *listed += 1;
        let line = |(program, statement): (&Program, &Statement)| statement_line(program, statement);
        self.changes.push(StatementDifference {
            what,
            kind,
            operation,
            line_a: a.and_then(line),
            line_b: b.and_then(line),
            old: a.map(|(program, statement)| clip_statement_text(program, statement)),
            new: b.map(|(program, statement)| clip_statement_text(program, statement)),
            by,
        });
    }

    fn into_diff(self, geometry: path_comparison::PathComparison, a: DiffSide, b: DiffSide) -> ProgramDiff {
        ProgramDiff {
            version: 1,
            a,
            b,
            identical: self.counts.is_empty(),
            same_meaning: self.counts.has_same_meaning() && geometry.same,
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

fn count_difference(counts: &mut DiffCounts, what: DifferenceKind, kind: RecordKind) {
    match what {
        DifferenceKind::Layout => counts.layout += 1,
        DifferenceKind::Text => counts.text += 1,
        DifferenceKind::Moved => counts.moved += 1,
        DifferenceKind::Turned => counts.turned += 1,
        DifferenceKind::Feed => counts.feeds += 1,
        DifferenceKind::Changed => *counts.changed.entry(kind).or_default() += 1,
        DifferenceKind::Added => *counts.added.entry(kind).or_default() += 1,
        DifferenceKind::Removed => *counts.removed.entry(kind).or_default() += 1,
    }
}

fn clip_statement_text(program: &Program, statement: &Statement) -> String {
    let text = program.statement_text(statement).trim_ascii_end();
    match text.get(..LONGEST_TEXT) {
        Some(start) if text.len() > LONGEST_TEXT => format!("{} ...", operation::decode_text(start)),
        _ => operation::decode_text(text),
    }
}
