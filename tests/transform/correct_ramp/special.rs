//! Ramps that are written otherwise: arcs, tilted tools, plunges, leads, several feeds.

use super::{FACE_MILL, correct, correct_program};
use crate::support;
use clsmith::program::geometry::MotionPath;
use clsmith::transform::correct_ramp::{LengtheningMethod, RampOutcome};

/// An operation of a 50 mm cutter that ramps by `ramp` and then clears 200 x 120 mm at z -2.
fn pocket(ramp: &str) -> String {
    let mut text = String::from(
        "TOOL PATH/POCKET,TOOL,FACE\nTLDATA/MILL,50.0000,6.0000,60.0000,0.0000,0.0000\nSPINDL/RPM,1600,CLW \n\
         PAINT/COLOR,211\nRAPID\nGOTO/60.0000,60.0000,20.0000\n",
    );
    text.push_str(ramp);
    text.push_str("PAINT/COLOR,31\nFEDRAT/MMPM,1200.0000\n");
    for (row, y) in (0..=6).map(|row| (row, f64::from(row) * 20.0)) {
        let (from, to) = if row % 2 == 0 { (0.0, 200.0) } else { (200.0, 0.0) };
        text.push_str(&format!("GOTO/{from:.4},{y:.4},-2.0000\nGOTO/{to:.4},{y:.4},-2.0000\n"));
    }
    text.push_str("PAINT/COLOR,211\nRAPID\nGOTO/0.0000,0.0000,50.0000\nEND-OF-PATH\n");
    text
}

const DOWN: &str = "RAPID\nGOTO/60.0000,60.0000,2.0000\nPAINT/COLOR,42\nFEDRAT/MMPM,300.0000\n";

#[test]
fn a_helix_of_arcs_stays_one_of_arcs() {
    // 2 turns of radius 4 in one record (TIMES,2), 22 mm down: too narrow and too steep.
    let ramp = "PAINT/COLOR,42\nFEDRAT/MMPM,300.0000\n\
        CIRCLE/56.0000,60.0000,-2.0000,0.0000000,0.0000000,-1.0000000,4.0000,0.0600,0.5000,50.0000,6.0000,TIMES,2\n\
        GOTO/60.0000,60.0000,-2.0000\n";
    let done = correct(FACE_MILL, pocket(ramp)).unwrap();
    let [helix] = &done.ramps[..] else { panic!() };
    assert_eq!(
        (helix.kind, helix.outcome, helix.lengthened),
        ("helix", RampOutcome::Corrected, LengtheningMethod::WidenedHelix)
    );
    assert!((helix.before.shortest_leg_mm - 8.0).abs() < 1e-9);
    let program = support::program(&done.text);
    let arcs: Vec<_> = program
        .motions()
        .filter_map(|motion| match motion.path {
            MotionPath::Arc(arc) => Some(arc),
            _ => None,
        })
        .collect();
    assert!(!arcs.is_empty() && arcs.iter().all(|arc| (arc.radius - 19.0).abs() < 1e-3));
    // The turns that 22 mm need at radius 19 and 5/38: 1.4, of which there were 2.
    let turns: f64 = arcs.iter().map(|arc| arc.sweep / std::f64::consts::TAU).sum();
    assert!((turns - 2.0).abs() < 1e-6, "{turns}");
    let fallen: f64 = arcs.iter().map(|arc| (arc.rise * arc.axis.z).abs()).sum();
    assert!((fallen - 22.0).abs() < 1e-3, "{fallen}");
    assert_eq!(correct(FACE_MILL, &done.text).unwrap().text, done.text);
}

#[test]
fn a_steep_helix_of_half_turns_gets_more_of_them() {
    let half = |x: i32, z: f64| {
        format!(
            "CIRCLE/60.0000,60.0000,{z:.4},0.0000000,0.0000000,-1.0000000,20.0000,0.0600,0.5000,50.0000,6.0000\n\
             GOTO/{x}.0000,60.0000,{z:.4}\n"
        )
    };
    let ramp = format!(
        "RAPID\nGOTO/80.0000,60.0000,18.0000\nPAINT/COLOR,42\nFEDRAT/MMPM,300.0000\n{}{}",
        half(40, 8.0),
        half(80, -2.0)
    );
    let done = correct(FACE_MILL, pocket(&ramp)).unwrap();
    let [helix] = &done.ramps[..] else { panic!() };
    // 20 mm in a turn of 125.7 mm is 9.04 degrees; two turns are enough.
    assert_eq!(
        (helix.outcome, helix.passes, helix.lengthened),
        (RampOutcome::Corrected, 2, LengtheningMethod::No)
    );
    assert_eq!(done.text.matches("CIRCLE/").count(), 4);
    assert_eq!(correct(FACE_MILL, &done.text).unwrap().text, done.text);
}

