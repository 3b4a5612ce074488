//! The gate through which transforms change a program.
//!
//! An edit makes a text, reads it back with the parser, and puts both in place, signed with the step. So a record always
//! says what its text says, and what simulation or checks see after a step is what will be written.

use super::file_style::FileStyle;
use super::number_patch;
use crate::diagnostic::{Diagnostic, codes};
use crate::parse;
use crate::program::{Program, Record, StatementSyntax, StepId};
use std::ops::Range;

/// Edits one program on behalf of one recipe step.
#[derive(Debug)]
pub struct ProgramEditor {
    program: Program,
    step: StepId,
    style: FileStyle,
    inserted: Vec<(usize, Vec<u8>, Record)>,
}

impl ProgramEditor {
    /// Opens the gate. Indices of statements stay valid until [`ProgramEditor::finish`].
    pub fn new(program: Program, step: StepId) -> Self {
        let style = FileStyle::from_program(&program);
        Self { program, step, style, inserted: Vec::new() }
    }

    /// The program with the edits made so far (insertions come with [`ProgramEditor::finish`]).
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The file's style.
    pub fn style(&self) -> &FileStyle {
        &self.style
    }

    /// Lets changed lengths and feeds have more decimals than their own, where a step needs them (see [`FileStyle::finer`]).
    pub fn set_extra_decimals(&mut self, decimals: usize) {
        self.style.finer = decimals;
    }

    /// Gives numbers of a statement new values: pairs of the number's index and its value.
    ///
    /// # Errors
    /// When the patched text cannot be read back (a value too large to print, say).
    pub fn set_numbers(&mut self, index: usize, edits: &[(usize, f64)]) -> Result<(), Box<Diagnostic>> {
        let Some(statement) = self.program.statement(index) else { return Ok(()) };
        let text = self.program.statement_text(statement);
        if let Some((_, value)) = edits.iter().find(|(_, value)| !value.is_finite()) {
            let message = format!("the step would write the value {value}, which no CL number can be");
            return Err(self.unwritable_error(index, &message));
        }
        match number_patch::patch_numbers(text, statement.record(), edits, &self.style) {
            Some(patched) => self.set_text(index, &patched),
            None => Ok(()),
        }
    }

    /// Replaces parts of a statement's text; `parts` are places in it with their new bytes, in order, not overlapping.
    ///
    /// # Errors
    /// When the new text cannot be read back.
    pub fn replace_parts(
        &mut self,
        index: usize,
        parts: &[(Range<usize>, &[u8])],
    ) -> Result<(), Box<Diagnostic>> {
        let Some(statement) = self.program.statement(index) else { return Ok(()) };
        let text = self.program.statement_text(statement);
        let mut out = Vec::with_capacity(text.len() + 16);
        let mut copied = 0;
        for (at, bytes) in parts {
            out.extend_from_slice(text.get(copied..at.start).unwrap_or_default());
            out.extend_from_slice(bytes);
            copied = at.end;
        }
        out.extend_from_slice(text.get(copied..).unwrap_or_default());
        self.set_text(index, &out)
    }

    /// Gives a statement a new text, line end included.
    ///
    /// # Errors
    /// When it is not one well-formed statement.
    pub fn set_text(&mut self, index: usize, text: &[u8]) -> Result<(), Box<Diagnostic>> {
        let record = self.read_back(index, text)?;
        self.program.replace_statement(index, text, record, self.step);
        Ok(())
    }

    /// Takes a statement out.
    pub fn delete_statement(&mut self, index: usize) {
        self.program.delete_statement(index, self.step);
    }

    /// Puts a statement in before another (the count of statements for the end). `text` needs no line end; it gets the
    /// file's.
    ///
    /// # Errors
    /// When it is not one well-formed statement.
    pub fn insert_before(&mut self, index: usize, text: &[u8]) -> Result<(), Box<Diagnostic>> {
        let text = [strip_line_end(text), self.style.line_end.as_bytes()].concat();
        let record = self.read_back(index, &text)?;
        self.inserted.push((index, text, record));
        Ok(())
    }

    /// Puts a statement in after another.
    ///
    /// # Errors
    /// When it is not one well-formed statement.
    pub fn insert_after(&mut self, index: usize, text: &[u8]) -> Result<(), Box<Diagnostic>> {
        self.insert_before(index + 1, text)
    }

    /// Closes the gate.
    ///
    /// # Errors
    /// As [`ProgramEditor::set_text`]: a last line without line end gets one when something is put after it.
    pub fn finish(mut self) -> Result<Program, Box<Diagnostic>> {
        let end = self.program.statements().len();
        let last = self
            .program
            .live_statements()
            .next_back()
            .map(|(index, statement)| (index, self.program.statement_text(statement)));
        if let Some((last, text)) = last.filter(|(_, text)| !text.ends_with(b"\n") && !text.ends_with(b"\r"))
            && let Some((_, new, _)) = self.inserted.iter_mut().rev().find(|(index, _, _)| *index == end)
        {
            new.truncate(strip_line_end(new).len());
            let closed = [text, self.style.line_end.as_bytes()].concat();
            self.set_text(last, &closed)?;
        }
        self.program.insert_statements(self.inserted, self.step);
        Ok(self.program)
    }

    fn read_back(&self, index: usize, text: &[u8]) -> Result<Record, Box<Diagnostic>> {
        let problem = match parse::read_whole_record(text) {
            Ok(record) => return Ok(record),
            Err(problem) => problem,
        };
        let shown = String::from_utf8_lossy(text.trim_ascii()).into_owned();
        let message =
            format!("the step would write `{shown}`, which is no CL statement: {}", problem.problem);
        Err(self.unwritable_error(index, &message))
    }

    fn unwritable_error(&self, index: usize, message: &str) -> Box<Diagnostic> {
        let mut diagnostic = Diagnostic::new(codes::UNREADABLE_EDIT, message);
        if let Some(statement) = self.program.statement(index) {
            diagnostic =
                diagnostic.with_label(self.program.source(), statement.origin(), "for this statement");
        }
        Box::new(diagnostic)
    }
}

/// A statement's text taken apart, with its index and program: for transforms that look at words.
pub fn statement_syntax(program: &Program, index: usize) -> Option<StatementSyntax<'_>> {
    program.statement(index).map(|statement| parse::syntax(program.statement_text(statement)))
}

fn strip_line_end(text: &[u8]) -> &[u8] {
    let end = text.iter().rposition(|byte| !matches!(byte, b'\n' | b'\r')).map_or(0, |last| last + 1);
    text.get(..end).unwrap_or_default()
}
