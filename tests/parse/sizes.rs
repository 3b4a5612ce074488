//! Nothing, and very much of it: time and stack stay in bounds whatever a file holds.

use crate::support::{text, within_seconds};
use clsmith::parse::parse;
use clsmith::program::Record;

/// Reads and writes back a text and takes its motions; gives the records.
#[track_caller]
fn read(bytes: impl AsRef<[u8]>) -> Vec<Record> {
    // Linear work takes a second at most; quadratic work on a megabyte takes hours.
    let parsed = within_seconds(20.0, || {
        let source = text(bytes);
        let parsed = parse(&source, None);
        assert_eq!(parsed.program.to_bytes(), source.bytes());
        parsed.program.motions().for_each(drop);
        parsed
    });
    parsed.program.statements().iter().map(|statement| statement.record().clone()).collect()
}

#[test]
fn an_empty_file_is_an_empty_program() {
    assert!(read("").is_empty());
    assert_eq!(read("\n"), [Record::Blank]);
    assert_eq!(read(" "), [Record::Blank]);
    assert_eq!(read("\r"), [Record::Blank]);
    assert_eq!(read(b"\xEF\xBB\xBF"), [Record::ByteOrderMark]);
    assert_eq!(read("\0"), [Record::Unparsed]);
}

const MEGABYTE: usize = 1 << 20;

#[test]
fn a_line_of_a_megabyte_is_one_statement() {
    for (line, unit) in [
        ("PPRINT ", "x"),
        ("$$ ", "x y "),
        ("KNOT/0", ",1"),
        ("MACHIN/A", " B"),
        ("X/", ","),
        ("", "x"),
        ("", " "),
    ] {
        let found = read(format!("{line}{}\nRAPID\n", unit.repeat(MEGABYTE / unit.len())));
        assert_eq!(found.len(), 2, "{line}{unit}");
        assert_eq!(found[1], Record::Rapid);
    }
}

#[test]
fn fields_without_commas_are_read_however_many_there_are() {
    // Not refused either: what a statement means must not hang on the stack of the thread that reads it.
    for unit in ["1 ", "'a' ", "(A/1) "] {
        let found = read(format!("MACHIN/{}\nRAPID\n", unit.repeat(MEGABYTE / 4 / unit.len())));
        assert_eq!(found, [Record::Known, Record::Rapid], "{unit}");
    }
}

#[test]
fn parentheses_without_end_do_not_exhaust_the_stack() {
    for unit in ["(", "(A/", "(A/(", "TLON,GOFWD/(", "((1)"] {
        assert_eq!(
            read(format!("TLON/{}\nRAPID\n", unit.repeat(MEGABYTE / 4 / unit.len())))[1],
            Record::Rapid,
            "{unit}"
        );
    }
    let nested = |depth: usize| read(format!("TLON/{}1{}\nRAPID\n", "(A/".repeat(depth), ")".repeat(depth)));
    assert_eq!(nested(3), [Record::Other, Record::Rapid]);
    for depth in [4, 1000, 50_000] {
        assert_eq!(nested(depth), [Record::Unparsed, Record::Rapid], "{depth}");
    }
}

#[test]
fn a_statement_of_a_hundred_thousand_lines_is_read_in_time() {
    assert_eq!(read(format!("KNOT/1{}\nRAPID\n", ",$\n1".repeat(100_000))).len(), 2);
    assert_eq!(read(format!("?{}\nRAPID\n", "$\n1".repeat(100_000))).len(), 2);
}

#[test]
fn a_statement_of_very_many_points_is_read() {
    let points = 160_000;
    for (blank, comment) in [(" ", ""), ("", " $$ points")] {
        let lines: Vec<String> = (0..points).map(|x| format!("{}.0000,0.0000,1.0000", x % 900)).collect();
        let found = codes(format!("GOTO/{}{comment}\nRAPID\n", lines.join(&format!(",{blank}$\n"))));
        assert_eq!(found, (vec![], 2), "{blank:?} {comment:?}");
    }
}

#[test]
fn many_broken_lines_are_read_in_time() {
    assert_eq!(read("?(\n".repeat(20_000)).len(), 20_000);
    assert_eq!(read("GOTO/1,2\n".repeat(20_000)).len(), 20_000);
    assert_eq!(read("\r".repeat(200_000)).len(), 200_000);
}