#[test]
fn a_plunge_becomes_a_ramp_along_the_first_pass() {
    let ramp = format!("{DOWN}GOTO/60.0000,60.0000,-2.0000\n");
    let done = correct(FACE_MILL, pocket(&ramp)).unwrap();
    let [plunge] = &done.ramps[..] else { panic!() };
    assert_eq!((plunge.kind, plunge.lengthened), ("plunge", LengtheningMethod::AlongPass));
    let after = plunge.after.unwrap();
    assert!(after.legs == 2 && after.shortest_leg_mm >= 38.0);
    let kept = correct(&format!("{FACE_MILL}, plunges: keep"), pocket(&ramp)).unwrap();
    assert_eq!((kept.text, kept.findings.len()), (pocket(&ramp), 1));
    assert_eq!(kept.findings[0].code.id(), "CL0322");
}

#[test]
fn the_way_down_through_air_is_no_ramp_but_one_into_material_is() {
    let ramp = format!(
        "{DOWN}GOTO/60.0000,60.0000,1.0000\nGOTO/100.0000,60.0000,-0.5000\nGOTO/60.0000,60.0000,-2.0000\n"
    );
    let done = correct(FACE_MILL, pocket(&ramp)).unwrap();
    assert_eq!((done.outcomes(), done.ramps[0].before.legs), (vec![RampOutcome::Fits], 2));
    // With a depth of cut of 4 mm there is material up to z 2, where the plunge begins.
    let done = correct(&format!("{FACE_MILL}, depth_of_cut: 4"), pocket(&ramp)).unwrap();
    assert_eq!((done.outcomes(), done.ramps[0].before.legs), (vec![RampOutcome::Corrected], 3));
}

#[test]
fn a_tilted_tool_ramps_in_its_own_frame() {
    // The same pocket, turned by 90 degrees about x: what was z is -y.
    let upright = pocket(&format!("{DOWN}GOTO/80.0000,60.0000,0.0000\nGOTO/60.0000,60.0000,-2.0000\n"));
    let mut tilted = String::new();
    let mut first = true;
    for line in upright.lines() {
        match line.strip_prefix("GOTO/") {
            Some(numbers) => {
                let [x, y, z] = numbers.split(',').map(|n| n.parse::<f64>().unwrap()).collect::<Vec<_>>()[..]
                else {
                    panic!()
                };
                let axis = if std::mem::take(&mut first) { ",0.0000000,-1.0000000,0.0000000" } else { "" };
                tilted.push_str(&format!("GOTO/{x:.4},{:.4},{y:.4}{axis}\n", 0.0 - z));
            }
            None => tilted.push_str(&format!("{line}\n")),
        }
    }
    let (one, other) = (correct(FACE_MILL, &upright).unwrap(), correct(FACE_MILL, &tilted).unwrap());
    assert_eq!(
        (one.outcomes(), other.outcomes()),
        (vec![RampOutcome::Corrected], vec![RampOutcome::Corrected])
    );
    let (a, b) = (one.ramps[0].after.unwrap(), other.ramps[0].after.unwrap());
    assert!((a.shortest_leg_mm - b.shortest_leg_mm).abs() < 1e-3 && a.legs == b.legs);
    assert!((a.steepest_degrees - b.steepest_degrees).abs() < 1e-2);
}

#[test]
fn unmarked_ramps_are_found_by_geometry_and_surfaces_are_left_alone() {
    let unmarked = |text: String| {
        text.lines()
            .filter(|line| !line.starts_with("PAINT"))
            .map(|line| format!("{line}\n"))
            .collect::<String>()
    };
    let ramp = format!("{DOWN}GOTO/80.0000,60.0000,0.0000\nGOTO/60.0000,60.0000,-2.0000\n");
    let done = correct(FACE_MILL, unmarked(pocket(&ramp))).unwrap();
    assert_eq!(done.outcomes(), [RampOutcome::Corrected]);
    // A finishing pass over waves: it goes down and up, with a flat here and there.
    let mut waves = String::from(
        "TOOL PATH/SURFACE,TOOL,FACE\nTLDATA/MILL,50.0000,6.0000,60.0000,0.0000,0.0000\nRAPID\nGOTO/0.0000,0.0000,20.0000\nFEDRAT/MMPM,300.0000\n",
    );
    for step in 0..64 {
        let z = [0.0, -1.0, -2.0, -3.0, -3.0, -2.0, -1.0, 0.0][step % 8];
        waves.push_str(&format!("GOTO/{step}.0000,0.0000,{z:.4}\n"));
    }
    waves.push_str("END-OF-PATH\n");
    assert!(correct(FACE_MILL, &waves).unwrap().ramps.is_empty());
}

#[test]
fn where_the_feed_gets_slower_all_new_points_are_slow() {
    let ramp = format!(
        "{DOWN}GOTO/80.0000,60.0000,0.0000\n$$ slower\nFEDRAT/MMPM,150.0000\nGOTO/60.0000,60.0000,-2.0000 $$ the floor\n"
    );
    let done = correct(&format!("{FACE_MILL}, region: none"), pocket(&ramp)).unwrap();
    let program = support::program(&done.text);
    let engages = program.motions().filter(|motion| motion.class == clsmith::program::MotionClass::Engage);
    let feeds: Vec<f64> = engages.map(|motion| motion.feed.unwrap().value).collect();
    assert!(feeds.len() >= 2 && feeds.iter().all(|feed| *feed == 150.0), "{feeds:?}");
    assert!(done.text.contains("$$ slower\nFEDRAT/MMPM,150.0000\n") && done.text.contains("$$ the floor"));
    let faster = pocket(&ramp.replace("150.0000", "600.0000"));
    let found = correct(&format!("{FACE_MILL}, region: none"), faster).err().unwrap();
    assert!(found.last().unwrap().message.contains("feed increases"), "{found:?}");
}

