//! Turning as far as CL data tell it: the plane of a lathe, its nose, and times at a constant surface speed.

use super::{apply, assert_near, read, totals};
use crate::transform::try_apply;
use clsmith::program::TurningPlane;
use clsmith::program::motion::Motion;
use std::f64::consts::{PI, TAU};

/// An NX program that turns in the plane of x and y, where x is the spindle's axis.
const NX: &str = "TOOL PATH/ROUGH,TOOL,OD_80_L\nTLDATA/TURN,1,0,0,1.6000,20.0000,5.0000,5.0000,20.0000,0.0000\n\
    LOAD/TOOL,1\nSPINDL/SMM,150.0000,CLW\nFEDRAT/MMPR,0.2000\nRAPID\nGOTO/50.0000,32.0000,0.0000\n\
    GOTO/50.0000,8.0000,0.0000\nGOTO/20.0000,8.0000,0.0000\nEND-OF-PATH\n";

/// The seconds of a path at a feed of 0.2 mm per revolution, from many short pieces of it. `rpm` tells the speed at a
/// radius.
fn brute_seconds(motion: &Motion, radius: impl Fn(&Motion, f64) -> f64, rpm: impl Fn(f64) -> f64) -> f64 {
    let pieces = 200_000;
    let mean: f64 = (0..pieces)
        .map(|piece| 1.0 / rpm(radius(motion, (f64::from(piece) + 0.5) / f64::from(pieces))))
        .sum();
    motion.length() / 0.2 * mean / f64::from(pieces) * 60.0
}

/// The seconds of a motion as clsmith tells them.
fn told_seconds(motion: &Motion) -> f64 {
    motion.length() / (0.2 * motion.spindle_rpm().unwrap()) * 60.0
}

#[test]
fn an_nx_lathe_has_times_nose_and_plane() {
    let program = read(NX);
    assert_eq!(program.turning_plane(), Some(TurningPlane::Xy));
    let facing = PI * (32.0_f64.powi(2) - 8.0_f64.powi(2)) / (0.2 * 150_000.0) * 60.0;
    let along = 30.0 / (0.2 * 150_000.0 / (TAU * 8.0)) * 60.0;
    assert_near("facing and turning", totals(&program).2, facing + along);
    let tool = program.motions().last().unwrap().tool.unwrap();
    let data = tool.data.as_ref().unwrap();
    // The number is the diameter of the nose, and no diameter of a mill.
    assert_eq!((data.diameter, data.nose_radius), (None, Some(0.8)));
}

#[test]
fn a_path_is_not_taken_out_of_the_plane_or_turned_over() {
    for (steps, told) in [
        ("rotate: { axis: x, degrees: 30 }", "would leave the plane z = 0"),
        ("mirror: z", "would be turned over"),
        ("rotate: { axis: x, degrees: 180 }", "would be turned over"),
    ] {
        let recipe = format!("version: 1\nsteps:\n  - move_origin: {{ {steps} }}\n");
        let found = try_apply(&recipe, NX).unwrap_err();
        assert!(found.iter().any(|found| found.message.contains(told)), "{steps}: {found:?}");
        assert!(found.iter().all(|found| !found.message.contains("in z")), "{steps}: {found:?}");
    }
    for steps in ["translate: [3, 5, 0]", "mirror: x", "rotate: { axis: z, degrees: 90 }"] {
        let recipe = format!("version: 1\nsteps:\n  - move_origin: {{ {steps} }}\n");
        assert!(try_apply(&recipe, NX).is_ok(), "{steps}");
    }
    // What the refusal advises does work.
    let catia = NX.replace("32.0000,0.0000", "0.0000,32.0000").replace("8.0000,0.0000", "0.0000,8.0000");
    assert_eq!(read(&catia).turning_plane(), Some(TurningPlane::Zx));
    let found =
        try_apply("version: 1\nsteps:\n  - move_origin: { rotate: { axis: z, degrees: 5 } }\n", &catia)
            .unwrap_err();
    assert!(found.iter().any(|found| found.message.ends_with("mirror in x")), "{found:?}");
    apply("  - move_origin: { mirror: x }\n", &catia);
    // A shift across the plane sets another zero; it is told, and done.
    for (text, steps, moved) in
        [(NX, "translate: [0, 0, 5]", ",5.0000\n"), (catia.as_str(), "translate: [0, 5, 0]", ",5.0000,")]
    {
        let recipe = format!("version: 1\nsteps:\n  - move_origin: {{ {steps} }}\n");
        let (written, found) = try_apply(&recipe, text).unwrap();
        assert!(written.contains(moved), "{written}");
        assert_eq!(found.iter().filter(|found| found.code.to_string() == "CL0318").count(), 1, "{found:?}");
    }
}

