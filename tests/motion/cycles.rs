//! Drilling cycles: a hole is a group of motions, in the form of each dialect.

use crate::support::{clean_motions, fixture, program, program_of};
use clsmith::program::MotionClass;
use clsmith::program::motion::Motion;
use clsmith::program::{Dialect, FeedUnit, NumberRole, Record};

/// Each hole as the heights its moves end at (capital R: at rapid, F: at feed), with the feed of the feed move.
fn holes(found: &[Motion]) -> Vec<(String, f64)> {
    let mut holes: Vec<(String, f64)> = Vec::new();
    for motion in found {
        let Some((hole, _)) = &motion.hole else { continue };
        assert_eq!(motion.class, MotionClass::Drill);
        holes.resize((hole + 1).max(holes.len()), (String::new(), 0.0));
        let (moves, feed) = &mut holes[*hole];
        let height = (motion.to.point.z * 1e4).round() / 1e4;
        moves.push_str(&format!("{}{height} ", if motion.rapid { 'R' } else { 'F' }));
        if !motion.rapid {
            *feed = motion.feed.map_or(0.0, |feed| feed.value);
        }
    }
    holes
}

#[track_caller]
fn assert_holes(dialect: Dialect, text: &str, expected: &[(&str, f64)]) {
    let found = holes(&clean_motions(&program_of(dialect, text)));
    let found: Vec<_> = found.iter().map(|(moves, feed)| (moves.trim_end(), *feed)).collect();
    assert_eq!(found, expected);
}

#[test]
fn nx_feeds_to_a_coordinate_below_the_point() {
    let text = "GOTO/0,0,30\nCYCLE/DRILL,RAPTO,3.0000,FEDTO,-12.5000,MMPM,250.0000\nGOTO/10,0,0\nGOTO/20,0,5\nCYCLE/OFF\nRAPID\nGOTO/20,0,30\n";
    // The first hole is approached at the height the tool is at, the second at its own clearance.
    assert_holes(Dialect::Nx, text, &[("R30 R3 F-12.5 R3", 250.0), ("R8 F-7.5 R8", 250.0)]);
}

#[test]
fn nx_countersinks_to_the_point_itself() {
    let text = "CYCLE/DRILL,DEEP,RAPTO,3.0000,FEDTO,0.0000,MMPM,250.0000\nGOTO/66,0,240,0,0,1\nGOTO/-255,0,240\nCYCLE/OFF\n";
    assert_holes(Dialect::Nx, text, &[("R243 F240 R243", 250.0), ("R243 F240 R243", 250.0)]);
}

#[test]
fn nx_changes_the_cycle_in_force_and_keeps_the_rest_of_it() {
    let text = "GOTO/0,0,30\nCYCLE/DRILL,DEEP,RAPTO,2,FEDTO,-40,RTRCTO,20,STEP,8,MMPM,120\nGOTO/10,0,0\nCYCLE/ON,FEDTO,-25,RTRCTO,AUTO\nGOTO/20,0,0\nCYCLE/OFF\n";
    assert_holes(Dialect::Nx, text, &[("R30 R2 F-40 R20", 120.0), ("R20 R2 F-25 R2", 120.0)]);
}

#[test]
fn solidworks_feeds_to_a_depth() {
    let text = "GOTO/42.,31.5,25.\nCYCLE/INIT\nCYCLE/DRILL,FEDTO,5.4,MMPM,125.37,RAPTO,3.,RTRCTO,27.5,DWELL,0\nGOTO/42.,31.5,-2.5\nGOTO/74.,17.5,-2.5\nCYCLE/OFF\n";
    assert_holes(Dialect::SolidWorks, text, &[("R0.5 F-7.9 R25", 125.37), ("R25 R0.5 F-7.9 R25", 125.37)]);
}

#[test]
fn a_word_that_starts_with_a_digit_is_no_depth() {
    let text = "GOTO/0,0,25\nCYCLE/DEEP2,FEDTO,9.6,1STPECK,5.,SUBPECK,2.,MMPM,102.,RAPTO,3.,RTRCTO,25.\nGOTO/0,0,0\nCYCLE/OFF\n";
    assert_holes(Dialect::SolidWorks, text, &[("R3 F-9.6 R25", 102.0)]);
}

#[test]
fn catia_puts_depth_and_clearance_by_position() {
    let text = "FEDRAT/  300.0000,MMPM\nGOTO  /0,0,25\nCYCLE/DRILL,    3.000000,    5.000000\nGOTO  /0,0,20\nCYCLE/OFF\nRAPID\nGOTO  /0,0,40\n";
    // No feed in the record: the one in force.
    assert_holes(Dialect::Catia, text, &[("F17 R25", 300.0)]);
    let tap = text.replace("DRILL,    3.000000,", "TAP,   10.0,");
    assert_holes(Dialect::Catia, &tap, &[("F10 F25", 300.0)]);
}

#[test]
fn icam_says_depth_clear_and_return() {
    let text = "GOTO/0,0,2\nCYCLE/DRILL,DEPTH,    5.200000,MMPR,    0.080000,CLEAR,    2.000000,$\nRETURN,    5.000000\nGOTO/0,0,0\nCYCLE/OFF\n";
    assert_holes(Dialect::CatiaIcam, text, &[("F-5.2 R5", 0.08)]);
    let found = clean_motions(&program_of(Dialect::CatiaIcam, text));
    assert_eq!(found[1].feed.unwrap().unit, Some(FeedUnit::MmPerRevolution));
}

