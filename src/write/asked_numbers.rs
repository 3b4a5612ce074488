//! This module compares the numbers of an edited statement with those that a step asked for. That the new text is a
//! statement does not say that it is the statement which was meant.

use crate::parse;
use crate::program::Record;
use std::ops::Range;

/// The largest difference between an edited number and the value that was asked for: half of the coarsest last decimal
/// that is printed.
const LAST_DECIMAL: f64 = 5e-5;

/// Returns the index of the first number of a patched text that is not what was asked for: an edited one that has
/// another value, or another one that does not have the value that it had. `before` are the numbers of the old text,
/// `record` is the meaning of the new one.
pub(super) fn find_wrong_number(
    before: &[(Range<usize>, f64)],
    edits: &[(usize, f64)],
    record: &Record,
    text: &[u8],
) -> Option<usize> {
    // Nearly all edits are moved points, whose record has all numbers of its text.
    match record {
        Record::Goto(goto) if before.len() == if goto.axis.is_some() { 6 } else { 3 } => {
            let axis = goto.axis.unwrap_or_default();
            let after = goto.point.iter().chain(axis.iter()).copied().take(before.len());
            compare_numbers(before, &mut [None; 6], edits, after)
        }
        _ => {
            let after = parse::statement_numbers(text);
            let mut asked = vec![None; before.len()];
            let wrong = compare_numbers(before, &mut asked, edits, after.iter().map(|(_, value)| *value));
            wrong.or((after.len() > before.len()).then_some(before.len()))
        }
    }
}

/// Compares the numbers of both texts. `asked` has a place for each number.
fn compare_numbers(
    before: &[(Range<usize>, f64)],
    asked: &mut [Option<f64>],
    edits: &[(usize, f64)],
    mut after: impl Iterator<Item = f64>,
) -> Option<usize> {
    for (index, wanted) in edits {
        // If a number has two new values, the first one counts.
        if let Some(place) = asked.get_mut(*index) {
            place.get_or_insert(*wanted);
        }
    }
    before.iter().zip(asked).position(|((_, old), asked)| match (after.next(), asked) {
        (Some(new), None) => new.to_bits() != old.to_bits(),
        (Some(new), Some(wanted)) => {
            // An edit is printed to a tenth of itself, so that it is not rounded away, and to 15 decimals at most.
            let allowed = LAST_DECIMAL.min(0.1 * (*wanted - old).abs()) * (1.0 + 1e-9);
            (new - *wanted).abs() > allowed + 1e-12 * wanted.abs().max(1.0)
        }
        (None, _) => true,
    })
}

#[cfg(test)]
mod tests {
    use super::find_wrong_number;
    use crate::fuzzed_statements::FuzzedStatements;
    use crate::parse::{self, statement_numbers};
    use crate::program::{Record, StepId};
    use crate::source::Source;
    use crate::write::ProgramEditor;

    /// Reads an edited text and compares it with what was asked for.
    fn compare(old: &str, edits: &[(usize, f64)], new: &str) -> Option<usize> {
        let (record, _) = parse::read_record(new.as_bytes()).unwrap();
        find_wrong_number(&statement_numbers(old.as_bytes()), edits, &record, new.as_bytes())
    }

    #[test]
    fn the_first_number_that_is_not_as_asked_is_found() {
        let old = "GOTO/1.0000,2.0000,3.0000\n";
        for (new, wrong) in [
            ("GOTO/1.0000,5.0000,3.0000\n", None),
            ("GOTO/1.0000,5.00004,3.0000\n", None),
            ("GOTO/1.0000,5.0002,3.0000\n", Some(1)),
            ("GOTO/1.0000,2.0000,3.0000\n", Some(1)),
            ("GOTO/1.0001,5.0000,3.0000\n", Some(0)),
            ("GOTO/1.0000,5.0000,3.0000,0.0,0.0,1.0\n", Some(3)),
        ] {
            assert_eq!(compare(old, &[(1, 5.0), (1, 6.0)], new), wrong, "{new}");
        }
        let old = "SPINDL/RPM,1000,CLW\n";
        assert_eq!(compare(old, &[(0, 800.0)], "SPINDL/RPM,800,CLW\n"), None);
        assert_eq!(compare(old, &[(0, 800.0)], "SPINDL/RPM,80,0,CLW\n"), Some(0));
        assert_eq!(compare(old, &[(0, 800.0)], "SPINDL/RPM,CLW\n"), Some(0));
        // A small edit has more decimals than its tolerance.
        assert_eq!(compare("FEDRAT/0.002\n", &[(0, 0.002001)], "FEDRAT/0.002\n"), Some(0));
    }

    /// Whatever a statement looks like: its numbers are edited as asked, or not at all.
    #[test]
    fn numbers_of_fuzzed_statements_become_what_was_asked() {
        let values = [0.0, -1.5, 98765.4321, 12.0, -0.00003, 1e7, 4.25];
        let (mut edited, mut refused) = (0, Vec::new());
        for (index, text) in FuzzedStatements::new(23).take(20_000).enumerate() {
            let program = parse::parse(&Source::new("part.cls", text.clone()).unwrap(), None).program;
            // What cannot be read cannot be edited either.
            let mut statements = program.live_statements();
            let first = statements.find(|(_, statement)| *statement.record() != Record::Unparsed);
            let Some((first, statement)) = first else { continue };
            let before = statement_numbers(program.statement_text(statement));
            let Some(number) = index.checked_rem(before.len()) else { continue };
            let wanted = values[index % values.len()];
            let mut editor = ProgramEditor::new(program.clone(), StepId(0));
            if let Err(failure) = editor.set_numbers(first, &[(number, wanted)]) {
                // Some records have no place for such a value: a negative feed, say.
                let message = failure.findings()[0].message.clone();
                if message.contains("does not read back as what the step asked for") {
                    refused.push(format!("{message}: {:?}", String::from_utf8_lossy(&text)));
                }
                continue;
            }
            edited += 1;
            let new = editor.program().statement_text(editor.program().statement(first));
            let after: Vec<f64> = statement_numbers(new).into_iter().map(|(_, value)| value).collect();
            let mut expected: Vec<f64> = before.iter().map(|(_, value)| *value).collect();
            expected[number] = wanted;
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 5.1e-5;
            assert!(
                after.len() == expected.len() && after.iter().zip(&expected).all(near),
                "{wanted} for number {number}: {:?} became {:?}",
                String::from_utf8_lossy(&text),
                String::from_utf8_lossy(new)
            );
        }
        // What is left are texts that nobody writes.
        assert!(edited > 5_000 && refused.len() < 6, "{edited} edited, refused: {refused:#?}");
    }
}
