//! Statistics of programs whose lengths and times are known in closed form.

use crate::support::{program, rounded_snapshots, snapshots};
use clsmith::parameters::Positive;
use clsmith::program::LengthUnit;
use clsmith::report::stats::{LengthUnitOrigin, ProgramStats, to_json, to_text};
use clsmith::setup::{MachineLimits, Setup};
use std::f64::consts::PI;

pub const POCKET: &str = "TOOL PATH/POCKET,TOOL,MILL_10
TLDATA/MILL,10.0000,1.0000,50.0000,0.0000,0.0000
MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000
LOAD/TOOL,3,ADJUST,3
SPINDL/RPM,2000.0000,CLW
RAPID
GOTO/0.0000,0.0000,50.0000,0.0000000,0.0000000,1.0000000
RAPID
GOTO/0.0000,0.0000,5.0000
PAINT/COLOR,42
FEDRAT/MMPM,300.0000
GOTO/0.0000,0.0000,-5.0000
PAINT/COLOR,31
FEDRAT/600.0000
GOTO/60.0000,0.0000,-5.0000
CIRCLE/60.0000,10.0000,-5.0000,0.0000000,0.0000000,-1.0000000,10.0000,0.0600,0.5000,10.0000,1.0000
GOTO/60.0000,20.0000,-5.0000
FEDRAT/MMPR,0.2000
GOTO/0.0000,20.0000,-5.0000
PAINT/COLOR,37
RAPID
GOTO/0.0000,20.0000,50.0000
END-OF-PATH
TOOL PATH/HOLES,TOOL,DRILL_8
TLDATA/DRILL,8.0000,0.0000,80.0000,118.0000,60.0000
LOAD/TOOL,7,ADJUST,7
CYCLE/DRILL,RAPTO,3.0000,FEDTO,-20.0000,MMPM,250.0000
GOTO/10.0000,10.0000,0.0000
GOTO/30.0000,10.0000,0.0000
CYCLE/OFF
END-OF-PATH
";

fn stats(text: &str) -> ProgramStats {
    ProgramStats::from_program(&program(text), &Setup::default())
}

#[track_caller]
fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} is not {wanted}");
}

#[test]
fn a_program_as_text() {
    snapshots("report").bind(|| insta::assert_snapshot!("stats", to_text(&stats(POCKET))));
}

#[test]
fn a_program_as_json() {
    rounded_snapshots("report").bind(|| insta::assert_snapshot!("stats_json", to_json(&stats(POCKET), &[])));
}

#[test]
fn nothing_gives_nothing() {
    let empty = stats("");
    assert_eq!((empty.bytes, empty.lines, empty.statements, empty.totals.motions), (0, 0, 0, 0));
    assert_eq!(empty.box_of_all, None);
    assert_eq!(empty.operations.len(), 1);
    snapshots("report").bind(|| insta::assert_snapshot!("stats_empty", to_text(&empty)));
    let comments = stats("$$ one\r\n$$ two");
    assert_eq!((comments.lines, comments.statements), (2, 2));
    assert!(to_text(&comments).contains("no motions"));
}

#[test]
fn time_is_length_by_feed() {
    let found = stats("FEDRAT/300,MMPM\nGOTO/0,0,0\nGOTO/30,40,0\nRAPID\nGOTO/30,40,100\n");
    close(found.totals.feed_length, 50.0);
    close(found.totals.feed_seconds, 10.0);
    close(found.totals.rapid_length, 100.0);
    assert_eq!(found.totals.rapid_seconds, None);
    assert_eq!(found.totals.motions, 2);
    assert_eq!(found.units.from, LengthUnitOrigin::Feeds);
}

#[test]
fn rapids_have_a_time_when_the_machine_is_known() {
    let machine = MachineLimits { rapid_feed: Positive::new(6000.0), ..MachineLimits::default() };
    let program = program("UNITS/INCHES\nGOTO/0,0,0\nRAPID\nGOTO/0,0,10\n");
    let found = ProgramStats::from_program(&program, &Setup { machine, ..Setup::default() });
    close(found.totals.rapid_seconds.unwrap(), 254.0 / 100.0);
    assert_eq!((found.units.unit, found.units.from), (LengthUnit::Inch, LengthUnitOrigin::File));
}

