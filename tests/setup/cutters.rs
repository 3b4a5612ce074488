//! Cutters of each dialect's words, and of what the setup adds to them.

use super::{close, good, tool};
use clsmith::cutter::NonCuttingKind;
use clsmith::program::LengthUnit;
use clsmith::program::motion::ActiveTool;
use clsmith::setup::{ResolvedCutter, Setup};

#[track_caller]
fn cutter(program: &str, setup: &str, units: LengthUnit) -> ResolvedCutter {
    let setup = if setup.is_empty() { Setup::default() } else { good(setup) };
    setup.resolve_cutter(&tool(program), units).unwrap()
}

const MM: LengthUnit = LengthUnit::Mm;

#[test]
fn a_mill_of_nx() {
    let found = cutter("TLDATA/MILL,12.0000,2.0000,60.0000,3.0000,5.0000\nGOTO/0,0,0\n", "", MM);
    let profile = &found.cutter.profile;
    close(profile.corner_radius_mm(), 2.0);
    close(profile.taper_rad(), 3_f64.to_radians());
    close(profile.bottom_angle_rad(), 5_f64.to_radians());
    close(profile.height_mm(), 60.0);
    assert_eq!(found.cutter.teeth, None);
    assert_eq!(
        found.assumptions,
        [
            "flute length 60 mm: the CL file only gives the length of the tool",
            "no holder: setup.tools gives none"
        ]
    );
}

#[test]
fn a_drill_of_nx_has_a_point_angle_and_flutes_below_a_shank() {
    let found = cutter("TLDATA/DRILL,MILL,10.0000,0.0000,50.0000,118.0000,35.0000\nGOTO/0,0,0\n", "", MM);
    let profile = &found.cutter.profile;
    close(profile.bottom_angle_rad(), 31_f64.to_radians());
    close(profile.height_at_radius_mm(5.0), 5.0 * 31_f64.to_radians().tan());
    close(profile.height_mm(), 35.0);
    let [shank] = found.cutter.collars.as_slice() else { panic!() };
    assert_eq!(
        (shank.kind, shank.radius_mm, shank.from_mm, shank.to_mm),
        (NonCuttingKind::Shank, 5.0, 35.0, 50.0)
    );
    assert_eq!(found.assumptions.len(), 2, "{:?}", found.assumptions);
}

#[test]
fn the_seven_numbers_of_cutter() {
    let found = cutter("CUTTER/16.,0,8.,4.806885,31.,0,71.\nLOADTL/1\nGOTO/0,0,0\n", "", MM);
    close(found.cutter.profile.bottom_angle_rad(), 31_f64.to_radians());
    close(found.cutter.radius_mm(), 8.0);
    close(found.cutter.flute_length_mm(), 71.0);
}

#[test]
fn creo_says_only_the_diameter() {
    let found = cutter("LOADTL / 1\n$$-> CUTTER / 0.500000\nGOTO / 0, 0, 0\n", "", LengthUnit::Inch);
    close(found.cutter.radius_mm(), 6.35);
    close(found.cutter.flute_length_mm(), 50.8);
    assert!(found.cutter.collars.is_empty());
    assert_eq!(
        found.assumptions,
        [
            "a flat bottom (tip 0): neither the CL file nor setup.tools gives its angle",
            "corner radius 0: neither the CL file nor setup.tools gives one",
            "taper 0: neither the CL file nor setup.tools gives one",
            "flute length 2 in: neither the CL file nor setup.tools gives one",
            "no holder: setup.tools gives none",
        ]
    );
}

