//! This module holds one statement of a program: its record, the location of its text, and the step that
//! changed it.

use super::record::Record;
use crate::source::Span;

/// The recipe step that changed a statement: its index in the recipe's list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StepId(pub u16);

/// The change of a statement since it was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StatementChange {
    /// It is unchanged and is written byte for byte.
    Untouched,
    /// Its text was changed; the value is the last step that did.
    Edited(StepId),
    /// It was not in the file.
    Inserted(StepId),
    /// It is not written. It is kept so that reports can show what was removed and by which step.
    Deleted(StepId),
}

/// The location of a statement's text: in the source, or among the texts of edits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TextLocation {
    /// The offset in the source. From the length of the source on, it is an offset in the texts of edits, so
    /// it may need more than 32 bits.
    pub(crate) start: u64,
    /// The number of bytes.
    pub(crate) length: u32,
}

/// A statement. Its text is the truth; the record is read from it and never changes without it. A file has
/// one for each line, so a test holds its size to at most 80 bytes.
#[derive(Debug, Clone)]
pub struct Statement {
    pub(super) record: Record,
    pub(super) origin: Span,
    // The two parts of its text's location, apart: together they would take four bytes more.
    text_start: u64,
    text_length: u32,
    pub(super) change: StatementChange,
}

impl Statement {
    /// Makes a statement whose text stands at a location.
    #[inline]
    pub(super) fn new(record: Record, text: TextLocation, origin: Span, change: StatementChange) -> Self {
        Self { record, origin, text_start: text.start, text_length: text.length, change }
    }

    /// Returns the location of its text.
    #[inline]
    pub(super) fn text(&self) -> TextLocation {
        TextLocation { start: self.text_start, length: self.text_length }
    }

    /// Gives it the text at another location, with the record that was read from it.
    pub(super) fn set_text(&mut self, text: TextLocation, record: Record) {
        self.record = record;
        (self.text_start, self.text_length) = (text.start, text.length);
    }

    /// Returns the meaning.
    #[inline]
    pub fn record(&self) -> &Record {
        &self.record
    }

    /// Returns its bytes in the source; for an inserted statement, the empty span at which it was inserted.
    #[inline]
    pub fn origin(&self) -> Span {
        self.origin
    }

    /// Returns the change.
    #[inline]
    pub fn change(&self) -> StatementChange {
        self.change
    }

    /// Returns whether it is still part of the program.
    #[inline]
    pub fn is_live(&self) -> bool {
        !matches!(self.change, StatementChange::Deleted(_))
    }

    /// Returns the step that changed it.
    pub fn edited_by(&self) -> Option<StepId> {
        match self.change {
            StatementChange::Untouched => None,
            StatementChange::Edited(step)
            | StatementChange::Inserted(step)
            | StatementChange::Deleted(step) => Some(step),
        }
    }
}
