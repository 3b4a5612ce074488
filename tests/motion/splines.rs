//! NURBS: clamped cubics as NX prints them.

use crate::support::{clean_motions, motions, program, statement_indices};
use clsmith::program::geometry::{MotionPath, Spline};
use clsmith::program::motion::MotionProblemKind;
use nalgebra::Point3;
use proptest::prelude::*;

fn spline(start: [f64; 3], knots: &[f64], controls: &[[f64; 3]]) -> Spline {
    let controls: Vec<Point3<f64>> = controls.iter().map(|&at| at.into()).collect();
    Spline::from_knots(start.into(), knots, &controls).unwrap()
}

#[test]
fn a_single_knot_makes_a_bezier_curve() {
    let curve = spline([0.0; 3], &[1.0], &[[0.0, 3.0, 0.0], [3.0, 3.0, 0.0], [3.0, 0.0, 6.0]]);
    assert_eq!(curve.knots, [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]);
    for step in 0..=20 {
        let t = f64::from(step) / 20.0;
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        let expected: nalgebra::Vector3<f64> =
            curve.controls.iter().zip(weights).map(|(point, weight)| point.coords * weight).sum();
        assert!((curve.point_at(t) - Point3::from(expected)).norm() < 1e-12, "{t}");
    }
}

#[test]
fn it_starts_at_the_tool_and_ends_at_the_last_control_point() {
    let curve = spline(
        [1.0, 2.0, 3.0],
        &[0.25, 0.5, 2.0],
        &[[2.0, 2.0, 3.0], [4.0; 3], [5.0; 3], [6.0; 3], [9.0; 3]],
    );
    assert!((curve.point_at(0.0) - curve.controls[0]).norm() < 1e-12);
    assert!((curve.point_at(1.0) - Point3::new(9.0, 9.0, 9.0)).norm() < 1e-12);
    assert!((curve.start_tangent() - nalgebra::Vector3::x()).norm() < 1e-12);
    assert!((curve.end_tangent() - nalgebra::Vector3::repeat(1.0).normalize()).norm() < 1e-12);
}

#[test]
fn controls_on_a_line_make_the_line() {
    let curve = spline(
        [0.0; 3],
        &[0.3, 0.7, 1.0],
        &[[1.0, 2.0, 2.0], [2.0, 4.0, 4.0], [3.0, 6.0, 6.0], [4.0, 8.0, 8.0], [5.0, 10.0, 10.0]],
    );
    for step in 0..=50 {
        let point = curve.point_at(f64::from(step) / 50.0);
        assert!((point.y - 2.0 * point.x).abs() < 1e-12 && (point.z - point.y).abs() < 1e-12);
    }
    assert!((curve.length() - 15.0).abs() < 1e-9);
}

#[test]
fn known_length_of_a_parabola() {
    // y = x^2 from 0 to 1, raised from quadratic to cubic.
    let curve =
        spline([0.0; 3], &[1.0], &[[1.0 / 3.0, 0.0, 0.0], [2.0 / 3.0, 1.0 / 3.0, 0.0], [1.0, 1.0, 0.0]]);
    let exact = 5f64.sqrt() / 2.0 + 2f64.asinh() / 4.0;
    assert!((curve.length() - exact).abs() < 1e-3 * exact);
}

#[test]
fn counts_and_order_must_fit() {
    let some = |knots: &[f64], controls: usize| {
        Spline::from_knots(Point3::origin(), knots, &vec![Point3::origin(); controls]).is_some()
    };
    assert!(some(&[1.0], 3) && some(&[0.5, 0.5, 1.0], 5));
    assert!(!some(&[1.0], 2) && !some(&[1.0], 4) && !some(&[], 2));
    assert!(!some(&[0.5, 0.4], 4) && !some(&[-0.1, 1.0], 4) && !some(&[0.0], 3));
}

#[test]
fn no_goto_follows_and_the_next_motion_starts_at_the_last_control() {
    let text = "GOTO/0,0,0\nNURBS/\nKNOT/0.5\nKNOT/1.0\nCNTRL/1,0,0\nCNTRL/2,1,0\nCNTRL/3,1,0\nCNTRL/4,0,0\nGOTO/9,0,0\n";
    let found = clean_motions(&program(text));
    assert_eq!(found.len(), 3);
    assert!(matches!(&found[1].path, MotionPath::Spline(curve) if curve.controls.len() == 5));
    assert_eq!(statement_indices(&found[1]), [1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(
        (found[1].to.point, found[2].from.point),
        (Point3::new(4.0, 0.0, 0.0), Point3::new(4.0, 0.0, 0.0))
    );
}

#[test]
fn two_splines_in_a_row_and_one_at_the_end_of_the_file() {
    let one = "NURBS/\nKNOT/1.0\nCNTRL/1,0,0\nCNTRL/2,0,0\nCNTRL/3,0,0\n";
    let found = clean_motions(&program(format!("GOTO/0,0,0\n{one}{one}")));
    assert_eq!(found.len(), 3);
    assert_eq!(found[2].from.point, Point3::new(3.0, 0.0, 0.0));
}

#[test]
fn a_broken_spline_still_moves_the_tool_to_its_end() {
    // The position after it is told, however the way there is.
    let (found, problems) =
        motions(&program("GOTO/0,0,0\nNURBS/\nKNOT/1.0\nCNTRL/1,0,0\nCNTRL/5,5,5\nGOTO/6,5,5\n"));
    assert_eq!(problems, [MotionProblemKind::BrokenSpline]);
    assert_eq!((&found[1].path, found[1].to.point), (&MotionPath::Line, Point3::new(5.0, 5.0, 5.0)));
    assert_eq!(motions(&program("GOTO/0,0,0\nCNTRL/1,0,0\n")).1, [MotionProblemKind::BrokenSpline]);
    assert_eq!(
        motions(&program("NURBS/\nKNOT/1\nCNTRL/1,0,0\nCNTRL/1,0,0\nCNTRL/1,0,0\n")).1,
        [MotionProblemKind::UnknownStart]
    );
}

proptest! {
    #![proptest_config(crate::support::property(300))]

    #[test]
    fn weights_are_positive_and_add_up_to_one(mut knots in prop::collection::vec(0.0f64..1.0, 0..8), t in 0.0f64..=1.0) {
        knots.sort_by(f64::total_cmp);
        knots.push(1.0);
        let count = knots.len() + 3;
        // With the unit vectors of many splines as controls the points are the weights themselves.
        let weight = |index: usize| {
            let at = |i: usize| if i == index { [1.0, 0.0, 0.0] } else { [0.0; 3] };
            let controls: Vec<[f64; 3]> = (1..count).map(at).collect();
            spline(at(0), &knots, &controls).point_at(t).x
        };
        let weights: Vec<f64> = (0..count).map(weight).collect();
        prop_assert!(weights.iter().all(|&weight| weight >= -1e-12));
        prop_assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-9);
        // A cubic: at most four of them count at any place.
        prop_assert!(weights.iter().filter(|&&weight| weight > 1e-12).count() <= 4);
    }
}
