//! `inverse_time`: motions keep their time, whatever is written.

use super::move_origin::{diff, shown};
use super::{apply, try_apply};
use crate::support::{program, snapshots};
use clsmith::program::{FeedUnit, LengthUnit};

/// The time of each motion at feed in minutes, by its feed.
fn minutes(text: &str) -> Vec<f64> {
    let program = program(text);
    let feeds = program.motions().filter(|motion| !motion.rapid && motion.length() > 0.0).map(|motion| {
        let length = motion.length();
        let rpm = motion.spindle_rpm();
        let feed = motion.feed.unwrap().mm_per_minute(LengthUnit::Mm, rpm, Some(length)).unwrap();
        length / feed
    });
    feeds.collect()
}

const PART: &str = "PARTNO/A\nUNITS/MM\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/0,0,0,0,0,1\nFEDRAT/900.0,MMPM\n\
GOTO/10,0,0\nGOTO/10,30,0,0,0.0871557,0.9961947\nCOOLNT/ON\nGOTO/10,34,0,0,0.1736482,0.9848078\nGOTO/10,50,0\nFEDRAT/0.2,MMPR\nGOTO/20,50,0,0,0.0871557,0.9961947\nGOTO/20,80,0\nFINI\n";

#[test]
fn a_motion_that_turns_takes_its_time() {
    let (after, findings) = apply("  - inverse_time: {}\n", PART);
    assert!(findings.is_empty(), "{findings:?}");
    // F = 60 / T with T in s: 30 mm and 4 mm at 900 mm/min, and 10 mm at 1000.
    let wanted = "RAPID\nGOTO/0,0,0,0,0,1\nFEDRAT/900.0,MMPM\nGOTO/10,0,0\nFEDRAT/30.00000,INVERS\n\
GOTO/10,30,0,0,0.0871557,0.9961947\nCOOLNT/ON\nFEDRAT/225.0000,INVERS\nGOTO/10,34,0,0,0.1736482,0.9848078\n\
FEDRAT/900.0,MMPM\nGOTO/10,50,0\nFEDRAT/0.2,MMPR\nFEDRAT/100.0000,INVERS\nGOTO/20,50,0,0,0.0871557,0.9961947\n\
FEDRAT/0.2,MMPR\nGOTO/20,80,0\nFINI\n";
    assert!(after.ends_with(wanted), "{after}");
    let (before, after_minutes) = (minutes(PART), minutes(&after));
    assert_eq!(before.len(), after_minutes.len());
    for (before, after) in before.iter().zip(&after_minutes) {
        assert!((before - after).abs() < 1e-6 * before, "{before} and {after}");
    }
    // A second run changes nothing.
    assert_eq!(apply("  - inverse_time: {}\n", &after).0, after);
    let units: Vec<_> = program(&after).motions().filter_map(|motion| motion.feed?.unit).collect();
    assert!(units.contains(&FeedUnit::InverseTime) && units.contains(&FeedUnit::MmPerRevolution));
}

#[test]
fn every_dialect_is_written_in_its_own_form() {
    let creo = "$$-> MFGNO / A\nUNITS / MM\nRAPID\nGOTO / 0.0000000000, 0.0000000000, 0.0000000000, $\n0.0000000000, 0.0000000000, 1.0000000000\nFEDRAT / 600.000000, MMPM\nGOTO / 10.0000000000, 0.0000000000, 0.0000000000, $\n0.0000000000, 0.0871557427, 0.9961946981\nFINI\n";
    let catia = "PARTNO A\nUNITS/MM\nMULTAX\nRAPID\nGOTO  /    0.00000,    0.00000,    0.00000, 0.000000, 0.000000, 1.000000\nFEDRAT/  600.0000,MMPM\nGOTO  /   10.00000,    0.00000,    0.00000, 0.000000, 0.087156, 0.996195\nFINI\n";
    let nx = "TOOL PATH/A,TOOL,T1\nRAPID\nGOTO/0.0000,0.0000,0.0000,0.0000000,0.0000000,1.0000000\nFEDRAT/MMPM,600.0000\nGOTO/10.0000,0.0000,0.0000,0.0000000,0.0871557,0.9961947\nEND-OF-PATH\n";
    for (name, text) in [("creo", creo), ("catia", catia), ("nx", nx), ("part", PART)] {
        let (after, findings) = apply("  - inverse_time: { word: INVERS }\n", text);
        let told = format!("\n{}{}", diff(text, &after), shown(&findings).join("\n"));
        snapshots("machine").bind(|| insta::assert_snapshot!(format!("inverse_time_{name}"), told));
    }
}

