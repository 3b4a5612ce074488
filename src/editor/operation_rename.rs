//! This module renames operations.

use super::program_view::ProgramView;
use crate::program::Record;
use crate::source::Span;

impl ProgramView {
    /// Returns the place and the name of the operation that begins on a line.
    pub fn operation_name_place(&self, line: u32) -> Option<(Span, String)> {
        let id = self.statement_on_line(line)?;
        let statement = self.program().statement(id);
        let Record::OperationStart(names) = statement.record() else { return None };
        let span = statement.origin().sub_span(names.name.start, names.name.end);
        let name = std::str::from_utf8(self.program().source().slice(span)).ok()?;
        (!name.is_empty()).then(|| (span, name.to_owned()))
    }

    /// Returns all places of the name of the operation that begins on a line. Operations of one name, as a system makes
    /// them when it parts one, are renamed together.
    pub fn operation_name_places(&self, line: u32) -> Vec<Span> {
        let Some((_, name)) = self.operation_name_place(line) else { return Vec::new() };
        let starts = self.operations().filter_map(|(operation, _)| operation.start);
        let places = starts.filter_map(|start| self.operation_name_place(self.line_of_statement(start)));
        places.filter(|(_, found)| *found == name).map(|(span, _)| span).collect()
    }
}

/// Says why a name cannot be that of an operation, if it cannot.
pub fn refuse_operation_name(name: &str) -> Option<&'static str> {
    if name.trim().is_empty() {
        return Some("an operation needs a name");
    }
    if name.trim() != name {
        return Some("the name begins or ends with a blank");
    }
    let is_bad = |c: char| c.is_control() || matches!(c, ',' | '/' | '$');
    name.contains(is_bad).then_some("a name of an operation has no comma, no slash, no `$` and no line end")
}
