//! This module keeps the history of edits: what steps made of statements, one edit after the other. It is
//! kept on request, for the comments in the file that tell about them.
//!
//! Texts of edits are never overwritten, so an earlier text is a location among them. Each edit is stored
//! under the location of the text that it made. That key stays valid when statements are inserted and indices
//! move. No step has to keep a log, and a program without history pays nothing.

use super::statement::{Statement, StepId, TextLocation};
use super::{Program, StatementChange, StatementId};
use std::collections::BTreeMap;

/// The history of a program's edits.
#[derive(Debug, Clone, Default)]
pub(super) struct EditHistory {
    /// The edits, by the start of the text that each one made.
    made: BTreeMap<u64, EditOrigin>,
    notes: BTreeMap<u64, Box<str>>,
}

/// The step that made a text, and the text before.
#[derive(Debug, Clone, Copy)]
struct EditOrigin {
    by: StepId,
    /// The text before; `None` if the statement was inserted.
    from: Option<TextLocation>,
}

impl EditHistory {
    /// Records that a step replaced one text by another.
    pub(super) fn record_edit(&mut self, to: TextLocation, from: Option<TextLocation>, by: StepId) {
        self.made.insert(to.start, EditOrigin { by, from });
    }
}

/// An edit: the text that one step made of a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StatementEdit<'p> {
    /// The step.
    pub by: StepId,
    /// The text before; `None` if the step inserted the statement.
    pub before: Option<&'p [u8]>,
    /// The text that the step made.
    pub after: &'p [u8],
    /// A note of the step about this edit.
    pub note: Option<&'p str>,
}

impl Program {
    /// Keeps every edit from now on (see [`Program::edits_of_statement`]), which takes about 50 bytes for
    /// each.
    pub fn keep_history(&mut self) {
        self.history.get_or_insert_default();
    }

    /// Returns whether edits are kept.
    pub fn has_history(&self) -> bool {
        self.history.is_some()
    }

    /// Returns the edits of a statement, the first one first. It is empty for a program that keeps no
    /// history. The deletion of a statement is not an edit.
    pub fn edits_of_statement(&self, statement: &Statement) -> Vec<StatementEdit<'_>> {
        let mut edits = Vec::new();
        let Some(history) = &self.history else { return edits };
        let mut place = statement.text();
        while let Some(made) = history.made.get(&place.start) {
            let note = history.notes.get(&place.start).map(|note| &**note);
            let before = made.from.map(|from| self.text_at(from));
            edits.push(StatementEdit { by: made.by, before, after: self.text_at(place), note });
            match made.from {
                // Texts are only appended, so earlier texts have smaller offsets and the loop ends.
                Some(from) if from.start < place.start => place = from,
                _ => break,
            }
        }
        edits.reverse();
        edits
    }

    /// Adds a note about a step's edit of a statement. It has no effect if the step did not edit the
    /// statement or no history is kept.
    pub(crate) fn add_edit_note(&mut self, id: StatementId, by: StepId, note: String) {
        let statement = self.statement(id);
        let changed = matches!(statement.change, StatementChange::Edited(step) | StatementChange::Inserted(step) if step == by);
        let start = statement.text().start;
        if let Some(history) = self.history.as_mut().filter(|_| changed) {
            history.notes.insert(start, note.into_boxed_str());
        }
    }
}
