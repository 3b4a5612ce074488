//! This module is the gate through which transforms change a program.
//!
//! An edit makes a text, reads it back with the parser, and puts text and record in place together, signed
//! with the step. So a record always has the meaning of its text, and a simulation or a check after a step
//! sees what will be written.

use super::asked_numbers::find_wrong_number;
use super::file_style::FileStyle;
use super::line_columns::fit_lines;
use super::number_patch::NumberPatcher;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::parse::{self, StatementNumbers};
use crate::program::{
    InsertionPoint, Program, Record, Statement, StatementChange, StatementField, StatementId,
    StatementSyntax, StepId,
};
use std::ops::Range;

/// Edits one program for one recipe step.
///
/// Statements are addressed by the ids that the program gives. All ids stay valid until
/// [`ProgramEditor::finish`]: a deleted statement keeps its id, and inserted statements join the program only in
/// `finish`. An edit of a statement that this step or an earlier one has deleted is an error
/// ([`codes::NO_SUCH_STATEMENT`]). So is an edit at a place that the program does not have.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::{Record, StepId};
/// use clsmith::source::Source;
/// use clsmith::write::ProgramEditor;
///
/// let source = Source::new("part.cls", b"RAPID\r\nGOTO/ 1., 2., 3.\r\nCOOLNT/ON\r\n".to_vec())?;
/// let program = parse(&source, None).program;
/// let goto = program.live_statements().find(|(_, statement)| matches!(statement.record(), Record::Goto(_)));
/// let (goto, _) = goto.expect("there is a GOTO");
/// let mut editor = ProgramEditor::new(program, StepId(0));
/// editor.set_numbers(goto, &[(2, 3.25)])?;
/// editor.insert_after(goto, b"DELAY/2")?;
/// let program = editor.finish()?;
/// assert_eq!(program.to_bytes(), b"RAPID\r\nGOTO/ 1., 2., 3.25\r\nDELAY/2\r\nCOOLNT/ON\r\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ProgramEditor {
    program: Program,
    step: StepId,
    style: FileStyle,
    inserted: Vec<(InsertionPoint, Vec<u8>, Record)>,
    patcher: NumberPatcher,
}

