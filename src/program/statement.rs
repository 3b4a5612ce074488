//! One statement of a program: its record, where its text is, and who changed it.

use super::record::Record;
use crate::source::Span;

/// The recipe step that changed a statement (its index in the recipe's list).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StepId(pub u16);

/// What happened to a statement since it was read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StatementChange {
    /// Nothing: it is written byte for byte.
    Untouched,
    /// Its text was changed; the last step that did is named.
    Edited(StepId),
    /// It was not in the file.
    Inserted(StepId),
    /// It is not written. Kept so that reports can say what went and why.
    Deleted(StepId),
}

/// Where a statement's text is: in the source, or among the texts that edits made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct TextLocation {
    /// Offset in the source; from the source's length on, offset in the edits (40 bits would do, a file has 32).
    pub(crate) start: u64,
    /// Bytes.
    pub(crate) length: u32,
}

/// A statement. Its text is the truth; the record is read from it and never changes without it.
#[derive(Debug, Clone)]
pub struct Statement {
    pub(super) record: Record,
    pub(super) text: TextLocation,
    pub(super) origin: Span,
    pub(super) change: StatementChange,
}

impl Statement {
    /// What it means.
    pub fn record(&self) -> &Record {
        &self.record
    }

    /// Its bytes in the source; for an inserted statement the empty place it was inserted at.
    pub fn origin(&self) -> Span {
        self.origin
    }

    /// What happened to it.
    pub fn change(&self) -> StatementChange {
        self.change
    }

    /// Whether it is still part of the program.
    pub fn is_live(&self) -> bool {
        !matches!(self.change, StatementChange::Deleted(_))
    }

    /// The step that changed it.
    pub fn edited_by(&self) -> Option<StepId> {
        match self.change {
            StatementChange::Untouched => None,
            StatementChange::Edited(step)
            | StatementChange::Inserted(step)
            | StatementChange::Deleted(step) => Some(step),
        }
    }
}
