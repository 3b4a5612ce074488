//! What is not sound is refused, with its place and reason.

use super::*;

#[test]
fn parameters() {
    assert!(refused("{}", NX).contains("none of"));
    for (settings, expected) in [
        ("{ rotate: { axis: [0, 0, 0], degrees: 1 } }", "no direction"),
        ("{ rotate: { axis: w, degrees: 1 } }", "`x`, `y`, `z`"),
        ("{ mirror: { through: [0, 0, 0] } }", "normal"),
        ("{ mirror: 3 }", "`normal` and `through`"),
        ("{ translate: [1, 2] }", "3"),
        ("{ translate: [1, 2, 3], where: { tools: [1] } }", "tools"),
        ("{ translate: [1, 2, 3], change: both }", "both"),
    ] {
        let found = try_apply(&format!("version: 1\nsteps:\n  - move_origin: {settings}"), NX).unwrap_err();
        assert!(found[0].message.contains(expected), "{settings}: {}", found[0].message);
    }
}

#[test]
fn a_mirror_that_turns_the_tool_over() {
    for text in [SOLIDWORKS, MAKINO, CREO] {
        let message = refused("{ mirror: z }", text);
        assert!(message.contains("normal to the tool axis") || message.contains("CSYS"), "{message}");
    }
    assert!(refused("{ mirror: z }", CAMWORKS).contains("tilts z"));
    // With a half turn the tool stands again as it did.
    let place =
        Place::identity().mirrored([0.0, 0.0, 1.0], [0.0; 3]).rotated([1.0, 0.0, 0.0], 180.0, [0.0; 3]);
    for text in [SOLIDWORKS, CAMWORKS, MAKINO] {
        let (after, _) = moved("{ mirror: z, rotate: { axis: x, degrees: 180 } }", text, &place);
        assert_eq!(after, apply("  - move_origin: { mirror: y }", text).0);
    }
}

#[test]
fn turns_that_the_records_cannot_follow() {
    let tilt = "{ rotate: { axis: x, degrees: 90 } }";
    assert!(refused(tilt, SOLIDWORKS).contains("third column"));
    assert!(refused(tilt, CAMWORKS).contains("tilts z"));
    assert!(refused(tilt, &NX.replace("CUTCOM/LEFT", "CUTCOM/LEFT,XYPLAN")).contains("CUTCOM names"));
    assert!(
        refused(
            "{ mirror: z, rotate: { axis: z, degrees: 90 } }",
            &NX.replace("CUTCOM/LEFT", "CUTCOM/LEFT,XYPLAN")
        )
        .contains("CUTCOM names")
    );
    let no_from = MAKINO.replace("FROM/0.0000000,0.0000000,50.0000000,0.0000000,0.0000000,1.0000000\n", "");
    assert!(refused(tilt, &no_from).contains("cannot state one"));
    let ignored = CATIA.replace("PARTNO PART\n", "PARTNO PART\nSYN/'TLAXIS','$$*TLAXIS'\n");
    assert!(refused(tilt, &ignored).contains("ignore TLAXIS"));
    let unknown = CATIA.replace("TLON,GOFWD/      (CIRCLE/", "TLON,GOFWD/      (CONE/");
    assert!(refused("{ translate: [1, 0, 0] }", &unknown).contains("does not understand"));
}

#[test]
fn camworks_setups_do_not_move_together() {
    let second = CAMWORKS
        .replace("FINI", "TLAXIS/ 0.000000,0.000000,1.000000 \nGOTO/ 1.000000,1.000000,1.000000 \nFINI");
    assert!(refused("{ translate: [1, 0, 0] }", &second).contains("frame of its own"));
}

#[test]
fn an_arc_whose_ends_would_round_together() {
    let text = "TOOL PATH/A,TOOL,T
GOTO/3.3333,0.0000,0.0000,0.0000000,0.0000000,1.0000000
CIRCLE/3.3333,5.0000,0.0000,0.0000000,0.0000000,-1.0000000,5.0000,0.0600,0.5000,0.0000,0.0000
GOTO/3.3334,0.0000,0.0000
END-OF-PATH
";
    let mut rounded_away = 0;
    for degrees in 1..90 {
        let step = format!("{{ rotate: {{ axis: z, degrees: {degrees} }} }}");
        match try_apply(&format!("version: 1\nsteps:\n  - move_origin: {step}"), text) {
            Ok((after, _)) => {
                let length: f64 = support::program(after).motions().map(|motion| motion.length()).sum();
                assert!(length < 0.01, "{degrees}: {length}");
            }
            Err(found) => {
                assert!(found[0].message.contains("full turn"), "{}", found[0].message);
                rounded_away += 1;
            }
        }
    }
    assert!(rounded_away > 0);
}
