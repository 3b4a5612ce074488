//! Insertions, and that they are made once.

use super::rules;
use crate::transform::apply;

/// Applies twice; the second time must change nothing.
#[track_caller]
fn once(rule_texts: &[&str], text: &str) -> String {
    let (done, _) = apply(&rules(rule_texts), text);
    assert_eq!(apply(&rules(rule_texts), &done).0, done, "a second run changes nothing more");
    done
}

#[test]
fn statements_go_before_and_behind() {
    let rule = "match: 'LOAD/TOOL,$N,$...REST', insert_before: STOP, insert_after: ['PPRINT/TOOL $N', 'COOLNT/FLOOD']";
    assert_eq!(
        once(&[rule], "A\nLOAD/TOOL,3,ADJUST,3 \nB\n"),
        "A\nSTOP\nLOAD/TOOL,3,ADJUST,3 \nPPRINT/TOOL 3\nCOOLNT/FLOOD\nB\n"
    );
}

#[test]
fn what_stands_there_is_not_inserted_however_it_is_spelt() {
    let rule = "match: 'LOADTL/$N', insert_before: [STOP, 'DELAY/2'], insert_after: 'COOLNT/ON'";
    let text = "stop $$ by hand\nDELAY / 2.000\nLOADTL/1\n  COOLNT/on\n";
    assert_eq!(once(&[rule], text), text);
    // In another order it is another thing.
    assert_eq!(
        once(&[rule], "DELAY/2\nSTOP\nLOADTL/1\nCOOLNT/ON\n"),
        "DELAY/2\nSTOP\nSTOP\nDELAY/2\nLOADTL/1\nCOOLNT/ON\n"
    );
}

#[test]
fn a_last_line_without_line_end_stays_last() {
    assert_eq!(once(&["match: FINI, insert_before: 'STOP'"], "A\nFINI"), "A\nSTOP\nFINI");
    assert_eq!(once(&["match: FINI, insert_after: 'END'"], "A\r\nFINI").replace('\r', ""), "A\nFINI\nEND");
}

#[test]
fn neighbours_are_seen_as_this_step_leaves_them() {
    // What the first rule deletes does not count as standing there.
    let delete_then_insert =
        ["match: COOLNT/OFF, delete: true", "match: 'LOADTL/$N', insert_after: COOLNT/OFF"];
    let (text, _) = apply(&rules(&delete_then_insert), "LOADTL/1\nCOOLNT/OFF\nX\n");
    assert_eq!(text, "LOADTL/1\nCOOLNT/OFF\nX\n");
    // What it replaces counts as what it becomes.
    let replace_and_insert =
        ["match: 'COOLNT/$X', replace: COOLNT/ON", "match: 'LOADTL/$N', insert_after: COOLNT/ON"];
    assert_eq!(once(&replace_and_insert, "LOADTL/1\nCOOLNT/OFF\n"), "LOADTL/1\nCOOLNT/ON\n");
    assert_eq!(once(&replace_and_insert, "LOADTL/1\nX\n"), "LOADTL/1\nCOOLNT/ON\nX\n");
}

#[test]
fn a_rule_does_not_feed_on_what_it_inserts() {
    assert_eq!(
        once(&["match: 'PPRINT $...', insert_before: 'PPRINT ----'"], "PPRINT A\n"),
        "PPRINT ----\nPPRINT A\n"
    );
    assert_eq!(once(&["match: A, insert_after: X", "match: B, insert_before: X"], "A\nB\n"), "A\nX\nX\nB\n");
}

#[test]
fn replacing_is_idempotent_when_the_result_no_longer_fits() {
    once(&["match: 'FEDRAT/MMPM,$F', if: '$F > 1000', replace: 'FEDRAT/MMPM,1000'"], "FEDRAT/MMPM,2000.0\n");
    once(&["match: 'COOLNT/ON', replace: 'COOLNT/FLOOD,ON'"], "COOLNT/ON\n");
    once(&["match: 'RAPID', delete: true"], "RAPID\nGOTO/1,2,3\n");
}
