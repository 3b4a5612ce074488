//! This module finds places that belong to a line: where its tool was loaded, and the feeds before and behind it.

use super::program_view::ProgramView;
use crate::program::operation::tool_name;
use crate::program::{Record, RecordKind, StatementId};
use crate::source::Span;

impl ProgramView {
    /// Returns the statement that loaded the tool in force on a line, or else that names it: in NX the start of an
    /// operation.
    pub fn tool_load(&self, line: u32) -> Option<Span> {
        let here = self.statement_on_line(line)?;
        let names_tool = |id: StatementId| {
            let statement = self.program().statement(id);
            match statement.record() {
                Record::ToolCall(call) => Some(call.loads),
                Record::OperationStart(_) => tool_name(self.program(), statement).map(|_| false),
                _ => None,
            }
        };
        let kinds = [RecordKind::Tool, RecordKind::Structure];
        let (mut loaded, mut named) = (None, None);
        for (id, _) in self.program().live_statements_of(&kinds).take_while(|(id, _)| *id <= here) {
            match names_tool(id) {
                Some(true) => loaded = Some(id),
                Some(false) => named = Some(id),
                None => {}
            }
        }
        // Post-processors load what LOAD/TOOL says; a name alone describes the tool.
        loaded.or(named).map(|id| self.trimmed_span(id))
    }

    /// Returns the next feed behind a line.
    pub fn next_feed(&self, line: u32) -> Option<Span> {
        let here = self.statement_on_line(line)?;
        let mut feeds = self.program().live_statements_of(&[RecordKind::Feed]);
        feeds.find(|(id, _)| *id > here).map(|(id, _)| self.trimmed_span(id))
    }

    /// Returns the last feed in front of a line.
    pub fn last_feed(&self, line: u32) -> Option<Span> {
        let here = self.statement_on_line(line)?;
        let feeds = self.program().live_statements_of(&[RecordKind::Feed]);
        feeds.take_while(|(id, _)| *id < here).last().map(|(id, _)| self.trimmed_span(id))
    }
}
