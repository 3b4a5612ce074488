//! CATIA: `INDIRV/` is the start tangent, the end stands inside `TLON`, and INTOF says that it goes beyond half.

use crate::support::{clean_motions, motions, only_arc, program_of, statement_indices};
use clsmith::program::geometry::CircularArc;
use clsmith::program::motion::MotionProblemKind;
use clsmith::program::{Dialect, Program};
use nalgebra::{Point3, Vector3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn drive(tangent: &str, end: &str, intof: bool) -> Program {
    let on = if intof { "ON,2,INTOF,$\n      " } else { "ON," };
    let text = format!(
        "GOTO  /   20.00000,    0.00000,   -5.00000\nAUTOPS\nINDIRV/{tangent}\nTLON,GOFWD/      (CIRCLE/      0.00000,      0.00000,     -5.00000,$\n      20.00000),{on}(LINE/      0.00000,      0.00000,     -5.00000,$\n       {end},     -5.00000)\n"
    );
    program_of(Dialect::Catia, text)
}

fn arc(tangent: &str, end: &str, intof: bool) -> CircularArc {
    only_arc(&clean_motions(&drive(tangent, end, intof))).clone()
}

#[test]
fn a_quarter_left_and_three_quarters_right() {
    let left = arc("0,1,0", "0,20", false);
    assert!((left.sweep - FRAC_PI_2).abs() < 1e-9 && (left.tangent_at(0.0) - Vector3::y()).norm() < 1e-9);
    let right = arc("0,-1,0", "0,20", true);
    assert!((right.sweep - 1.5 * PI).abs() < 1e-9 && (right.tangent_at(0.0) + Vector3::y()).norm() < 1e-9);
}

#[test]
fn no_goto_follows_and_the_tool_is_at_the_end_of_the_line() {
    let program = drive("0,1,0", "0,20", false);
    let found = clean_motions(&program);
    assert_eq!(found.len(), 2);
    assert_eq!(found[1].to.point, Point3::new(0.0, 20.0, -5.0));
    // The motion is INDIRV and TLON; AUTOPS before it stays out.
    assert_eq!(statement_indices(&found[1]), [2, 3]);
}

#[test]
fn a_full_circle_ends_where_it_starts() {
    let full = arc("0,1,0", "20,0", true);
    assert!((full.sweep - TAU).abs() < 1e-9);
    assert!((full.point_at(0.25) - Point3::new(0.0, 20.0, -5.0)).norm() < 1e-9);
    let other = arc("0,-1,0", "20,0", true);
    assert!((other.point_at(0.25) - Point3::new(0.0, -20.0, -5.0)).norm() < 1e-9);
}

#[test]
fn half_a_circle_may_be_written_either_way() {
    for intof in [false, true] {
        assert!((arc("0,1,0", "-20,0", intof).sweep - PI).abs() < 1e-4);
    }
}

#[test]
fn a_rounded_tangent_does_not_tilt_the_plane() {
    // Five decimals: 1.5e-5 off the plane must not lift the arc's points.
    let rounded = arc("0.00001,1.0,0.00001", "-11.55819,16.32235", false);
    assert!((rounded.point_at(0.5).z + 5.0).abs() < 1e-9, "{:?}", rounded.point_at(0.5));
}

#[test]
fn word_and_tangent_that_contradict_are_told() {
    for (tangent, intof) in [("0,1,0", true), ("0,-1,0", false)] {
        assert_eq!(
            motions(&drive(tangent, "0,20", intof)).1,
            [MotionProblemKind::TangentMismatch],
            "{tangent}"
        );
    }
}

#[test]
fn a_tangent_that_points_along_the_spoke_gives_no_arc() {
    for tangent in ["1,0,0", "0,0,0"] {
        let (found, problems) = motions(&drive(tangent, "0,20", false));
        assert_eq!(problems, [MotionProblemKind::TangentMismatch]);
        assert_eq!(found[1].to.point, Point3::new(0.0, 20.0, -5.0));
    }
}

#[test]
fn a_direction_without_arc_is_told_and_not_kept() {
    let text = "GOTO/0,0,0\nINDIRV/0,1,0\nGOTO/5,0,0\nTLON,GOFWD/(CIRCLE/0,0,0,5),ON,(LINE/0,0,0,0,5,0)\n";
    let (found, problems) = motions(&program_of(Dialect::Catia, text));
    assert_eq!(problems, [MotionProblemKind::ArcWithoutEnd, MotionProblemKind::TangentMismatch]);
    assert_eq!(found.len(), 3);
}

#[test]
fn lathe_arcs_lie_in_the_plane_of_x_and_z() {
    let text = "GOTO/10,0,-10\nINDIRV/0,0,-1\nTLON,GOFWD/(CIRCLE/14,0,-10,4),ON,(LINE/14,0,-10,14,0,-14)\n";
    let arc = only_arc(&clean_motions(&program_of(Dialect::Catia, text))).clone();
    assert!((arc.sweep - FRAC_PI_2).abs() < 1e-9 && (arc.axis.y.abs() - 1.0).abs() < 1e-9);
    assert!((arc.tangent_at(1.0) - Vector3::x()).norm() < 1e-9);
}
