//! This module holds a program: statements over untouched text, and the views of them.
//!
//! Text is the truth and records are a view of it. An edit makes text, and the record is read from that text
//! by the same parser. So a simulation after a step sees exactly what will be written, including rounding.
//! Fresh from the parser, the spans of the statements tile the file. Deleted statements stay, with a mark,
//! until the program is dropped, so the report needs no log.
//!
//! Motions ([`motion`]) and operations ([`operation`]) are views that are computed and not stored.

mod dialect;
mod edit;
pub mod geometry;
mod history;
pub mod motion;
mod motion_class;
pub mod operation;
mod program_stamp;
mod provenance_comments;
pub mod record;
mod record_kind;
mod shop_vocabulary;
mod statement;
mod statement_id;
mod statements;
mod step_edits;
mod syntax;
mod turning;
mod units;

pub(crate) use dialect::DialectDetector;
pub use dialect::{ArcRule, Dialect};
pub use history::StatementEdit;
pub use motion_class::MotionClass;
pub(crate) use provenance_comments::OWN_WORD;
pub use provenance_comments::ProvenanceComment;
pub use record::{NumberRole, Record};
pub use record_kind::RecordKind;
pub use shop_vocabulary::{ShopVocabulary, ShopWordMeaning};
pub use statement::{Statement, StatementChange, StepId};
pub use statement_id::{InsertionPoint, StatementId, StatementRange};
pub use step_edits::StepEdits;
pub use syntax::{FieldGroup, FieldKind, StatementField, StatementKind, StatementSyntax};
pub(crate) use syntax::{fold_text, join_broken};
pub use turning::TurningPlane;
pub use units::{Feed, FeedUnit, LengthUnit};

use crate::source::{Source, Span};
use statement::TextLocation;
use std::sync::Arc;

/// A CL program.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::{Dialect, LengthUnit};
/// use clsmith::source::Source;
///
/// let text = b"TOOL PATH/A,TOOL,T1\nFEDRAT/MMPM,1200.\nGOTO/1.,2.,3.\nEND-OF-PATH\n";
/// let source = Source::new("part.cls", text.to_vec())?;
/// let program = parse(&source, None).program;
/// assert_eq!(program.dialect(), Dialect::Nx);
/// assert_eq!(program.feed_length_unit(), Some(LengthUnit::Mm));
/// assert_eq!(program.to_bytes(), source.bytes());
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone)]
pub struct Program {
    source: Arc<Source>,
    edits: Vec<u8>,
    statements: Vec<Statement>,
    /// The kind of each statement's record.
    kinds: Vec<RecordKind>,
    dialect: Dialect,
    history: Option<Box<history::EditHistory>>,
    step_edits: step_edits::StepEditCounts,
    stamp: program_stamp::ProgramStamp,
    vocabulary: Arc<ShopVocabulary>,
}

impl Program {
    /// Makes an empty program over a source; the parser fills it.
    pub(crate) fn new(source: Arc<Source>) -> Self {
        Self {
            source,
            edits: Vec::new(),
            statements: Vec::new(),
            kinds: Vec::new(),
            dialect: Dialect::Iso,
            history: None,
            step_edits: step_edits::StepEditCounts::default(),
            stamp: program_stamp::ProgramStamp::new(),
            vocabulary: Arc::default(),
        }
    }

    pub(crate) fn set_dialect(&mut self, dialect: Dialect) {
        self.dialect = dialect;
    }

    /// Gives statements the meanings of a shop's own words; `read` returns the meaning of a statement that
    /// begins with one.
    pub(crate) fn set_vocabulary(
        &mut self,
        vocabulary: &Arc<ShopVocabulary>,
        mut read: impl FnMut(&[u8], Span) -> Option<Record>,
    ) {
        self.vocabulary = Arc::clone(vocabulary);
        for index in 0..self.statements.len() {
            let Some(statement) = self.statements.get(index) else { break };
            let text = self.text_at(statement.text());
            if statement.record.may_be_shop_word()
                && let Some(record) = read(text, statement.origin)
                && let Some(statement) = self.statements.get_mut(index)
                && let Some(kind) = self.kinds.get_mut(index)
            {
                *kind = RecordKind::from_record(&record);
                statement.record = record;
            }
        }
    }

