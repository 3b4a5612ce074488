//! Feeds and speeds, their units, and what comes back.

use crate::support::{clean_motions, motions, program};
use clsmith::program::record::{CompensationSide, CutterCompensation, SpindleDirection, SpindleUnit};
use clsmith::program::{Feed, FeedUnit, LengthUnit};

fn feeds(text: &str) -> Vec<Feed> {
    clean_motions(&program(text)).into_iter().map(|motion| motion.feed.unwrap()).collect()
}

#[test]
fn the_unit_may_stand_before_or_after_the_number() {
    for (text, value, unit) in [
        ("FEDRAT/MMPM,250.0000", 250.0, FeedUnit::MmPerMinute),
        ("FEDRAT/  300.0000,MMPM", 300.0, FeedUnit::MmPerMinute),
        ("FEDRAT / 10.000000,  IPM", 10.0, FeedUnit::InchPerMinute),
        ("FEDRAT/ MMPM,185.687240", 185.68724, FeedUnit::MmPerMinute),
        ("FEDRAT/PERMIN,141", 141.0, FeedUnit::PerMinute),
        ("FEDRAT/    0.1000,MMPR", 0.1, FeedUnit::MmPerRevolution),
        ("FEDRAT/.004,IPR", 0.004, FeedUnit::InchPerRevolution),
        ("FEDRAT/0.2,PERREV", 0.2, FeedUnit::PerRevolution),
        ("FEDRAT/40,INVERS", 40.0, FeedUnit::InverseTime),
    ] {
        assert_eq!(feeds(&format!("{text}\nGOTO/0,0,0\n")), [Feed { value, unit: Some(unit) }], "{text}");
    }
}

#[test]
fn a_feed_without_unit_keeps_the_unit_in_force() {
    let found = feeds("FEDRAT/5\nGOTO/0,0,0\nFEDRAT/MMPR,0.2\nGOTO/1,0,0\nFEDRAT/0.3\nGOTO/2,0,0\n");
    let units: Vec<_> = found.iter().map(|feed| feed.unit).collect();
    assert_eq!(units, [None, Some(FeedUnit::MmPerRevolution), Some(FeedUnit::MmPerRevolution)]);
    assert_eq!(found[0].unit_or_default(), FeedUnit::PerMinute);
}

#[test]
fn all_units_lead_to_millimetres_per_minute() {
    let in_mm =
        |value, unit, file, rpm, length| Feed { value, unit: Some(unit) }.mm_per_minute(file, rpm, length);
    use FeedUnit::*;
    use LengthUnit::{Inch, Mm};
    assert_eq!(in_mm(100.0, MmPerMinute, Inch, None, None), Some(100.0));
    assert_eq!(in_mm(10.0, InchPerMinute, Mm, None, None), Some(254.0));
    assert_eq!(in_mm(10.0, PerMinute, Inch, None, None), Some(254.0));
    assert_eq!(in_mm(10.0, PerMinute, Mm, None, None), Some(10.0));
    assert_eq!(in_mm(0.5, MmPerRevolution, Inch, Some(1000.0), None), Some(500.0));
    assert_eq!(in_mm(0.5, PerRevolution, Inch, Some(100.0), None), Some(1270.0));
    assert_eq!(in_mm(0.5, MmPerRevolution, Mm, None, None), None);
    // 4 moves in a minute over 25 mm: 100 mm/min; over 25 inches 2540.
    assert_eq!(in_mm(4.0, InverseTime, Mm, None, Some(25.0)), Some(100.0));
    assert_eq!(in_mm(4.0, InverseTime, Inch, None, Some(25.0)), Some(2540.0));
    assert_eq!(in_mm(4.0, InverseTime, Mm, None, None), None);
}

#[test]
fn before_the_first_fedrat_no_feed_is_known() {
    assert_eq!(clean_motions(&program("GOTO/0,0,0\n"))[0].feed, None);
}

