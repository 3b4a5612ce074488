//! What a recipe made of a program, step by step.
//!
//! Counted from the signatures of the statements, so no step keeps a log. A statement is signed by the last step that
//! changed it. The JSON ([`to_json`]) is [`Changes`] as it stands, with `"version": 1`; `version` changes when a reader of
//! the structure would have to, new keys may be added without.

mod text;

use crate::program::LengthUnit;
pub use text::{steps_to_text, to_text};

use super::kind::Kind;
use super::stats::{Measured, Totals, Units};
use crate::program::{Change, Program};
use serde::Serialize;
use std::collections::BTreeMap;

/// What a recipe made of a program.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Changes {
    /// Version of the JSON structure: 1.
    pub version: u32,
    /// The file's name.
    pub file: String,
    /// The unit of lengths, before and after: that of the program after.
    pub units: Units,
    /// The steps in order, those without a change included.
    pub steps: Vec<StepChanges>,
    /// Statements that no step touched.
    pub untouched: usize,
    /// Lengths and times before; rapids have no time.
    pub before: Totals,
    /// Lengths and times after.
    pub after: Totals,
}

/// What one step changed, by kind of statement.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct StepChanges {
    /// The step's name in the recipe.
    pub name: String,
    /// Statements it gave a new text.
    pub edited: BTreeMap<Kind, usize>,
    /// Statements it put in.
    pub inserted: BTreeMap<Kind, usize>,
    /// Statements of the file that it took out.
    pub deleted: BTreeMap<Kind, usize>,
}

impl StepChanges {
    /// Whether the step changed nothing that a later step did not change again.
    pub fn is_empty(&self) -> bool {
        self.edited.is_empty() && self.inserted.is_empty() && self.deleted.is_empty()
    }
}

impl Changes {
    /// Counts what `steps` (their names in the recipe's order) made of `before`. `after` carries the signatures; one of a step
    /// that `steps` does not name gets a step of its own, without a name.
    /// `caller` is the unit of lengths where neither the program nor its feeds tell it, as for the steps.
    pub fn of(before: &Program, after: &Program, steps: &[&str], caller: Option<LengthUnit>) -> Self {
        let told =
            |program: &Program| Units::of(program, caller.filter(|_| program.units_of_feeds().is_none()));
        let (units_before, units) = (told(before), told(after));
        // A step may have changed the unit; numbers that stand side by side must not.
        let scale = units_before.unit.in_mm() / units.unit.in_mm();
        let (steps, untouched) = count(after, steps);
        Self {
            version: 1,
            file: after.source().name().to_owned(),
            units,
            steps,
            untouched,
            before: totals(before, units_before).scaled(scale),
            after: totals(after, units),
        }
    }

    /// Whether the program is as it was.
    pub fn is_empty(&self) -> bool {
        self.steps.iter().all(StepChanges::is_empty)
    }
}

/// What each of `steps` changed, and how many statements no step touched; see [`Changes::of`].
pub fn count(after: &Program, steps: &[&str]) -> (Vec<StepChanges>, usize) {
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
            Change::Inserted(_) => &mut step.inserted,
            // One step put it in, this one took it out: the file never had it.
            Change::Deleted(_) if statement.origin().is_empty() => continue,
            Change::Deleted(_) => &mut step.deleted,
            Change::Edited(_) | Change::Untouched => &mut step.edited,
        };
        *counts.entry(Kind::of(statement.record())).or_default() += 1;
    }
    (found, untouched)
}

fn totals(program: &Program, units: Units) -> Totals {
    let mut totals = Totals::default();
    program.motions().for_each(|motion| totals.add(&Measured::of(&motion, units.unit, None)));
    totals
}

/// The changes as one JSON document, indented and with a line end.
pub fn to_json(changes: &Changes) -> String {
    super::json_text(changes)
}