#[test]
fn clt_leaves_commas_out() {
    let text = "GOTO/ 0,0,25 \nCYCLE/ ON \nCYCLE/ DRILL,G98,11.846500,PECKING,5.000000,2.000000,MMPM,203.471650,3.000000,43.518204 43.518204 DWELL,0.000000 \nGOTO/ 0,0,-18.518204 \nCYCLE/ OFF \nCYCLE/ ON \nCYCLE/ CDRILL G98,2.000000,MMPM,150.000000,3.000000,43.518204 43.518204 DWELL,0.000000 \nGOTO/ 0,0,-18.518204 \nCYCLE/ OFF \n";
    assert_holes(
        Dialect::CamWorks,
        text,
        &[("R-15.5182 F-30.3647 R25", 203.47165), ("R-15.5182 F-20.5182 R25", 150.0)],
    );
}

#[test]
fn iso_puts_depth_feed_and_clearance_by_position_and_rapto_counts_down_from_the_clearance() {
    // The post computes RAPTO as clearance minus retract: how far to go down at rapid, not a height.
    let text = "GOTO/0,0,20\nCYCLE/DRILL, 12.0, MMPM, 150.0, 15.0, RAPTO, 10.0\nFEDRAT/150.0, MMPM\nGOTO/0,0,0\nCYCLE/OFF\n";
    assert_holes(Dialect::Iso, text, &[("R5 F-12 R15", 150.0)]);
    let without = text.replace(", RAPTO, 10.0", "");
    assert_holes(Dialect::Iso, &without, &[("R15 F-12 R15", 150.0)]);
}

#[test]
fn a_dwell_in_turns_is_no_length() {
    let text = "GOTO/0,0,20\nCYCLE/DRILL,DEPTH,5,IPM,4,DWELL,REV,2,CLEAR,1\nGOTO/0,0,0\nCYCLE/OFF\n";
    assert_holes(Dialect::Creo, text, &[("R1 F-5 R1", 4.0)]);
    let only_dwell = "GOTO/0,0,20\nCYCLE/DRILL,DEPTH,5,DWELL,REV,2\nGOTO/0,0,0\nCYCLE/OFF\n";
    assert_holes(Dialect::Creo, only_dwell, &[("R0 F-5 R0", 0.0)]);
}

#[test]
fn depth_goes_along_the_tool_axis() {
    let found =
        clean_motions(&program("GOTO/0,0,0,1,0,0\nCYCLE/DRILL,DEPTH,10,CLEAR,2\nGOTO/-5,7,8\nCYCLE/OFF\n"));
    let ends: Vec<_> =
        found[1..].iter().map(|motion| [motion.to.point.x, motion.to.point.y, motion.to.point.z]).collect();
    assert_eq!(ends, [[0.0, 7.0, 8.0], [-3.0, 7.0, 8.0], [-15.0, 7.0, 8.0], [-3.0, 7.0, 8.0]]);
}

#[test]
fn a_rapid_within_a_cycle_goes_over_a_clamp_and_drills_nothing() {
    let text = "GOTO/0,0,30\nCYCLE/DRILL,DEPTH,5,CLEAR,2\nGOTO/10,0,0\nRAPID\nGOTO/10,0,50\nGOTO/20,0,0\nCYCLE/OFF\n";
    let found = clean_motions(&program(text));
    assert_eq!(holes(&found).len(), 2);
    assert_eq!(found.iter().filter(|motion| motion.hole.is_none()).count(), 2);
}

#[test]
fn going_home_with_the_cycle_in_force_drills_nothing() {
    let found =
        clean_motions(&program("GOTO/0,0,30\nCYCLE/DRILL,DEPTH,5,CLEAR,2\nGOTO/10,0,0\nGOHOME/0,0,100\n"));
    assert_eq!(holes(&found).len(), 1);
    assert_eq!((found.last().unwrap().to.point.z, &found.last().unwrap().hole), (100.0, &None));
}

#[test]
fn a_cycle_that_was_switched_off_can_be_switched_on_again() {
    let text = "GOTO/0,0,30\nCYCLE/DRILL,DEPTH,5,CLEAR,2\nGOTO/10,0,0\nCYCLE/OFF\nGOTO/15,0,30\nCYCLE/ON\nGOTO/20,0,0\nCYCLE/OFF\nGOTO/30,0,30\n";
    let found = clean_motions(&program(text));
    assert_eq!(holes(&found).len(), 2);
    assert!(found.last().unwrap().hole.is_none());
}

#[test]
fn several_points_in_a_goto_are_several_holes() {
    let found = clean_motions(&program(
        "GOTO/0,0,30\nCYCLE/DRILL,DEPTH,5,CLEAR,2\nGOTO/10,0,0, 20,0,0, 30,0,0\nCYCLE/OFF\n",
    ));
    assert_eq!(holes(&found).len(), 3);
}

#[test]
fn the_holes_of_the_fixtures() {
    let counts = [
        "nx/drilling.cls",
        "catia/balayage-multax-latin1.aptsource",
        "catia-icam/spot-drilling.aptsource",
        "creo/volume-mill-3axis.ncl",
        "solidworks/plate-3axis.apt",
        "camworks/glue-plate-cp1251.clt",
        "iso/bracket-bom.apt",
    ]
    .map(|path| holes(&clean_motions(&fixture(path))).len());
    assert_eq!(counts, [5, 1, 2, 2, 3, 3, 2]);
}

#[test]
fn times_turns_and_angles_of_a_cycle_are_no_lengths() {
    // A change of units scales lengths and feeds; an orientation of 90 degrees must stay one.
    let line = clsmith::parse::syntax(b"CYCLE/BORE, 20, MMPM, 80, 15, ORIENT, 90, DWELL, 0.5, STEP, 2");
    let roles = Record::read(&line).unwrap().number_roles(&line);
    assert_eq!(
        roles,
        [
            NumberRole::Length,
            NumberRole::Feed,
            NumberRole::Length,
            NumberRole::Plain,
            NumberRole::Plain,
            NumberRole::Length
        ]
    );
}