#[test]
fn the_speed_comes_back_after_a_stop() {
    let text = "SPINDL/RPM,1200,CLW\nGOTO/0,0,0\nSPINDL/OFF\nGOTO/1,0,0\nSPINDL/ON\nGOTO/2,0,0\nSPINDL/CCLW\nGOTO/3,0,0\n";
    let found = clean_motions(&program(text));
    let rpm: Vec<_> = found.iter().map(|motion| motion.spindle_rpm()).collect();
    assert_eq!(rpm, [Some(1200.0), None, Some(1200.0), Some(1200.0)]);
    assert_eq!(found[2].spindle.as_ref().unwrap().direction, Some(SpindleDirection::Clockwise));
    assert_eq!(found[3].spindle.as_ref().unwrap().direction, Some(SpindleDirection::CounterClockwise));
}

#[test]
fn speeds_in_every_dialect() {
    for text in [
        "SPINDL/RPM,1000,CLW ",
        "SPINDL/ 1000.0000,RPM,CLW",
        "SPINDL / RPM, 1000.000000,  CLW",
        "SPINDL/  1000.0000,RPM, CLW",
        "SPINDL/1000,CLW",
    ] {
        let found = clean_motions(&program(format!("{text}\nGOTO/0,0,0\n")));
        assert_eq!(found[0].spindle_rpm(), Some(1000.0), "{text}");
        assert_eq!(found[0].spindle.as_ref().unwrap().direction, Some(SpindleDirection::Clockwise));
    }
}

#[test]
fn a_surface_speed_is_no_spindle_speed() {
    let found = clean_motions(&program("SPINDL/  500.0000,SFM,CCLW\nGOTO/0,0,0\n"));
    let spindle = found[0].spindle.as_ref().unwrap();
    assert_eq!(
        (found[0].spindle_rpm(), spindle.unit, spindle.speed),
        (None, SpindleUnit::SurfaceFeet, Some(500.0))
    );
}

#[test]
fn compensation_is_in_force_until_off() {
    let program =
        program("CUTCOM/LEFT,XYPLAN\nGOTO/0,0,0\nCUTCOM/RIGHT\nGOTO/1,0,0\nCUTCOM/OFF\nGOTO/2,0,0\n");
    let mut motions = program.motions();
    let mut found = Vec::new();
    while motions.next().is_some() {
        found.push(motions.state().compensation.map(|(mode, set_by)| (mode, set_by.index())));
    }
    use CutterCompensation::{Off, On};
    assert_eq!(
        found,
        [Some((On(CompensationSide::Left), 0)), Some((On(CompensationSide::Right), 2)), Some((Off, 4))]
    );
}

#[test]
fn a_feed_in_the_fixture_of_each_feed_style_is_in_force_where_it_stands() {
    let listing = crate::support::fixture("iso/listing-mixed-ends.apt");
    let (found, _) = motions(&listing);
    assert_eq!(listing.stated_length_unit(), Some(LengthUnit::Inch));
    let last = found.last().unwrap().feed.unwrap();
    assert_eq!((last.value, last.unit), (40.0, Some(FeedUnit::InverseTime)));
}

#[test]
fn an_oriented_stop_and_a_limit_of_speed_set_no_speed() {
    let text = "SPINDL/RPM,900,CLW\nSPINDL/ORIENT,90\nFEDRAT/100,MMPM\nGOTO/0,0,0\nSPINDL/MAXRPM,3000\nGOTO/1,0,0\n\
                SPINDL/MAXRPM,3000,SFM,200\nGOTO/2,0,0\n";
    let program = crate::support::program(text);
    let speeds: Vec<_> = program.motions().map(|motion| motion.spindle_rpm()).collect();
    // A surface speed without a lathe's tool makes no speed that is known, and its limit is none either.
    assert_eq!(speeds, [Some(900.0), Some(900.0), None]);
}