#[test]
fn a_tool_that_nothing_describes_may_turn_where_none_mills() {
    let facing = |lines: &str| {
        let text = "SPINDL/  150.0000,SMM,CLW\nRAPID\nGOTO/32.,0.,0.\nFEDRAT/0.2,MMPR\nGOTO/8.,0.,0.\n";
        format!("$$     CATIA APT VERSION 1.0\n{}FINI\n", lines.replace("FACE\n", text))
    };
    // The time of each ring is 2 pi r dr / (f v).
    let seconds = PI * (32.0_f64.powi(2) - 8.0_f64.powi(2)) / (0.2 * 150_000.0) * 60.0;
    for (lines, passes) in [
        ("LOADTL/3\nFACE\n", 1.0),
        ("TURRET/3\nFACE\n", 1.0),
        // One that is told only behind it: what was found for the first says nothing of the second.
        ("LOADTL/3\nFACE\nCUTTER/    1.600000\nLOADTL/4\nFACE\n", 2.0),
        ("LOADTL/3\nFACE\nTOOLNO/4,TURN\nCUTTER/    1.600000\nLOADTL/4\nFACE\n", 2.0),
    ] {
        assert_near(lines, totals(&read(facing(lines))).2, passes * seconds);
    }
    // Where a tool mills, one that nothing describes may mill, too; so does one that makes holes.
    let times = |lines: &str| totals(&read(facing(lines))).2;
    assert_near(
        "mill",
        times("TOOLNO/2,MILL\nCUTTER/10,0,5,0,0,0,60\nLOADTL/2\nGOTO/0,3,0\nLOADTL/3\nFACE\n"),
        0.0,
    );
    assert_near("holes", times("LOADTL/3\nCYCLE/DRILL,5.,2.\nFACE\n"), 0.0);
}

#[test]
fn points_of_mills_in_a_turret_do_not_count() {
    let mill = "TOOL PATH/FLAT,TOOL,EM\nTLDATA/MILL,10.,0.,75.,0.,0.\nLOAD/TOOL,2\nSPINDL/RPM,900,CLW\nGOTO/50.,3.,7.\nEND-OF-PATH\n";
    let both = format!("{NX}{mill}");
    assert_eq!(read(&both).turning_plane(), Some(TurningPlane::Xy));
    assert_eq!(read(mill).turning_plane(), None);
    // A turning tool that leaves every plane has none.
    assert_eq!(read(NX.replace("20.0000,8.0000,0.0000", "20.0000,8.0000,3.0000")).turning_plane(), None);
}

#[test]
fn a_thread_at_surface_speed_has_a_time() {
    let thread = "SPINDL/SMM,120.0000,CLW\nRAPID\nGOTO/4.,29.,0.\nPITCH/2.0000\nTHREAD/TURN\nGOTO/-25.,29.,0.\nTHREAD/OFF\nEND-OF-PATH\n";
    let text = NX
        .replace(
            "FEDRAT/MMPR,0.2000\nRAPID\nGOTO/50.0000,32.0000,0.0000\n\
    GOTO/50.0000,8.0000,0.0000\nGOTO/20.0000,8.0000,0.0000\nEND-OF-PATH\n",
            thread,
        )
        .replace("SPINDL/SMM,150.0000,CLW\n", "");
    assert!(text.contains("LOAD/TOOL,1\nSPINDL/SMM,120"), "{text}");
    let rpm = 120_000.0 / (TAU * 29.0);
    assert_near("thread", totals(&read(&text)).2, 29.0 / (2.0 * rpm) * 60.0);
}

