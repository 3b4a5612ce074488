//! Tip paths that have closed forms.

use super::brute::{assert_runs, assert_touches, height, polyline};
use crate::support::within_seconds;
use clsmith::internals::surface::profile::{
    BallCompensationError, Chain, ChainPiece, Point, check_tip_path, compensate_profile,
};
use std::f64::consts::{FRAC_PI_2, PI};

const R: f64 = 5.0;

fn tip(chain: &Chain) -> Chain {
    let tip = compensate_profile(chain, R).unwrap();
    assert_runs(&tip, chain.end().u >= chain.start().u);
    assert_touches(chain, &tip, R, 1e-9);
    tip
}

fn near(point: Point, u: f64, z: f64) {
    assert!(point.distance(Point::new(u, z)) < 1e-9, "{point:?} is not ({u}, {z})");
}

#[test]
fn a_flat_profile_is_its_own_tip_path() {
    let path = tip(&polyline(&[[0.0, 1.0], [40.0, 1.0]]));
    assert_eq!(path.pieces().len(), 1);
    near(path.start(), 0.0, 1.0);
    near(path.end(), 40.0, 1.0);
}

#[test]
fn a_slope_moves_by_the_papers_equations() {
    for (degrees, forward) in [(30.0_f64, true), (-30.0, true), (30.0, false), (75.0, true)] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let mut profile = polyline(&[[2.0, 1.0], [2.0 + 40.0 * cos, 1.0 + 40.0 * sin]]);
        if !forward {
            profile = profile.reversed();
        }
        let path = tip(&profile);
        assert_eq!(path.pieces().len(), 1);
        near(path.start(), profile.start().u - R * sin, profile.start().z - R * (1.0 - cos));
        near(path.end(), profile.end().u - R * sin, profile.end().z - R * (1.0 - cos));
    }
}

#[test]
fn a_hollow_arc_wider_than_the_ball_shrinks_by_its_radius() {
    let profile = Chain::new(vec![
        ChainPiece::line(Point::new(-30.0, 0.0), Point::new(0.0, 0.0)),
        ChainPiece::arc(Point::new(0.0, 12.0), 12.0, -FRAC_PI_2, FRAC_PI_2),
        ChainPiece::line(Point::new(12.0, 12.0), Point::new(12.0, 30.0)),
    ])
    .unwrap();
    let path = tip(&profile);
    let ChainPiece::Arc(arc) = path.pieces()[1] else { panic!("{path:?}") };
    near(arc.centre, 0.0, 7.0);
    assert!((arc.radius_mm - 7.0).abs() < 1e-9);
    near(path.pieces()[1].end(), 7.0, 7.0);
    // The wall is followed to its top by the ball's side.
    near(path.end(), 7.0, 25.0);
    assert_eq!(path.pieces().len(), 3);
}

#[test]
fn a_hollow_arc_tighter_than_the_ball_is_bridged() {
    let profile = Chain::new(vec![
        ChainPiece::line(Point::new(-30.0, 0.0), Point::new(0.0, 0.0)),
        ChainPiece::arc(Point::new(0.0, 3.0), 3.0, -FRAC_PI_2, FRAC_PI_2),
        ChainPiece::line(Point::new(3.0, 3.0), Point::new(3.0, 30.0)),
    ])
    .unwrap();
    let path = tip(&profile);
    assert_eq!(path.pieces().len(), 2);
    near(path.pieces()[0].end(), -2.0, 0.0);
    near(path.end(), -2.0, 25.0);
    // Exactly as wide as the ball: it fits, and nothing of the arc is left in the path.
    let same = Chain::new(vec![
        ChainPiece::line(Point::new(-30.0, 0.0), Point::new(0.0, 0.0)),
        ChainPiece::arc(Point::new(0.0, R), R, -FRAC_PI_2, FRAC_PI_2),
        ChainPiece::line(Point::new(R, R), Point::new(R, 30.0)),
    ])
    .unwrap();
    near(tip(&same).pieces()[0].end(), 0.0, 0.0);
}

#[test]
fn a_hollow_corner_is_turned_where_both_sides_are_touched() {
    for (a, b) in [(0.0_f64, 45.0_f64), (-30.0, 60.0), (10.0, 30.0)] {
        let (a, b) = (a.to_radians(), b.to_radians());
        let profile =
            polyline(&[[-30.0 * a.cos(), -30.0 * a.sin()], [0.0, 0.0], [30.0 * b.cos(), 30.0 * b.sin()]]);
        let path = tip(&profile);
        assert_eq!(path.pieces().len(), 2);
        // The centre is on the bisector, R / cos(half the bend) from the corner.
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let far = R / half.cos();
        near(path.pieces()[0].end(), -far * middle.sin(), far * middle.cos() - R);
    }
}

#[test]
fn a_bulging_corner_gets_an_arc_of_the_balls_radius() {
    let profile = polyline(&[[-30.0, -15.0], [0.0, 0.0], [30.0, -15.0]]);
    let path = tip(&profile);
    assert_eq!(path.pieces().len(), 3);
    let ChainPiece::Arc(arc) = path.pieces()[1] else { panic!("{path:?}") };
    near(arc.centre, 0.0, -R);
    assert!((arc.radius_mm - R).abs() < 1e-12);
    assert!((arc.sweep_rad + 2.0 * 0.5_f64.atan()).abs() < 1e-9);
}

