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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parse::parse;
    use crate::program::{Program, StepId};
    use crate::source::Source;

    /// Points, arcs and words, so many that two threads work on them.
    fn program() -> Program {
        let statement = |index: usize| match index % 3 {
            0 => format!("GOTO/{index}.0000,-2.5000,0.0010,0.0000000,0.6000000,0.8000000\n"),
            1 => format!("CIRCLE/0.0000,0.0000,0.0000,0.0000000,0.0000000,-1.0000000,{index}.0000\n"),
            _ => "COOLNT/ON\n".to_owned(),
        };
        let text: String = (0..3 * WORTH_A_THREAD).map(statement).collect();
        parse(&Source::new("part.cls", text.into_bytes()).unwrap(), None).program
    }

    /// Every number that a statement may have gets a value of its own; COOLNT has none.
    fn add_edits(known: f64, numbers: &StatementNumbers, edits: &mut Vec<(usize, f64)>) {
        let values = numbers.places.iter().map(|(_, value)| value * 0.5 + known);
        edits.extend(values.enumerate().filter(|(index, _)| index % 2 == 0));
    }

    #[test]
    fn many_edits_are_the_edits_one_by_one() {
        let mut many = ProgramEditor::new(program(), StepId(0));
        let tasks: Vec<(StatementId, f64)> =
            many.program().statement_ids().map(|id| (id, id.index() as f64 / 16.0)).collect();
        many.set_numbers_of_many(&tasks, |known, _, numbers, edits| add_edits(known, numbers, edits))
            .unwrap();
        let mut single = ProgramEditor::new(program(), StepId(0));
        for (id, known) in
            single.program().statement_ids().map(|id| (id, id.index() as f64 / 16.0)).collect::<Vec<_>>()
        {
            let (mut numbers, mut edits) = (StatementNumbers::default(), Vec::new());
            let statement = single.program().statement(id);
            numbers.read(statement.record(), single.program().statement_text(statement));
            add_edits(known, &numbers, &mut edits);
            single.set_numbers(id, &edits).unwrap();
        }
        let (many, single) = (many.finish().unwrap(), single.finish().unwrap());
        assert_eq!(many.to_bytes(), single.to_bytes());
        assert_ne!(many.to_bytes(), program().to_bytes());
        for (many, single) in many.statements().iter().zip(single.statements()) {
            assert_eq!((many.record(), many.change()), (single.record(), single.change()));
        }
    }

    #[test]
    fn the_first_statement_that_cannot_be_written_is_told() {
        let mut editor = ProgramEditor::new(program(), StepId(0));
        let tasks: Vec<(StatementId, usize)> =
            editor.program().statement_ids().map(|id| (id, id.index())).collect();
        for bad in [[300, 900], [300, 5 * WORTH_A_THREAD / 2], [2 * WORTH_A_THREAD, 5 * WORTH_A_THREAD / 2]] {
            let Err(Failure::Found(found)) = editor.set_numbers_of_many(&tasks, |index, _, _, edits| {
                edits.extend(bad.iter().filter(|bad| **bad / 3 * 3 == index).map(|_| (0, f64::INFINITY)));
            }) else {
                panic!("{bad:?} was written");
            };
            let first = editor.program().statements()[bad[0] / 3 * 3].origin();
            assert_eq!(found.iter().map(|found| found.labels[0].span).collect::<Vec<_>>(), [first]);
        }
    }
}
