//! What stays in force from one statement to the next, and what is used up.

use crate::support::{clean_motions, motions, program, program_of, statement_indices};
use clsmith::program::Dialect;
use clsmith::program::geometry::MotionPath;
use clsmith::program::motion::MotionProblemKind;
use nalgebra::{Point3, Vector3};

#[test]
fn a_three_value_goto_keeps_the_axis() {
    let found = clean_motions(&program("GOTO/0,0,0,0,0.6,0.8\nGOTO/1,0,0\nGOTO/2,0,0,0,0,1\nGOTO/3,0,0\n"));
    let axes: Vec<_> = found.iter().map(|motion| motion.to.axis).collect();
    let tilted = Vector3::new(0.0, 0.6, 0.8);
    assert_eq!(axes, [tilted, tilted, Vector3::z(), Vector3::z()]);
    assert_eq!((found[2].from.axis, found[2].to.axis), (tilted, Vector3::z()));
}

#[test]
fn without_any_axis_the_tool_stands_along_z() {
    assert_eq!(clean_motions(&program("GOTO/1,2,3\n"))[0].to.axis, Vector3::z());
}

#[test]
fn tlaxis_is_the_axis_of_the_points_after_it() {
    let found = clean_motions(&program("TLAXIS/ 0.000000, 1.000000, 0.000000\nGOTO/1,2,3\n"));
    assert_eq!(found[0].to.axis, Vector3::y());
    // CLT prints each setup in its own frame; TLAXIS says how that stands in the machine.
    let clt = program_of(Dialect::CamWorks, "TLAXIS/ 0.0,-1.0,0.0 \nGOTO/ 1,2,3 \n");
    assert_eq!(clean_motions(&clt)[0].to.axis, Vector3::z());
}

#[test]
fn an_nx_path_starts_with_the_axis_of_its_frame() {
    let text =
        "TOOL PATH/A,TOOL,T\nGOTO/0,0,0,1,0,0\nEND-OF-PATH\nTOOL PATH/B,TOOL,T\nGOTO/1,0,0\nEND-OF-PATH\n";
    assert_eq!(clean_motions(&program(text))[1].to.axis, Vector3::z());
}

#[test]
fn an_axis_that_is_no_unit_vector_is_made_one() {
    // Depths of cycles and angles are measured along it.
    let found = clean_motions(&program("GOTO/0,0,0,0,0,2.0\nTLAXIS/3,0,4\nGOTO/1,1,1\n"));
    assert_eq!((found[0].to.axis, found[1].to.axis), (Vector3::z(), Vector3::new(0.6, 0.0, 0.8)));
    // Printed decimals are no reason to change it: what is written must be what was read.
    let printed = Vector3::new(0.9902681, 0.0, 0.1391731);
    assert_eq!(clean_motions(&program("GOTO/0,0,0,0.9902681,0.0000000,0.1391731\n"))[0].to.axis, printed);
}

#[test]
fn rapid_is_good_for_one_motion_and_the_feed_comes_back() {
    let program = program("FEDRAT/100,MMPM\nGOTO/0,0,0\nRAPID\nGOTO/1,0,0\nGOTO/2,0,0\nRAPID/\nGOTO/3,0,0\n");
    let found = clean_motions(&program);
    assert_eq!(found.iter().map(|motion| motion.rapid).collect::<Vec<_>>(), [false, true, false, true]);
    assert!(
        found.iter().all(|motion| motion.feed.unwrap().value == 100.0
            && motion.feed_from == program.statement_ids().next())
    );
}

#[test]
fn rapid_waits_for_a_motion_over_other_words() {
    let found = clean_motions(&program(
        "GOTO/0,0,0\nRAPID\nCOOLNT/ON\nPPRINT up\nSPINDL/1000\n$$ c\nGOTO/1,0,0\nGOTO/2,0,0\n",
    ));
    assert_eq!(found.iter().map(|motion| motion.rapid).collect::<Vec<_>>(), [false, true, false]);
    assert_eq!(statement_indices(&found[1]), [1, 2, 3, 4, 5, 6]);
}

#[test]
fn from_is_no_motion_and_uses_no_rapid_up() {
    // Otherwise the long way from the home point would be taken at feed.
    let found = clean_motions(&program("RAPID\nFROM/0,0,100\nGOTO/0,0,5\nGOTO/0,0,0\n"));
    assert_eq!(
        found.iter().map(|motion| (motion.rapid, &motion.path)).collect::<Vec<_>>(),
        [(false, &MotionPath::Start), (true, &MotionPath::Line), (false, &MotionPath::Line)]
    );
}