#[test]
fn facing_past_the_axis_is_integrated_up_to_the_limit_of_the_speed() {
    for (limit, max_rpm) in [("", f64::INFINITY), (",MAXRPM,2500", 2500.0), (",MAXRPM,400", 400.0)] {
        let text = NX
            .replace("150.0000,CLW", &format!("150.0000,CLW{limit}"))
            .replace("50.0000,8.0000", "50.0000,-1.0000")
            .replace("20.0000,8.0000", "20.0000,-1.0000");
        let facing = read(&text).motions().nth(1).unwrap();
        let radius =
            |motion: &Motion, t: f64| motion.from.point.y + (motion.to.point.y - motion.from.point.y) * t;
        let rpm = |radius: f64| (150_000.0 / (TAU * radius.abs())).min(max_rpm);
        let (told, brute) = (told_seconds(&facing), brute_seconds(&facing, radius, rpm));
        assert!((told - brute).abs() < 1e-4 * brute, "{limit}: {told}, not {brute}");
        let speeds = facing.surface_rpm.unwrap();
        assert!((speeds.lowest - rpm(32.0)).abs() < 1e-6 && speeds.highest == max_rpm, "{speeds:?}");
    }
}

#[test]
fn arcs_are_integrated_exactly() {
    // A quarter of a circle, one that passes the largest radius, and one over the axis.
    for (center, start, end, sense) in [
        ([0.0, 20.0], [10.0, 20.0], [0.0, 30.0], -1.0),
        ([0.0, 20.0], [6.0, 28.0], [-6.0, 28.0], -1.0),
        ([0.0, 2.0], [6.0, 10.0], [-8.0, -4.0], -1.0),
    ] {
        for max_rpm in [f64::INFINITY, 3000.0] {
            let limit = if max_rpm.is_finite() { format!(",MAXRPM,{max_rpm}") } else { String::new() };
            let text = NX.replace("150.0000,CLW", &format!("150.0000,CLW{limit}")).replace(
                "GOTO/50.0000,8.0000,0.0000\nGOTO/20.0000,8.0000,0.0000\n",
                &format!(
                    "GOTO/{:.4},{:.4},0.\nCIRCLE/{:.4},{:.4},0.,0.,0.,{sense:.1},10.\nGOTO/{:.4},{:.4},0.\n",
                    start[0], start[1], center[0], center[1], end[0], end[1]
                ),
            );
            let arc = read(&text).motions().last().unwrap();
            let clsmith::program::geometry::MotionPath::Arc(path) = arc.path.clone() else {
                panic!("no arc: {text}")
            };
            let rpm = |radius: f64| (150_000.0 / (TAU * radius.abs())).min(max_rpm);
            let (told, brute) = (told_seconds(&arc), brute_seconds(&arc, |_, t| path.point_at(t).y, rpm));
            assert!((told - brute).abs() < 1e-5 * brute, "{center:?} {max_rpm}: {told}, not {brute}");
            let samples = (0..=1000).map(|step| rpm(path.point_at(f64::from(step) / 1000.0).y));
            let lowest = samples.fold(f64::INFINITY, f64::min);
            assert!((arc.surface_rpm.unwrap().lowest - lowest).abs() < 1e-3 * lowest, "{center:?}");
        }
    }
}

#[test]
fn a_limit_of_the_speed_holds_from_its_record_on() {
    let alone = NX.replace("SPINDL/SMM", "SPINDL/MAXRPM,900\nSPINDL/SMM");
    let before = NX.replace("SPINDL/SMM,150.0000,CLW", "SPINDL/MAXRPM,900,SMM,150.0000,CLW");
    for text in [&alone, &before] {
        let speeds: Vec<f64> =
            read(text).motions().filter_map(|motion| Some(motion.surface_rpm?.highest)).collect();
        assert!(speeds.iter().all(|speed| *speed <= 900.0) && speeds.contains(&900.0), "{speeds:?}");
        // The limit is no speed: a step that scales speeds leaves it.
        let scaled = apply("  - set_spindle: { speed: { scale: 0.5 }, feeds: keep }\n", text);
        assert!(scaled.contains("MAXRPM,900") && scaled.contains("75.0000"), "{scaled}");
    }
}

#[test]
fn the_documented_numbers_of_lathe_tools_are_converted() {
    let inch =
        apply("  - convert_units: { from: mm, to: inch }\n", NX.replace("1.6000,20.0000", "2.5400,25.4000"));
    let told = "TLDATA/TURN,1,0,0,0.1,1,5.0000,5.0000,0.787402,0.0000";
    let numbers =
        |line: &str| -> Vec<f64> { line.split(',').filter_map(|field| field.parse().ok()).collect() };
    let line = inch.lines().find(|line| line.starts_with("TLDATA")).unwrap();
    for (found, wanted) in numbers(line).iter().zip(numbers(told)) {
        assert!((found - wanted).abs() < 1e-5, "{line}");
    }
}