#[test]
fn a_bulging_arc_grows_by_the_radius() {
    let profile = Chain::new(vec![ChainPiece::arc(Point::new(3.0, 2.0), 20.0, PI, -PI)]).unwrap();
    let path = tip(&profile);
    near(path.start(), 3.0 - 25.0, 2.0 - R);
    near(path.end(), 3.0 + 25.0, 2.0 - R);
    let ChainPiece::Arc(arc) = path.pieces()[0] else { panic!("{path:?}") };
    assert!((arc.radius_mm - 25.0).abs() < 1e-12 && path.pieces().len() == 1);
}

#[test]
fn a_sine_has_the_heights_of_the_envelope() {
    let at = |index: i32| {
        let u = f64::from(index) * 0.05;
        [u, 3.0 * (u * 0.6).sin()]
    };
    let points: Vec<[f64; 2]> = (0..1200).map(at).collect();
    let path = tip(&polyline(&points));
    for index in 0..100 {
        let u = 1.0 + f64::from(index) * 0.55;
        let envelope = (0..15_000)
            .map(|index| f64::from(index) * 0.004)
            .filter(|q| (q - u).abs() <= R)
            .map(|q| 3.0 * (q * 0.6).sin() + (R * R - (u - q) * (u - q)).sqrt() - R)
            .fold(f64::NEG_INFINITY, f64::max);
        // Chords of 0.05 mm at a radius of curvature of 0.93 mm bulge by 0.0003 mm.
        let z = height(&path, u).unwrap();
        assert!((z - envelope).abs() < 5e-4, "{z} {envelope} at {u}");
    }
}

#[test]
fn pieces_without_length_and_twice_the_same_change_nothing() {
    let plain = polyline(&[[0.0, 0.0], [10.0, 0.0], [20.0, 8.0], [30.0, 0.0]]);
    let full = polyline(&[
        [0.0, 0.0],
        [0.0, 0.0],
        [10.0, 0.0],
        [10.0, 0.0],
        [20.0, 8.0],
        [20.0 + 1e-13, 8.0],
        [20.0, 8.0],
        [30.0, 0.0],
        [30.0, 0.0],
    ]);
    let (plain, full) = (tip(&plain), tip(&full));
    assert_eq!(plain.pieces().len(), full.pieces().len());
    for (a, b) in plain.vertices().zip(full.vertices()) {
        near(a, b.u, b.z);
    }
}

#[test]
fn the_check_by_samples_sees_what_is_wrong() {
    let profile = polyline(&[[0.0, 0.0], [20.0, 0.0], [40.0, 20.0], [60.0, 20.0]]);
    let path = tip(&profile);
    let verdict = check_tip_path(&profile, &path, R, 0.001);
    assert!(verdict.gouge_mm <= verdict.bound_mm && verdict.gap_mm <= verdict.bound_mm, "{verdict:?}");
    assert!(verdict.bound_mm < 1e-6);
    // Pointwise compensation of the corner's two sides, or none at all, gouges.
    let verdict = check_tip_path(&profile, &profile, R, 0.01);
    assert!(verdict.gouge_mm > 1.0 && (20.0..40.0).contains(&verdict.gouge_at.u), "{verdict:?}");
    let verdict = check_tip_path(&profile, &path.shifted(0.0, 0.25), R, 0.01);
    assert!(verdict.gouge_mm == 0.0 && (verdict.gap_mm - 0.25).abs() < 1e-4, "{verdict:?}");
    let verdict = check_tip_path(&profile, &path.shifted(0.0, -0.25), R, 0.01);
    assert!((verdict.gouge_mm - 0.25).abs() < 1e-4, "{verdict:?}");
}

#[test]
fn the_upper_end_of_a_steep_piece_is_touched_though_rounding_hides_the_piece() {
    // Up a wall that leans over by a ten-thousandth of a micrometre, beside a slope: at a metre a rounding of u is a micrometre of
    // height there, so that the two cross where the wall ends, and 1e-7 mm of it stand out.
    for shift in [0.0, 1000.0, -1000.0] {
        let wall = polyline(&[[1.0, -1.0], [0.5, -0.5], [0.5 + 1e-10, -2.0], [0.5 + 1e-7, -0.5]]);
        let profile = wall.shifted(shift, 0.0);
        assert_touches(&profile, &tip(&profile), R, 1e-9);
        let profile = profile.reversed();
        assert_touches(&profile, &tip(&profile), R, 1e-9);
    }
}

#[test]
fn a_hundred_thousand_samples_are_checked_quickly() {
    let points: Vec<[f64; 2]> =
        (0..=2000).map(|index| f64::from(index) * 0.05).map(|u| [u, 3.0 * (u * 0.3).sin()]).collect();
    let profile = polyline(&points);
    let path = compensate_profile(&profile, R).unwrap();
    let verdict = within_seconds(5.0, || check_tip_path(&profile, &path, R, 0.001));
    assert!(verdict.gouge_mm <= verdict.bound_mm && verdict.gap_mm <= verdict.bound_mm, "{verdict:?}");
}

#[test]
fn a_ball_needs_a_radius() {
    let profile = polyline(&[[0.0, 0.0], [20.0, 0.0]]);
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-4] {
        assert!(matches!(compensate_profile(&profile, radius), Err(BallCompensationError::Radius(_))));
    }
}
