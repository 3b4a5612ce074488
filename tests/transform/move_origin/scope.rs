//! `where`: whole operations move, and the others keep what they relied on.

use super::*;

const TWO: &str = "TOOL PATH/A,TOOL,T
GOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000
GOTO/1.0000,0.0000,0.0000
END-OF-PATH
TOOL PATH/B,TOOL,T
GOTO/0.0000,5.0000,0.0000
GOTO/1.0000,5.0000,0.0000
END-OF-PATH
";

#[test]
fn only_the_selected_operation_changes() {
    let (after, _) =
        apply("  - move_origin: { rotate: { axis: y, degrees: 90 }, where: { operations: [A] } }", TWO);
    let expected = TWO
        .replace(
            "GOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000",
            "GOTO/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000",
        )
        .replace("GOTO/1.0000,0.0000,0.0000", "GOTO/0.0000,0.0000,-1.0000");
    assert_eq!(after, expected);
    let (after, _) =
        apply("  - move_origin: { rotate: { axis: y, degrees: 90 }, where: { operations: [\"[B]\"] } }", TWO);
    let expected = TWO
        .replace("GOTO/0.0000,5.0000,0.0000", "GOTO/0.0000,5.0000,0.0000,1.0000000,0.0000000,0.0000000")
        .replace("GOTO/1.0000,5.0000,0.0000", "GOTO/0.0000,5.0000,-1.0000");
    assert_eq!(after, expected);
}

#[test]
fn an_axis_that_others_inherit_is_written_back() {
    let text = "$$     CATIA APT VERSION 1.0
$$ OPERATION NAME : A
GOTO  /    1.00000,    0.00000,    0.00000
$$ OPERATION NAME : B
RAPID
GOTO  /    2.00000,    0.00000,    0.00000
";
    let (after, _) =
        apply("  - move_origin: { rotate: { axis: y, degrees: 90 }, where: { operations: [A] } }", text);
    let expected = "$$     CATIA APT VERSION 1.0
$$ OPERATION NAME : A
TLAXIS/ 1.000000, 0.000000, 0.000000
GOTO  /    0.00000,    0.00000,   -1.00000
$$ OPERATION NAME : B
TLAXIS/ 0.000000, 0.000000, 1.000000
RAPID
GOTO  /    2.00000,    0.00000,    0.00000
";
    assert_eq!(after, expected);
}

#[test]
fn an_arc_that_starts_in_another_operation_is_refused() {
    let text = TWO.replace(
        "GOTO/0.0000,5.0000,0.0000",
        "CIRCLE/1.0000,2.5000,0.0000,0.0000000,0.0000000,1.0000000,2.5000\nGOTO/0.0000,5.0000,0.0000",
    );
    assert!(refused("{ translate: [1, 0, 0], where: { operations: [B] } }", &text).contains("starts where"));
    let compensated = TWO.replacen("GOTO/1.0000", "CUTCOM/LEFT\nGOTO/1.0000", 1);
    assert!(refused("{ mirror: x, where: { operations: [A] } }", &compensated).contains("compensation"));
    moved("{ translate: [1, 0, 0] }", &text, &Place::identity().translated([1.0, 0.0, 0.0]));
}

#[test]
fn selecting_nothing_is_reported() {
    let (after, findings) =
        apply("  - move_origin: { translate: [1, 0, 0], where: { operations: [C] } }", TWO);
    assert_eq!(after, TWO);
    assert_eq!(findings[0].code.id(), "CL0303");
}