#[test]
fn all_motions_where_it_is_asked_for() {
    let (after, _) = apply("  - inverse_time: { all: true }\n", PART);
    assert_eq!(after.matches("INVERS").count(), 6, "{after}");
    let (before, after) = (minutes(PART), minutes(&after));
    assert!(before.iter().zip(&after).all(|(before, after)| (before - after).abs() < 1e-6 * before));
}

#[test]
fn the_word_is_that_of_the_file_or_asked_for() {
    let nx = "TOOL PATH/A,TOOL,T1\nRAPID\nGOTO/0,0,0,0,0,1\nFEDRAT/MMPM,600.0000\nGOTO/10,0,0,0,0.0871557,0.9961947\nEND-OF-PATH\n";
    let refused = try_apply("version: 1\nsteps:\n  - inverse_time: {}\n", nx).unwrap_err();
    assert!(refused[0].message.contains("word: INVERS"), "{}", refused[0].message);
    let (after, _) = apply("  - inverse_time: { word: INVTIM }\n", nx);
    assert!(after.contains("FEDRAT/MMPM,600.0000\nFEDRAT/INVTIM,60.00000\nGOTO/10,"), "{after}");
    let own =
        nx.replace("GOTO/10,0,0,0", "FEDRAT/INVTIM,5.0\nGOTO/5,0,0\nFEDRAT/MMPM,600.0000\nGOTO/15,0,0,0");
    let (after, _) = apply("  - inverse_time: {}\n", &own);
    assert!(after.contains("FEDRAT/INVTIM,60.00000\nGOTO/15,"), "{after}");
}

#[test]
fn what_has_no_time_of_its_own_is_left_and_told() {
    // A FEDRAT without a unit would be read as inverse time behind one.
    let bare = PART.replace("FEDRAT/0.2,MMPR", "FEDRAT/300.0");
    let refused = try_apply("version: 1\nsteps:\n  - inverse_time: {}\n", &bare).unwrap_err();
    assert!(refused[0].message.contains("names no unit"), "{}", refused[0].message);
    // The tip stands: without a machine nobody knows how long, with one its axes say it.
    let standing = "PARTNO/A\nUNITS/MM\nRAPID\nGOTO/0,0,0,0,0,1\nFEDRAT/900.0,MMPM\nGOTO/0,0,0,0,0.1736482,0.9848078\nFINI\n";
    let (after, findings) = apply("  - inverse_time: {}\n", standing);
    assert_eq!(after, standing);
    assert!(findings.len() == 1 && findings[0].message.contains("tip stands"), "{findings:?}");
    let axis = |name: &str, kind: &str, direction: &str| {
        let point = if kind == "rotary" { "point: [0, 0, 0], " } else { "" };
        format!(
            "      - {{ name: {name}, kind: {kind}, direction: {direction}, {point}max_speed: 1200, rapid: 9000, acceleration: 400 }}\n"
        )
    };
    let recipe = format!(
        "version: 1\nsetup:\n  machine:\n    table:\n{}    head:\n{}{}{}steps:\n  - inverse_time: {{}}\n",
        axis("A", "rotary", "[1, 0, 0]"),
        axis("X", "linear", "[1, 0, 0]"),
        axis("Y", "linear", "[0, 1, 0]"),
        axis("Z", "linear", "[0, 0, 1]")
    );
    let (after, findings) = try_apply(&recipe, standing).unwrap();
    // 10 degrees at 1200 deg/min: 0.5 s, of which 120 fit into a minute.
    assert!(findings.is_empty() && after.contains("FEDRAT/120.000"), "{after} {findings:?}");
}