#[test]
fn a_rapid_with_no_motion_is_told() {
    for text in ["GOTO/0,0,0\nRAPID\n", "RAPID\nRAPID\nGOTO/0,0,0\n", "RAPID\nFEDRAT/100\nGOTO/0,0,0\n"] {
        assert_eq!(motions(&program(text)).1, [MotionProblemKind::RapidWithoutMotion], "{text}");
    }
}

#[test]
fn the_first_point_starts_and_does_not_cut() {
    let found = clean_motions(&program("GOTO/1,2,3\nGOTO/1,2,0\n"));
    assert_eq!((&found[0].path, found[0].length()), (&MotionPath::Start, 0.0));
    assert_eq!((&found[1].path, found[1].length()), (&MotionPath::Line, 3.0));
}

#[test]
fn steps_go_on_from_where_the_tool_is() {
    let found = clean_motions(&program("GOTO/1,2,3,0,0.6,0.8\nGODLTA/1,1,1\nGODLTA/-10\nGOTO/0,0,0\n"));
    assert_eq!(found[1].to.point, Point3::new(2.0, 3.0, 4.0));
    // One number steps along the tool axis.
    assert!((found[2].to.point - Point3::new(2.0, -3.0, -4.0)).norm() < 1e-12);
    assert_eq!(found[3].from, found[2].to);
    assert_eq!(motions(&program("GODLTA/1,0,0\n")).1, [MotionProblemKind::UnknownStart]);
}

#[test]
fn gohome_is_a_motion_or_leads_to_a_place_that_nobody_knows() {
    let found = clean_motions(&program("GOTO/1,2,3\nRAPID\nGOHOME/0,0,100\nGOTO/1,1,1\n"));
    assert_eq!((found[1].rapid, found[1].to.point), (true, Point3::new(0.0, 0.0, 100.0)));
    let found = clean_motions(&program("GOTO/1,2,3\nRAPID\nGOHOME\nGOTO/1,1,1\n"));
    assert_eq!((found.len(), found[1].rapid, &found[1].path), (2, false, &MotionPath::Start));
}

#[test]
fn several_points_are_several_motions_of_one_statement() {
    let found = clean_motions(&program("GOTO/0,0,0\n1,0,0\n2,0,0, 3,0,0\nRAPID\nGOTO/4,0,0, 5,0,0, 6,0,0\n"));
    let ends: Vec<_> = found.iter().map(|motion| motion.to.point.x).collect();
    assert_eq!(ends, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    // RAPID is for the next record, and that has three points.
    assert_eq!(
        found.iter().map(|motion| motion.rapid).collect::<Vec<_>>(),
        [false, false, false, false, true, true, true]
    );
}

#[test]
fn nine_values_are_a_point_an_axis_and_the_contact_normal() {
    let found = clean_motions(&program("GOTO/1,2,3, 0,0,1, 0,0.6,0.8\nGOTO/4,5,6\n"));
    assert_eq!((found.len(), found[0].normal), (2, Some(Vector3::new(0.0, 0.6, 0.8))));
    assert_eq!((found[0].to.axis, found[1].normal), (Vector3::z(), None));
}

#[test]
fn under_multax_every_line_of_points_holds_axes() {
    let text = "MULTAX/ON\nGOTO/0,0,0, 0,0,1\n  5,0,0, 0,0.6,0.8\n  6,0,0, 0,0.8,0.6, 7,0,0, 0,0,1\n";
    let found = clean_motions(&program(text));
    assert_eq!(found.iter().map(|motion| motion.to.point.x).collect::<Vec<_>>(), [0.0, 5.0, 6.0, 7.0]);
    assert_eq!(found[1].to.axis, Vector3::new(0.0, 0.6, 0.8));
}

#[test]
fn a_rapid_is_for_every_point_of_its_goto() {
    let found = crate::support::clean_motions(&crate::support::program(
        "FEDRAT/100\nGOTO/0,0,0\nRAPID\nGOTO/1,0,0,2,0,0,3,0,0\nGOTO/4,0,0\n",
    ));
    assert_eq!(found.iter().map(|motion| motion.rapid).collect::<Vec<_>>(), [false, true, true, true, false]);
}
