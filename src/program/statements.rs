//! This module goes through the statements of a program and finds them by their ids.

use super::{InsertionPoint, Program, RecordKind, Statement, StatementId};

impl Program {
    /// Returns all statements in order, including deleted ones (see [`Statement::is_live`]).
    pub fn statements(&self) -> &[Statement] {
        &self.statements
    }

    /// Returns the ids of all statements in order, including deleted ones.
    pub fn statement_ids(
        &self,
    ) -> impl DoubleEndedIterator<Item = StatementId> + ExactSizeIterator + Clone + use<> {
        let stamp = self.stamp;
        (0..self.statements.len()).map(move |index| StatementId::new(index, stamp))
    }

    /// Returns all statements with their ids, including deleted ones.
    pub fn numbered_statements(
        &self,
    ) -> impl DoubleEndedIterator<Item = (StatementId, &Statement)> + ExactSizeIterator {
        self.statement_ids().zip(&self.statements)
    }

    /// Returns the live statements with their ids.
    pub fn live_statements(&self) -> impl DoubleEndedIterator<Item = (StatementId, &Statement)> {
        self.numbered_statements().filter(|(_, statement)| statement.is_live())
    }

    /// Returns the live statements of some kinds with their ids. It only looks at statements of these kinds, which is
    /// many times faster than a look at all where they are few.
    pub(crate) fn live_statements_of(
        &self,
        kinds: &[RecordKind],
    ) -> impl Iterator<Item = (StatementId, &Statement)> {
        debug_assert_eq!(self.kinds.len(), self.statements.len(), "every statement has its kind");
        let bit = |kind: RecordKind| 1_u32 << kind as u32;
        let wanted = kinds.iter().fold(0, |all, kind| all | bit(*kind));
        let stamp = self.stamp;
        let found = self.kinds.iter().enumerate().filter(move |(_, kind)| wanted & bit(**kind) != 0);
        found.filter_map(move |(index, _)| {
            let statement = self.statements.get(index).filter(|statement| statement.is_live())?;
            Some((StatementId::new(index, stamp), statement))
        })
    }

    /// Returns the statement with an id, live or deleted.
    ///
    /// # Panics
    /// It panics if the id is of another program with more statements; with debug assertions, if it is of any
    /// other program. No file can cause that, only a fault in the code that kept the id.
    // Every id was made for a statement, and no statement is ever removed from the list.
    #[allow(clippy::indexing_slicing)]
    #[inline]
    pub fn statement(&self, id: StatementId) -> &Statement {
        id.stamp().assert_belongs_to(self.stamp);
        &self.statements[id.index()]
    }

    /// Returns whether the program has a statement with the id. It has none only if the id is of another program.
    pub fn contains(&self, id: StatementId) -> bool {
        id.index() < self.statements.len()
    }

    /// Returns the statements before another one, including deleted ones.
    pub fn statements_before(&self, id: StatementId) -> &[Statement] {
        self.split_statements(id.before()).0
    }

    /// Returns the statements after another one, including deleted ones.
    pub fn statements_after(&self, id: StatementId) -> &[Statement] {
        self.split_statements(id.after()).1
    }

    /// Returns the statements between two places, including deleted ones; none if `to` is not behind `from`.
    pub fn statements_between(&self, from: InsertionPoint, to: InsertionPoint) -> &[Statement] {
        from.stamp().assert_belongs_to(self.stamp);
        self.split_statements(to).0.get(from.index()..).unwrap_or_default()
    }

    fn split_statements(&self, at: InsertionPoint) -> (&[Statement], &[Statement]) {
        at.stamp().assert_belongs_to(self.stamp);
        debug_assert!(at <= self.end(), "{at:?} is no place of this program");
        self.statements.split_at(at.index().min(self.statements.len()))
    }

    /// Returns the next live statement after another one.
    pub fn next_live_statement(&self, id: StatementId) -> Option<StatementId> {
        let skipped = self.statements_after(id).iter().position(Statement::is_live)?;
        Some(StatementId::new(id.index() + 1 + skipped, self.stamp))
    }

    /// Returns the statement that directly follows a place, live or deleted, or `None` at the end.
    pub fn statement_behind(&self, at: InsertionPoint) -> Option<StatementId> {
        at.stamp().assert_belongs_to(self.stamp);
        (at < self.end()).then(|| StatementId::new(at.index(), self.stamp))
    }

    /// Returns the place before the first statement.
    pub fn start(&self) -> InsertionPoint {
        InsertionPoint::new(0, self.stamp)
    }

    /// Returns the place after the last statement.
    pub fn end(&self) -> InsertionPoint {
        InsertionPoint::new(self.statements.len(), self.stamp)
    }

    /// Returns the last statement that begins at a byte of the source or before it, or `None` if there is none.
    pub fn statement_at_offset(&self, offset: u32) -> Option<StatementId> {
        // Statements are in the order of their origins, and an inserted one begins where the next one does.
        let after = self.statements.partition_point(|statement| statement.origin().start <= offset);
        Some(StatementId::new(after.checked_sub(1)?, self.stamp))
    }
}
