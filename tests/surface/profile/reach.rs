//! What the ball does not touch.

use super::brute::polyline;
use clsmith::internals::surface::profile::{Chain, ChainPiece, Point, find_unreachable_parts};
use std::f64::consts::{FRAC_PI_2, PI};

const R: f64 = 5.0;

fn near(point: Point, u: f64, z: f64) {
    assert!(point.distance(Point::new(u, z)) < 1e-6, "{point:?} is not ({u}, {z})");
}

#[test]
fn all_of_a_smooth_profile_is_touched() {
    let wide = Chain::new(vec![
        ChainPiece::line(Point::new(-30.0, 0.0), Point::new(0.0, 0.0)),
        ChainPiece::arc(Point::new(0.0, 12.0), 12.0, -FRAC_PI_2, FRAC_PI_2),
        ChainPiece::line(Point::new(12.0, 12.0), Point::new(12.0, 30.0)),
        ChainPiece::line(Point::new(12.0, 30.0), Point::new(40.0, 30.0)),
        ChainPiece::line(Point::new(40.0, 30.0), Point::new(40.0, -3.0)),
    ])
    .unwrap();
    for chain in [wide.clone(), wide.reversed()] {
        assert_eq!(find_unreachable_parts(&chain, R, 1e-6).unwrap(), []);
    }
    let slanting = polyline(&[[0.0, 0.0], [-1e-4, 20.0], [50.0, 20.0], [49.9999, -1.0]]);
    for chain in [slanting.clone(), slanting.reversed()] {
        assert_eq!(find_unreachable_parts(&chain, R, 2e-4).unwrap(), []);
    }
    // Chorded finely, each corner hides a little; what is left there is next to nothing.
    let points: Vec<[f64; 2]> = (0..400)
        .map(|index| f64::from(index) * PI / 400.0)
        .map(|angle| [-12.0 * angle.cos(), -12.0 * angle.sin()])
        .collect();
    assert_eq!(find_unreachable_parts(&polyline(&points), R, 1e-3).unwrap(), []);
}

#[test]
fn a_corner_at_a_wall_keeps_the_balls_rounding() {
    let profile = polyline(&[[0.0, 0.0], [20.0, 0.0], [20.0, 30.0], [50.0, 30.0]]);
    let found = find_unreachable_parts(&profile, R, 1e-6).unwrap();
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].first, found[0].last), (0, 1));
    near(found[0].from, 15.0, 0.0);
    near(found[0].to, 20.0, 5.0);
    assert!((found[0].left_mm - R * (2.0_f64.sqrt() - 1.0)).abs() < 1e-9);
    let back = find_unreachable_parts(&profile.reversed(), R, 1e-6).unwrap();
    assert_eq!((back.len(), back[0].first, back[0].last), (1, 1, 2));
}

#[test]
fn a_tight_fillet_and_an_overhang_are_told() {
    let fillet = Chain::new(vec![
        ChainPiece::line(Point::new(-30.0, 0.0), Point::new(0.0, 0.0)),
        ChainPiece::arc(Point::new(0.0, 3.0), 3.0, -FRAC_PI_2, FRAC_PI_2),
        ChainPiece::line(Point::new(3.0, 3.0), Point::new(3.0, 30.0)),
    ])
    .unwrap();
    let found = find_unreachable_parts(&fillet, R, 1e-6).unwrap();
    assert_eq!((found.len(), found[0].first, found[0].last), (1, 0, 2), "{found:?}");
    near(found[0].from, -2.0, 0.0);
    near(found[0].to, 3.0, 5.0);
    assert!((found[0].left_mm - 2.0 * (2.0_f64.sqrt() - 1.0)).abs() < 1e-9);
    let overhang =
        polyline(&[[0.0, 20.0], [30.0, 20.0], [30.0, 15.0], [10.0, 15.0], [10.0, 0.0], [60.0, 0.0]]);
    let found = find_unreachable_parts(&overhang, R, 1e-6).unwrap();
    assert_eq!((found.len(), found[0].first, found[0].last), (1, 2, 4), "{found:?}");
    near(found[0].from, 30.0, 15.0);
    near(found[0].to, 35.0, 0.0);
    assert!(found[0].left_mm > 10.0);
}
