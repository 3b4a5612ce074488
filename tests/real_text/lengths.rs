//! Lengths in every record, also those written as whole numbers; cutters that stand on a point; turning.

use super::{TO_INCH, alarms, assert_near, read};
use crate::transform::{apply as apply_with_findings, try_apply};

fn around(line: &str) -> String {
    format!("UNITS/MM\nCUTTER/10\nLOADTL/1\nFEDRAT/MMPM,600\nGOTO/0,0,0\n{line}\nGOTO/30,0,0\n")
}

#[test]
fn lengths_are_converted_or_named_however_they_are_written() {
    for (line, converted) in [
        ("CLRSRF/0,0,1,40", "CLRSRF/0,0,1,1.574803"),
        ("CLRSRF/40.", "CLRSRF/1.574803"),
        ("CLEARP/XYPLAN,60", "CLEARP/XYPLAN,2.362205"),
        ("RETRCT/30", "RETRCT/1.181102"),
        ("SAFETY/15", "SAFETY/0.590551"),
        ("LOAD/TOOL,4,LENGTH,120", "LOAD/TOOL,4,LENGTH,4.724409"),
        ("LOAD/TOOL,4,ADJUST,4", "LOAD/TOOL,4,ADJUST,4"),
        ("TURRET/1,OSETNO,1,SETOOL,10,20,0", "TURRET/1,OSETNO,1,SETOOL,0.393701,0.787402,0"),
        ("CUTCOM/LEFT,OFFSET,8", "CUTCOM/LEFT,OFFSET,0.314961"),
        ("ARCSLP/ 3", "ARCSLP/ 0.11811"),
        ("PITCH/2", "PITCH/0.07874"),
        ("LOADTL/2, 2, 60, 2", "LOADTL/2, 2, 2.362205, 2"),
        ("PSIS/0,0,1,12", "PSIS/0,0,1,0.472441"),
        ("SPINDL/SMM,100,CLW,RADIUS,20", "SPINDL/SFM,328.08399,CLW,RADIUS,0.787402"),
        ("PITCH/TPI,16", "PITCH/TPI,16"),
        ("THREAD/TURN,LEAD,2", "THREAD/TURN,LEAD,0.07874"),
    ] {
        let (text, found) = apply_with_findings(TO_INCH, around(line));
        let line = text.lines().nth(5).unwrap();
        assert_eq!(line, converted);
        assert!(found.iter().all(|found| found.code.to_string() != "CL0305"), "{line}: {found:?}");
    }
    for line in [
        "COUPLE/25",
        "PIVOTZ/120",
        "CUTCOM/ADJUST,8",
        "CUTCOM/LEFT,8",
        "MYWORD/1,2,3",
        "MYWORD/3",
        "MYWORD/3.5",
        "LOADTL/2,1,60",
        "CHECK/5,XAXIS,10",
        "SET/HOLDER,50",
        "THREAD/TURN,2",
        "THREAD/2.0",
    ] {
        let (text, found) = apply_with_findings(TO_INCH, around(line));
        assert_eq!(text.lines().nth(5), Some(line));
        assert_eq!(
            found.iter().filter(|found| found.code.to_string() == "CL0305").count(),
            1,
            "{line}: {found:?}"
        );
    }
}

#[test]
fn the_second_number_of_a_feed_is_named() {
    let (text, found) = apply_with_findings(TO_INCH, around("FEDRAT/100,MMPM,MAXIPM,200"));
    assert_eq!(text.lines().nth(5), Some("FEDRAT/3.937008,IPM,MAXIPM,200"));
    assert_eq!(found.iter().filter(|found| found.code.to_string() == "CL0305").count(), 1, "{found:?}");
}

#[test]
fn every_length_of_a_tools_description_is_converted() {
    for (line, converted) in [
        // Seven and ten parameters: the centres of the corner radii, and the upper one.
        ("TLDATA/MILL,20.,2.,75.,0.,5.,8.,2.5", "TLDATA/MILL,.787402,.07874,2.952756,0.,5.,.314961,.098425"),
        (
            "TLDATA/MILL,20.,2.,75.,10.,5.,8.,2.5,1.,9.,60.",
            "TLDATA/MILL,.787402,.07874,2.952756,10.,5.,.314961,.098425,.03937,.354331,2.362205",
        ),
    ] {
        let (text, found) = apply_with_findings(TO_INCH, around(line));
        let after: Vec<f64> =
            text.lines().nth(5).unwrap().split(',').filter_map(|field| field.parse().ok()).collect();
        let wanted: Vec<f64> = converted.split(',').filter_map(|field| field.parse().ok()).collect();
        assert_eq!(after.len(), wanted.len(), "{text}");
        assert!(after.iter().zip(&wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-4), "{text}");
        assert!(found.iter().all(|found| found.code.to_string() != "CL0305"), "{line}: {found:?}");
    }
    // Each kind of tool whose numbers are not known is named, not the first alone.
    let two = around("TLDATA/TCUTTER,50.,10.,1.,1.,8.\nTLDATA/BARREL,50.,10.,1.");
    let (_, found) = apply_with_findings(TO_INCH, two);
    assert_eq!(found.iter().filter(|found| found.code.to_string() == "CL0305").count(), 2, "{found:?}");
}

