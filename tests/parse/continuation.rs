//! `$` at the end of a line: the statement goes on.

use crate::support::{program, text};
use clsmith::diagnostic::codes;
use clsmith::parse::{parse, syntax};
use clsmith::program::record::{Goto, ToolCall};
use clsmith::program::{FieldKind, Record};
use nalgebra::{Point3, Vector3};

fn only(text: &str) -> Record {
    let program = program(text);
    assert_eq!(program.statements().len(), 1, "{text}");
    program.statements()[0].record().clone()
}

#[test]
fn creo_breaks_every_five_axis_goto_in_two_lines() {
    let record = only("GOTO / 288.1640937215, 71.2503418896, 133.5817460029,  $\n0.6, -0.0000004711, 0.8\n");
    let point = Point3::new(288.1640937215, 71.2503418896, 133.5817460029);
    assert_eq!(record, Record::Goto(Goto { point, axis: Some(Vector3::new(0.6, -0.0000004711, 0.8)) }));
}

#[test]
fn text_after_a_single_dollar_is_comment_and_the_statement_goes_on() {
    // Columns 73-80 of a card deck, or a word to the operator.
    let record = only("GOTO/1,2, $TEST0310\n $ columns 73-80, with $ in it\n  3\n");
    assert_eq!(record, Record::Goto(Goto { point: Point3::new(1.0, 2.0, 3.0), axis: None }));
}

#[test]
fn catia_describes_a_mill_in_seventeen_fields_on_four_lines() {
    let toolno = b"TOOLNO/1,MILL,1,0,   10.000000,  100.000000,$\n   50.000000,  100.000000,,   90.000000,,   90.000000,$\n 1000.000000,MMPM,   70.000000,RPM,CLW,$\nON,,NOTE\n";
    let line = syntax(toolno);
    assert_eq!(line.text, toolno);
    assert_eq!(line.fields.len(), 20);
    // The empty arguments keep their places: what follows them is found by counting.
    let empty: Vec<_> = (0..20).filter(|&index| line.fields[index].kind == FieldKind::Empty).collect();
    assert_eq!(empty, [8, 10, 18]);
    assert_eq!(
        Record::read(&line).unwrap(),
        Record::ToolCall(ToolCall { number: 1, loads: false, channel: None })
    );
}

#[test]
fn a_comma_may_stand_on_either_side_of_the_break() {
    let expected = Record::Goto(Goto { point: Point3::new(1.0, 2.0, 3.0), axis: None });
    for goto in
        ["GOTO/1,2$\n,3\n", "GOTO/1,2,$\n3\n", "GOTO/1,2,$\r\n$\r\n  3\r\n", "GOTO$\n/1,2,3", "GOTO/$\n1,2,3"]
    {
        assert_eq!(only(goto), expected, "{goto:?}");
    }
}

#[test]
fn a_long_chain_of_lines_is_one_statement() {
    let mut knots = "KNOT/0.0".to_owned();
    (0..5000).for_each(|_| knots.push_str(",$\n1.0"));
    assert!(matches!(only(&knots), Record::Knot(knots) if knots.len() == 5001));
}

#[test]
fn the_file_may_not_end_in_the_middle_of_a_statement() {
    for cut in [
        "GOTO / 1.0, 2.0, 3.0,  $\n",
        "GOTO/1,2,3,0,0,1,$\n",
        "GOTO/1,2,3,$",
        "FEDRAT/300,MMPM $\r\n",
        "TPRINT/T1,$\n",
    ] {
        let source = text(format!("RAPID\n{cut}"));
        let parsed = parse(&source, None);
        let open: Vec<_> =
            parsed.diagnostics.iter().filter(|found| found.code == codes::CONTINUES_PAST_END).collect();
        assert_eq!(open.len(), 1, "{cut:?}: {:?}", parsed.diagnostics);
        // The label holds the whole statement, without the line end after it.
        assert_eq!(source.slice(open[0].labels[0].span), cut.trim_end().as_bytes(), "{cut:?}");
        assert_eq!(parsed.program.to_bytes(), source.bytes());
    }
}

#[test]
fn a_continuation_that_ends_in_a_blank_line_is_whole() {
    let program = program("GOTO/1,2,3 $\n\nRAPID\n");
    assert_eq!(program.statements().len(), 2);
    assert!(matches!(program.statements()[0].record(), Record::Goto(_)));
}
