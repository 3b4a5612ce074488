//! What `correct_ramp` refuses, and where it points.

use super::{FACE_MILL, correct};
use clsmith::diagnostic::Diagnostic;

const SMALL: &str = "TOOL PATH/POCKET,TOOL,FACE
TLDATA/MILL,50.0000,6.0000,60.0000,0.0000,0.0000
RAPID
GOTO/0.0000,0.0000,2.0000
PAINT/COLOR,42
FEDRAT/MMPM,300.0000
GOTO/10.0000,0.0000,0.0000
GOTO/0.0000,0.0000,-2.0000
PAINT/COLOR,31
GOTO/10.0000,0.0000,-2.0000
GOTO/10.0000,10.0000,-2.0000
END-OF-PATH
";

/// Code and labelled texts of what stopped the step.
fn refused(parameters: &str, text: &str) -> (&'static str, String, Vec<String>) {
    let Err(mut found) = correct(parameters, text) else { panic!("not refused: {parameters}") };
    let last: Diagnostic = found.pop().unwrap();
    let texts = last
        .labels
        .iter()
        .map(|label| String::from_utf8_lossy(label.source.slice(label.span)).trim().to_owned());
    (last.code.id(), last.message.clone(), texts.collect())
}

#[test]
fn no_room_is_an_error_at_the_ramp_and_at_the_step() {
    let (code, message, texts) = refused(FACE_MILL, SMALL);
    assert_eq!(code, "CL0321");
    assert!(message.contains("38.000 mm leaves the region"), "{message}");
    assert_eq!(texts, ["GOTO/10.0000,0.0000,0.0000", "GOTO/0.0000,0.0000,-2.0000", "correct_ramp"]);
    let kept = correct(&format!("{FACE_MILL}, if_impossible: keep"), SMALL).unwrap();
    assert_eq!((kept.text.as_str(), kept.codes()), (SMALL, vec!["CL0322"]));
    let anywhere = correct(&format!("{FACE_MILL}, region: none"), SMALL).unwrap();
    assert_eq!(anywhere.codes(), ["CL0320"]);
}

#[test]
fn a_cutter_that_cuts_to_its_centre_has_no_limits() {
    let (code, message, texts) = refused("tool: { diameter: 12, insert_radius: 6, insert_height: 5 }", SMALL);
    assert_eq!(code, "CL0302");
    assert!(message.contains("up to its centre"), "{message}");
    assert!(texts[0].contains("diameter: 12"), "{texts:?}");
}

#[test]
fn what_is_not_known_of_the_cutter_is_asked_for() {
    let (code, message, _) = refused("tool: { diameter: 50 }", SMALL);
    assert_eq!(code, "CL0302");
    assert!(message.contains("cutting height of the insert of tool FACE"), "{message}");
    let (code, message, _) = refused("region: hull", SMALL);
    assert_eq!(code, "CL0302");
    assert!(message.contains("gives the inserts of tool FACE"), "{message}");
}

#[test]
fn a_region_that_crosses_itself_is_refused_where_it_stands() {
    let crossed = "region: { polygon: [[0, 0], [10, 10], [10, 0], [0, 10]] }";
    let (code, message, texts) = refused(&format!("{FACE_MILL}, {crossed}"), SMALL);
    assert!(code.starts_with("CL02"), "{code}");
    assert!(message.contains("crosses itself"), "{message}");
    assert!(texts[0].contains("[0, 0]"), "{texts:?}");
    let (_, message, _) = refused(&format!("{FACE_MILL}, region: {{ polygon: [[0, 0], [1, 1]] }}"), SMALL);
    assert!(message.contains("three vertices"), "{message}");
}

#[test]
fn a_ramp_that_leads_to_no_level_is_not_guessed() {
    let away = SMALL.replace(
        "PAINT/COLOR,31\nGOTO/10.0000,0.0000,-2.0000\nGOTO/10.0000,10.0000,-2.0000",
        "PAINT/COLOR,37\nGOTO/10.0000,0.0000,5.0000",
    );
    let (code, message, texts) = refused(&format!("{FACE_MILL}, region: none"), &away);
    assert_eq!((code, texts[0].as_str()), ("CL0321", "GOTO/10.0000,0.0000,0.0000"));
    assert!(message.contains("no level") || message.contains("does not end at a level"), "{message}");
}

#[test]
fn statements_that_hold_several_points_are_not_rewritten() {
    let shared = SMALL.replace(
        "GOTO/10.0000,0.0000,0.0000\nGOTO/0.0000,0.0000,-2.0000",
        "GOTO/10.0000,0.0000,0.0000,0.0000,0.0000,-2.0000,0.0000,0.0000,-2.0000,0.0,0.0,-2.0",
    );
    let (code, message, _) = refused(&format!("{FACE_MILL}, region: none"), &shared);
    assert_eq!(code, "CL0321");
    assert!(message.contains("plain GOTO"), "{message}");
}

#[test]
fn misspelt_parameters_point_at_themselves() {
    let (code, _, texts) = refused("region: hul", SMALL);
    assert!(code.starts_with("CL02"));
    assert_eq!(texts[0], "hul");
    let (_, _, texts) = refused("depth_of_cut: -2", SMALL);
    assert_eq!(texts[0], "-2");
}
