//! This module holds a program as an editor asks about it: read and checked once, with places from which the state at
//! any line is found at once.

use super::path_sums::PathSums;
use crate::check::CheckedProgram;
use crate::diagnostic::Diagnostic;
use crate::program::motion::{Motions, SuspendedMotions};
use crate::program::operation::{Operation, find_operations};
use crate::program::{LengthUnit, Program, RecordKind, StatementId};
use crate::report::stats::ResolvedLengthUnit;
use crate::setup::Setup;
use crate::source::Source;
use crate::transform::check_with_setup;
use std::sync::Arc;

/// The number of motions between two places from which the state is found.
const STRIDE: usize = 2048;

/// A program that was read and checked for an editor.
#[derive(Debug)]
pub struct ProgramView {
    program: Program,
    unit: LengthUnit,
    rapid_feed_mm_min: Option<f64>,
    findings: Vec<Diagnostic>,
    operations: Vec<Operation>,
    operation_sums: Vec<PathSums>,
    checkpoints: Vec<Checkpoint>,
    coolant: Vec<StatementId>,
}

/// A place between two motions.
#[derive(Debug)]
pub(super) struct Checkpoint {
    motions: SuspendedMotions,
    pub(super) sums: PathSums,
}

impl ProgramView {
    /// Reads and checks a program; a setup is asked about it, too.
    ///
    /// ```
    /// use clsmith::editor::ProgramView;
    /// use clsmith::source::Source;
    ///
    /// let text = b"FEDRAT/MMPM,1200.\nGOTO/0,0,0\nGOTO/40,0,0\n";
    /// let view = ProgramView::new(&Source::new("part.cls", text.to_vec())?, None);
    /// let state = view.line_state(2).expect("there is a third line");
    /// assert_eq!(state.feed_mm_min, Some(1200.0));
    /// assert_eq!(state.sums.feed_length_mm, 40.0);
    /// # Ok::<(), clsmith::source::SourceTooLarge>(())
    /// ```
    pub fn new(source: &Arc<Source>, setup: Option<&Setup>) -> Self {
        let vocabulary = setup.map(|setup| Arc::clone(&setup.vocabulary)).unwrap_or_default();
        let CheckedProgram { program, of_reading, of_checks } =
            CheckedProgram::read_source(source, None, &vocabulary);
        let is_unread = of_reading.iter().any(Diagnostic::is_error);
        let mut findings = of_reading;
        findings.extend(of_checks);
        let unit = ResolvedLengthUnit::from_program(&program, None).unit;
        if let Some(setup) = setup.filter(|_| !is_unread) {
            findings.extend(check_with_setup(&program, setup, unit));
        }
        let rapid_feed = setup.and_then(|setup| setup.machine.rapid_feed);
        let mut view = Self {
            unit,
            rapid_feed_mm_min: rapid_feed.map(|feed| feed.get()),
            findings,
            operations: find_operations(&program),
            operation_sums: Vec::new(),
            checkpoints: Vec::new(),
            coolant: list_coolant(&program),
            program,
        };
        (view.operation_sums, view.checkpoints) = view.measure_motions();
        view
    }

    /// Goes through the motions once: sums of operations, and the places between.
    fn measure_motions(&self) -> (Vec<PathSums>, Vec<Checkpoint>) {
        let mut whole = PathSums::default();
        let mut of_operations = vec![PathSums::default(); self.operations.len()];
        let mut checkpoints = vec![Checkpoint { motions: self.program.motions().suspend(), sums: whole }];
        let mut motions = self.program.motions();
        let mut count = 0_usize;
        while let Some(motion) = motions.next() {
            let sums = self.measure(&motion);
            whole.add(&sums);
            if let Some(operation) = of_operations.get_mut(motion.operation) {
                operation.add(&sums);
            }
            motions.give_back(motion);
            count += 1;
            if count.is_multiple_of(STRIDE) {
                checkpoints.push(Checkpoint { motions: motions.suspend(), sums: whole });
            }
        }
        (of_operations, checkpoints)
    }

    /// Measures a motion with the feeds that are known.
    pub(super) fn measure(&self, motion: &crate::program::motion::Motion) -> PathSums {
        PathSums::of_motion(motion, self.unit, self.rapid_feed_mm_min)
    }

    /// Returns the last place before a statement, and the motions from there on.
    pub(super) fn motions_before(&self, id: StatementId) -> (PathSums, Motions<'_>) {
        let behind = self.checkpoints.partition_point(|place| place.motions.statements_read() <= id.index());
        match behind.checked_sub(1).and_then(|last| self.checkpoints.get(last)) {
            Some(place) => (place.sums, place.motions.resume(&self.program)),
            None => (PathSums::default(), self.program.motions()),
        }
    }

    /// Returns the program.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Returns the unit of the program's lengths.
    pub fn unit(&self) -> LengthUnit {
        self.unit
    }

    /// Returns what is wrong with it.
    pub fn findings(&self) -> &[Diagnostic] {
        &self.findings
    }

    /// Returns the operations, each with the sums of its motions.
    pub fn operations(&self) -> impl Iterator<Item = (&Operation, &PathSums)> {
        self.operations.iter().zip(&self.operation_sums)
    }

    /// Returns the COOLNT statements in order.
    pub(super) fn coolant_statements(&self) -> &[StatementId] {
        &self.coolant
    }

    /// Returns the statement on a line, counted from 0.
    pub fn statement_on_line(&self, line: u32) -> Option<StatementId> {
        let span = self.program.source().line_span(line as usize + 1)?;
        self.program.statement_at_offset(span.start)
    }

    /// Returns the line on which a statement begins, counted from 0. Empty lines before its word do not count.
    pub fn line_of_statement(&self, id: StatementId) -> u32 {
        let statement = self.program.statement(id);
        let text = self.program.statement_text(statement);
        let blank = text.len() - text.trim_ascii_start().len();
        let start = statement.origin().start + if blank < text.len() { blank as u32 } else { 0 };
        self.program.source().line_column(start).0 as u32 - 1
    }
}

fn list_coolant(program: &Program) -> Vec<StatementId> {
    let others = program.live_statements_of(&[RecordKind::Other]);
    let is_coolant = |text: &[u8]| {
        text.trim_ascii_start().get(..6).is_some_and(|word| word.eq_ignore_ascii_case(b"COOLNT"))
    };
    others.filter(|(_, statement)| is_coolant(program.statement_text(statement))).map(|(id, _)| id).collect()
}
