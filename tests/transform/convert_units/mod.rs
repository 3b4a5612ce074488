//! convert_units.

use super::move_origin::{CAMWORKS, CATIA, CREO, MAKINO, NX, SOLIDWORKS, diff, shown};
use super::moved::{Place, assert_moved};
use super::{apply, try_apply};
use crate::support::{self, snapshots};
use clsmith::program::Program;

mod corpus;

const SAID: [(&str, &str); 4] =
    [("creo", CREO), ("solidworks", SOLIDWORKS), ("camworks", CAMWORKS), ("makino", MAKINO)];

#[test]
fn every_dialect_in_its_own_words() {
    for (name, text) in SAID {
        let to = if name == "creo" { "mm" } else { "inch" };
        let (after, findings) = apply(&format!("  - convert_units: {{ to: {to} }}"), text);
        snapshots("convert_units").bind(|| {
            insta::assert_snapshot!(name, format!("\n{}{}", diff(text, &after), shown(&findings).join("\n")));
        });
    }
    for (name, text) in [("nx", NX), ("catia", CATIA)] {
        let (after, findings) = apply("  - convert_units: { from: mm, to: inch }", text);
        snapshots("convert_units").bind(|| {
            insta::assert_snapshot!(name, format!("\n{}{}", diff(text, &after), shown(&findings).join("\n")));
        });
    }
}

#[test]
fn the_unit_must_be_known_and_must_agree() {
    let found = try_apply("version: 1\nsteps:\n  - convert_units: { to: inch }", NX).unwrap_err();
    assert!(found[0].message.contains("does not state"), "{found:?}");
    assert!(found[0].help.as_ref().unwrap().contains("from:"));
    let found = try_apply("version: 1\nsteps:\n  - convert_units: { from: mm, to: inch }", CREO).unwrap_err();
    assert!(found[0].message.contains("another unit"), "{found:?}");
    let twice = SOLIDWORKS.replace("FINI", "UNITS/INCHES\nFINI");
    let found = try_apply("version: 1\nsteps:\n  - convert_units: { to: inch }", twice).unwrap_err();
    assert!(found[0].message.contains("changes its unit"), "{found:?}");
}

#[test]
fn a_program_that_has_the_unit_is_left_alone() {
    for (name, text) in SAID {
        let to = if name == "creo" { "inch" } else { "mm" };
        let (after, findings) = apply(&format!("  - convert_units: {{ to: {to} }}"), text);
        assert_eq!(after, text);
        assert!(findings.is_empty());
    }
    assert_eq!(apply("  - convert_units: { from: mm, to: mm }", NX).0, NX);
    let step = "  - convert_units: { to: inch }";
    let (once, _) = apply(step, SOLIDWORKS);
    assert_eq!(apply(step, &once).0, once);
}

#[test]
fn there_and_back_gives_the_same_places_and_feeds() {
    let both = "  - convert_units: { to: inch }\n  - convert_units: { to: mm }";
    for (_, text) in SAID.iter().filter(|(name, _)| *name != "creo") {
        same(&support::program(text), &support::program(apply(both, text).0));
    }
    let both = "  - convert_units: { from: mm, to: inch }\n  - convert_units: { from: inch, to: mm }";
    for text in [NX, CATIA] {
        same(&support::program(text), &support::program(apply(both, text).0));
    }
}

fn same(before: &Program, after: &Program) {
    // The feeds may differ in their last decimals; everything else is held by the property of a move by nothing.
    for (old, new) in before.motions().zip(after.motions()) {
        let (old, new) = (old.feed.map(|feed| feed.value), new.feed.map(|feed| feed.value));
        assert!((old.unwrap_or(0.0) - new.unwrap_or(0.0)).abs() <= 1e-3, "{old:?} {new:?}");
    }
    let scaled = |program: &Program| {
        let text = String::from_utf8_lossy(&program.to_bytes()).into_owned();
        let step = "  - scale_feed: { factor: 1 }";
        let feeds = text.lines().filter(|line| !line.contains("FEDRAT") && !line.contains("CYCLE"));
        apply(step, feeds.collect::<Vec<_>>().join("\n")).0
    };
    let (before, after) = (support::program(scaled(before)), support::program(scaled(after)));
    assert_moved("round trip", &before, &after, &Place::identity(), 1e-4);
}

