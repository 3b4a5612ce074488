//! `where`, what is reported, and what the gate refuses.

use super::{rules, shown, stopped};
use crate::support::snapshots;
use crate::transform::apply;

const TWO: &str = "TOOL PATH/ROUGH,TOOL,MILL_20\nLOAD/TOOL,1\nCOOLNT/ON\nGOTO/1.0000,2.0000,3.0000\nEND-OF-PATH\n\
    TOOL PATH/FINISH,TOOL,BALL_6\nLOAD/TOOL,2\nCOOLNT/ON\nGOTO/1.0000,2.0000,3.0000\nEND-OF-PATH\n";

fn in_region(region: &str, rule: &str) -> (String, Vec<clsmith::diagnostic::Diagnostic>) {
    apply(&format!("  - rewrite:\n      where: {region}\n      rules:\n        - {{ {rule} }}\n"), TWO)
}

#[test]
fn operations_and_tools_choose_statements() {
    let rule = "match: COOLNT/ON, replace: COOLNT/MIST";
    let (first, last) = TWO.split_at(TWO.find("TOOL PATH/FINISH").unwrap());
    let mist = |text: &str| text.replace("COOLNT/ON", "COOLNT/MIST");
    for region in [
        "{ operations: [FIN*] }",
        "{ tools: [2] }",
        "{ tools: ['BALL*'] }",
        "{ operations: ['*'], tools: [2] }",
    ] {
        let (text, findings) = in_region(region, rule);
        assert_eq!(text, [first, &mist(last)].concat(), "{region}");
        assert!(findings.is_empty());
    }
    assert_eq!(in_region("{ operations: [ROUGH] }", rule).0, [&mist(first), last].concat());
    // A LOAD belongs to the tool that it loads.
    let (text, _) = in_region("{ tools: [1] }", "match: 'LOAD/TOOL,$N', insert_after: STOP");
    assert_eq!(text, TWO.replace("TOOL,1\n", "TOOL,1\nSTOP\n"));
    assert_eq!(in_region("{}", rule).0, mist(TWO));
}

#[test]
fn what_finds_nothing_says_so() {
    let mut text = String::new();
    for (region, rule) in [
        ("{ operations: [POCKET] }", "match: COOLNT/ON, delete: true"),
        ("{ tools: [7] }", "match: COOLNT/ON, delete: true"),
        ("{ tools: [1] }", "match: 'COOLNT/FLOOD', delete: true"),
    ] {
        let (unchanged, findings) = in_region(region, rule);
        assert_eq!(unchanged, TWO);
        text += &findings.iter().map(shown).collect::<String>();
    }
    let (_, findings) =
        apply(&rules(&["match: 'COOLNT/$...', delete: true", "match: COOLNT/ON, replace: X"]), TWO);
    text += &findings.iter().map(shown).collect::<String>();
    snapshots("rewrite").bind(|| insta::assert_snapshot!("nothing", text));
    // A condition that is never true has found nothing to correct.
    let (_, findings) = apply(&rules(&["match: 'LOAD/TOOL,$N', if: '$N > 5', delete: true"]), TWO);
    assert!(findings.is_empty());
}

#[test]
fn what_is_no_statement_is_refused_at_the_rule() {
    let mut text = String::new();
    for (rule, program) in [
        ("match: 'PPRINT $T', replace: 'GOTO/$T'", "PPRINT 1,2\n"),
        ("match: 'PPRINT $T', insert_before: [STOP, 'GOTO/$T']", "PPRINT 1,2\n"),
        ("match: 'PPRINT $T', insert_after: 'LOAD/TOOL,$T'", "PPRINT 1.5\n"),
        ("match: 'FROM/$...A', replace: 'PPRINT $...A'", "FROM/1,2,$\n3\n"),
        ("match: 'GOTO/$...', insert_after: STOP", "GOTO/1,2,3\n4,5,6\n"),
        ("match: 'GOTO/$...', delete: true", "GOTO/1,2,3\n\nGOTO/1,2,3\n4,5,6\n"),
    ] {
        text += &shown(&stopped(&rules(&[rule]), program));
    }
    snapshots("rewrite").bind(|| insta::assert_snapshot!("refused", text));
}

#[test]
fn points_may_change_with_the_numbers_that_go_on() {
    let (text, _) = apply(
        &rules(&["match: 'GOTO/$X,$Y,$Z', replace: 'GOTO/$X,$Y,9', insert_before: STOP"]),
        "GOTO/1,2,3\n4,5,6\n",
    );
    assert_eq!(text, "STOP\nGOTO/1,2,9\n4,5,6\n");
}

#[test]
fn statements_of_earlier_steps_are_seen() {
    let steps = [
        rules(&["match: A, replace: B, insert_after: 'C/1.5'"]),
        rules(&["match: B, delete: true", "match: 'C/$X', replace: 'C/${X * 3}'"]),
    ];
    assert_eq!(apply(&steps.concat(), "A\nD\n").0, "C/4.5\nD\n");
}

#[test]
fn the_schema_describes_the_rules() {
    let schema = clsmith::transform::schema_of("rewrite").unwrap().to_value().to_string();
    for key in ["match", "insert_before", "operations", "idempotent", "$...NAME"] {
        assert!(schema.contains(key), "{key}");
    }
}