    /// Returns the words of the shop with which the program was read.
    pub fn vocabulary(&self) -> &Arc<ShopVocabulary> {
        &self.vocabulary
    }

    pub(crate) fn reserve(&mut self, statements: usize) {
        self.statements.reserve(statements);
        self.kinds.reserve(statements);
    }

    /// Adds a statement as the parser read it.
    #[inline]
    pub(crate) fn push(&mut self, record: Record, span: Span) {
        debug_assert!(span.end as usize <= self.source.bytes().len(), "{span:?} is no place in the source");
        let text = TextLocation { start: u64::from(span.start), length: span.len() as u32 };
        self.kinds.push(RecordKind::from_record(&record));
        self.statements.push(Statement::new(record, text, span, StatementChange::Untouched));
    }

    /// Adds the statements of a program that was read from a later part of the same source.
    pub(crate) fn append(&mut self, behind: Self) {
        debug_assert!(behind.edits.is_empty(), "only what was just read is put together");
        self.statements.extend(behind.statements);
        self.kinds.extend(behind.kinds);
    }

    /// Returns the file from which the program was read.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Returns the dialect: detected, or forced when the program was parsed.
    #[inline]
    pub fn dialect(&self) -> Dialect {
        self.dialect
    }

    /// Returns the current text of a statement with its line end.
    #[inline]
    pub fn statement_text(&self, statement: &Statement) -> &[u8] {
        self.text_at(statement.text())
    }

    /// Returns the text at a location.
    #[inline]
    fn text_at(&self, place: TextLocation) -> &[u8] {
        let start = place.start as usize;
        let length = place.length as usize;
        let source = self.source.bytes();
        // Offsets from the source's length on are in the texts of edits.
        let (bytes, start) = if start < source.len() {
            (source, start)
        } else {
            (self.edits.as_slice(), start - source.len())
        };
        let text = bytes.get(start..start + length);
        debug_assert!(text.is_some(), "texts are never taken out of the source or the edits");
        text.unwrap_or_default()
    }

    /// Returns the unit of lengths that the file states first, or `None` if it states none (NX and CATIA
    /// never do).
    pub fn stated_length_unit(&self) -> Option<LengthUnit> {
        self.live_statements_of(&[RecordKind::Structure]).find_map(|(_, statement)| {
            match statement.record() {
                Record::Units(units) => Some(*units),
                _ => None,
            }
        })
    }

    /// Returns the unit that the words of the feeds name (MMPM, IPM, ...), or `None` if no feed names one or
    /// they disagree.
    pub fn feed_length_unit(&self) -> Option<LengthUnit> {
        let mut found: Option<LengthUnit> = None;
        for (_, statement) in self.live_statements_of(&[RecordKind::Feed, RecordKind::Cycle]) {
            let feed = match statement.record() {
                Record::Feed(feed) => Some(*feed),
                Record::Cycle(cycle) => cycle.feed,
                _ => None,
            };
            // A feed in the file's own unit gives different results for the two defaults, and says nothing
            // about the unit.
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

    /// Returns the bytes of the whole program as it is now, piece by piece and in order. Untouched pieces are
    /// slices of the source, joined as far as they reach.
    pub fn byte_chunks(&self) -> impl Iterator<Item = &[u8]> {
        ProgramChunks { program: self, next: 0 }
    }

    /// Returns the bytes of the whole program as it is now.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.source.bytes().len());
        self.byte_chunks().for_each(|piece| bytes.extend_from_slice(piece));
        bytes
    }
}

/// An iterator over the program's bytes.
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
            // Untouched neighbours are one slice of the source, so that writing copies few large pieces.
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
        assert!(size_of::<Statement>() <= 80, "{}", size_of::<Statement>());
    }
}
