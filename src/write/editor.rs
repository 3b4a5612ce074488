//! This module is the gate through which transforms change a program.
//!
//! An edit makes a text, reads it back with the parser, and puts text and record in place together, signed
//! with the step. So a record always has the meaning of its text, and a simulation or a check after a step
//! sees what will be written.

use super::file_style::FileStyle;
use super::number_patch;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::parse;
use crate::program::{Program, Record, StatementSyntax, StepId};
use std::ops::Range;

/// Edits one program for one recipe step.
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

    /// Returns the program with the edits so far; insertions are made by [`ProgramEditor::finish`].
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// Returns the file's style.
    pub fn style(&self) -> &FileStyle {
        &self.style
    }

    /// Sets how many decimals changed lengths and feeds get beyond their own, if a step needs them (see
    /// [`FileStyle::finer`]).
    pub fn set_extra_decimals(&mut self, decimals: usize) {
        self.style.finer = decimals;
    }

    /// Gives numbers of a statement new values: pairs of the number's index and its value.
    ///
    /// # Errors
    /// Returns an error if the patched text cannot be read back, for example because a value is too large to
    /// print.
    pub fn set_numbers(&mut self, index: usize, edits: &[(usize, f64)]) -> Result<(), Failure> {
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

    /// Replaces parts of a statement's text. `parts` are places in it with their new bytes, in order and
    /// without overlap.
    ///
    /// # Errors
    /// Returns an error if the new text cannot be read back.
    pub fn replace_parts(&mut self, index: usize, parts: &[(Range<usize>, &[u8])]) -> Result<(), Failure> {
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

    /// Gives a statement a new text with its line end.
    ///
    /// # Errors
    /// Returns an error if the text is not one well-formed statement.
    pub fn set_text(&mut self, index: usize, text: &[u8]) -> Result<(), Failure> {
        let record = self.read_back(index, text)?;
        self.program.replace_statement(index, text, record, self.step);
        Ok(())
    }

    /// Deletes a statement.
    pub fn delete_statement(&mut self, index: usize) {
        self.program.delete_statement(index, self.step);
    }

    /// Inserts a statement before another one (before the count of statements for the end). `text` needs no
    /// line end; it gets that of the file.
    ///
    /// # Errors
    /// Returns an error if the text is not one well-formed statement.
    pub fn insert_before(&mut self, index: usize, text: &[u8]) -> Result<(), Failure> {
        let text = [strip_line_end(text), self.style.line_end.as_bytes()].concat();
        let record = self.read_back(index, &text)?;
        self.inserted.push((index, text, record));
        Ok(())
    }

    /// Inserts a statement after another one.
    ///
    /// # Errors
    /// Returns an error if the text is not one well-formed statement.
    pub fn insert_after(&mut self, index: usize, text: &[u8]) -> Result<(), Failure> {
        self.insert_before(index + 1, text)
    }

    /// Closes the gate and returns the program with all edits.
    ///
    /// # Errors
    /// Returns the errors of [`ProgramEditor::set_text`]: a last line without line end gets one if something
    /// is inserted after it.
    pub fn finish(mut self) -> Result<Program, Failure> {
        let end = self.program.statements().len();
        let last = self
            .program
            .live_statements()
            .next_back()
            .map(|(index, statement)| (index, self.program.statement_text(statement)));
        if let Some((last, text)) = last.filter(|(_, text)| !text.ends_with(b"\n") && !text.ends_with(b"\r"))
            && let Some((_, new, _)) = self.inserted.iter_mut().rev().find(|(index, _, _)| *index == end)
        {
            // The old last line gets a line end, and the new last line has none, as the file had it.
            new.truncate(strip_line_end(new).len());
            let closed = [text, self.style.line_end.as_bytes()].concat();
            self.set_text(last, &closed)?;
        }
        self.program.insert_statements(self.inserted, self.step);
        Ok(self.program)
    }

    /// Reads a text back; makes an error of a text that is not one statement.
    fn read_back(&self, index: usize, text: &[u8]) -> Result<Record, Failure> {
        let problem = match parse::read_whole_record(text) {
            Ok(record) => return Ok(record),
            Err(problem) => problem,
        };
        let shown = String::from_utf8_lossy(text.trim_ascii()).into_owned();
        let message =
            format!("the step would write `{shown}`, which is no CL statement: {}", problem.problem);
        Err(self.unwritable_error(index, &message))
    }

    /// Makes the error for a text that cannot be written, with the place of its statement.
    fn unwritable_error(&self, index: usize, message: &str) -> Failure {
        let mut diagnostic = Diagnostic::new(codes::UNREADABLE_EDIT, message);
        if let Some(statement) = self.program.statement(index) {
            diagnostic =
                diagnostic.with_label(self.program.source(), statement.origin(), "for this statement");
        }
        diagnostic.into()
    }
}

/// Returns the syntax of a statement's text, for transforms that examine words.
pub fn statement_syntax(program: &Program, index: usize) -> Option<StatementSyntax<'_>> {
    program.statement(index).map(|statement| parse::syntax(program.statement_text(statement)))
}

/// Returns a text without its line end.
fn strip_line_end(text: &[u8]) -> &[u8] {
    let end = text.iter().rposition(|byte| !matches!(byte, b'\n' | b'\r')).map_or(0, |last| last + 1);
    text.get(..end).unwrap_or_default()
}
