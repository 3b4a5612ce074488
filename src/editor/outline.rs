//! This module makes the outline of a program: operations, and in them the places where tools are loaded.

use super::program_view::ProgramView;
use crate::presentation::text_format::format_duration;
use crate::program::{Record, RecordKind, StatementId};
use crate::source::Span;

/// What an entry of an outline is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OutlineKind {
    /// An operation.
    Operation,
    /// The load of a tool.
    Tool,
}

/// An entry of the outline.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OutlineEntry {
    /// What it is.
    pub kind: OutlineKind,
    /// Its name, which is never empty.
    pub name: String,
    /// What else is known: the time of an operation.
    pub detail: String,
    /// All of its text.
    pub whole: Span,
    /// The statement that begins it.
    pub head: Span,
    /// What is in it.
    pub children: Vec<OutlineEntry>,
}

impl ProgramView {
    /// Returns the operations with the tools that are loaded in them. In a file that marks no operation, the tools
    /// stand alone.
    pub fn outline(&self) -> Vec<OutlineEntry> {
        let mut tools = self.list_tool_entries().into_iter().peekable();
        let mut found = Vec::new();
        for (operation, sums) in self.operations() {
            let (Some(start), Some(range)) = (operation.start, operation.statements) else { continue };
            let whole = Span { start: self.trimmed_span(start).start, end: self.origin(range.last()).end };
            // Tools in front of the first operation stand before it.
            while let Some(tool) = tools.next_if(|tool| tool.head.start < whole.start) {
                found.push(tool);
            }
            let mut children = Vec::new();
            while let Some(tool) = tools.next_if(|tool| tool.head.start < whole.end) {
                children.push(tool);
            }
            let last = children.len().saturating_sub(1);
            for at in 0..children.len() {
                let end =
                    children.get(at + 1).filter(|_| at < last).map_or(whole.end, |next| next.head.start);
                if let Some(child) = children.get_mut(at) {
                    child.whole.end = end;
                }
            }
            found.push(OutlineEntry {
                kind: OutlineKind::Operation,
                name: named(operation.name.clone(), "operation"),
                detail: format_duration(sums.seconds),
                whole,
                head: self.trimmed_span(start),
                children,
            });
        }
        found.extend(tools);
        self.close_lone_tools(&mut found);
        found
    }

    /// Returns the ranges of lines that may be folded, counted from 0: operations, and tools where there are none.
    pub fn foldings(&self) -> Vec<(u32, u32)> {
        let line = |offset: u32| self.program().source().line_column(offset).0 as u32 - 1;
        let mut found = Vec::new();
        let mut open = self.outline();
        while let Some(entry) = open.pop() {
            let (first, last) = (line(entry.head.start), line(entry.whole.end.saturating_sub(1)));
            if last > first {
                found.push((first, last));
            }
            open.extend(entry.children);
        }
        found.sort_unstable();
        found
    }

    fn list_tool_entries(&self) -> Vec<OutlineEntry> {
        let mut found = Vec::new();
        for (id, statement) in self.program().live_statements_of(&[RecordKind::Tool]) {
            let Record::ToolCall(call) = statement.record() else { continue };
            if !call.loads {
                continue;
            }
            let head = self.trimmed_span(id);
            let name = format!("tool {}", call.number);
            let detail = String::new();
            let whole = Span { start: head.start, end: self.origin(id).end };
            found.push(OutlineEntry {
                kind: OutlineKind::Tool,
                name,
                detail,
                whole,
                head,
                children: Vec::new(),
            });
        }
        found
    }

    /// Lets tools that stand in no operation reach to the next entry.
    fn close_lone_tools(&self, entries: &mut [OutlineEntry]) {
        let end = self.program().source().bytes().len() as u32;
        let starts: Vec<u32> = entries.iter().skip(1).map(|entry| entry.head.start).chain([end]).collect();
        for (entry, next) in entries.iter_mut().zip(starts) {
            if entry.kind == OutlineKind::Tool {
                entry.whole.end = next;
            }
        }
    }

    fn origin(&self, id: StatementId) -> Span {
        self.program().statement(id).origin()
    }

    /// Returns the bytes of a statement without the blanks and line ends around them.
    pub(super) fn trimmed_span(&self, id: StatementId) -> Span {
        let statement = self.program().statement(id);
        let text = self.program().statement_text(statement);
        let start = text.len() - text.trim_ascii_start().len();
        statement.origin().sub_span(start.min(text.trim_ascii_end().len()), text.trim_ascii_end().len())
    }
}

fn named(name: String, otherwise: &str) -> String {
    if name.trim().is_empty() { otherwise.to_owned() } else { name }
}
