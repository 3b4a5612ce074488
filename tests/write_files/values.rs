//! Values that have no text, and numbers that outgrow their column.

use crate::support;
use clsmith::program::{Dialect, StepId};
use clsmith::write::ProgramEditor;

#[test]
fn a_value_too_large_is_an_error() {
    let program = support::program("GOTO/1.0000,2.0000,3.0000\n");
    let goto = program.statement_ids().next().unwrap();
    let mut editor = ProgramEditor::new(program, StepId(0));
    for value in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert!(editor.set_numbers(goto, &[(0, value), (1, 5.0)]).is_err());
    }
    assert_eq!(editor.program().to_bytes(), b"GOTO/1.0000,2.0000,3.0000\n");
}

#[test]
fn a_number_that_outgrows_its_column_does_not_run_into_the_one_before() {
    let text = "CYCLE/DRILL,    3.000000  5.000000\n";
    let program = support::program_of(Dialect::Catia, text);
    let cycle = program.statement_ids().next().unwrap();
    let mut editor = ProgramEditor::new(program, StepId(0));
    editor.set_numbers(cycle, &[(1, -12345.5)]).unwrap();
    assert_eq!(editor.program().to_bytes(), b"CYCLE/DRILL,    3.000000 -12345.500000\n");
}
