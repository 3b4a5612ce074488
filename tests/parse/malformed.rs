//! What cannot be read: one diagnostic with its place, and the next statement is read as if nothing had been.

use crate::support::text;
use clsmith::diagnostic::{DiagnosticCode, codes};
use clsmith::parse::parse;
use clsmith::program::Record;

/// The line stands between two good ones; `at` is the text that the label shows.
#[track_caller]
fn assert_one(line: &str, code: DiagnosticCode, at: &str) {
    let source = text(format!("GOTO/1,2,3\n{line}\nGOTO/4,5,6\n"));
    let parsed = parse(&source, None);
    let found: Vec<_> = parsed
        .diagnostics
        .iter()
        .map(|found| (found.code, String::from_utf8_lossy(source.slice(found.labels[0].span)).into_owned()))
        .collect();
    assert_eq!(found, [(code, at.to_owned())], "{line:?}");
    let records: Vec<_> = parsed.program.statements().iter().map(|statement| statement.record()).collect();
    assert_eq!(records.len(), 3, "{line:?}");
    assert_eq!(records[1], &Record::Unparsed);
    assert!(matches!(records[2], Record::Goto(goto) if goto.point.x == 4.0));
    assert_eq!(parsed.program.to_bytes(), source.bytes());
}

#[test]
fn unclosed_parentheses_and_quotes_cannot_be_read() {
    assert_one("TLON,GOFWD/(CIRCLE/1,2,3,4,ON", codes::MALFORMED, "ON");
    assert_one("PARTS/'bracket", codes::MALFORMED, "'bracket");
    assert_one("SYN/'a','b", codes::MALFORMED, "'b");
}

#[test]
fn lines_that_start_with_punctuation_cannot_be_read() {
    for line in ["/1,2,3", "?", ",1,2", "-", "%", "(comment)", "{", "\"x\"", "*"] {
        assert_one(line, codes::MALFORMED, line);
    }
}

#[test]
fn a_broken_statement_takes_its_continued_lines_with_it() {
    assert_one("PARTS/'bracket,$\n  5,6,$ more\n 7", codes::MALFORMED, "'bracket,$\n  5,6,$ more\n 7");
}

#[test]
fn a_known_word_with_the_wrong_count_is_reported_whole() {
    assert_one("GOTO/1,2", codes::BAD_ARGUMENTS, "GOTO/1,2");
    assert_one("GOTO/1,2,3,4", codes::BAD_ARGUMENTS, "GOTO/1,2,3,4");
    assert_one("GOTO/1,2,3,4,5", codes::BAD_ARGUMENTS, "GOTO/1,2,3,4,5");
    assert_one("FROM/1,2", codes::BAD_ARGUMENTS, "FROM/1,2");
    assert_one("CIRCLE/0,0,0,0,0", codes::BAD_ARGUMENTS, "CIRCLE/0,0,0,0,0");
    assert_one("MSYS/0,0,0,1,0,0", codes::BAD_ARGUMENTS, "MSYS/0,0,0,1,0,0");
    assert_one("FEDRAT/MMPM", codes::BAD_ARGUMENTS, "FEDRAT/MMPM");
    assert_one("KNOT", codes::BAD_ARGUMENTS, "KNOT");
    assert_one("INDIRV/1,0", codes::BAD_ARGUMENTS, "INDIRV/1,0");
    assert_one("UNITS/FURLONGS", codes::BAD_ARGUMENTS, "UNITS");
    assert_one("TLDATA/MILL,10.0", codes::BAD_ARGUMENTS, "TLDATA/MILL,10.0");
    assert_one("RAPID/FAST", codes::BAD_ARGUMENTS, "RAPID/FAST");
}

#[test]
fn a_field_that_is_no_number_is_reported_alone() {
    assert_one("GOTO/1.0,2.O,3.0", codes::BAD_NUMBER, "2.O");
    assert_one("GOTO/1,2.5.0,3", codes::BAD_NUMBER, "2.5.0");
    assert_one("GOTO/1,,3", codes::BAD_NUMBER, "");
    assert_one("GOTO/1,2,1E999", codes::BAD_NUMBER, "1E999");
    assert_one("GOTO / 1.0, 2.0, 3.0,  $\n0.0, 0.0, l.0", codes::BAD_NUMBER, "l.0");
    assert_one("FEDRAT/1O00,MMPM", codes::BAD_NUMBER, "1O00");
    assert_one("SPINDL/RPM,10.0.0,CLW", codes::BAD_NUMBER, "10.0.0");
    assert_one("CIRCLE/0,0,0,0,0,1,R5", codes::BAD_NUMBER, "R5");
    assert_one("MOVARC/0,0,0,0,0,1,5,ANGLE,X", codes::BAD_NUMBER, "X");
    assert_one("CIRCLE/0,0,0,0,0,1,5,TIMES,two", codes::BAD_NUMBER, "two");
}

#[test]
fn an_infinite_nan_or_hexadecimal_coordinate_is_no_number() {
    for value in ["NaN", "inf", "-inf", "INFINITY", "0x10", "1_000", "٣"] {
        assert_one(&format!("GOTO/1,2,{value}"), codes::BAD_NUMBER, value);
    }
}

#[test]
fn values_that_no_machine_can_take_are_reported() {
    assert_one("FEDRAT/-100,MMPM", codes::BAD_ARGUMENTS, "-100");
    assert_one("CIRCLE/0,0,0,0,0,0,5", codes::BAD_ARGUMENTS, "0,0,0");
    assert_one("CIRCLE/0,0,0,0,0,1,5,TIMES,0", codes::BAD_ARGUMENTS, "0");
    assert_one("CIRCLE/0,0,0,0,0,1,5,TIMES,1.5", codes::BAD_ARGUMENTS, "1.5");
    assert_one("CIRCLE/0,0,0,0,0,1,5,TIMES", codes::BAD_ARGUMENTS, "TIMES");
    assert_one("LOADTL/1.5", codes::BAD_ARGUMENTS, "LOADTL/1.5");
    assert_one("LOADTL/-1", codes::BAD_ARGUMENTS, "LOADTL/-1");
    // A tool axis without direction: every post would divide by its length.
    assert_one("GOTO/1,2,3,0,0,0", codes::BAD_ARGUMENTS, "0,0,0");
    assert_one("FROM/1,2,3,0.0,-0.0,0", codes::BAD_ARGUMENTS, "0.0,-0.0,0");
    assert_one("TLAXIS/0,0,0", codes::BAD_ARGUMENTS, "0,0,0");
    assert_one("GOTO/1,2,3,0,0,1E200", codes::BAD_ARGUMENTS, "0,0,1E200");
}

#[test]
fn unknown_words_are_no_error() {
    let source = text("FROBNICATE/1,A,'x'\nT100\nM3 S500\nN10 G1 X5.0\n");
    let parsed = parse(&source, None);
    assert!(parsed.diagnostics.is_empty(), "{:?}", parsed.diagnostics);
    assert!(parsed.program.statements().iter().all(|statement| statement.record() == &Record::Other));
}

/// DOS programs end a text with the byte 1A.
#[test]
fn the_end_mark_of_dos_is_a_blank_line() {
    for end in ["\u{1A}", "\r\n\u{1A}", "\u{1A}\r\n", " \u{1A}\u{1A}"] {
        let source = text(format!("RAPID\r\nGOTO/1,2,3\r\n{end}"));
        let parsed = parse(&source, None);
        assert!(parsed.diagnostics.is_empty(), "{end:?}: {:?}", parsed.diagnostics);
        assert_eq!(parsed.program.to_bytes(), source.bytes(), "{end:?}");
    }
}
