//! This module defines the names of statements and the places between them.
//!
//! Only a [`Program`](super::Program) makes them: its iterators, its motions and its operations return ids of
//! statements that it has. So no caller calculates with bare numbers, and an id always leads to a statement.
//!
//! An id is valid for the program that made it and for its clones, also after statements are edited or deleted.
//! Only an insertion gives statements new ids, because ids are positions: 4 bytes each, in the order of the
//! file. [`ProgramEditor`](crate::write::ProgramEditor) makes all insertions of a step at once in `finish`, so
//! within a step every id stays valid. Builds with debug assertions check each id against its program
//! ([`ProgramStamp`]).

use super::program_stamp::ProgramStamp;
use std::cmp::Ordering;
use std::hash::{Hash, Hasher};

/// The name of one statement of a program. Ids are ordered as the statements are.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::Record;
/// use clsmith::source::Source;
///
/// let source = Source::new("part.cls", b"RAPID\nGOTO/1,2,3\n".to_vec())?;
/// let program = parse(&source, None).program;
/// let rapid = program
///     .live_statements()
///     .find(|(_, statement)| matches!(statement.record(), Record::Rapid))
///     .map(|(id, _)| id)
///     .expect("there is a RAPID");
/// let next = program.next_live_statement(rapid).expect("a GOTO follows");
/// assert_eq!(program.statement_text(program.statement(next)), b"GOTO/1,2,3\n");
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct StatementId {
    index: u32,
    stamp: ProgramStamp,
}

impl StatementId {
    /// Makes the id of the statement with `index` statements before it.
    #[inline]
    pub(super) fn new(index: usize, stamp: ProgramStamp) -> Self {
        // A file has fewer than 4 GiB and a statement at least one byte, and so many insertions fit no memory.
        debug_assert!(u32::try_from(index).is_ok(), "no program has {index} statements");
        Self { index: index as u32, stamp }
    }

    /// Returns how many statements are before it, including deleted ones. This is its row in a table with one
    /// row for each statement.
    #[inline]
    pub fn index(self) -> usize {
        self.index as usize
    }

    /// Returns the place directly before the statement.
    pub fn before(self) -> InsertionPoint {
        InsertionPoint(self)
    }

    /// Returns the place directly after the statement, which is the one before the next statement.
    pub fn after(self) -> InsertionPoint {
        InsertionPoint(Self { index: self.index + 1, stamp: self.stamp })
    }

    /// The mark of the program that made it.
    #[inline]
    pub(super) fn stamp(self) -> ProgramStamp {
        self.stamp
    }
}

// The stamp takes no part in comparisons: it is there only to find mistakes.
impl PartialEq for StatementId {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        self.index == other.index
    }
}

impl Eq for StatementId {}

impl PartialOrd for StatementId {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for StatementId {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        self.index.cmp(&other.index)
    }
}

impl Hash for StatementId {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.index.hash(state);
    }
}

/// A place between two statements, or at the start or end of a program, where statements can be inserted.
///
/// It is held as the id of the statement behind it; the end has the id that comes after the last one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InsertionPoint(StatementId);

impl InsertionPoint {
    /// Makes the place with `index` statements before it.
    pub(super) fn new(index: usize, stamp: ProgramStamp) -> Self {
        Self(StatementId::new(index, stamp))
    }

    /// Returns how many statements are before it, including deleted ones.
    pub fn index(self) -> usize {
        self.0.index()
    }

    /// The mark of the program that made it.
    pub(super) fn stamp(self) -> ProgramStamp {
        self.0.stamp
    }
}

/// Statements that follow each other, from the first to the last one. There is always at least one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct StatementRange {
    first: StatementId,
    last: StatementId,
}

impl StatementRange {
    /// Makes the range from `first` to `last`, including both.
    #[inline]
    pub(super) fn new(first: StatementId, last: StatementId) -> Self {
        debug_assert!(first <= last, "{first:?} is behind {last:?}");
        Self { first, last }
    }

    /// Returns the first statement.
    #[inline]
    pub fn first(self) -> StatementId {
        self.first
    }

    /// Returns the last statement.
    #[inline]
    pub fn last(self) -> StatementId {
        self.last
    }

    /// Returns the range of one statement.
    pub(crate) fn of_one(id: StatementId) -> Self {
        Self { first: id, last: id }
    }

    /// Makes the range longer by the statement directly behind it; returns whether `next` is that one.
    pub(crate) fn extend_by(&mut self, next: StatementId) -> bool {
        let follows = self.last.index.checked_add(1) == Some(next.index);
        if follows {
            self.last = next;
        }
        follows
    }

    /// Returns whether a statement is in the range.
    pub fn contains(self, id: StatementId) -> bool {
        self.first <= id && id <= self.last
    }

    /// Returns all statements of the range in order, including deleted ones.
    pub fn ids(self) -> impl DoubleEndedIterator<Item = StatementId> + Clone {
        let stamp = self.first.stamp;
        (self.first.index..=self.last.index).map(move |index| StatementId { index, stamp })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_costs_four_bytes_where_nothing_is_asserted() {
        let stamp = size_of::<ProgramStamp>();
        assert_eq!(stamp, if cfg!(debug_assertions) { 4 } else { 0 });
        assert_eq!(size_of::<StatementId>(), 4 + stamp);
        assert_eq!(size_of::<StatementRange>(), 2 * (4 + stamp));
    }
}
