//! Values that have no text, and numbers that outgrow their column.

use crate::support;
use clsmith::program::{Dialect, StepId};
use clsmith::write::Editor;

#[test]
fn a_value_too_large_is_an_error() {
    let mut editor = Editor::new(support::program("GOTO/1.0000,2.0000,3.0000\n"), StepId(0));
    for value in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
        assert!(editor.set_numbers(0, &[(0, value), (1, 5.0)]).is_err());
    }
    assert_eq!(editor.program().to_bytes(), b"GOTO/1.0000,2.0000,3.0000\n");
}
