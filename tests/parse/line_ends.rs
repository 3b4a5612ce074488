//! CRLF, LF, a lone CR, any mixture, and none at the end.

use crate::support::program;
use clsmith::program::Record;

const LINES: [&str; 8] = [
    "$$ head",
    "PARTNO PLATE 7",
    "TPRINT/a,b",
    "LOADTL/1",
    "RAPID",
    "GOTO/1.0,2.0,3.0",
    "GOTO / 4.0, 5.0, 6.0,  $",
    "0.0, 0.6, 0.8",
];

fn kinds(text: &str) -> Vec<Record> {
    let program = program(text);
    assert_eq!(program.to_bytes(), text.as_bytes(), "{text:?}");
    program.statements().iter().map(|statement| statement.record().clone()).collect()
}

#[test]
fn every_kind_of_line_end_reads_the_same_and_is_kept() {
    let expected = kinds(&LINES.map(|line| format!("{line}\n")).concat());
    assert_eq!(expected.len(), 7);
    for end in ["\r\n", "\r"] {
        assert_eq!(kinds(&LINES.map(|line| format!("{line}{end}")).concat()), expected, "{end:?}");
    }
}

/// Columns are counted from the start of each line, whatever ends the lines.
#[test]
fn the_columns_of_a_continued_statement_are_those_of_its_lines() {
    for (first, value) in
        [("SPINDL/RPM,$", "800"), ("GODLTA/5,6,$", "12"), ("FEDRAT/MMPM,$", "400"), ("GOTO/1,$", "2,3")]
    {
        for length in 68..=80 {
            let lines = format!("{first}\n{value:>width$}\nRAPID\n", width = length - first.len());
            let expected = kinds(&lines);
            assert_eq!(expected.len(), 2, "{lines}");
            for end in ["\r", "\r\n"] {
                assert_eq!(
                    kinds(&lines.replace('\n', end)),
                    expected,
                    "{first} {value} of {length} bytes, {end:?}"
                );
            }
        }
    }
    // An identification and a full line are seen there too.
    let cards = format!("{:<72}PT     1\n{:<72}PT     2\nRAPID\n", "GODLTA/5,6,$", " 12");
    let full = format!("GOTO/{:>62},10$\n.5,3.\nRAPID\n", "1.0");
    for lines in [cards, full] {
        let expected = kinds(&lines);
        assert_eq!(expected.len(), 2, "{lines}");
        assert_eq!(kinds(&lines.replace('\n', "\r")), expected, "{lines}");
    }
}

#[test]
fn line_ends_may_change_within_a_file() {
    let ends = ["\r\n", "\n", "\r", "\n", "\r\n", "\r", "\r\n", "\n"];
    let mixed: String = LINES.iter().zip(ends).map(|(line, end)| format!("{line}{end}")).collect();
    assert_eq!(kinds(&mixed), kinds(&LINES.map(|line| format!("{line}\n")).concat()));
}

#[test]
fn the_last_line_needs_no_end() {
    for count in 1..=LINES.len() {
        let lines = LINES.get(..count).unwrap();
        // A continued statement needs its next line.
        if count != 7 {
            assert_eq!(kinds(&lines.join("\n")), kinds(&format!("{}\n", lines.join("\n"))));
        }
    }
}

#[test]
fn trailing_blanks_and_form_feeds_are_kept() {
    let text = "RAPID \nFINI   \r\n  \t \n\x0C\nGOTO/1,2,3  \n$$-> END / \n";
    let found = kinds(text);
    assert_eq!(found[..2], [Record::Rapid, Record::ProgramEnd]);
    assert_eq!(found[2..4], [Record::Blank, Record::Blank]);
    assert!(matches!(found[4], Record::Goto(_)));
}

#[test]
fn cr_cr_lf_is_a_blank_line_between_two() {
    // What a file looks like after a text-mode copy of CRLF lines.
    let found = kinds("RAPID\r\r\nGOTO/1,2,3\r\r\n");
    assert_eq!(found.len(), 4);
    assert_eq!((&found[0], &found[1]), (&Record::Rapid, &Record::Blank));
}

#[test]
fn lines_and_columns_count_alike_for_every_line_end() {
    let source = crate::support::text("a\rbb\r\nccc\ndddd");
    assert_eq!(
        [0, 2, 3, 6, 10, 13].map(|at| source.line_column(at)),
        [(1, 1), (2, 1), (2, 2), (3, 1), (4, 1), (4, 4)]
    );
    assert_eq!(source.slice(source.line_span(2).unwrap()), b"bb");
    assert_eq!(source.slice(source.line_span(4).unwrap()), b"dddd");
    assert!(source.line_span(5).is_none() && source.line_span(0).is_none());
}

#[test]
fn junk_after_the_end_is_kept_and_known_to_nobody() {
    // A hand-typed line after END, with the line ends mixed: a real file has it.
    let found = kinds("SPINDL/OFF\nREWIND/0\nEND\r\nYqzk7plm\r\n\n");
    assert_eq!(found[2..], [Record::ProgramEnd, Record::Other, Record::Blank]);
}
