//! This module applies `where:` to the statements of a program, including those that are no motion.
//!
//! Every statement belongs to an operation, and to the tool that is in force after it: a LOAD/TOOL belongs to
//! the tool that it loads. Statements before the first operation belong to that operation.
//!
//! A statement that makes motions (a GOTO, and the RAPID or CIRCLE that announces it) has their classes and
//! feeds. Any other statement (SPINDL, COOLNT, LOAD, CYCLE, FEDRAT) may govern many motions or none, so it
//! has neither. A `where` with `motions` or `feed` never means it.

use super::StepContext;
use super::empty_selection::report_nothing_selected;
use super::step_context::feed_per_minute;
use crate::program::motion::{Motion, Motions};
use crate::program::operation::{self, Operation};
use crate::program::{LengthUnit, Program, StatementId, StatementRange};
use crate::recipe::MotionFilter;
use std::collections::VecDeque;

/// Decides for each statement, in order, whether a step means it.
pub struct StatementSelection<'p> {
    wanted: MotionFilter,
    operations: Vec<Operation>,
    operation: usize,
    /// The state machine up to the last statement that was asked for. It knows the tool in force.
    tools: Motions<'p>,
    /// The last statement that `tools` has read.
    read: Option<StatementId>,
    motions: StatementMotions<'p>,
    file: LengthUnit,
    units: LengthUnit,
}

impl<'p> StatementSelection<'p> {
    /// Prepares the selection of a step in a program.
    pub fn new(wanted: impl Into<MotionFilter>, program: &'p Program, context: &StepContext<'_>) -> Self {
        let wanted = wanted.into();
        let operations = match wanted.operations {
            Some(_) => operation::find_operations(program),
            None => Vec::new(),
        };
        Self {
            wanted,
            operations,
            operation: 0,
            tools: program.motions(),
            read: None,
            motions: StatementMotions { ahead: program.motions(), found: VecDeque::new() },
            file: context.file_length_unit(program),
            units: context.units,
        }
    }

    /// Returns whether a statement is meant. Statements have to be asked for in their order; skipping some
    /// costs little.
    pub fn contains(&mut self, statement: StatementId) -> bool {
        self.is_in_operation(statement) && self.is_under_tool(statement) && self.makes_motion(statement)
    }

    fn is_in_operation(&mut self, statement: StatementId) -> bool {
        if self.wanted.operations.is_none() {
            return true;
        }
        while self.operations.get(self.operation).is_some_and(|found| ends_before(found, statement)) {
            self.operation += 1;
        }
        let found = self.operations.get(self.operation);
        self.wanted.matches_operation(found.map(|operation| operation.name.as_str()))
    }

    fn is_under_tool(&mut self, statement: StatementId) -> bool {
        if self.wanted.tools.is_none() {
            return true;
        }
        while self.read.is_none_or(|read| read < statement) {
            let Some(read) = self.tools.read_statement() else { break };
            self.read = Some(read);
        }
        let tool = self.tools.state().tool.as_deref();
        self.wanted
            .matches_tool(tool.and_then(|tool| tool.number), tool.and_then(|tool| tool.name.as_deref()))
    }

    fn makes_motion(&mut self, statement: StatementId) -> bool {
        if self.wanted.motions.is_none() && self.wanted.feed.is_none() {
            return true;
        }
        let (wanted, file, units) = (&self.wanted, self.file, self.units);
        self.motions.find_motions(statement).any(|motion| {
            let feed = if motion.rapid { None } else { feed_per_minute(motion, file, units) };
            wanted.matches_kind(Some(motion.class), feed)
        })
    }
}

fn ends_before(operation: &Operation, statement: StatementId) -> bool {
    operation.statements.is_none_or(|statements| statements.last() < statement)
}

/// The motions of a program, found by their statements.
struct StatementMotions<'p> {
    ahead: Motions<'p>,
    /// The motions that do not end before the statement that was last asked for.
    found: VecDeque<Motion>,
}

impl StatementMotions<'_> {
    /// Returns the motions that a statement makes: the points of a GOTO, or the moves of a hole. Statements
    /// have to be asked for in their order.
    fn find_motions(&mut self, statement: StatementId) -> impl Iterator<Item = &Motion> {
        while self.found.front().is_some_and(|motion| motion.statements.last() < statement) {
            self.found.pop_front();
        }
        while self.found.back().is_none_or(|motion| motion.statements.first() <= statement) {
            let Some(motion) = self.ahead.next() else { break };
            if motion.statements.last() >= statement {
                self.found.push_back(motion);
            }
        }
        self.found.iter().filter(move |motion| motion.statements.contains(statement))
    }
}

/// The statements that a step means. They can be asked for in any order and while the program changes,
/// because ids are those of the program in which the selection was made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SelectedStatements {
    /// The ranges of selected statements, in order. Neighbouring selected statements are in the same range.
    ranges: Vec<StatementRange>,
}

impl SelectedStatements {
    /// Selects the statements of a program that a step means. It reports a warning if there are none. `kind`
    /// is what `where` selects: `statement` or `operation`.
    pub fn select(
        wanted: impl Into<MotionFilter>,
        program: &Program,
        kind: &str,
        context: &mut StepContext<'_>,
    ) -> Self {
        let mut selection = StatementSelection::new(wanted, program, context);
        let mut ranges: Vec<StatementRange> = Vec::new();
        for id in program.statement_ids().filter(|id| selection.contains(*id)) {
            if !ranges.last_mut().is_some_and(|last| last.extend_by(id)) {
                ranges.push(StatementRange::of_one(id));
            }
        }
        if ranges.is_empty() && !selection.wanted.is_everything() {
            report_nothing_selected(kind, &selection.wanted, program, context);
        }
        Self { ranges }
    }

    /// Returns whether a statement is selected.
    pub fn contains(&self, statement: StatementId) -> bool {
        let after = self.ranges.partition_point(|range| range.last() < statement);
        self.ranges.get(after).is_some_and(|range| range.contains(statement))
    }

    /// Returns whether no statement is selected.
    pub fn is_empty(&self) -> bool {
        self.ranges.is_empty()
    }
}