impl ProgramEditor {
    /// Opens the gate.
    pub fn new(program: Program, step: StepId) -> Self {
        let style = FileStyle::from_program(&program);
        Self { program, step, style, inserted: Vec::new(), patcher: NumberPatcher::default() }
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
    /// Returns an error if the statement is deleted, if it has no number with such an index, or if the patched
    /// text cannot be read back, for example because a value is too large to print.
    pub fn set_numbers(&mut self, id: StatementId, edits: &[(usize, f64)]) -> Result<(), Failure> {
        let mut patcher = std::mem::take(&mut self.patcher);
        let patched = self.patch_statement(id, &mut patcher, |_, _, into| into.extend_from_slice(edits));
        let put = patched.map(|record| {
            if let Some(record) = record {
                self.put_read_text(id, &patcher.out, record);
            }
        });
        self.patcher = patcher;
        put
    }

    /// Works out the text of a statement with other numbers, and leaves it in the patcher. `edit` gets the record and
    /// its numbers, and adds the edits. Returns the record of the new text, or `None` if nothing changes.
    ///
    /// # Errors
    /// Returns the errors of [`ProgramEditor::set_numbers`].
    pub(super) fn patch_statement(
        &self,
        id: StatementId,
        patcher: &mut NumberPatcher,
        edit: impl FnOnce(&Record, &StatementNumbers, &mut Vec<(usize, f64)>),
    ) -> Result<Option<Record>, Failure> {
        let statement = self.live_statement(id)?;
        let text = self.program.statement_text(statement);
        patcher.numbers.read(statement.record(), text);
        patcher.edits.clear();
        edit(statement.record(), &patcher.numbers, &mut patcher.edits);
        if let Some((_, value)) = patcher.edits.iter().find(|(_, value)| !value.is_finite()) {
            let message = format!("the step would write the value {value}, which no CL number can be");
            return Err(self.unwritable_error(id, &message));
        }
        match patcher.patch(text, &self.style) {
            Ok(true) => {
                let record = self.read_back(id.before(), &patcher.out, &mut patcher.numbers.spare_fields)?;
                let before = &patcher.numbers.places;
                match find_wrong_number(before, &patcher.edits, &record, &patcher.out) {
                    Some(wrong) => Err(self.wrong_number_error(id, wrong, &patcher.out)),
                    None => Ok(Some(record)),
                }
            }
            Ok(false) => Ok(None),
            Err(missing) => {
                let message =
                    format!("the step would change number {} of a statement that has none", missing + 1);
                Err(self.unwritable_error(id, &message))
            }
        }
    }

    /// Puts a text that was read back in place.
    pub(super) fn put_read_text(&mut self, id: StatementId, text: &[u8], record: Record) {
        self.program.replace_statement(id, text, record, self.step);
    }

    /// Replaces parts of a statement's text. `parts` are places in it with their new bytes, in order and
    /// without overlap.
    ///
    /// # Errors
    /// Returns an error if the statement is deleted, if a part is no place in its text, or if the new text cannot
    /// be read back.
    pub fn replace_parts(&mut self, id: StatementId, parts: &[(Range<usize>, &[u8])]) -> Result<(), Failure> {
        let text = self.program.statement_text(self.live_statement(id)?);
        let mut out = Vec::with_capacity(text.len() + 16);
        let mut copied = 0;
        for (at, bytes) in parts {
            let Some(kept) = text.get(copied..at.start).filter(|_| text.get(at.clone()).is_some()) else {
                let message =
                    format!("the step would replace the bytes {at:?} of a text that has no such part");
                return Err(self.unwritable_error(id, &message));
            };
            out.extend_from_slice(kept);
            out.extend_from_slice(bytes);
            copied = at.end;
        }
        out.extend_from_slice(text.get(copied..).unwrap_or_default());
        self.set_text(id, &out)
    }

    /// Gives a statement a new text with its line end, in the columns of the old one.
    ///
    /// # Errors
    /// Returns an error if the statement is deleted, or if the text is not one well-formed statement.
    pub fn set_text(&mut self, id: StatementId, text: &[u8]) -> Result<(), Failure> {
        self.put_text(id, text.to_vec())
    }

    fn put_text(&mut self, id: StatementId, text: Vec<u8>) -> Result<(), Failure> {
        let old = self.program.statement_text(self.live_statement(id)?);
        let text = fit_lines(old, text, self.style.full_column);
        let record = self.read_back(id.before(), &text, &mut Vec::new())?;
        self.put_read_text(id, &text, record);
        Ok(())
    }

    /// Deletes a statement.
    ///
    /// # Errors
    /// Returns an error if the statement is deleted already.
    pub fn delete_statement(&mut self, id: StatementId) -> Result<(), Failure> {
        self.live_statement(id)?;
        self.program.delete_statement(id, self.step);
        Ok(())
    }

    /// Returns whether an earlier edit of the running step inserted a statement.
    pub fn is_own_insertion(&self, id: StatementId) -> bool {
        matches!(self.program.statement(id).change(), StatementChange::Inserted(by) if by == self.step)
    }

    /// Inserts a statement at a place. `text` needs no line end; it gets that of the file. Insertions at the same
    /// place keep their order.
    ///
    /// # Errors
    /// Returns an error if the program has no such place, or if the text is not one well-formed statement.
    pub fn insert(&mut self, at: InsertionPoint, text: &[u8]) -> Result<(), Failure> {
        if at > self.program.end() {
            let message = format!("the step puts a statement in at place {}", at.index());
            return Err(self.missing_error(&message));
        }
        let text = [strip_line_end(text), self.style.line_end.as_bytes()].concat();
        let text = fit_lines(b"", text, self.style.full_column);
        let record = self.read_back(at, &text, &mut Vec::new())?;
        self.inserted.push((at, text, record));
        Ok(())
    }

    /// Inserts a statement before another one, which may be deleted: its place is still known.
    ///
    /// # Errors
    /// Returns the errors of [`ProgramEditor::insert`].
    pub fn insert_before(&mut self, id: StatementId, text: &[u8]) -> Result<(), Failure> {
        self.insert(id.before(), text)
    }

    /// Inserts a statement after another one, which may be deleted.
    ///
    /// # Errors
    /// Returns the errors of [`ProgramEditor::insert`].
    pub fn insert_after(&mut self, id: StatementId, text: &[u8]) -> Result<(), Failure> {
        self.insert(id.after(), text)
    }

    /// Closes the gate and returns the program with all edits. Statements behind an insertion get new ids.
    ///
    /// # Errors
    /// Returns the errors of [`ProgramEditor::set_text`]: a last line without line end gets one if something
    /// is inserted after it.
    pub fn finish(mut self) -> Result<Program, Failure> {
        let end = self.program.end();
        let last = self
            .program
            .live_statements()
            .next_back()
            .map(|(id, statement)| (id, self.program.statement_text(statement)));
        if let Some((last, text)) = last.filter(|(_, text)| !text.ends_with(b"\n") && !text.ends_with(b"\r"))
            && let Some((_, new, _)) = self.inserted.iter_mut().rev().find(|(at, _, _)| *at == end)
        {
            // The old last line gets a line end, and the new last line has none, as the file had it.
            new.truncate(strip_line_end(new).len());
            let closed = [text, self.style.line_end.as_bytes()].concat();
            self.set_text(last, &closed)?;
        }
        self.program.insert_statements(self.inserted, self.step);
        Ok(self.program)
    }

    /// Returns a statement for an edit, and makes an error of one that is not there.
    fn live_statement(&self, id: StatementId) -> Result<&Statement, Failure> {
        if !self.program.contains(id) {
            return Err(self.missing_error(&format!("the step edits statement {}", id.index())));
        }
        let statement = self.program.statement(id);
        let StatementChange::Deleted(by) = statement.change() else { return Ok(statement) };
        let message = match by == self.step {
            true => "the step edits a statement that it has taken out",
            false => "the step edits a statement that an earlier step has taken out",
        };
        let error = Diagnostic::new(codes::NO_SUCH_STATEMENT, message);
        Err(error.with_label(self.program.source(), statement.origin(), "this statement").into())
    }

    /// Makes the error for a place that the program does not have.
    fn missing_error(&self, message: &str) -> Failure {
        let count = self.program.statements().len();
        let message = format!("{message}, but the program has {count} statements");
        Diagnostic::new(codes::NO_SUCH_STATEMENT, message).into()
    }

    /// Reads a text back; makes an error of a text that is not one statement. `spare` is memory for its fields.
    fn read_back(
        &self,
        at: InsertionPoint,
        text: &[u8],
        spare: &mut Vec<StatementField>,
    ) -> Result<Record, Failure> {
        let problem = match parse::read_whole_record_in(text, self.program.vocabulary(), spare) {
            Ok(record) => return Ok(record),
            Err(problem) => problem,
        };
        let shown = String::from_utf8_lossy(text.trim_ascii()).into_owned();
        let message =
            format!("the step would write `{shown}`, which is no CL statement: {}", problem.problem);
        Err(match self.program.statement_behind(at) {
            Some(id) => self.unwritable_error(id, &message),
            None => Diagnostic::new(codes::UNREADABLE_EDIT, message).into(),
        })
    }

    /// Makes the error for a text whose numbers are not those that the step asked for.
    fn wrong_number_error(&self, id: StatementId, number: usize, text: &[u8]) -> Failure {
        let shown = String::from_utf8_lossy(text.trim_ascii()).into_owned();
        let message = format!(
            "the step would write `{shown}`, whose number {} does not read back as what the step asked for",
            number + 1
        );
        self.unwritable_error(id, &message)
    }

    /// Makes the error for a text that cannot be written, with the place of its statement.
    fn unwritable_error(&self, id: StatementId, message: &str) -> Failure {
        let origin = self.program.statement(id).origin();
        let error = Diagnostic::new(codes::UNREADABLE_EDIT, message);
        error.with_label(self.program.source(), origin, "for this statement").into()
    }
}

/// Returns the syntax of a statement's text, for transforms that examine words.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::source::Source;
/// use clsmith::write::statement_syntax;
///
/// let program = parse(&Source::new("part.cls", b"SPINDL/RPM,4500,CLW\n".to_vec())?, None).program;
/// let spindle = program.statement_ids().next().expect("there is a statement");
/// let syntax = statement_syntax(&program, spindle);
/// assert_eq!(syntax.major_word(), "SPINDL");
/// assert_eq!(syntax.word_at(2).as_deref(), Some("CLW"));
/// assert_eq!(syntax.number_at(1), Some(4500.0));
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
pub fn statement_syntax(program: &Program, id: StatementId) -> StatementSyntax<'_> {
    parse::syntax(program.statement_text(program.statement(id)))
}

/// Returns a text without its line end.
fn strip_line_end(text: &[u8]) -> &[u8] {
    let end = text.iter().rposition(|byte| !matches!(byte, b'\n' | b'\r')).map_or(0, |last| last + 1);
    text.get(..end).unwrap_or_default()
}
