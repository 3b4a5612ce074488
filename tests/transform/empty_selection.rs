//! What is said of a `where` that selects nothing.

use super::apply;

const PART: &str = "TOOL PATH/FACE,TOOL,MILL50
LOAD/TOOL,1
FEDRAT/MMPM,1000.0000
GOTO/0.0000,0.0000,0.0000
END-OF-PATH
TOOL PATH/POCKET,TOOL,MILL10
LOAD/TOOL,3
FEDRAT/MMPM,400.0000
GOTO/9.0000,0.0000,0.0000
GOTO/9.0000,9.0000,0.0000
END-OF-PATH
";

/// Returns the help of the only finding of a step with this `where`.
fn help_for(step: &str, wanted: &str) -> String {
    let (text, findings) = apply(&format!("  - {step}, where: {wanted} }}"), PART);
    assert_eq!(text, PART);
    let [found] = findings.as_slice() else { panic!("{findings:?}") };
    assert_eq!(found.code.id(), "CL0303");
    let help = found.help.clone().unwrap();
    help.strip_suffix(" Write `required: false` into the `where` of a step that may find nothing.")
        .unwrap()
        .to_owned()
}

const SCALE: &str = "scale_feed: { factor: 0.5";

#[test]
fn an_operation_that_does_not_exist_lists_those_that_do_and_the_nearest_name() {
    let expected = "No operation is called `POKET`; did you mean `POCKET`? The program has the operations `FACE`, `POCKET`.";
    assert_eq!(help_for(SCALE, "{ operations: [POKET] }"), expected);
    assert!(help_for(SCALE, "{ operations: ['pocket*'] }").contains("did you mean `POCKET`?"));
    let far = help_for(SCALE, "{ operations: [DRILLING, 'THREAD*'] }");
    assert!(far.starts_with("No operation is called `DRILLING` or `THREAD*`. The program"), "{far}");
    let step = "move_origin: { translate: [1, 0, 0]";
    assert_eq!(help_for(step, "{ operations: [POKET] }"), expected);
    let step = "rewrite: { rules: [ { match: 'LOAD/$...', delete: true } ]";
    assert_eq!(help_for(step, "{ operations: [POKET] }"), expected);
}

#[test]
fn a_tool_that_does_not_exist_lists_those_that_do_by_number_and_name() {
    let found = help_for(SCALE, "{ tools: [2] }");
    assert_eq!(found, "No tool is called `2`. The program has the tools 1 (`MILL50`), 3 (`MILL10`).");
    let found = help_for(SCALE, "{ tools: [MILL11] }");
    assert!(found.starts_with("No tool is called `MILL11`; did you mean `MILL1"), "{found}");
}

#[test]
fn classes_and_feeds_that_do_not_occur_list_those_that_do() {
    let found = help_for(SCALE, "{ motions: [drill] }");
    assert_eq!(found, "No motion is of these classes. The program has the classes cut.");
    let found = help_for(SCALE, "{ feed: { min: 2000 } }");
    assert_eq!(found, "No feed lies in this range: the feeds of the program run from 400 to 1000.");
}

#[test]
fn conditions_that_only_fail_together_are_not_blamed_one_by_one() {
    let found = help_for(SCALE, "{ operations: [FACE], tools: [3] }");
    assert!(found.contains("no motion that the step changes matches all of them"), "{found}");
}

#[test]
fn long_lists_are_shortened() {
    let many: String =
        (1..=12).map(|at| format!("TOOL PATH/OP{at},TOOL,T\nGOTO/{at}.0,0.0,0.0\nEND-OF-PATH\n")).collect();
    let (_, findings) = apply(&format!("  - {SCALE}, where: {{ operations: [X] }} }}"), many);
    let help = findings.iter().find(|found| found.code.id() == "CL0303").unwrap().help.clone().unwrap();
    assert!(help.contains("`OP7`, `OP8` and 4 more. "), "{help}");
}
