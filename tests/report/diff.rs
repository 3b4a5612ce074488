//! Differences by meaning.

use super::stats::POCKET;
use crate::support::{program, rounded_snapshots, snapshots};
use clsmith::program::RecordKind;
use clsmith::report::diff::{ProgramDiff, summarize_diff, to_json, to_text};
use std::fmt::Write;

fn diff(a: &str, b: &str) -> ProgramDiff {
    ProgramDiff::from_programs(&program(a), &program(b))
}

/// A zigzag of `rows` rows with an insertion or removal possible anywhere.
fn zigzag(rows: usize, dx: f64) -> String {
    let mut text = String::from("TOOL PATH/FACE,TOOL,T\nFEDRAT/MMPM,800.0000\n");
    for row in 0..rows {
        for column in 0..10 {
            let x = if row % 2 == 0 { column } else { 9 - column };
            let _ = writeln!(text, "GOTO/{:.4},{:.4},0.0000", f64::from(x) * 10.0 + dx, row);
        }
    }
    text + "END-OF-PATH\n"
}

#[test]
fn a_file_does_not_differ_from_itself() {
    let found = diff(POCKET, POCKET);
    assert!(found.is_empty() && found.same_meaning && found.geometry.same);
    assert_eq!(summarize_diff(&found), "the same, byte for byte\n");
    assert!(diff("", "").is_empty());
}

#[test]
fn changed_feeds_are_the_same_geometry() {
    let faster = POCKET.replace("FEDRAT/600.0000", "FEDRAT/750.0000").replace("MMPM,250", "MMPM,200");
    let found = diff(POCKET, &faster);
    assert!(found.geometry.same && !found.same_meaning);
    assert_eq!((found.counts.feeds, found.counts.changed.len()), (2, 0));
    let change = found.feed_change.unwrap();
    assert!((change.min + 20.0).abs() < 1e-9 && (change.max - 25.0).abs() < 1e-9);
    snapshots("report").bind(|| insta::assert_snapshot!("diff_feeds", to_text(&found, 10)));
    rounded_snapshots("report").bind(|| insta::assert_snapshot!("diff_feeds_json", to_json(&found, &[])));
}

#[test]
fn layout_and_comments_are_no_difference_in_meaning() {
    let other = POCKET
        .replace("FEDRAT/MMPM,300.0000", "FEDRAT / 300., MMPM")
        .replace("GOTO/60.0000,0.0000,-5.0000", "GOTO/ 60,-0.0,-5.00 $$ corner")
        .replace("SPINDL/RPM,2000.0000,CLW", "SPINDL/RPM,2000,CLW\r")
        .replace("END-OF-PATH\nTOOL", "END-OF-PATH\n$$ by hand\n\nTOOL");
    let found = diff(POCKET, &other);
    assert!(found.same_meaning && !found.is_empty(), "{}", to_text(&found, 10));
    assert_eq!((found.counts.layout, found.counts.text), (3, 2));
}

#[test]
fn other_arguments_are_a_change() {
    let found = diff(POCKET, &POCKET.replace("ADJUST,7", "ADJUST,8"));
    assert!(!found.same_meaning && found.geometry.same);
    assert_eq!(found.counts.changed[&RecordKind::Tool], 1);
}

#[test]
fn points_that_all_move_stay_paired() {
    for dx in [0.05, 10.0] {
        let found = diff(&zigzag(40, 0.0), &zigzag(40, dx));
        assert_eq!((found.counts.moved, found.counts.added.len(), found.counts.removed.len()), (400, 0, 0));
        assert!((found.largest_move.unwrap() - dx).abs() < 1e-9);
        assert_eq!(found.geometry.parts_at, Some((Some(3), Some(3))));
        assert_eq!(found.not_listed, 0);
    }
}

#[test]
fn records_put_among_moved_points_are_found() {
    let a = zigzag(200, 0.0);
    let b = zigzag(200, 0.5).replace("GOTO/90.5000", "FEDRAT/MMPM,400.0000\nGOTO/90.5000");
    let found = diff(&a, &b);
    assert_eq!(found.counts.moved, 2000);
    assert_eq!(found.counts.added[&RecordKind::Feed], 200);
    assert!(found.counts.removed.is_empty() && found.counts.changed.is_empty());
}

#[test]
fn a_point_taken_out_is_one_removal() {
    let a = zigzag(20, 0.0);
    let found = diff(&a, &a.replace("GOTO/50.0000,7,0.0000\n", ""));
    assert_eq!(found.counts.removed[&RecordKind::Point], 1);
    assert_eq!((found.counts.moved, found.counts.added.len()), (0, 0));
    // The point stood on a line, so the way is the same.
    assert!(found.geometry.same);
    let found = diff(&a, &a.replace("GOTO/90.0000,7,0.0000\n", ""));
    assert!(!found.geometry.same);
}

