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
    ] {
        let (text, found) = apply_with_findings(TO_INCH, around(line));
        let line = text.lines().nth(5).unwrap();
        assert_eq!(line, converted);
        assert!(found.iter().all(|found| found.code.to_string() != "CL0305"), "{line}: {found:?}");
    }
    for line in
        ["COUPLE/25", "PIVOTZ/120", "CUTCOM/ADJUST,8", "LOADTL/2, 2, 60, 2", "CUTCOM/LEFT,8", "MYWORD/1,2,3"]
    {
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
    for steps in [
        "rotate: { axis: z, degrees: 30 }",
        "translate: [0, 5, 0]",
        "rotate: { axis: x, degrees: 90 }, translate: [0, 1, 0]",
    ] {
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
