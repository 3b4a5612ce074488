//! What a replaced statement looks like.

use super::{by, rules};
use crate::transform::apply;

#[test]
fn only_the_argument_that_differs_changes() {
    let rule = "match: 'FEDRAT/MMPM,$F', if: '$F > 1000', replace: 'FEDRAT/MMPM,1000'";
    assert_eq!(
        by(rule, "FEDRAT/MMPM,1500.0000\nFEDRAT/MMPM,800.0000\n"),
        "FEDRAT/MMPM,1000.0000\nFEDRAT/MMPM,800.0000\n"
    );
    assert_eq!(
        by(rule, "  FEDRAT /MMPM ,$ next\n  1500 $$ fast\n"),
        "  FEDRAT /MMPM ,$ next\n  1000 $$ fast\n"
    );
    assert_eq!(
        by("match: 'SPINDL/RPM,$S,CLW', replace: 'SPINDL/RPM,$S,CCLW'", "SPINDL/RPM,1000,CLW \n"),
        "SPINDL/RPM,1000,CCLW \n"
    );
}

#[test]
fn bound_arguments_are_written_byte_for_byte() {
    let text = "SELECT/TOOL,05.50,ADJUST,+2\n";
    assert_eq!(by("match: 'SELECT/TOOL,$N,ADJUST,$A', replace: 'DELAY/$N,$A'", text), "DELAY/05.50,+2\n");
    assert_eq!(
        by("match: 'SELECT/TOOL,$N,$...R', replace: 'PPRINT T${N}x ($...R) ${R}'", text),
        "PPRINT T05.50x (ADJUST,+2) ADJUST,+2\n"
    );
}

#[test]
fn computed_numbers_keep_their_decimals_or_get_more() {
    let by_factor = |factor: &str| format!("match: 'FEDRAT/$U,$F', replace: 'FEDRAT/$U,${{F * {factor}}}'");
    assert_eq!(by(&by_factor("0.8"), "FEDRAT/MMPM,1000.0000\n"), "FEDRAT/MMPM,800.0000\n");
    assert_eq!(by(&by_factor("0.5"), "FEDRAT/MMPM,1001\n"), "FEDRAT/MMPM,500.5\n");
    assert_eq!(by("match: 'LOADTL/$N', replace: 'LOAD/TOOL,${N + 100}'", "LOADTL/5\n"), "LOAD/TOOL,105\n");
    assert_eq!(
        by("match: 'LOADTL/$N', replace: 'PPRINT ${2 * 3.5} ${''$X''}'", "LOADTL/5\n"),
        "PPRINT 7 $X\n"
    );
    assert_eq!(
        by("match: 'DELAY/$T', replace: 'DELAY/${-($T - 1) / 4 + 2 * 3}'", "DELAY/3.00\n"),
        "DELAY/5.50\n"
    );
}

#[test]
fn an_empty_rest_takes_its_comma_along() {
    let rule = "match: 'LOAD/TOOL,$N,$...REST', replace: 'LOADTL/$N,$...REST'";
    assert_eq!(by(rule, "LOAD/TOOL,5,ADJUST,2\n"), "LOADTL/5,ADJUST,2\n");
    assert_eq!(by(rule, "LOAD/TOOL,5\n"), "LOADTL/5\n");
    assert_eq!(by("match: 'COOLNT/$...A', replace: 'FLUSH/$...A'", "COOLNT\n"), "FLUSH\n");
    assert_eq!(by("match: 'COOLNT/$...A', replace: 'FLUSH/$...A,ON'", "COOLNT\n"), "FLUSH/ON\n");
    assert_eq!(by("match: 'PPRINT TOOL $...A', replace: 'PPRINT T: $...A'", "PPRINT TOOL\n"), "PPRINT T:\n");
}

#[test]
fn another_shape_keeps_indentation_comment_and_line_end() {
    let rule = "match: 'COOLNT/$X', replace: 'COOLNT/FLOOD,$X'";
    assert_eq!(by(rule, "  COOLNT/ON  $$ by hand\r\n"), "  COOLNT/FLOOD,ON  $$ by hand\r\n");
    assert_eq!(by(rule, "COOLNT/ON"), "COOLNT/FLOOD,ON");
    assert_eq!(by("match: COOLNT/ON, replace: PPRINT COOL", "COOLNT/ON $$ x\n"), "PPRINT COOL\n");
    assert_eq!(by("match: COOLNT/ON, replace: 'FLUSH $$ new'", "COOLNT/ON $$ x\n"), "FLUSH $$ new\n");
    assert_eq!(by("match: COOLNT/ON, replace: '$$ none'", "COOLNT/ON \n"), "$$ none\n");
}

#[test]
fn text_and_comments_are_patched_too() {
    assert_eq!(
        by("match: 'PPRINT TOOL: $T', replace: 'PPRINT T=$T'", "PPRINT/TOOL: A 1  \n"),
        "PPRINT/T=A 1  \n"
    );
    assert_eq!(
        by("match: '$$  Start of $...O', replace: '$$ Begin $...O'", "$$  Start of : X\r\n"),
        "$$  Begin : X\r\n"
    );
    assert_eq!(
        by("match: '$$-> CUTTER / $D', replace: '$$-> CUTTER / 12.7'", "$$-> CUTTER / 6.000000\n"),
        "$$-> CUTTER / 12.700000\n"
    );
    assert_eq!(
        by("match: 'TOOL PATH/$O,TOOL,$T', replace: 'TOOL PATH/$O,TOOL,X 1'", "TOOL PATH/A B,TOOL,C\n"),
        "TOOL PATH/A B,TOOL,X 1\n"
    );
}

#[test]
fn deletion_and_insertion_go_together() {
    let rule = "match: COOLNT/ON, delete: true, insert_before: A, insert_after: [B, 'C/1']";
    assert_eq!(by(rule, "X\nCOOLNT/ON\nY\n"), "X\nA\nB\nC/1\nY\n");
    assert_eq!(by("match: 'COOLNT/$X', delete: true", "COOLNT/ON\nX\nCOOLNT/OFF\n"), "X\n");
}

#[test]
fn the_first_rule_that_fits_is_applied_and_only_that() {
    let step = rules(&["match: A, replace: B", "match: B, replace: C", "match: $W, replace: D"]);
    assert_eq!(apply(&step, "A\nB\nC\nA/1\n").0, "B\nC\nD\nA/1\n");
}

#[test]
fn a_block_of_text_may_continue() {
    let step = "  - rewrite:\n      rules:\n        - match: 'COOLNT/ON'\n          replace: |\n            COOLNT/FLOOD,$\n              ON\n";
    assert_eq!(apply(step, "GOTO/1,2,3\r\nCOOLNT/ON\r\n").0, "GOTO/1,2,3\r\nCOOLNT/FLOOD,$\r\n  ON\r\n");
}
