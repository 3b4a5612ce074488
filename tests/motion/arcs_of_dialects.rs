//! The sense of arcs: measured for each dialect, wrong in every reader that guesses.

use crate::support::{clean_motions, motions, only_arc, program_of};
use clsmith::program::Dialect;
use clsmith::program::geometry::CircularArc;
use clsmith::program::motion::MotionProblemKind;
use nalgebra::{Point3, Vector3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The arc about the origin from (10,0,0) to (0,10,0); `circle` is the record, `before` the point before.
fn quarter(dialect: Dialect, before: &str, circle: &str) -> CircularArc {
    let text = format!("GOTO/{before}\nGOTO/10,0,0\n{circle}\nGOTO/0,10,0\n");
    only_arc(&clean_motions(&program_of(dialect, text))).clone()
}

const BELOW: &str = "10,-5,0";
const ABOVE: &str = "10,5,0";

#[track_caller]
fn assert_counter_clockwise(arc: &CircularArc) {
    assert!(
        (arc.sweep - FRAC_PI_2).abs() < 1e-12 && (arc.tangent_at(0.0) - Vector3::y()).norm() < 1e-12,
        "{arc:?}"
    );
}

#[track_caller]
fn assert_clockwise(arc: &CircularArc) {
    assert!(
        (arc.sweep - 1.5 * PI).abs() < 1e-12 && (arc.tangent_at(0.0) + Vector3::y()).norm() < 1e-12,
        "{arc:?}"
    );
}

#[test]
fn nx_and_ff_are_left_hand() {
    for dialect in [Dialect::Nx, Dialect::MakinoFf] {
        assert_counter_clockwise(&quarter(dialect, BELOW, "CIRCLE/0,0,0,0,0,-1,10,0.06,0.5,10,0"));
        assert_clockwise(&quarter(dialect, ABOVE, "CIRCLE/0,0,0,0,0,1,10,0.06,0.5,10,0"));
        // The tangent has no say: a sharp corner is allowed.
        assert_clockwise(&quarter(dialect, BELOW, "CIRCLE/0,0,0,0,0,1,10,0.06,0.5,10,0"));
    }
}

#[test]
fn solidworks_is_right_hand_and_prints_no_radius() {
    assert_counter_clockwise(&quarter(Dialect::SolidWorks, BELOW, "CIRCLE/0,0,0,0,0,1."));
    assert_clockwise(&quarter(Dialect::SolidWorks, BELOW, "CIRCLE/0,0,0,0,0,-1."));
}

#[test]
fn the_word_decides_in_clt() {
    assert_counter_clockwise(&quarter(Dialect::CamWorks, BELOW, "CIRCLE/ 0,0,0,0,0,1,10,COUNTERCLOCKWISE "));
    assert_clockwise(&quarter(Dialect::CamWorks, BELOW, "CIRCLE/ 0,0,0,0,0,1,10,CLOCKWISE "));
    // The word counts in any dialect.
    assert_counter_clockwise(&quarter(Dialect::Nx, BELOW, "CIRCLE/0,0,0,0,0,1,10,CCLW"));
}

#[test]
fn iso_continues_the_motion_before() {
    for axis in ["0,0,1", "0,0,-1"] {
        assert_counter_clockwise(&quarter(Dialect::Iso, BELOW, &format!("CIRCLE/0,0,0,{axis},10")));
        assert_clockwise(&quarter(Dialect::Iso, ABOVE, &format!("CIRCLE/0,0,0,{axis},10")));
    }
}

#[test]
fn creo_is_right_hand_whatever_comes_before() {
    for dialect in [Dialect::Creo, Dialect::CreoGpost] {
        for before in [BELOW, ABOVE] {
            assert_counter_clockwise(&quarter(dialect, before, "CIRCLE/0,0,0,0,0,1,10"));
            assert_clockwise(&quarter(dialect, before, "CIRCLE/0,0,0,0,0,-1,10"));
        }
    }
}

#[test]
fn where_the_motion_before_does_not_tell_the_sense_is_right_hand_and_said_to_be_assumed() {
    for before in ["GOTO/5,0,0\nGOTO/10,0,0", "GOTO/10,-5,0\nRAPID\nGOTO/10,0,0", "GOTO/10,0,0"] {
        let program = program_of(Dialect::Iso, format!("{before}\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n"));
        let (found, problems) = motions(&program);
        assert_eq!(problems, [MotionProblemKind::AssumedSense], "{before}");
        assert_counter_clockwise(only_arc(&found));
    }
}

#[test]
fn an_arc_continues_an_arc() {
    let text = "GOTO/10,-5,0\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\nCIRCLE/0,15,0,0,0,1,5\nGOTO/-5,15,0\n";
    let found = clean_motions(&program_of(Dialect::Iso, text));
    let clsmith::program::geometry::MotionPath::Arc(second) = &found[3].path else { panic!() };
    // Counter-clockwise into (0,10) the tool goes to -x; about (0,15) that is clockwise.
    assert!(
        (second.tangent_at(0.0) + Vector3::x()).norm() < 1e-12 && (second.sweep - FRAC_PI_2).abs() < 1e-12
    );
}

#[test]
fn movarc_is_right_hand_with_its_angle() {
    assert_counter_clockwise(&quarter(Dialect::Iso, BELOW, "MOVARC/0, 0, 0, 0, 0, 1, 10, ANGLE, 90"));
    assert_clockwise(&quarter(Dialect::Iso, BELOW, "MOVARC/0, 0, 0, 0, 0, -1, 10, ANGLE, 270"));
    assert_counter_clockwise(&quarter(
        Dialect::Iso,
        BELOW,
        "MOVARC/CENTER,0,0,0,AXIS,0,0,1,RADIUS,10,ANGLE,90",
    ));
    // Whole turns only the angle can tell.
    let spiral = quarter(Dialect::Iso, BELOW, "MOVARC/0,0,0,0,0,1,10,ANGLE,810");
    assert!((spiral.sweep - 2.0 * TAU - FRAC_PI_2).abs() < 1e-9);
}

#[test]
fn an_angle_that_does_not_lead_to_the_end_point_is_told() {
    let text = "GOTO/10,0,0\nMOVARC/0,0,0,0,0,1,10,ANGLE,180\nGOTO/0,10,0\n";
    let (_, problems) = motions(&program_of(Dialect::Iso, text));
    assert!(
        matches!(problems[..], [MotionProblemKind::ArcEndOffCircle(off)] if (off - 200f64.sqrt()).abs() < 1e-6),
        "{problems:?}"
    );
}

#[test]
fn an_arc_shorter_than_the_decimals_is_no_full_circle() {
    // A radius of 10 mm and 0.0002 degrees: both ends print alike.
    for end in ["10,0,0", "10,-0.0001,0"] {
        let text = format!("GOTO/10,0,0\nMOVARC/0,0,0,0,0,1,10,ANGLE,0.0002\nGOTO/{end}\n");
        let arc = only_arc(&clean_motions(&program_of(Dialect::Iso, text))).clone();
        assert!(arc.length() < 1e-4, "{arc:?}");
    }
}

#[test]
fn equal_ends_are_a_full_circle() {
    for (dialect, circle) in [
        (Dialect::SolidWorks, "CIRCLE/0,0,0,0,0,1."),
        (Dialect::CamWorks, "CIRCLE/ 0,0,0,0,0,1,10,CLOCKWISE "),
        (Dialect::Iso, "MOVARC/0,0,0,0,0,1,10,ANGLE,360"),
    ] {
        let text = format!("GOTO/10,-5,0\nGOTO/10,0,0\n{circle}\nGOTO/10,0,0\n");
        let arc = only_arc(&clean_motions(&program_of(dialect, text))).clone();
        assert!((arc.sweep - TAU).abs() < 1e-12, "{dialect}");
        assert!((arc.point_at(0.5) - Point3::new(-10.0, 0.0, 0.0)).norm() < 1e-9);
    }
}

#[test]
fn times_counts_how_often_the_end_is_passed() {
    for (times, turns) in [("", 0.0), (",TIMES,1", 0.0), (",TIMES,2", 1.0), (",TIMES,5", 4.0)] {
        let text = format!("GOTO/10,0,5\nCIRCLE/0,0,0,0,0,-1,10,0.06,0.5,10,0{times}\nGOTO/0,10,0\n");
        let arc = only_arc(&clean_motions(&program_of(Dialect::Nx, text))).clone();
        assert!((arc.sweep - FRAC_PI_2 - TAU * turns).abs() < 1e-12);
        assert!((arc.point_at(1.0) - Point3::new(0.0, 10.0, 0.0)).norm() < 1e-9);
        assert!((arc.point_at(0.5).z - 2.5).abs() < 1e-9);
    }
}

#[test]
fn ends_off_the_circle_are_told_and_the_point_is_reached_anyhow() {
    let text = "GOTO/10,0,0\nCIRCLE/0,0,0,0,0,-1,10.1\nGOTO/0,10.5,0\nGOTO/1,1,1\n";
    let (found, problems) = motions(&program_of(Dialect::Nx, text));
    let offs: Vec<_> = problems
        .iter()
        .map(|kind| match kind {
            MotionProblemKind::ArcStartOffCircle(off) => ("start", (off * 1e6).round()),
            MotionProblemKind::ArcEndOffCircle(off) => ("end", (off * 1e6).round()),
            _ => ("other", 0.0),
        })
        .collect();
    assert_eq!(offs, [("start", 1e5), ("end", 5e5)]);
    assert_eq!(found[2].from.point, Point3::new(0.0, 10.5, 0.0));
}

#[test]
fn an_arc_needs_a_start_and_an_end() {
    let kinds = |text: &str| motions(&program_of(Dialect::Nx, text)).1;
    assert_eq!(kinds("CIRCLE/0,0,0,0,0,1,10\nGOTO/10,0,0\n"), [MotionProblemKind::UnknownStart]);
    assert_eq!(kinds("GOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\n"), [MotionProblemKind::ArcWithoutEnd]);
    let twice = "GOTO/10,0,0\nCIRCLE/5,5,5,0,0,1,10\nCIRCLE/0,0,0,0,0,-1,10\nGOTO/0,10,0\n";
    assert_eq!(kinds(twice), [MotionProblemKind::ArcWithoutEnd]);
}

#[test]
fn an_arc_in_any_plane() {
    // Right-hand about +y leads from +x to -z; left-hand that is the printed axis -y.
    let text = "GOTO/10,0,0\nCIRCLE/0,0,0,0,-1,0,10\nGOTO/0,0,-10\n";
    let arc = only_arc(&clean_motions(&program_of(Dialect::Nx, text))).clone();
    assert!((arc.sweep - FRAC_PI_2).abs() < 1e-12 && (arc.tangent_at(0.0) + Vector3::z()).norm() < 1e-12);
}
