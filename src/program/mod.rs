//! A program: statements over untouched text, and what can be seen in them.
//!
//! Text is the truth and records are a view over it. Fresh from the parser the statements' spans tile the file. Motions
//! ([`motion`]) and operations ([`operation`]) are views that are computed, not stored.

mod dialect;
mod edit;
pub mod geometry;
mod history;
pub mod motion;
pub mod motion_class;
pub mod operation;
mod provenance_comments;
pub mod record;
mod statement;
mod syntax;
pub mod units;

pub use dialect::{ArcRule, Dialect, DialectDetector};
pub use history::StatementEdit;
pub use motion_class::MotionClass;
pub use provenance_comments::{OWN_WORD, ProvenanceComment};
pub use record::{NumberRole, Record};
pub use statement::{Statement, StatementChange, StepId};
pub use syntax::{FieldGroup, FieldKind, StatementField, StatementKind, StatementSyntax, fold_text};
pub use units::{Feed, FeedUnit, LengthUnit};

use crate::source::{Source, Span};
use statement::TextLocation;
use std::sync::Arc;

/// A CL program.
#[derive(Debug, Clone)]
pub struct Program {
    source: Arc<Source>,
    edits: Vec<u8>,
    statements: Vec<Statement>,
    dialect: Dialect,
    history: Option<Box<history::EditHistory>>,
}

impl Program {
    /// An empty program over a source; the parser fills it.
    pub(crate) fn new(source: Arc<Source>) -> Self {
        Self { source, edits: Vec::new(), statements: Vec::new(), dialect: Dialect::Iso, history: None }
    }

    pub(crate) fn set_dialect(&mut self, dialect: Dialect) {
        self.dialect = dialect;
    }

    pub(crate) fn reserve(&mut self, statements: usize) {
        self.statements.reserve(statements);
    }

    /// Adds a statement as the parser read it.
    #[inline]
    pub(crate) fn push(&mut self, record: Record, span: Span) {
        let text = TextLocation { start: u64::from(span.start), length: span.len() as u32 };
        self.statements.push(Statement { record, text, origin: span, change: StatementChange::Untouched });
    }

    /// The file it was read from.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Its dialect: detected, or forced when it was parsed.
    pub fn dialect(&self) -> Dialect {
        self.dialect
    }

    /// All statements in order, deleted ones included (see [`Statement::is_live`]).
    pub fn statements(&self) -> &[Statement] {
        &self.statements
    }

    /// The statement of an index.
    pub fn statement(&self, index: usize) -> Option<&Statement> {
        self.statements.get(index)
    }

    /// The live statements with their indices.
    pub fn live_statements(&self) -> impl DoubleEndedIterator<Item = (usize, &Statement)> {
        self.statements.iter().enumerate().filter(|(_, statement)| statement.is_live())
    }

    /// The text of a statement as it stands now, line end included.
    pub fn statement_text(&self, statement: &Statement) -> &[u8] {
        self.text_at(statement.text)
    }

    fn text_at(&self, place: TextLocation) -> &[u8] {
        let start = place.start as usize;
        let length = place.length as usize;
        let source = self.source.bytes();
        let (bytes, start) = if start < source.len() {
            (source, start)
        } else {
            (self.edits.as_slice(), start - source.len())
        };
        bytes.get(start..start + length).unwrap_or_default()
    }

    /// The unit of lengths: what the file says first, `None` where it says nothing (NX and CATIA never do).
    pub fn stated_length_unit(&self) -> Option<LengthUnit> {
        self.live_statements().find_map(|(_, statement)| match statement.record() {
            Record::Units(units) => Some(*units),
            _ => None,
        })
    }

    /// The unit that the words of the feeds name (MMPM, IPM, ...); `None` where none does, or where they disagree.
    pub fn feed_length_unit(&self) -> Option<LengthUnit> {
        let mut found: Option<LengthUnit> = None;
        for (_, statement) in self.live_statements() {
            let feed = match statement.record() {
                Record::Feed(feed) => Some(*feed),
                Record::Cycle(cycle) => cycle.feed,
                _ => None,
            };
            // A feed in the file's own unit says nothing; the two defaults tell it from one that does.
            let Some(word) = feed.and_then(|feed| feed.unit) else { continue };
            let (mm, inch) = (word.length_unit(LengthUnit::Mm), word.length_unit(LengthUnit::Inch));
            match (found, mm) {
                _ if mm != inch => {}
                (Some(before), Some(unit)) if before != unit => return None,
                (_, unit) => found = unit.or(found),
            }
        }
        found
    }

    /// The bytes of the whole program as it stands, piece by piece, in order. Pieces that were not touched are slices of the
    /// source, joined as far as they reach.
    pub fn byte_chunks(&self) -> impl Iterator<Item = &[u8]> {
        ProgramChunks { program: self, next: 0 }
    }

    /// The bytes of the whole program as it stands.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.source.bytes().len());
        self.byte_chunks().for_each(|piece| bytes.extend_from_slice(piece));
        bytes
    }
}

struct ProgramChunks<'p> {
    program: &'p Program,
    next: usize,
}

impl<'p> Iterator for ProgramChunks<'p> {
    type Item = &'p [u8];

    fn next(&mut self) -> Option<&'p [u8]> {
        let statements = &self.program.statements;
        loop {
            let statement = statements.get(self.next)?;
            self.next += 1;
            if !statement.is_live() {
                continue;
            }
            if statement.change != StatementChange::Untouched {
                return Some(self.program.statement_text(statement));
            }
            let mut end = statement.origin.end;
            while let Some(next) = statements.get(self.next)
                && next.change == StatementChange::Untouched
                && next.origin.start == end
            {
                end = next.origin.end;
                self.next += 1;
            }
            return Some(self.program.source.slice(Span { start: statement.origin.start, end }));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_statement_stays_small() {
        assert!(size_of::<Record>() <= 56, "{}", size_of::<Record>());
        assert!(size_of::<Statement>() <= 88, "{}", size_of::<Statement>());
    }
}
