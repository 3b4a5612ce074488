//! What steps made of statements, one edit after the other: kept on request, for the comments that say so in the file.
//!
//! Texts of edits are never overwritten, so an earlier text is a place among them. A text's own place is its key, which stays
//! when statements are put in and indices move.

use super::statement::{Statement, StepId, TextLocation};
use super::{Program, StatementChange};
use std::collections::BTreeMap;

/// The edits of a program.
#[derive(Debug, Clone, Default)]
pub(super) struct EditHistory {
    /// By the start of the text that an edit made.
    made: BTreeMap<u64, EditOrigin>,
    notes: BTreeMap<u64, Box<str>>,
}

#[derive(Debug, Clone, Copy)]
struct EditOrigin {
    by: StepId,
    /// The text before; `None` where the statement was put in.
    from: Option<TextLocation>,
}

impl EditHistory {
    pub(super) fn record_edit(&mut self, to: TextLocation, from: Option<TextLocation>, by: StepId) {
        self.made.insert(to.start, EditOrigin { by, from });
    }
}

/// What one step made of a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StatementEdit<'p> {
    /// The step.
    pub by: StepId,
    /// The text before; `None` where the step put the statement in.
    pub before: Option<&'p [u8]>,
    /// The text that it made.
    pub after: &'p [u8],
    /// What the step has to say of it.
    pub note: Option<&'p str>,
}

impl Program {
    /// From now on every edit is remembered (see [`Program::edits_of_statement`]): some 50 bytes for each.
    pub fn keep_history(&mut self) {
        self.history.get_or_insert_default();
    }

    /// Whether it is remembered.
    pub fn has_history(&self) -> bool {
        self.history.is_some()
    }

    /// What steps made of a statement, the first edit first; empty for a program that keeps no history. That a statement was
    /// taken out is no edit.
    pub fn edits_of_statement(&self, statement: &Statement) -> Vec<StatementEdit<'_>> {
        let mut edits = Vec::new();
        let Some(history) = &self.history else { return edits };
        let mut place = statement.text;
        while let Some(made) = history.made.get(&place.start) {
            let note = history.notes.get(&place.start).map(|note| &**note);
            let before = made.from.map(|from| self.text_at(from));
            edits.push(StatementEdit { by: made.by, before, after: self.text_at(place), note });
            match made.from {
                // Texts only come to the end, so this ends, too.
                Some(from) if from.start < place.start => place = from,
                _ => break,
            }
        }
        edits.reverse();
        edits
    }

    /// Says something about what a step just made of a statement; nothing where it made nothing, or no history is kept.
    pub(crate) fn add_edit_note(&mut self, index: usize, by: StepId, note: String) {
        let Some(statement) = self.statements.get(index) else { return };
        let changed = matches!(statement.change, StatementChange::Edited(step) | StatementChange::Inserted(step) if step == by);
        if let Some(history) = self.history.as_mut().filter(|_| changed) {
            history.notes.insert(statement.text.start, note.into_boxed_str());
        }
    }
}
