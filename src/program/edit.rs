//! This module is the only place where a statement changes.
//!
//! The texts come from `write`, which patches them and reads them back. Here they are only put in place and
//! signed with the step.

use super::program_stamp::ProgramStamp;
use super::statement::{Statement, StatementChange, StepId, TextLocation};
use super::{InsertionPoint, Program, Record, RecordKind, StatementId};
use crate::source::Span;

/// So many bytes of edited text are the edits of a step that changes most of a program.
const MANY_EDITS: usize = 1 << 16;

impl Program {
    /// Appends a text to the texts of edits.
    fn store_text(&mut self, text: &[u8]) -> TextLocation {
        let full = self.edits.capacity() - self.edits.len() < text.len();
        // Many edits are edits of most statements. Memory that grows by small steps leaves holes behind it.
        if full && self.edits.len() >= MANY_EDITS {
            self.edits.reserve(text.len().max(self.source.bytes().len() / 2));
        }
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

    /// Gives a live statement a new text and the record that was read from it. An equal text is not a
    /// change.
    pub(crate) fn replace_statement(&mut self, id: StatementId, text: &[u8], record: Record, step: StepId) {
        let before = self.statement(id).text();
        if self.text_at(before) == text {
            return;
        }
        let place = self.store_text(text);
        if let Some(history) = &mut self.history {
            history.record_edit(place, Some(before), step);
        }
        if let Some(kind) = self.kinds.get_mut(id.index()) {
            *kind = RecordKind::from_record(&record);
        }
        let statement = live_statement_mut(&mut self.statements, self.stamp, id);
        statement.set_text(place, record);
        // A statement that is not in the file stays inserted, whoever edits it.
        statement.change = match statement.change {
            StatementChange::Inserted(_) => StatementChange::Inserted(step),
            _ => StatementChange::Edited(step),
        };
    }

    /// Removes a live statement from the program. It is kept with a mark, also if a step inserted it, so that the
    /// report can show it.
    pub(crate) fn delete_statement(&mut self, id: StatementId, step: StepId) {
        let statement = live_statement_mut(&mut self.statements, self.stamp, id);
        self.step_edits.record_deletion(&statement.record, statement.change, step);
        statement.change = StatementChange::Deleted(step);
    }

    /// Inserts new statements at places of this program as it is before the call. Statements behind them get new
    /// ids. Insertions at the same place keep their order.
    pub(crate) fn insert_statements(
        &mut self,
        mut new: Vec<(InsertionPoint, Vec<u8>, Record)>,
        step: StepId,
    ) {
        for (at, _, _) in &new {
            at.stamp().assert_belongs_to(self.stamp);
            debug_assert!(*at <= self.end(), "{at:?} is behind the end of the program");
        }
        if new.is_empty() {
            return;
        }
        new.iter().for_each(|(_, _, record)| self.step_edits.record_insertion(record));
        // A stable sort keeps the order of insertions at the same place. One pass then merges both lists.
        new.sort_by_key(|(at, _, _)| *at);
        let mut merged = Vec::with_capacity(self.statements.len() + new.len());
        let mut new = new.into_iter().peekable();
        let old = std::mem::take(&mut self.statements);
        let end = old.last().map_or(0, |last| last.origin.end);
        for (index, statement) in old.into_iter().enumerate() {
            while let Some((_, text, record)) = new.next_if(|(at, _, _)| at.index() <= index) {
                // The origin is an empty span at the following statement, so that findings can point at a
                // place in the file.
                let origin = Span { start: statement.origin.start, end: statement.origin.start };
                let text = self.store_inserted_text(&text, step);
                merged.push(Statement::new(record, text, origin, StatementChange::Inserted(step)));
            }
            merged.push(statement);
        }
        for (_, text, record) in new {
            let text = self.store_inserted_text(&text, step);
            let origin = Span { start: end, end };
            merged.push(Statement::new(record, text, origin, StatementChange::Inserted(step)));
        }
        self.kinds.clear();
        self.kinds.extend(merged.iter().map(|statement| RecordKind::from_record(&statement.record)));
        self.statements = merged;
        self.stamp = ProgramStamp::new();
    }
}

/// Returns a live statement for a change. [`ProgramEditor`](crate::write::ProgramEditor) refuses edits of deleted
/// statements before.
// As in `Program::statement`: every id was made for a statement.
#[allow(clippy::indexing_slicing)]
fn live_statement_mut(statements: &mut [Statement], stamp: ProgramStamp, id: StatementId) -> &mut Statement {
    id.stamp().assert_belongs_to(stamp);
    let statement = &mut statements[id.index()];
    debug_assert!(statement.is_live(), "a deleted statement cannot be changed");
    statement
}