#[test]
fn dialects_are_compared_by_their_motions() {
    let nx = "TOOL PATH/A,TOOL,T\nFEDRAT/MMPM,100.0000\nGOTO/0.0000,0.0000,0.0000\nCIRCLE/5.0000,0.0000,0.0000,0.0000000,0.0000000,-1.0000000,5.0000,0.0600,0.5000,10.0000,0.0000\nGOTO/5.0000,5.0000,0.0000\nEND-OF-PATH\n";
    let other = "PARTNO A\nUNIT/MM\nCSI_SET_FLUTE_LENGTH/20.\nFEDRAT/100.,MMPM\nGOTO/0,0,0\nCIRCLE/5.,0,0,0,0,1.\nGOTO/5.,5.,0\nFINI\n";
    let found = diff(nx, other);
    assert_eq!((found.a.dialect.name, found.b.dialect.name), ("nx", "solidworks"));
    // Axis -z is counter-clockwise in one, +z in the other.
    assert!(found.geometry.same && !found.same_meaning);
    assert_eq!(found.counts.layout, 3, "{}", to_text(&found, 10));
    let found = diff(nx, &other.replace("CIRCLE/5.,0,0,0,0,1.", "CIRCLE/5.,0,0,0,0,-1."));
    assert!(!found.geometry.same);
}

#[test]
fn a_point_in_another_unit_has_neither_moved_nor_turned() {
    let inch = "UNITS/INCHES\nGOTO/1,2,3,0,0,1\nGOTO/0.3333,2,3\n";
    let mm = "UNITS/MM\nGOTO/25.4,50.8,76.2,0,0,1\nGOTO/8.4658,50.8,76.2\n";
    let found = format!("{:?}", diff(inch, mm).counts);
    assert!(
        found.contains("moved: 0") && found.contains("turned: 0") && found.contains("layout: 2"),
        "{found}"
    );
    let turned = "UNITS/MM\nGOTO/25.4,50.8,76.2,0,1,0\nGOTO/8.4668,50.8,76.2\n";
    let found = format!("{:?}", diff(inch, turned).counts);
    assert!(found.contains("moved: 1") && found.contains("turned: 1"), "{found}");
}

#[test]
fn inches_and_millimetres_of_one_path_are_the_same_geometry() {
    let inch = "UNITS/INCHES\nFEDRAT/10,IPM\nGOTO/0,0,0\nGOTO/2,0,0\n";
    let mm = "UNITS/MM\nFEDRAT/254,MMPM\nGOTO/0,0,0\nGOTO/50.8,0,0\n";
    let found = diff(inch, mm);
    assert!(found.geometry.same);
    assert!((found.a.totals.feed_seconds - found.b.totals.feed_seconds).abs() < 1e-9);
    assert!(summarize_diff(&found).contains("path length 2 in -> 50.8 mm, time at feed 12.0 s -> 12.0 s"));
}

#[test]
fn operations_stand_apart() {
    let b = POCKET
        .replace("GOTO/60.0000,20.0000", "GOTO/60.0000,20.0400")
        .replace(
            "GOTO/30.0000,10.0000,0.0000\n",
            "GOTO/30.0000,10.0000,0.0000\nGOTO/50.0000,10.0000,0.0000\n",
        )
        .replace("COLOR,42", "COLOR,36");
    let found = diff(POCKET, &b);
    assert_eq!(
        found.operations.iter().map(|operation| operation.name.as_str()).collect::<Vec<_>>(),
        ["POCKET", "HOLES"]
    );
    snapshots("report").bind(|| insta::assert_snapshot!("diff_operations", to_text(&found, 1)));
}

#[test]
fn a_hole_written_out_is_the_same_way() {
    let cycle = "FROM/0,0,50\nCYCLE/DRILL,RAPTO,3,FEDTO,-20,MMPM,250\nGOTO/10,0,0\nCYCLE/OFF\n$$ x\nTLDATA/DRILL,8,0,80,118,60\n";
    let written = "FROM/0,0,50\nRAPID\nGOTO/10,0,50\nRAPID\nGOTO/10,0,3\nFEDRAT/MMPM,250\nGOTO/10,0,-20\nRAPID\nGOTO/10,0,3\n$$ x\nTLDATA/DRILL,8,0,80,118,60\n";
    let found = diff(cycle, written);
    assert!(found.geometry.same, "{}", to_text(&found, 10));
    assert_eq!(found.a.totals, found.b.totals);
}

#[test]
fn the_order_of_two_programs_does_not_change_what_is_counted() {
    let other = POCKET.replace("GOTO/60.0000,0.0000,-5.0000\n", "").replace("2000.0000", "2500.0000");
    let (there, back) = (diff(POCKET, &other), diff(&other, POCKET));
    assert_eq!(there.counts.removed, back.counts.added);
    assert_eq!(there.counts.changed, back.counts.changed);
    assert_eq!(there.counts.changed[&RecordKind::Spindle], 1);
}

#[test]
fn a_file_with_numbers_at_the_end_of_their_range_does_not_differ_from_itself() {
    let text =
        "GOTO/1E308,0,0\nGOTO/-1E308,1E308,0\nGOTO/0,0,1E308\nCIRCLE/1E308,0,0,0,0,1,1E308\nGOTO/5,0,0\n";
    let found = diff(text, text);
    assert!(found.identical && found.same_meaning && found.geometry.same, "{found:?}");
}