#[test]
fn feeds_per_revolution_need_the_spindle() {
    let path = "FEDRAT/0.1,MMPR\nGOTO/0,0,0\nGOTO/10,0,0\n";
    let known = stats(&format!("SPINDL/1000,RPM,CLW\n{path}"));
    close(known.totals.feed_seconds, 6.0);
    close(known.feed.unwrap().max, 100.0);
    for spindle in ["", "SPINDL/200,SFM,CLW\n", "SPINDL/1000,RPM\nSPINDL/OFF\n"] {
        let unknown = stats(&format!("{spindle}{path}"));
        assert_eq!(unknown.totals.unknown_time.no_spindle_speed, 1);
        close(unknown.totals.unknown_time.length, 10.0);
        assert_eq!((unknown.totals.feed_seconds, unknown.feeds[0].seconds, unknown.feed), (0.0, None, None));
        assert!(to_text(&unknown).contains("1 motion is without a time: a feed per revolution"));
    }
}

#[test]
fn inverse_time_is_moves_per_minute() {
    let found = stats("FEDRAT/INVERS,30\nGOTO/0,0,0\nGOTO/10,0,0\nGOTO/10,0,0,0,1,0\n");
    close(found.totals.feed_seconds, 4.0);
    close(found.feed.unwrap().min, 300.0);
}

#[test]
fn a_missing_feed_and_a_feed_of_zero_are_counted_apart() {
    let found = stats("GOTO/0,0,0\nGOTO/10,0,0\nFEDRAT/0\nGOTO/20,0,0\nFEDRAT/100\nGOTO/30,0,0\n");
    let unknown = found.totals.unknown_time;
    assert_eq!((unknown.motions, unknown.no_feed, unknown.zero_feed), (2, 1, 1));
    close(found.totals.feed_seconds, 6.0);
    assert!(to_text(&found).contains("> 6.0 s"));
}

#[test]
fn arcs_and_helices_have_their_length_and_their_box() {
    // A three-quarter turn, counter-clockwise about +z from (10,0), that rises by 3.
    let found = stats(
        "FEDRAT/600,MMPM\nGOTO/10,0,0\nMOVARC/0,0,0,0,0,1,10,ANGLE,270\nGOTO/0,-10,0\nGOTO/10,0,0\nMOVARC/0,0,0,0,0,1,10,ANGLE,270\nGOTO/0,-10,3\n",
    );
    assert_eq!((found.paths.arcs, found.paths.helices, found.paths.lines), (1, 1, 1));
    let turn = 1.5 * PI * 10.0;
    close(found.totals.feed_length, turn + 200f64.sqrt() + turn.hypot(3.0));
    let bounds = found.box_of_feed.unwrap();
    for (found, wanted) in bounds.min.into_iter().zip([-10.0, -10.0, 0.0]) {
        close(found, wanted);
    }
    for (found, wanted) in bounds.max.into_iter().zip([10.0, 10.0, 3.0]) {
        close(found, wanted);
    }
}

#[test]
fn holes_are_counted_and_their_legs_summed() {
    let found = stats(
        "CYCLE/DRILL,RAPTO,3,FEDTO,-20,MMPM,230\nGOTO/0,0,0\nGOTO/10,0,0\nCYCLE/OFF\n$$ x\nTLDATA/DRILL,8,0,80,118,60\n",
    );
    assert_eq!(found.paths.holes, 2);
    close(found.totals.feed_length, 46.0);
    close(found.totals.feed_seconds, 12.0);
}

#[test]
fn very_many_feeds_share_rows() {
    let mut text = String::from("GOTO/0,0,0\n");
    for index in 0..5000 {
        text += &format!("FEDRAT/MMPM,{}.5\nGOTO/{},0,0\n", 100 + index, index + 1);
    }
    let found = stats(&text);
    assert!(found.feeds.len() < 210, "{}", found.feeds.len());
    assert_eq!(found.feeds.iter().map(|row| row.motions).sum::<usize>(), 5000);
    close(found.feeds.iter().filter_map(|row| row.seconds).sum(), found.totals.feed_seconds);
    assert_eq!((found.feeds[0].min, found.feeds.last().unwrap().max), (100.5, 5099.5));
    assert!(to_text(&found).lines().count() < 60);
}

#[test]
fn names_cannot_talk_to_the_terminal() {
    let found = stats("TOOL PATH/A\u{1b}[31mB,TOOL,T\nGOTO/0,0,0\nGOTO/1,0,0\nEND-OF-PATH\n");
    assert!(!to_text(&found).contains('\u{1b}'));
}