#[test]
fn an_entry_overrides_what_the_file_says_and_leaves_the_rest() {
    let setup = "tools: [ { match: { number: 4 }, corner_radius: 1, flute_length: 20, teeth: 4, helix: 38,\n  \
        shank: { diameter: 11, length: 45 }, holder: { diameter: 32, length: 60 } } ]";
    let found = cutter("TLDATA/MILL,12.0,2.0,60.0,0.0,0.0\nLOAD/TOOL,4\nGOTO/0,0,0\n", setup, MM);
    close(found.cutter.radius_mm(), 6.0);
    close(found.cutter.profile.corner_radius_mm(), 1.0);
    assert!(found.assumptions.is_empty(), "{:?}", found.assumptions);
    assert_eq!(found.cutter.teeth.as_ref().unwrap().count(), 4);
    let [shank, holder] = found.cutter.collars.as_slice() else { panic!() };
    assert_eq!((shank.radius_mm, shank.from_mm, shank.to_mm), (5.5, 20.0, 45.0));
    assert_eq!(
        (holder.kind, holder.radius_mm, holder.from_mm, holder.to_mm),
        (NonCuttingKind::Holder, 16.0, 45.0, 105.0)
    );
}

#[test]
fn an_entry_is_enough_where_the_file_says_nothing() {
    let setup = good(
        "tools: [ { match: {}, diameter: 6, corner_radius: 3, taper: 0, tip: 0, holder: { diameter: 20, length: 5 } } ]",
    );
    let found = setup.resolve_cutter(&ActiveTool::default(), MM).unwrap();
    assert_eq!(found.cutter.profile.bottom_radius_mm(), 0.0);
    close(found.cutter.flute_length_mm(), 24.0);
    let [holder] = found.cutter.collars.as_slice() else { panic!() };
    close(holder.from_mm, 24.0);
    // A lathe's tool that the setup describes as a cutter is one.
    let lathe = tool("TLDATA/TURN,1.0,0.4\nGOTO/0,0,0\n");
    assert!(setup.resolve_cutter(&lathe, MM).is_ok());
    assert!(Setup::default().resolve_cutter(&lathe, MM).is_err());
}

#[test]
fn inches_of_the_file_and_millimetres_of_the_setup_meet() {
    let setup = "units: mm\ntools: [ { match: {}, flute_length: 20 } ]";
    let found = cutter("TLDATA/MILL,0.5,0.125,3.0,0.0,0.0\nGOTO/0,0,0\n", setup, LengthUnit::Inch);
    close(found.cutter.radius_mm(), 6.35);
    close(found.cutter.profile.corner_radius_mm(), 3.175);
    close(found.cutter.flute_length_mm(), 20.0);
    close(found.cutter.collars[0].to_mm, 76.2);
}

#[test]
fn a_ball_stays_a_ball_when_its_radius_was_rounded() {
    // 3/16 inch: half of it does not fit four decimals.
    for radius in ["0.0938", "0.0937"] {
        let text = format!("TLDATA/MILL,0.1875,{radius},3.0,0.0,0.0\nGOTO/0,0,0\n");
        let found = cutter(&text, "", LengthUnit::Inch);
        assert_eq!(found.cutter.profile.bottom_radius_mm(), 0.0, "{radius}");
    }
}

#[test]
fn an_unsaid_flute_length_ends_where_the_shank_does() {
    let setup = "tools: [ { match: {}, shank: { diameter: 10, length: 30 } } ]";
    let found = cutter("TLDATA/MILL,12.0,2.0,60.0,0.0,0.0\nGOTO/0,0,0\n", setup, MM);
    close(found.cutter.flute_length_mm(), 30.0);
    assert!(found.cutter.collars.is_empty());
}

#[test]
fn zeros_that_nobody_filled_in_say_nothing() {
    let found = cutter("TLDATA/DRILL,MILL,10.0,0.0,0.0,0.0,0.0\nGOTO/0,0,0\n", "", MM);
    assert_eq!(found.cutter.profile.bottom_angle_rad(), 0.0);
    close(found.cutter.flute_length_mm(), 40.0);
}

#[test]
fn every_fixture_gives_a_cutter_or_says_what_is_missing() {
    for (_, path) in crate::support::fixtures() {
        let source = crate::support::source(&path);
        let program = clsmith::parse::parse(&source, None).program;
        for motion in program.motions() {
            let Some(tool) = motion.tool else { continue };
            match Setup::default().resolve_cutter(&tool, MM) {
                Ok(found) => assert!(found.cutter.radius_mm() > 0.0),
                Err(gap) => assert_eq!(gap.diagnostic(&source, Default::default()).code.id(), "CL0501"),
            }
        }
    }
}
