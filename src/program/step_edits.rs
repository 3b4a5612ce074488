//! What each step of a recipe changed, counted when the step ends.
//!
//! A statement carries the signature of the last step that changed it. A step that is followed by another one on the same
//! statements would lose its changes to that one, so each step's are counted before the next one begins.

use super::{Program, Record, RecordKind, StatementChange, StepId};
use std::collections::BTreeMap;

/// The statements that one step changed, counted by kind.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StepEdits {
    /// The step.
    pub step: StepId,
    /// Statements that it gave a new text.
    pub edited: BTreeMap<RecordKind, usize>,
    /// Statements that it put in.
    pub inserted: BTreeMap<RecordKind, usize>,
    /// Statements that it took out: those of the file, and those that an earlier step had put in.
    pub deleted: BTreeMap<RecordKind, usize>,
}

/// The edits of the steps that are done, and what is known of the one that runs.
#[derive(Debug, Clone, Default)]
pub(super) struct StepEditCounts {
    closed: Vec<StepEdits>,
    inserted: BTreeMap<RecordKind, usize>,
    deleted: BTreeMap<RecordKind, usize>,
}

impl StepEditCounts {
    /// Takes notice of a statement that the running step puts in.
    pub(super) fn record_insertion(&mut self, record: &Record) {
        *self.inserted.entry(RecordKind::from_record(record)).or_default() += 1;
    }

    /// Takes notice of a statement that the running step takes out. What it had put in itself was never there.
    pub(super) fn record_deletion(&mut self, record: &Record, before: StatementChange, step: StepId) {
        let kind = RecordKind::from_record(record);
        match before {
            StatementChange::Deleted(_) => {}
            StatementChange::Inserted(by) if by == step => {
                if let Some(count) = self.inserted.get_mut(&kind) {
                    *count = count.saturating_sub(1);
                }
            }
            _ => *self.deleted.entry(kind).or_default() += 1,
        }
    }
}

impl Program {
    /// Counts what a step changed, once it is done and before the next one begins. Takes one pass over the statements.
    pub(crate) fn close_step(&mut self, step: StepId) {
        let inserted = std::mem::take(&mut self.step_edits.inserted);
        let deleted = std::mem::take(&mut self.step_edits.deleted);
        let edits = self.count_signed_edits(step, inserted, deleted);
        self.step_edits.closed.push(edits);
    }

    /// What each step changed, in the order in which the steps ran. Edits after the last step that was closed are counted for
    /// the step that signed them.
    pub fn step_edits(&self) -> Vec<StepEdits> {
        let mut all = self.step_edits.closed.clone();
        let signed = self.statements.iter().filter_map(|statement| statement.edited_by()).max();
        if let Some(step) = signed.filter(|step| all.iter().all(|closed| closed.step != *step)) {
            let StepEditCounts { inserted, deleted, .. } = self.step_edits.clone();
            all.push(self.count_signed_edits(step, inserted, deleted));
        }
        all
    }

    fn count_signed_edits(
        &self,
        step: StepId,
        mut inserted: BTreeMap<RecordKind, usize>,
        deleted: BTreeMap<RecordKind, usize>,
    ) -> StepEdits {
        let mut edited: BTreeMap<RecordKind, usize> = BTreeMap::new();
        let mut put_in_before = inserted.clone();
        for statement in self.statements.iter().filter(|statement| statement.is_live()) {
            let kind = RecordKind::from_record(&statement.record);
            match statement.change {
                StatementChange::Edited(by) if by == step => *edited.entry(kind).or_default() += 1,
                StatementChange::Inserted(by) if by == step => match put_in_before.get_mut(&kind) {
                    Some(count) if *count > 0 => *count -= 1,
                    // An earlier step put it in; this one gave it another text and signed it anew.
                    _ => *edited.entry(kind).or_default() += 1,
                },
                _ => {}
            }
        }
        inserted.retain(|_, count| *count > 0);
        StepEdits { step, edited, inserted, deleted }
    }
}