#[test]
fn a_tool_change_in_a_shops_word_names_its_lengths() {
    let named = |line: &str| {
        let (text, found) = super::apply_in_words("{ TC_LOAD: tool_change }", TO_INCH, around(line));
        assert_eq!(text.lines().nth(5), Some(line));
        found.iter().filter(|found| found.code.to_string() == "CL0305").count()
    };
    assert_eq!(named("TC_LOAD/5, 120.5"), 1);
    assert_eq!(named("TC_LOAD/5, 120"), 1);
    assert_eq!(named("TC_LOAD/5, LEN=120"), 1);
    assert_eq!(named("TC_LOAD/5"), 0);
}

#[test]
fn the_plane_of_a_part_surface_moves_with_the_path() {
    // The numbers of the plane behind a step, and how often it was named.
    let plane = |line: &str, steps: &str| {
        let (text, found) = apply_with_findings(steps, around(line));
        // A turn puts records of the axis in front of it.
        let line = text.lines().find(|line| line.starts_with("PSIS")).unwrap();
        let fields = line.split(['/', ',', '(', ')']).filter_map(|field| field.trim().parse().ok());
        let numbers: Vec<f64> = fields.map(|number: f64| number + 0.0).collect();
        (numbers, found.iter().filter(|found| found.message.contains("part surface")).count())
    };
    // The points (x, y, 12) become (x + 5, y - 3, 14).
    assert_eq!(plane("PSIS/(PLANE/0.,0.,1.,12.)", super::MOVE), (vec![0.0, 0.0, 1.0, 14.0], 0));
    assert_eq!(plane("PSIS/(PLANE/1.,0.,0.,12.)", super::MOVE), (vec![1.0, 0.0, 0.0, 17.0], 0));
    let turned = "  - move_origin: { rotate: { axis: y, degrees: 90 }, translate: [1, 0, 0] }\n";
    // z becomes x, so the plane is x = 12 + 1.
    assert_eq!(plane("PSIS/(PLANE/0.,0.,1.,12.)", turned), (vec![1.0, 0.0, 0.0, 13.0], 0));
    assert_eq!(plane("PSIS/3.,4.", super::MOVE), (vec![3.0, 4.0], 1));
}

#[test]
fn a_cone_on_its_tip_is_a_cutter() {
    let cutter = |numbers: &str| {
        format!(
            "UNITS/MM\nCUTTER/{numbers}\nLOADTL/1\nSPINDL/RPM,900,CLW\nFEDRAT/MMPM,600\nGOTO/0,0,0\nGOTO/9,0,0\n"
        )
    };
    assert_eq!(alarms(cutter("0,0,0,0,0,20,30")), []);
    assert_eq!(alarms(cutter("0,0,0,0,0,0,30")), [("CL0133".to_owned(), 2)]);
}

/// A facing operation in radius, at a surface speed.
fn facing(speed: &str, from: f64, to: f64) -> String {
    format!(
        "$$     CATIA APT VERSION 1.0\nTOOLNO/3,TURN,1,0,3,    0.800000\nCUTTER/    1.600000\nLOADTL/3,1,1\n\
         SPINDL/  {speed},CLW\nFEDRAT/    0.2000,MMPR\nGOTO  /{from:>11.5},    0.00000,    0.00000\n\
         GOTO  /{to:>11.5},    0.00000,    0.00000\nFINI\n"
    )
}

#[test]
fn a_lathe_that_keeps_its_surface_speed_has_times() {
    for (speed, metres) in [("150.0000,SMM", 150.0), ("400.0000,SFM", 121.92)] {
        let motion = read(facing(speed, 32.0, 8.0)).motions().last().unwrap();
        let rpm = motion.spindle_rpm().unwrap();
        // The time of each ring is 2 pi r dr / (f v).
        let seconds =
            std::f64::consts::PI * (32.0_f64.powi(2) - 8.0_f64.powi(2)) / (0.2 * metres * 1000.0) * 60.0;
        assert_near(speed, motion.length() / (0.2 * rpm) * 60.0, seconds);
    }
    // A mill's surface speed is that of its own diameter.
    let mill = facing("150.0000,SMM", 32.0, 8.0).replace("    1.600000", "16.,0,8.,0,0,0,60.");
    assert_eq!(read(mill).motions().last().unwrap().spindle_rpm(), None);
}

#[test]
fn a_lathes_path_is_not_turned_out_of_its_plane() {
    let text = facing("150.0000,SMM", 32.0, 8.0);
    for steps in
        ["rotate: { axis: z, degrees: 30 }", "rotate: { axis: x, degrees: 90 }, translate: [0, 1, 0]"]
    {
        let recipe = format!("version: 1\nsteps:\n  - move_origin: {{ {steps} }}\n");
        let found = try_apply(&recipe, &text).unwrap_err();
        assert!(found.iter().any(|found| found.message.contains("plane")), "{found:?}");
    }
    for steps in ["translate: [3, 0, 5]", "rotate: { axis: y, degrees: 90 }"] {
        let recipe = format!("version: 1\nsteps:\n  - move_origin: {{ {steps} }}\n");
        assert!(try_apply(&recipe, &text).is_ok(), "{steps}");
    }
}

#[test]
fn numbers_of_hundreds_of_digits_are_told_shortly() {
    let source = crate::support::text("GOTO/0,0,0\nGOTO/9e290,1,2\nCIRCLE/0,0,0,0,0,1,5\nGOTO/0,5,0\n");
    let (_, found) = clsmith::check::read_and_check(&source, None);
    assert!(found.iter().any(|found| found.message.contains("9e290")), "{found:?}");
    assert!(
        found.iter().all(|found| found.message.len() < 120 && !found.message.contains("inf")),
        "{found:?}"
    );
}
