//! Lines that CATIA broke because they were full, inside numbers, words and texts.

use super::{HALF, MOVE, TO_INCH, alarms, apply, read, totals};
use clsmith::program::Record;
use clsmith::program::record::Goto;
use proptest::prelude::*;

/// A CATIA program around some lines, with CRLF.
fn catia(lines: &str) -> String {
    let head = "$$     CATIA APT VERSION 1.0\nMULTAX\nTOOLNO/1,   12.000000\nCUTTER/   12.000000\nLOADTL/1\n\
                SPINDL/ 3000.0000,RPM,CLW\nFEDRAT/ 1500.0000,MMPM\n";
    format!("{head}{lines}FINI\n").replace('\n', "\r\n")
}

/// Breaks a statement at column 72 as CATIA does, with CRLF.
fn broken(statement: &str) -> String {
    let mut lines = Vec::new();
    let mut rest = statement;
    while rest.len() > 72 {
        let (line, tail) = rest.split_at(71);
        lines.push(format!("{line}$"));
        rest = tail;
    }
    lines.push(rest.to_owned());
    lines.join("\n") + "\n"
}

fn gotos(text: &str) -> Vec<Goto> {
    let program = read(text);
    let gotos = program.statements().iter().filter_map(|statement| match statement.record() {
        Record::Goto(goto) => Some(*goto),
        _ => None,
    });
    gotos.collect()
}

#[test]
fn a_number_goes_on_wherever_its_line_is_broken() {
    let whole = "GOTO  /  14.250000, -40.500000,  60.125000,   0.480000,  -0.360000,   0.800000";
    let expected = gotos(&catia(&format!("{whole}\n")));
    assert_eq!(expected.len(), 1);
    // The break may be in front of the sign, behind it, and at every digit.
    for blanks in 0..12 {
        let statement = format!("GOTO  /{}{}", " ".repeat(blanks), &whole["GOTO  /  ".len()..]);
        let text = catia(&broken(&statement.replace("0.800000", "-0.800000")));
        let found = gotos(&text);
        assert_eq!(found.len(), 1, "{text}");
        assert_eq!(found[0].axis.map(|axis| axis.z), Some(-0.8), "{text}");
        assert_eq!(alarms(&text), [], "{text}");
    }
}

#[test]
fn a_number_goes_on_behind_a_break_in_any_column() {
    let text = catia("GOTO  / 1.5$\n0,2.,3.,0.,-0$\n.6,-$\n0.8\n");
    let found = gotos(&text);
    assert_eq!((found[0].point.x, found[0].axis.map(|axis| (axis.y, axis.z))), (1.5, Some((-0.6, -0.8))));
}

#[test]
fn a_break_that_ends_no_full_line_joins_no_words() {
    // Joined, the GOTO would be the tail of a word or a text, and nobody would miss it.
    for text in ["SPINDL/100,RPM,CLW$\nGOTO/1,2,3\n", "PPRINT COST 5$\nGOTO/1,2,3\n"] {
        let program = read(catia(text));
        let lost =
            !program.statements().iter().any(|statement| matches!(statement.record(), Record::Goto(_)));
        assert_eq!(lost, !alarms(catia(text)).is_empty(), "{text}");
    }
}

#[test]
fn moved_points_are_broken_as_they_were() {
    let points = broken("GOTO  / 150.250000, -40.500000,  60.125000,   0.480000,  -0.360000,   0.800000");
    let moved = points.replace("150.250000, -40.500000,  60.125000", "155.250000, -43.500000,  62.125000");
    assert_eq!(apply(MOVE, catia(&points)), catia(&moved));
    assert_eq!(apply(HALF, catia(&points)), catia(&points).replace("1500.0000", " 750.0000"));
}

#[test]
fn a_number_that_is_broken_itself_is_changed_as_one() {
    let cutter = |first: &str, broken: &str| {
        format!("CUTTER/{first},  2.000000,  6.000000,  2.000000,  0.000000,  5.00000$\n{broken}\n")
    };
    let text = catia(&cutter(" 16.000000", "0, 80.000000"));
    let inch = apply(TO_INCH, &text);
    assert!(inch.contains("5.00000$\r\n0,3.14960630\r\n"), "{inch}");
    // A point whose last coordinate is broken.
    let text = catia(&broken(&format!("GOTO  /{:>30},{:>30},   12.500000", "1.000000", "2.000000")));
    let moved = apply(MOVE, &text);
    let found = gotos(&moved);
    assert_eq!((found[0].point.x, found[0].point.z), (6.0, 14.5), "{moved}");
    assert!(moved.lines().all(|line| line.len() <= 72), "{moved}");
    assert_eq!(alarms(&moved), [], "{moved}");
}