#[test]
fn cutter_compensation_and_feeds_inside_arcs_stand_in_the_way() {
    let ramp = format!(
        "{DOWN}CUTCOM/LEFT,XYPLAN\nGOTO/80.0000,60.0000,0.0000\nGOTO/60.0000,60.0000,-2.0000\nCUTCOM/OFF\n"
    );
    let found = correct(FACE_MILL, pocket(&ramp)).err().unwrap();
    assert!(found.last().unwrap().message.contains("CUTCOM"), "{found:?}");
    let half = |x: i32, z: f64, feed: &str| {
        format!(
            "CIRCLE/60.0000,60.0000,{z:.4},0.0000000,0.0000000,-1.0000000,20.0000,0.0600,0.5000,50.0000,6.0000\n{feed}GOTO/{x}.0000,60.0000,{z:.4}\n"
        )
    };
    let ramp = format!(
        "FEDRAT/MMPM,5000.0000\nGOTO/80.0000,60.0000,18.0000\nPAINT/COLOR,42\n{}{}",
        half(40, 8.0, "FEDRAT/MMPM,300.0000\n"),
        half(80, -2.0, "")
    );
    let found = correct(FACE_MILL, pocket(&ramp)).err().unwrap();
    assert!(found.last().unwrap().message.contains("feed"), "{found:?}");
}

#[test]
fn an_engage_onto_a_surface_is_no_ramp() {
    let text = "TOOL PATH/SURFACE,TOOL,FACE\nTLDATA/MILL,50.0000,6.0000,60.0000,0.0000,0.0000\nPAINT/COLOR,211\nRAPID\nGOTO/0.0000,0.0000,20.0000\nPAINT/COLOR,42\nFEDRAT/MMPM,300.0000\nGOTO/1.0000,0.0000,2.0000\nPAINT/COLOR,31\nGOTO/10.0000,0.0000,1.0000\nGOTO/20.0000,0.0000,3.0000\nEND-OF-PATH\n";
    assert!(correct(FACE_MILL, text).unwrap().ramps.is_empty());
}

#[test]
fn the_setup_knows_inserts_and_solid_cutters_are_left_alone() {
    let ramp = format!("{DOWN}GOTO/80.0000,60.0000,0.0000\nGOTO/60.0000,60.0000,-2.0000\n");
    let one = pocket(&ramp);
    let two = one.replace("TOOL,FACE", "TOOL,SOLID").replace("POCKET", "OTHER");
    let setup = "{ tools: [ { match: { name: FACE }, insert: { height: 5, radius: 6 } } ] }";
    let done = correct_program("", setup, support::program(format!("{one}{two}"))).unwrap();
    assert_eq!(done.ramps.len(), 1);
    let codes = done.codes();
    assert!(codes.contains(&"CL0320") && codes.contains(&"CL0323"), "{codes:?}");
    assert!(done.text.ends_with(&two), "the solid cutter's operation is untouched");
}

#[test]
fn around_an_outside_contour_the_part_is_no_place_to_ramp() {
    // A contour of 100 x 60 mm around a boss, with a lead 30 mm long beside it: the hull spans the boss, the milled band does not.
    let text = "TOOL PATH/BOSS,TOOL,FACE\nTLDATA/MILL,20.0000,2.0000,60.0000,0.0000,0.0000\nPAINT/COLOR,211\nRAPID\nGOTO/50.0000,0.0000,5.0000\n\
        PAINT/COLOR,42\nFEDRAT/MMPM,300.0000\nGOTO/50.0000,6.0000,1.0000\nGOTO/50.0000,0.0000,-3.0000\nPAINT/COLOR,31\n\
        GOTO/100.0000,0.0000,-3.0000\nGOTO/100.0000,60.0000,-3.0000\nGOTO/0.0000,60.0000,-3.0000\nGOTO/0.0000,0.0000,-3.0000\n\
        GOTO/50.0000,0.0000,-3.0000\nEND-OF-PATH\n";
    let tool = "tool: { diameter: 20, insert_radius: 2, insert_height: 4 }";
    let deepest = |region: &str| {
        let done = correct(&format!("{tool}, region: {region}"), text).unwrap();
        let lengthened = done.ramps[0].lengthened;
        let inside = |[x, y, _]: &&[f64; 3]| (11.0..89.0).contains(x) && (11.0..49.0).contains(y);
        (lengthened, done.ramps[0].path_after.iter().filter(inside).count())
    };
    assert_eq!(deepest("milled"), (LengtheningMethod::AlongPass, 0));
    let (_, inside) = deepest("hull");
    assert!(inside > 0, "the circle bulges into the boss");
}
