//! scale_feed and clamp_feed.

use super::{apply, try_apply};

const NX: &str = "TOOL PATH/A,TOOL,T1
PAINT/COLOR,42
FEDRAT/MMPM,1000.0000
GOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000
GOTO/0.0000,0.0000,-1.0000
PAINT/COLOR,31
CIRCLE/5.0000,0.0000,-1.0000,0.0000000,0.0000000,1.0000000,5.0000,0.0600,0.5000,10.0000,0.0000
GOTO/10.0000,0.0000,-1.0000
RAPID
GOTO/10.0000,0.0000,5.0000
GOTO/20.0000,0.0000,5.0000
END-OF-PATH
";

#[test]
fn the_whole_program_is_scaled_in_place() {
    let (text, findings) = apply("  - scale_feed: { factor: 0.8 }", NX);
    assert_eq!(text, NX.replace("1000.0000", "800.0000"));
    assert!(findings.is_empty());
}

#[test]
fn a_selected_class_gets_its_own_feedrats_and_the_programmed_feed_comes_back() {
    let (text, _) = apply("  - scale_feed: { factor: 0.5, where: { motions: [engage] } }", NX);
    let expected =
        NX.replace("MMPM,1000.0000", "MMPM,500.0000").replace("CIRCLE/", "FEDRAT/MMPM,1000.0000\nCIRCLE/");
    assert_eq!(text, expected);
}

#[test]
fn clamping_twice_changes_nothing_more() {
    let step = "  - clamp_feed: { min: 100, max: 640.5 }";
    let (once, _) = apply(step, NX);
    assert_eq!(once, NX.replace("1000.0000", "640.5000"));
    assert_eq!(apply(step, &once).0, once);
}

#[test]
fn a_limit_must_come_from_somewhere() {
    let found = try_apply("version: 1\nsteps:\n  - clamp_feed: {}", NX).unwrap_err();
    assert_eq!(found[0].code.id(), "CL0302");
    assert!(
        found[0].message.contains("`max: 3000`") && found[0].message.contains("max_feed: 10000"),
        "{found:?}"
    );
    let machine = "version: 1\nsetup: { machine: { max_feed: 700 } }\nsteps:\n  - clamp_feed: {}";
    assert!(try_apply(machine, NX).unwrap().0.contains("FEDRAT/MMPM,700.0000"));
}

#[test]
fn a_recipe_without_units_and_a_program_in_inches_are_brought_together_aloud() {
    let part = "UNITS/INCHES\nFEDRAT/100.0,IPM\nGOTO/0,0,0\nGOTO/1,0,0\n";
    let codes = |recipe: &str| {
        let (_, found) = try_apply(recipe, part).unwrap();
        found.iter().map(|found| found.code.id()).collect::<Vec<_>>()
    };
    assert_eq!(codes("version: 1\nsteps:\n  - clamp_feed: { max: 9000 }\n"), ["CL0307"]);
    assert!(codes("version: 1\nunits: mm\nsteps:\n  - clamp_feed: { max: 9000 }\n").is_empty());
    assert!(codes("version: 1\nunits: inch\nsteps:\n  - clamp_feed: { max: 9000 }\n").is_empty());
    assert!(codes("version: 1\nsteps:\n  - scale_feed: { factor: 1 }\n").is_empty());
}

/// Posts name their taps in many ways, and some exports say the feed of a tap a second time.
#[test]
fn taps_by_any_name_keep_their_feed_and_what_repeats_it() {
    let holes = |cycle: &str| {
        format!(
            "PARTNO/TAPS\nUNITS/MM\nLOADTL/4\nSPINDL/400,CLW\nRAPID\nGOTO/0.,0.,20.\n{cycle}\nFEDRAT/600.,MMPM\nGOTO/0.,0.,0.\n\
             GOTO/10.,0.,0.\nCYCLE/OFF\nFEDRAT/900.,MMPM\nGOTO/10.,0.,20.\nFINI\n"
        )
    };
    for name in ["TAP", "TAPRIG", "RIGIDTAP", "REVTAP", "LTAP", "BRKTAP"] {
        let text = holes(&format!("CYCLE/{name},12.,MMPM,600.,3."));
        let (after, findings) = apply("  - scale_feed: { factor: 0.5 }", &text);
        assert_eq!(after, text.replace("900.", "450."), "{name}");
        assert!(findings.iter().any(|found| found.code.id() == "CL0309"), "{name}: {findings:?}");
    }
    let drilled = holes("CYCLE/DRILL,12.,MMPM,600.,3.");
    let (after, _) = apply("  - scale_feed: { factor: 0.5 }", &drilled);
    assert_eq!(after, drilled.replace("600.", "300.").replace("900.", "450."));
}

/// At constant surface speed the limit holds at the smallest diameter: 200 m/min at x = 20 are 1591.5 rev/min.
#[test]
fn a_limit_holds_where_the_spindle_of_a_lathe_is_fastest() {
    let lathe = |to: &str| {
        format!(
            "PARTNO TURN\nUNITS/MM\nCUTTER/    1.600000\nTOOLNO/3,TURN,1,0,3,    0.800000,$\n\
                 0.000000,    0.000000,    0.200000,MMPR,  150.000000,SMM,$\nCLW,ON,    0.000000,NOTE\nLOADTL/3,1,1\nSPINDL/  200.0000,SMM,CLW\nRAPID\nGOTO/50.0,0.0,0.0\nFEDRAT/ 0.2500,MMPR\n\
             GOTO/{to},0.0,0.0\nFINI\n"
        )
    };
    let (after, _) = apply("  - clamp_feed: { max: 100 }", lathe("20.0"));
    assert!(after.contains("FEDRAT/ 0.0628,MMPR"), "{after}");
    let (after, findings) = apply("  - clamp_feed: { max: 100 }", lathe("0.0"));
    assert_eq!(after, lathe("0.0"));
    assert!(
        findings.iter().any(|found| found.message.contains("no highest speed towards the axis")),
        "{findings:?}"
    );
}
