//! What is said when a tool cannot be simulated.

use super::{good, seen, tool};
use crate::support;
use clsmith::diagnostic::Diagnostic;
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Span;

/// The finding about the tool in force at the end of a program, at the program's last line.
#[track_caller]
fn gap(program: &str, setup: &str) -> Diagnostic {
    let setup = if setup.is_empty() { Setup::default() } else { good(setup) };
    let (source, span) = last_line(program);
    setup.resolve_cutter(&tool(program), LengthUnit::Mm).unwrap_err().diagnostic(&source, span)
}

fn last_line(program: &str) -> (std::sync::Arc<clsmith::source::Source>, Span) {
    let source = support::text(program);
    let start = program.trim_end().rfind('\n').map_or(0, |at| at + 1);
    (source, Span::new(start, program.trim_end().len()))
}

#[test]
fn shapes() {
    let found = [
        gap("LOADTL/3\nGOTO/0,0,0\n", ""),
        gap("LOADTL/3\nGOTO/0,0,0\n", "tools:\n  - match: { number: 3 }\n    teeth: 4\n"),
        gap("GOTO/0,0,0\n", ""),
        gap("TOOL PATH/ROUGH,TOOL,IT'S [A]*\nGOTO/0,0,0\n", ""),
        gap("TLDATA/MILL,10.0,6.0,50.0,0.0,0.0\nLOAD/TOOL,1\nGOTO/0,0,0\n", ""),
        gap("TLDATA/MILL,10.0,5.0,3.0,0.0,0.0\nLOAD/TOOL,1\nGOTO/0,0,0\n", ""),
        gap(
            "TLDATA/MILL,10.0,0.0,50.0,-25.0,0.0\nLOAD/TOOL,1\nGOTO/0,0,0\n",
            "tools: [ { match: {}, teeth: 2 } ]",
        ),
        gap(
            "TLDATA/DRILL,MILL,10.0,0.0,90.0,118.0,70.0\nLOAD/TOOL,1\nGOTO/0,0,0\n",
            "tools: [ { match: {}, shank: { diameter: 10, length: 50 } } ]",
        ),
        gap("TLDATA/WEDM,0.2000,25.0000,0.0000\nGOTO/0,0,0\n", ""),
    ];
    seen("shape_gaps", &found);
}

#[test]
fn teeth_and_assumptions() {
    let program = "TLDATA/MILL,10.0,0.0,50.0,0.0,0.0\nLOAD/TOOL,3\nGOTO/0,0,0\n";
    let (source, span) = last_line(program);
    let tool = tool(program);
    let entry = good("tools:\n  - { match: { number: 3 }, holder: { diameter: 40, length: 50 } }\n");
    let resolved = entry.resolve_cutter(&tool, LengthUnit::Mm).unwrap();
    let found = [
        Setup::default().report_missing_teeth(&tool, &source, span),
        entry.report_missing_teeth(&tool, &source, span),
        resolved.note_assumptions(&tool, &source, span).unwrap(),
    ];
    seen("teeth_gaps", &found);
    let all = good("tools: [ { match: {}, flute_length: 50, holder: { diameter: 40, length: 50 } } ]");
    assert!(
        all.resolve_cutter(&tool, LengthUnit::Mm).unwrap().note_assumptions(&tool, &source, span).is_none()
    );
}

#[test]
fn what_the_help_says_to_write_fits_the_tool() {
    for name in ["MILL_10", "IT'S [A]*", "a\\b{c}?", "ä 1"] {
        let program = format!("TOOL PATH/ROUGH,TOOL,{name}\nGOTO/0,0,0\n");
        let help = gap(&program, "").help.unwrap();
        let yaml = help.split('`').nth(3).unwrap().replace('…', "5");
        assert!(good(&yaml).resolve_cutter(&tool(&program), LengthUnit::Mm).is_ok(), "{help}");
    }
}
