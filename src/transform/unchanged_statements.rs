//! This module reports statements that a geometric step cannot change, because it is not known what their
//! numbers mean.

use super::StepContext;
use super::statement_numbers::major_word;
use crate::parse;
use crate::program::{FieldKind, Program, Record, StatementId};

/// Reports unknown words with numbers that may be points or lengths, with one finding for each word, and
/// statements that could not be read, with one finding for all of them. `meant` tells which statements the
/// step changes, and `verb` is what it does to them.
pub(super) fn report_unchanged_statements(
    program: &Program,
    meant: impl Fn(StatementId) -> bool,
    verb: &str,
    context: &mut StepContext<'_>,
) {
    let mut words: Vec<String> = Vec::new();
    let mut unreadable = Vec::new();
    for (id, statement) in program.live_statements() {
        match statement.record() {
            Record::Unparsed | Record::Definition if meant(id) => unreadable.push(id),
            Record::Other if meant(id) => {
                let text = program.statement_text(statement);
                let word = major_word(text).into_owned();
                if may_hold_lengths(text) && !words.contains(&word) {
                    context.report_unchanged(
                        format!(
                            "clsmith does not know the word `{word}`: if its numbers are points or lengths, they are not {verb}"
                        ),
                        program,
                        id,
                    );
                    words.push(word);
                }
            }
            _ => {}
        }
    }
    if let Some(first) = unreadable.first() {
        let count = unreadable.len();
        let message = match count {
            1 => format!("a statement that cannot be read is not {verb}"),
            _ => format!("{count} statements that cannot be read are not {verb}"),
        };
        context.report_unchanged(message, program, *first);
    }
}

/// Returns whether numbers of an unknown statement may be lengths. A length may be written as a whole number, so tool
/// numbers, registers and counts cannot be told from it; a zero is the same in every unit.
fn may_hold_lengths(text: &[u8]) -> bool {
    let syntax = parse::syntax(text);
    let numbers = syntax.numbers();
    numbers.len() >= 3
        || syntax.fields.iter().any(|field| matches!(field.kind, FieldKind::Group(_)))
        || numbers.iter().any(|(_, value)| *value != 0.0)
}
