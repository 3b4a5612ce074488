//! What a recipe made of a program, step by step.
//!
//! Counted from the signatures of the statements, so no step keeps a log. A statement is signed by the last step that
//! changed it. The JSON ([`to_json`]) is [`RecipeChanges`] as it stands, with `"version": 1`; `version` changes when a reader of
//! the structure would have to, new keys may be added without.

mod text;

use crate::program::LengthUnit;
pub use text::{steps_to_text, to_text};

use super::record_kind::RecordKind;
use super::stats::{MotionLengthAndTime, MotionTotals, ResolvedLengthUnit};
use crate::program::{Program, StatementChange};
use serde::Serialize;
use std::collections::BTreeMap;

/// What a recipe made of a program.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecipeChanges {
    /// Version of the JSON structure: 1.
    pub version: u32,
    /// The file's name.
    pub file: String,
    /// The unit of lengths, before and after: that of the program after.
    pub units: ResolvedLengthUnit,
    /// The steps in order, those without a change included.
    pub steps: Vec<StepChanges>,
    /// Statements that no step touched.
    pub untouched: usize,
    /// Lengths and times before; rapids have no time.
    pub before: MotionTotals,
    /// Lengths and times after.
    pub after: MotionTotals,
}

/// What one step changed, by kind of statement.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct StepChanges {
    /// The step's name in the recipe.
    pub name: String,
    /// Statements it gave a new text.
    pub edited: BTreeMap<RecordKind, usize>,
    /// Statements it put in.
    pub inserted: BTreeMap<RecordKind, usize>,
    /// Statements of the file that it took out.
    pub deleted: BTreeMap<RecordKind, usize>,
}

impl StepChanges {
    /// Whether the step changed nothing that a later step did not change again.
    pub fn is_empty(&self) -> bool {
        self.edited.is_empty() && self.inserted.is_empty() && self.deleted.is_empty()
    }
}

impl RecipeChanges {
    /// Counts what `steps` (their names in the recipe's order) made of `before`. `after` carries the signatures; one of a step
    /// that `steps` does not name gets a step of its own, without a name.
    /// `caller` is the unit of lengths where neither the program nor its feeds tell it, as for the steps.
    pub fn from_programs(
        before: &Program,
        after: &Program,
        steps: &[&str],
        caller: Option<LengthUnit>,
    ) -> Self {
        let told = |program: &Program| {
            ResolvedLengthUnit::from_program(program, caller.filter(|_| program.feed_length_unit().is_none()))
        };
        let (units_before, units) = (told(before), told(after));
        // A step may have changed the unit; numbers that stand side by side must not.
        let scale = units_before.unit.mm_per_unit() / units.unit.mm_per_unit();
        let (steps, untouched) = count_step_changes(after, steps);
        Self {
            version: 1,
            file: after.source().name().to_owned(),
            units,
            steps,
            untouched,
            before: sum_motions(before, units_before).scaled_by(scale),
            after: sum_motions(after, units),
        }
    }

    /// Whether the program is as it was.
    pub fn is_empty(&self) -> bool {
        self.steps.iter().all(StepChanges::is_empty)
    }
}

/// What each of `steps` changed, and how many statements no step touched; see [`RecipeChanges::from_programs`].
pub fn count_step_changes(after: &Program, steps: &[&str]) -> (Vec<StepChanges>, usize) {
    let named = |name: &&str| StepChanges { name: (*name).to_owned(), ..StepChanges::default() };
    let mut found: Vec<StepChanges> = steps.iter().map(named).collect();
    let mut untouched = 0;
    for statement in after.statements() {
        let Some(step) = statement.edited_by() else {
            untouched += 1;
            continue;
        };
        let step = usize::from(step.0);
        if found.len() <= step {
            found.resize(step + 1, StepChanges::default());
        }
        let Some(step) = found.get_mut(step) else { continue };
        let counts = match statement.change() {
            StatementChange::Inserted(_) => &mut step.inserted,
            // One step put it in, this one took it out: the file never had it.
            StatementChange::Deleted(_) if statement.origin().is_empty() => continue,
            StatementChange::Deleted(_) => &mut step.deleted,
            StatementChange::Edited(_) | StatementChange::Untouched => &mut step.edited,
        };
        *counts.entry(RecordKind::from_record(statement.record())).or_default() += 1;
    }
    (found, untouched)
}

fn sum_motions(program: &Program, units: ResolvedLengthUnit) -> MotionTotals {
    let mut totals = MotionTotals::default();
    program
        .motions()
        .for_each(|motion| totals.add_motion(&MotionLengthAndTime::from_motion(&motion, units.unit, None)));
    totals
}

/// The changes as one JSON document, indented and with a line end.
pub fn to_json(changes: &RecipeChanges) -> String {
    super::to_json_text(changes)
}
