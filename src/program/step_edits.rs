//! This module counts the changes of each recipe step when the step ends.
//!
//! A statement carries the signature of the last step that changed it. If a later step changes the same
//! statements, the earlier one would lose its changes. So the changes of each step are counted before the
//! next one begins.

use super::{Program, Record, RecordKind, StatementChange, StepId};
use std::collections::BTreeMap;

/// The statements that one step changed, counted by kind.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct StepEdits {
    /// The step.
    pub step: StepId,
    /// The statements to which it gave a new text.
    pub edited: BTreeMap<RecordKind, usize>,
    /// The statements that it inserted.
    pub inserted: BTreeMap<RecordKind, usize>,
    /// The statements that it deleted: those of the file, and those that an earlier step had inserted.
    pub deleted: BTreeMap<RecordKind, usize>,
}

/// The edits of the finished steps, and the state of the running one.
#[derive(Debug, Clone, Default)]
pub(super) struct StepEditCounts {
    closed: Vec<StepEdits>,
    inserted: BTreeMap<RecordKind, usize>,
    deleted: BTreeMap<RecordKind, usize>,
}

impl StepEditCounts {
    /// Records that the running step inserts a statement.
    pub(super) fn record_insertion(&mut self, record: &Record) {
        *self.inserted.entry(RecordKind::from_record(record)).or_default() += 1;
    }

    /// Records that the running step deletes a statement. One that it had inserted itself does not count.
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
    /// Counts the changes of a step when it is finished and before the next one begins. It takes one pass
    /// over the statements.
    pub(crate) fn close_step(&mut self, step: StepId) {
        let inserted = std::mem::take(&mut self.step_edits.inserted);
        let deleted = std::mem::take(&mut self.step_edits.deleted);
        let edits = self.count_signed_edits(step, inserted, deleted);
        self.step_edits.closed.push(edits);
    }

    /// Returns the changes of each step, in the order in which the steps ran. Edits after the last counted
    /// step count for the step that signed them.
    ///
    /// ```
    /// use clsmith::parse::parse;
    /// use clsmith::program::{RecordKind, StepId};
    /// use clsmith::source::Source;
    /// use clsmith::write::ProgramEditor;
    ///
    /// let source = Source::new("part.cls", b"FEDRAT/MMPM,500.\nGOTO/1,2,3\n".to_vec())?;
    /// let program = parse(&source, None).program;
    /// let feed = program.statement_ids().next().expect("there are statements");
    /// let mut editor = ProgramEditor::new(program, StepId(0));
    /// editor.set_numbers(feed, &[(0, 250.0)])?;
    /// let program = editor.finish()?;
    /// assert_eq!(program.step_edits()[0].edited.get(&RecordKind::Feed), Some(&1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
                    // An earlier step inserted the statement, and this one gave it another text and its
                    // signature.
                    _ => *edited.entry(kind).or_default() += 1,
                },
                _ => {}
            }
        }
        inserted.retain(|_, count| *count > 0);
        StepEdits { step, edited, inserted, deleted }
    }
}
