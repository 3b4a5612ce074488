//! The source of an APT processor is not CL data: one diagnostic, and the file is kept whole.

use crate::support::{program, text};
use clsmith::diagnostic::codes;
use clsmith::parse::parse;
use clsmith::program::Record;

#[track_caller]
fn assert_refused(source: &str, at: &str) {
    let source = text(source);
    let parsed = parse(&source, None);
    let found: Vec<_> = parsed.diagnostics.iter().map(|found| found.code).collect();
    assert_eq!(found, [codes::APT_PART_PROGRAM]);
    assert_eq!(source.slice(parsed.diagnostics[0].labels[0].span), at.as_bytes());
    assert_eq!(parsed.program.to_bytes(), source.bytes());
    assert_eq!(parsed.program.motions().count(), 0);
}

#[test]
fn geometry_is_defined() {
    assert_refused("PARTNO PLATE\nP1 = POINT/0,0,0\nL1 = LINE/P1,ATANGL,30\nGO/TO,L1\n", "P1 = POINT/0,0,0");
}

#[test]
fn variables_in_lower_case_with_remarks_are_defined() {
    assert_refused(
        "partno pocket\n  outrad  = 8     $$ outer radius\nx=5\n",
        "outrad  = 8     $$ outer radius".trim(),
    );
    assert_refused("x=5\n", "x=5");
}

#[test]
fn macros_and_loops_are_defined() {
    assert_refused("MACHIN/BENCH\nDRL = MACRO/X,Y\nGOTO/X,Y,0\nTERMAC\n", "DRL = MACRO/X,Y");
    assert_refused("loopst\nagn) goto/1,2,3\njump/agn\nloopnd\n", "agn) goto/1,2,3");
}

#[test]
fn arrays_and_continued_definitions_are_one_statement() {
    assert_refused(
        "RESERV/TP,9\nTP(5) = POINT/ $TEST0310\n  1,2,3\nFINI\n",
        "TP(5) = POINT/ $TEST0310\n  1,2,3",
    );
}

#[test]
fn errors_before_the_definition_do_not_add_to_it() {
    assert_refused("GOTO/A,B,C\n?\nR=12.5\n", "R=12.5");
}

#[test]
fn an_equals_sign_in_text_defines_nothing() {
    let program = program(
        "PPRINT X=5\nREMARK MACHID=MACHIN / UNCX05, 1\nINSERT/[HOLDER=C40]\nMACHIN/OPT=3\n$$ a = b\nTOOL PATH/A=B,TOOL,C=D\n",
    );
    assert!(!program.statements().iter().any(|statement| statement.record() == &Record::Definition));
}