#[test]
fn feeds_by_their_words() {
    let text = "UNITS/MM
SPINDL/120.0,SMM,CLW
FEDRAT/PERMIN,254
GOTO/1.0,0.0,0.0
FEDRAT/0.1000,MMPR
GOTO/2.0,0.0,0.0
FEDRAT/0.2540
GOTO/3.0,0.0,0.0
FEDRAT/INVERS,3.5
GOTO/4.0,0.0,0.0
FEDRAT/4.5
FEDRAT/IPM,12.0
SPINDL/500.0,RPM,CLW
CYCLE/DRILL,DEPTH,25.4,IPM,12.0,CLEAR,2.54
CYCLE/DRILL,DEPTH,25.4,MMPR,0.254,CLEAR,2.54,DWELL,2.0
CYCLE/TAP,DEPTH,25.4,TPI,20.0
";
    let (after, findings) = apply("  - convert_units: { to: inch }", text);
    assert!(findings.is_empty(), "{:?}", shown(&findings));
    snapshots("convert_units").bind(|| insta::assert_snapshot!("feeds", after));
}

#[test]
fn what_is_not_understood_is_reported() {
    let text = "UNITS/MM
TOOLNO/1,MILL,1,0,   10.000000,  100.000000,$
   50.000000
SPINDL/ 500.0000,SFM,CCLW
TURRET/1,OSETNO,1,SETOOL,    1.500000,    0.000000,    0.000000
WIDGET/1.5
PPRINT/ESCAPE-HEIGHT,50.0000000
PPRINT/PART-LEAST,0.0000001
INSERT/Stock Size X55. Y35. Z32.25
DELAY/   50.000000
";
    let (after, findings) = apply("  - convert_units: { to: inch }", text);
    let inches = text.replace("UNITS/MM", "UNITS/INCHES").replace("1.500000,", "0.05905512,");
    assert_eq!(after, inches);
    snapshots("convert_units").bind(|| insta::assert_snapshot!("reported", shown(&findings).join("\n")));
}

#[test]
fn a_converted_file_that_states_no_unit_is_not_converted_again() {
    let step = "  - convert_units: { from: mm, to: inch }";
    let (once, _) = apply(step, NX);
    let found = try_apply(&format!("version: 1\nsteps:\n{step}"), &once).unwrap_err();
    assert_eq!(found.last().unwrap().code.id(), "CL0302");
}

/// The pitch of a thread is a length wherever it stands; threads per inch stay.
#[test]
fn pitches_are_converted_and_threads_per_inch_stay() {
    let text = "PARTNO/A\nUNITS/MM\nPITCH/2.54,INCR,25.4\nPITCH/LEAD,5.08\nPITCH/TPI,20\nTHREAD/TURN,PITCH,12.7\nFEDRAT/MMPM,254.0\n\
                GOTO/0.0,0.0,25.4\nFINI\n";
    let (after, _) = apply("  - convert_units: { to: inch }", text);
    for row in ["PITCH/0.1", "INCR,1.", "PITCH/LEAD,0.2", "PITCH/TPI,20\n", "THREAD/TURN,PITCH,0.5"] {
        assert!(after.contains(row), "{row}: {after}");
    }
}

/// A clearance plane is a normal and a distance, as in CLRSRF; the offsets and the length of a tool are lengths in every
/// record that calls one.
#[test]
fn planes_and_offsets_of_tools_are_converted() {
    let text = "PARTNO/A\nUNITS/MM\nCLEARP/0.0,0.0,1.0,50.8\nLOAD/TOOL,4,ADJUST,4,ZOFF,25.4\nTURRET/2,XOFF,12.7,ZOFF,50.8\n\
                SELECT/TOOL,4,LENGTH,101.6\nFEDRAT/MMPM,254.0\nGOTO/0.0,0.0,25.4\nFINI\n";
    let (after, _) = apply("  - convert_units: { to: inch }", text);
    for row in [
        "CLEARP/0.0,0.0,1.0,2",
        "ADJUST,4,ZOFF,1.",
        "TURRET/2,XOFF,0.5",
        "ZOFF,2.",
        "SELECT/TOOL,4,LENGTH,4.",
    ] {
        assert!(after.contains(row), "{row}: {after}");
    }
}
