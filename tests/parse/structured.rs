//! Records that Creo hides in comments: `$$->`, and `REMARK ->` in the G-POST input.

use crate::support::program;
use clsmith::program::operation::{find_operations, operation_name};
use clsmith::program::record::{FrameWord, ToolWord};
use clsmith::program::{Record, Statement};

const CSYS: &str = "$$-> CSYS / 0.0000000000, -1.0000000000, 0.0000000000, 10.0000000000,  $\n            1.0000000000, 0.0000000000, 0.0000000000, 20.0000000000,  $\n            0.0000000000, 0.0000000000, 1.0000000000, 30.0000000000\n";

#[test]
fn a_frame_goes_on_over_three_comment_lines() {
    // A reader that drops `$$` lines would read two lines of bare numbers as points.
    let program = program(format!("{CSYS}MULTAX / ON\n"));
    assert_eq!(program.statements().len(), 2);
    let Record::Frame(frame) = program.statements()[0].record() else { panic!() };
    assert_eq!(frame.word, FrameWord::Csys);
    assert_eq!(frame.numbers, [0.0, -1.0, 0.0, 10.0, 1.0, 0.0, 0.0, 20.0, 0.0, 0.0, 1.0, 30.0]);
}

#[test]
fn the_tool_and_the_features_stand_nowhere_else() {
    let text = "$$-> MFGNO / MFG0031\n$$-> FEATNO / 2021\n$$-> CUTTER / 0.500000\n$$-> CUTCOM_GEOMETRY_TYPE / OUTPUT_ON_CENTER\n$$-> END / \n$$-> FEATNO / 2044\n$$-> END / \n";
    let program = program(text);
    let records: Vec<_> = program.statements().iter().map(Statement::record).collect();
    assert_eq!(records[0], &Record::Known);
    assert!(
        matches!(records[2], Record::ToolData(data) if data.word == ToolWord::CreoCutter && data.diameter == Some(0.5))
    );
    assert_eq!((records[3], records[4]), (&Record::Known, &Record::OperationEnd));
    let names: Vec<_> = find_operations(&program).into_iter().map(|found| found.name).collect();
    assert_eq!(names, ["2021", "2044"]);
}

#[test]
fn gpost_writes_the_same_records_as_remarks() {
    let program = program(
        "REMARK -> FEATNO / 2021\nREMARK -> CUTTER / 6.000000\nREMARK -> END /\nREMARK -> hand text\n",
    );
    let records: Vec<_> = program.statements().iter().map(Statement::record).collect();
    assert_eq!(operation_name(&program, &program.statements()[0]).unwrap(), "2021");
    assert!(matches!(records[1], Record::ToolData(data) if data.diameter == Some(6.0)));
    assert_eq!((records[2], records[3]), (&Record::OperationEnd, &Record::Comment));
}

#[test]
fn camera_is_indented_and_broken_over_five_lines() {
    let camera = "    CAMERA/ 1.0000000000, 0.0000000000, 0.0000000000, -106.6093750000,$\n     0.0000000000, 1.0000000000, 0.0000000000,$\n     -121.2812500000, 0.0000000000,$\n     0.0000000000, 1.0000000000,$\n     -100.5937500000\n";
    let program = program(camera);
    let Record::Frame(frame) = program.statements()[0].record() else { panic!() };
    assert_eq!((frame.word, frame.numbers[3], frame.numbers[11]), (FrameWord::Csys, -106.609375, -100.59375));
}

#[test]
fn an_unknown_structured_record_stays_a_comment() {
    let program = program("$$-> PALLET / 4, 'x'\n$$-> note to the operator\n");
    assert!(program.statements().iter().all(|statement| statement.record() == &Record::Comment));
}
