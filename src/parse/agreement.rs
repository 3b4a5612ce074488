//! This module compares the shortcuts of the parser with the grammar, which is the definition of the language.
//!
//! Tests and a benchmark use it: over real files, over fuzzed statements, over whatever a fuzzer finds.

use super::{plain_statement, shortcut, split_by_grammar};
use crate::program::record::Goto;
use crate::program::{FieldKind, Record, StatementField};

/// Reads the statement at the start of a text by the shortcuts and by the grammar. Returns how many bytes it has,
/// and whether a shortcut took it.
///
/// # Errors
/// Returns a description of the first difference.
pub fn compare_with_grammar(text: &[u8]) -> Result<(usize, bool), String> {
    let (by_grammar, length) = split_by_grammar(text);
    let describe = |what: &str| format!("{what}: {:?}", String::from_utf8_lossy(text));
    let mut taken = false;
    if let Some(plain) = plain_statement::read_plain_statement(text, &mut Vec::new()) {
        taken = true;
        let parts = (plain.form, &plain.word, &plain.remark, plain.open, plain.text.len());
        let expected =
            (by_grammar.form, &by_grammar.word, &by_grammar.remark, by_grammar.open, by_grammar.text.len());
        if parts != expected || plain.text.len() != length {
            return Err(describe(&format!("{parts:?} is not {expected:?}")));
        }
        if !are_same_fields(&plain.fields, &by_grammar.fields) {
            return Err(describe(&format!("{:?} is not {:?}", plain.fields, by_grammar.fields)));
        }
    }
    if let Some((goto, end)) = shortcut::read_plain_goto(text) {
        taken = true;
        match Record::read(&by_grammar) {
            Ok(Record::Goto(expected))
                if goto_bits(&goto) == goto_bits(&expected) && end == length && !by_grammar.open => {}
            other => return Err(describe(&format!("{goto:?} of {end} is not {other:?} of {length}"))),
        }
    }
    Ok((length, taken))
}

/// Returns whether fields are the same, their numbers bit for bit.
fn are_same_fields(left: &[StatementField], right: &[StatementField]) -> bool {
    left.len() == right.len()
        && left.iter().zip(right).all(|(left, right)| {
            left.at == right.at
                && match (&left.kind, &right.kind) {
                    (FieldKind::Number(left), FieldKind::Number(right)) => left.to_bits() == right.to_bits(),
                    (FieldKind::Group(left), FieldKind::Group(right)) => {
                        left.word == right.word && are_same_fields(&left.fields, &right.fields)
                    }
                    (left, right) => left == right,
                }
        })
}

fn goto_bits(goto: &Goto) -> ([u64; 3], Option<[u64; 3]>) {
    (goto.point.coords.map(f64::to_bits).into(), goto.axis.map(|axis| axis.map(f64::to_bits).into()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fuzzed_statements::FuzzedStatements;

    /// The seed is fixed, so every run sees the same statements; `cargo bench --bench agreement` sees ten million.
    #[test]
    fn shortcuts_agree_with_the_grammar_on_fuzzed_statements() {
        let mut taken = 0;
        for text in FuzzedStatements::new(17).take(40_000) {
            match compare_with_grammar(&text) {
                Ok((_, by_shortcut)) => taken += usize::from(by_shortcut),
                Err(difference) => panic!("{difference}"),
            }
        }
        // Where nearly all is declined, the agreement says little; where nothing is, the fuzzing is too tame.
        assert!((10_000..36_000).contains(&taken), "{taken} of 40,000 were read by a shortcut");
    }

    #[test]
    fn plain_statements_of_every_dialect_are_taken() {
        for text in [
            "PAINT/COLOR,31\n",
            "RAPID\r\n",
            "RAPID/\n",
            "FEDRAT/MMPM,250.0000\n",
            "FEDRAT/  300.0000,MMPM\n",
            "CIRCLE/1.0,2.0,3.0,0.0,0.0,-1.0,5.0,0.06,0.5,10.0,0.0,TIMES,2\n",
            "LOADTL/2,2,2\n",
            "SPINDL/RPM,1000,CLW \n",
            "TOOLNO/2,MILL,2,0,   20.0,$\n 150.0,,   90.0,,$\nON,,NOTE\n",
            "TLON,GOFWD/      (CIRCLE/ 0.0, 0.0, -0.6,$\n 45.9),ON,2,INTOF,$\n (LINE/ 0.0, 0.0, -0.6,$\n 4.9, 0.0, -0.6)\n",
            "GOTO  / 1.0, 0$\n.75, 3.0\n",
            "END-OF-PATH\n",
            "$$ centerline data\n",
            "\n",
            "CUTTER/ 7.0,1.0,\n",
        ] {
            assert_eq!(compare_with_grammar(text.as_bytes()), Ok((text.len(), true)), "{text}");
        }
    }

    #[test]
    fn what_only_the_grammar_can_tell_is_left_to_it() {
        for text in [
            "PPRINT A,B $\n",
            "TPRINT/A B,C\n",
            "$$-> CUTTER / 0.5\n",
            "$$*CATIA0\n",
            "$$  1.0 0.0 0.0 0.0\n",
            "TOOL PATH/A,TOOL,B\n",
            "N10 GOTO/1,2,3\n",
            "L1 = LINE/1,2\n",
            "CHANNEL,1\n",
            "CYCLE/DRILL,1E3\n",
            "SYN/'A','B'\n",
            "STOP/(TEXT)\n",
            "FEDRAT/100 MMPM\n",
            "FEDRAT/100,$\n",
            "RAPID $$ fast\n",
            "RAPID\rGOTO/1,2,3\n",
        ] {
            let compared = compare_with_grammar(text.as_bytes());
            assert!(matches!(compared, Ok((_, false))), "{text}: {compared:?}");
        }
    }

    #[test]
    fn an_identification_is_no_part_of_a_plain_statement() {
        for data in ["FEDRAT/MMPM,250.0", "PAINT/COLOR,31"] {
            let card = format!("{data:<72}PT     2\n");
            assert!(matches!(compare_with_grammar(card.as_bytes()), Ok((_, false))), "{card}");
        }
        let full = format!("CIRCLE/{},A5PKT00010\n", "1".repeat(62));
        assert!(matches!(compare_with_grammar(full.as_bytes()), Ok((_, false))), "{full}");
    }
}