#[test]
fn a_spline_of_very_many_points_is_measured_in_time() {
    let knots: String = (1..=20_000).map(|knot| format!("KNOT/{knot}\n")).collect();
    let controls: String = (0..20_002).map(|x| format!("CNTRL/{x},0,0\n")).collect();
    let source = text(format!("GOTO/0,0,0\nNURBS/\n{knots}{controls}"));
    let program = parse(&source, None).program;
    let length = within_seconds(10.0, || program.motions().last().unwrap().length());
    assert!((length - 20_001.0).abs() < 1.0, "{length}");
}

#[test]
fn a_statement_beyond_all_measure_is_refused_before_it_fills_the_memory() {
    let line = format!("FOO/{}\n", "1 ".repeat(1_500_000));
    let parsed = clsmith::parse::parse(&crate::support::text(format!("RAPID\n{line}GOTO/1,2,3\n")), None);
    assert_eq!(parsed.diagnostics.iter().map(|found| found.code.id()).collect::<Vec<_>>(), ["CL0001"]);
    assert_eq!(parsed.program.statements().len(), 3);
}

/// Long files are read in parts, in two threads. A part may end anywhere among points and lines of bare numbers.
#[test]
fn a_long_file_is_read_as_its_pieces_are() {
    let mut piece = String::new();
    for line in 0..400 {
        piece += match line % 23 {
            0 => "$$ a comment\n",
            5 => "FEDRAT/MMPM,800.\n",
            9 => "CIRCLE/0,0,0,0,0,1,5, $\n4\n",
            _ if line < 200 => "4.0, 5.0, 6.0, $\n7.0, 8.0, 9.0\n",
            _ => "GOTO/1.0,2.0,3.0\n",
        };
        if line % 23 < 10 {
            piece += "GOTO/1.0,2.0,3.0,4.0,5.0,6.0\n";
        }
    }
    let one = read(&piece);
    assert!(!one.contains(&Record::Unparsed));
    for megabytes in [1, 3, 20] {
        let times = megabytes * MEGABYTE / piece.len() + 1;
        let all = read(piece.repeat(times));
        assert_eq!(all.len(), times * one.len());
        assert!(all.chunks(one.len()).all(|part| part == one), "{megabytes}");
    }
}

/// The codes of findings, and how many statements there are.
fn codes(bytes: String) -> (Vec<&'static str>, usize) {
    let parsed = within_seconds(20.0, || parse(&text(bytes), None));
    (parsed.diagnostics.iter().map(|found| found.code.id()).collect(), parsed.program.statements().len())
}

/// Neither what stands behind a statement nor how plainly it is written decides whether it is too long.
#[test]
fn a_statement_is_too_long_by_its_own_length() {
    let knots = |count: usize| format!("KNOT/1.0000{}", ",1.0000".repeat(count));
    for (count, expected) in [(1_000_000, &[] as &[_]), (1_100_000, &["CL0001"])] {
        for end in ["\n", "\t\n", " $$ knots\n"] {
            let found = codes(format!("RAPID\n{}{end}GOTO/1,2,3\nRAPID\n", knots(count)));
            assert_eq!((found.0.as_slice(), found.1), (expected, 4), "{count} {end:?}");
        }
    }
    for (blanks, expected) in [(16_000_000, &[] as &[_]), (17_000_000, &["CL0001"])] {
        for end in ["\n", "\t\n"] {
            let found = codes(format!("RAPID\nGOTO/1,{}2,3{end}RAPID\n", " ".repeat(blanks)));
            assert_eq!((found.0.as_slice(), found.1), (expected, 3), "{blanks} {end:?}");
        }
    }
}

/// The window of lines that is given to the grammar doubles, and may reach over the limit where the statement does not.
#[test]
fn a_long_statement_takes_no_other_statement_with_it() {
    let gotos = "GOTO/1.0000,2.0000,3.0000\n".repeat(60_000);
    // Of every line a comma, a blank and the end count as fields.
    for (lines, expected) in [(300_000, &[] as &[_]), (400_000, &["CL0001"])] {
        let found = codes(format!("RAPID\nKNOT/1.0{}\n{gotos}", ",$ c\n1.000000".repeat(lines)));
        assert_eq!((found.0.as_slice(), found.1), (expected, 60_002), "{lines}");
    }
}
