//! This module is the only place where a statement changes.
//!
//! The texts come from `write`, which patches them and reads them back. Here they are only put in place and
//! signed with the step.

use super::statement::{Statement, StatementChange, StepId, TextLocation};
use super::{Program, Record};
use crate::source::Span;

impl Program {
    /// Appends a text to the texts of edits.
    fn store_text(&mut self, text: &[u8]) -> TextLocation {
        let start = (self.source.bytes().len() + self.edits.len()) as u64;
        self.edits.extend_from_slice(text);
        TextLocation { start, length: text.len() as u32 }
    }

    /// Appends the text of an inserted statement and records it in the history.
    fn store_inserted_text(&mut self, text: &[u8], step: StepId) -> TextLocation {
        let place = self.store_text(text);
        if let Some(history) = &mut self.history {
            history.record_edit(place, None, step);
        }
        place
    }

    /// Gives a statement a new text and the record that was read from it. An equal text is not a change.
    pub(crate) fn replace_statement(&mut self, index: usize, text: &[u8], record: Record, step: StepId) {
        let same = self.statement(index).is_none_or(|statement| self.statement_text(statement) == text);
        if same {
            return;
        }
        let place = self.store_text(text);
        if let Some(statement) = self.statements.get_mut(index) {
            if let Some(history) = &mut self.history {
                history.record_edit(place, Some(statement.text), step);
            }
            statement.text = place;
            statement.record = record;
            // A statement that is not in the file stays inserted, whoever edits it.
            statement.change = match statement.change {
                StatementChange::Inserted(_) => StatementChange::Inserted(step),
                _ => StatementChange::Edited(step),
            };
        }
    }

    /// Removes a statement from the program. It is kept with a mark, also if a step inserted it, so that the
    /// report can show it.
    pub(crate) fn delete_statement(&mut self, index: usize, step: StepId) {
        if let Some(statement) = self.statements.get_mut(index) {
            self.step_edits.record_deletion(&statement.record, statement.change, step);
            statement.change = StatementChange::Deleted(step);
        }
    }

    /// Inserts new statements, each before the statement with its index (the count of statements for the
    /// end). Insertions with the same index keep their order. Indices are those before the call.
    pub(crate) fn insert_statements(&mut self, mut new: Vec<(usize, Vec<u8>, Record)>, step: StepId) {
        if new.is_empty() {
            return;
        }
        new.iter().for_each(|(_, _, record)| self.step_edits.record_insertion(record));
        // A stable sort keeps the order of insertions at the same place. One pass then merges both lists.
        new.sort_by_key(|(index, _, _)| *index);
        let mut merged = Vec::with_capacity(self.statements.len() + new.len());
        let mut new = new.into_iter().peekable();
        let old = std::mem::take(&mut self.statements);
        let end = old.last().map_or(0, |last| last.origin.end);
        for (index, statement) in old.into_iter().enumerate() {
            while let Some((_, text, record)) = new.next_if(|(before, _, _)| *before <= index) {
                // The origin is an empty span at the following statement, so that findings can point at a
                // place in the file.
                let origin = Span { start: statement.origin.start, end: statement.origin.start };
                let text = self.store_inserted_text(&text, step);
                merged.push(Statement { record, text, origin, change: StatementChange::Inserted(step) });
            }
            merged.push(statement);
        }
        for (_, text, record) in new {
            let text = self.store_inserted_text(&text, step);
            merged.push(Statement {
                record,
                text,
                origin: Span { start: end, end },
                change: StatementChange::Inserted(step),
            });
        }
        self.statements = merged;
    }
}