#[test]
fn a_text_goes_on_behind_a_full_line_and_its_tail_is_no_statement() {
    for word in ["PPRINT", "PARTNO", "TPRINT/T1"] {
        let text = broken(&format!("{word} {} AT{}", "A".repeat(67 - word.len()), "RAPID"));
        assert!(text.contains("$\n"), "{text}");
        let text = catia(&format!("GOTO/0,0,0\n{}GOTO/10,0,0\n", text));
        assert_eq!(totals(&read(&text)), (10.0, 0.0, 0.4), "{text}");
        assert_eq!(alarms(&text), [], "{text}");
    }
    // A short line ends where it ends.
    let program = read("PPRINT US$\nRAPID\nGOTO/1,2,3\n");
    assert_eq!(program.statements().len(), 3);
}

#[test]
fn rules_see_a_broken_text_as_one_statement() {
    let text = broken(&format!("PPRINT {}", "LONG TEXT ".repeat(9)));
    let deleted =
        apply("  - rewrite: { rules: [ { match: 'PPRINT $...T', delete: true } ] }\n", catia(&text));
    assert_eq!(deleted, catia(""));
    let behind =
        apply("  - rewrite: { rules: [ { match: 'PPRINT $...T', insert_after: OPSTOP } ] }\n", catia(&text));
    assert_eq!(behind, catia(&format!("{text}OPSTOP\n")));
    let copied = apply(
        "  - rewrite: { rules: [ { match: 'PPRINT $...T', replace: 'PPRINT NOTE: $...T' } ] }\n",
        catia(&text),
    );
    assert_eq!(read(&copied).statements().len(), read(catia(&text)).statements().len(), "{copied}");
    assert_eq!(copied.replace("$\r\n", "").matches("LONG TEXT").count(), 9, "{copied}");
}

#[test]
fn a_word_that_is_broken_is_that_word() {
    let statement = format!("SPINDL/{:>62},RPM,CLW", "2500.0000");
    let text = catia(&format!("GOTO/0,0,0\n{}GOTO/1,0,0\n", broken(&statement)));
    assert!(text.contains("R$\r\nPM,CLW") || text.contains("$\r\n"), "{text}");
    let program = read(&text);
    assert_eq!(program.motions().last().and_then(|motion| motion.spindle_rpm()), Some(2500.0), "{text}");
    assert_eq!(alarms(&text), []);
}

/// A number as CAM systems print it, with up to six decimals.
fn number() -> impl Strategy<Value = String> {
    (any::<bool>(), 0..100_000u32, 0..7usize).prop_map(|(minus, whole, decimals)| {
        let sign = if minus { "-" } else { "" };
        format!("{sign}{whole}.{:0<decimals$}", "")
    })
}

proptest! {
    #![proptest_config(crate::support::property(400))]

    #[test]
    fn a_broken_statement_means_what_it_means_in_one_line(
        word in "GOTO|CIRCLE|MSYS|TLDATA|CYCLE|OWNWORD",
        fields in prop::collection::vec(prop_oneof![4 => number(), 1 => "[A-Z]{1,9}"], 8..30),
    ) {
        let whole = format!("{word}/{}\n", fields.join(","));
        prop_assume!(whole.len() > 81);
        let broken = broken(whole.trim_end());
        let joined = clsmith::parse::read_record(broken.as_bytes()).ok();
        let expected = clsmith::parse::read_record(whole.as_bytes()).ok();
        prop_assert!(joined.iter().all(|(_, syntax)| syntax.text.len() == broken.len()), "{}", broken);
        prop_assert_eq!(joined.map(|(record, _)| record), expected.map(|(record, _)| record));
    }

    #[test]
    fn points_move_alike_in_one_line_and_broken(
        values in prop::collection::vec(number(), 3),
        width in 10..40usize,
    ) {
        let statement = format!("GOTO  /{:>width$},{:>width$},{:>width$}", values[0], values[1], values[2]);
        let broken = broken(&statement);
        let moved = |text: &str| gotos(&apply(MOVE, catia(text)))[0].point;
        prop_assert!((moved(&broken) - moved(&format!("{statement}\n"))).norm() < 1e-4, "{}", broken);
    }
}
