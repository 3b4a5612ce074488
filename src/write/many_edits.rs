//! This module changes the numbers of many statements. The new texts are worked out and read back in two threads where
//! that is worth it, and put in place one after the other: the bytes do not depend on the threads.

use super::ProgramEditor;
use super::number_patch::NumberPatcher;
use crate::diagnostic::Failure;
use crate::parse::StatementNumbers;
use crate::program::{Record, StatementId};
use crate::threads::both_ways;

/// The number of statements from which a second thread gains more than it costs.
const WORTH_A_THREAD: usize = 2_000;

/// Statements that were patched and are not put in place yet.
#[derive(Default)]
struct PatchedStatements {
    /// Their texts, one behind the other.
    texts: Vec<u8>,
    /// Each statement with the length of its text and its record.
    statements: Vec<(StatementId, usize, Record)>,
    /// What stopped at the statement behind them.
    failure: Option<Failure>,
}

impl ProgramEditor {
    /// Gives numbers of statements new values, as [`ProgramEditor::set_numbers`] does for each of them in order. Each
    /// statement comes once, with what `edit` needs to know of it beside its record and numbers.
    ///
    /// # Errors
    /// Returns the first error of [`ProgramEditor::set_numbers`].
    pub(crate) fn set_numbers_of_many<T: Copy + Sync>(
        &mut self,
        statements: &[(StatementId, T)],
        edit: impl Fn(T, &Record, &StatementNumbers, &mut Vec<(usize, f64)>) + Sync,
    ) -> Result<(), Failure> {
        let (first, second) = statements.split_at(statements.len() / 2);
        let editor = &*self;
        let (first, second) = both_ways(
            statements.len() >= WORTH_A_THREAD,
            || editor.patch_statements(first, &edit),
            || editor.patch_statements(second, &edit),
        );
        self.put_patched(first)?;
        self.put_patched(second)
    }

    fn patch_statements<T: Copy>(
        &self,
        statements: &[(StatementId, T)],
        edit: impl Fn(T, &Record, &StatementNumbers, &mut Vec<(usize, f64)>),
    ) -> PatchedStatements {
        let mut patcher = NumberPatcher::default();
        let mut patched = PatchedStatements::default();
        for (id, known) in statements {
            let edit = |record: &Record, numbers: &StatementNumbers, into: &mut Vec<_>| {
                edit(*known, record, numbers, into);
            };
            match self.patch_statement(*id, &mut patcher, edit) {
                Ok(Some(record)) => {
                    patched.texts.extend_from_slice(&patcher.out);
                    patched.statements.push((*id, patcher.out.len(), record));
                }
                Ok(None) => {}
                Err(failure) => {
                    patched.failure = Some(failure);
                    break;
                }
            }
        }
        patched
    }

    fn put_patched(&mut self, patched: PatchedStatements) -> Result<(), Failure> {
        let mut rest = patched.texts.as_slice();
        for (id, length, record) in patched.statements {
            let Some((text, behind)) = rest.split_at_checked(length) else {
                debug_assert!(false, "every patched statement has its text");
                break;
            };
            rest = behind;
            self.put_read_text(id, text, record);
        }
        patched.failure.map_or(Ok(()), Err)
    }
}
