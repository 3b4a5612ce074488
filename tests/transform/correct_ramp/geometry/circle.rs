//! The circumscribed circle.

use super::near;
use clsmith::internals::transform::correct_ramp::circumscribed_circle::{
    BulgeSide, find_arc_angle, find_own_side, place_on_circle,
};
use nalgebra::Point2;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn places(points: &[[f64; 2]]) -> Vec<Point2<f64>> {
    points.iter().map(|place| Point2::from(*place)).collect()
}

/// The signed distance of the centre of an arc over the chord s.
fn centre_distance(s: f64, arc: f64) -> f64 {
    -0.5 * s / (0.5 * arc).tan()
}

/// The leg of the circle whose centre is at the signed distance e.
fn leg(s: f64, e: f64, legs: usize) -> f64 {
    s.hypot(2.0 * e) * ((FRAC_PI_2 + (2.0 * e / s).atan()) / legs as f64).sin()
}

/// The centre through three points, by the perpendicular bisectors.
fn centre(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> Point2<f64> {
    let (b, c) = (b - a, c - a);
    let twice = 2.0 * b.perp(&c);
    let (bb, cc) = (b.norm_squared(), c.norm_squared());
    a + nalgebra::Vector2::new(c.y * bb - b.y * cc, b.x * cc - c.x * bb) / twice
}

#[test]
fn the_root_of_the_leg_equation_is_found_on_both_sides_of_the_chord() {
    for legs in [2, 3, 4, 7] {
        for (s, e) in [(10.0, 3.0), (10.0, -3.0), (10.0, 0.0), (0.05, 4.0), (40.0, -9.0), (12.0, 80.0)] {
            let arc = find_arc_angle(s, leg(s, e, legs), legs).unwrap();
            near(centre_distance(s, arc) / s.max(e.abs()), e / s.max(e.abs()));
        }
    }
}

#[test]
fn squares_and_triangles_come_out() {
    // Three legs as long as the chord: a square. Its centre is half a side off.
    near(find_arc_angle(10.0, 10.0, 3).unwrap(), 1.5 * PI);
    // Two: an equilateral triangle.
    near(find_arc_angle(10.0, 10.0, 2).unwrap(), 4.0 * PI / 3.0);
    // Half a circle in two: the centre lies on the chord.
    near(find_arc_angle(10.0, 50f64.sqrt(), 2).unwrap(), PI);
}

#[test]
fn legs_that_only_just_reach_lie_on_the_chord() {
    for leg in [2.0, 3.0] {
        assert_eq!(find_arc_angle(9.0, leg, 3), None);
        let line = place_on_circle(
            &places(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [9.0, 0.0]]),
            leg,
            BulgeSide::Left,
            false,
        );
        assert_eq!(line.unwrap(), places(&[[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [9.0, 0.0]]));
    }
    assert_eq!(place_on_circle(&places(&[[0.0, 0.0], [1.0, 0.0]]), 5.0, BulgeSide::Left, false), None);
}

#[test]
fn a_closed_ramp_becomes_a_regular_polygon() {
    for legs in 2..9 {
        let mut own = vec![[1.0, 2.0]];
        own.extend((1..legs).map(|index| {
            let angle = TAU * f64::from(index) / f64::from(legs);
            [1.0 + 0.3 - 0.3 * angle.cos(), 2.0 - 0.3 * angle.sin()]
        }));
        own.push([1.0, 2.0]);
        let own = places(&own);
        assert_eq!(find_own_side(&own, true), BulgeSide::Left);
        for (side, away) in [(BulgeSide::Left, 1.0), (BulgeSide::Right, -1.0)] {
            let moved = place_on_circle(&own, 12.0, side, true).unwrap();
            let radius = 12.0 / (2.0 * (PI / f64::from(legs)).sin());
            let centre = own[0] + nalgebra::Vector2::new(away * radius, 0.0);
            for pair in moved.windows(2) {
                near((pair[1] - pair[0]).norm(), 12.0);
                near((pair[0] - centre).norm(), radius);
                let turn = (pair[0] - centre).perp(&(pair[1] - centre));
                assert!(legs == 2 || turn * away > 0.0, "counter-clockwise, mirrored clockwise");
            }
            assert_eq!(moved.last(), own.last());
        }
    }
}

#[test]
fn the_circle_lies_where_the_points_were() {
    let side = |inner: &[[f64; 2]], closed: bool| {
        let mut all = vec![[0.0, 0.0]];
        all.extend(inner);
        all.push(if closed { [0.0, 0.0] } else { [10.0, 0.0] });
        find_own_side(&places(&all), closed)
    };
    assert_eq!(side(&[[3.0, 2.0], [5.0, 1.0]], false), BulgeSide::Left);
    assert_eq!(side(&[[3.0, -2.0], [5.0, -1.0]], false), BulgeSide::Right);
    // On both sides: the larger area.
    assert_eq!(side(&[[3.0, 4.0], [6.0, -1.0]], false), BulgeSide::Left);
    assert_eq!(side(&[[3.0, 1.0], [6.0, -4.0]], false), BulgeSide::Right);
    // In line, also beyond the ends.
    assert_eq!(side(&[[3.0, 0.0]], false), BulgeSide::Left);
    assert_eq!(side(&[[14.0, 0.0], [-3.0, 0.0]], false), BulgeSide::Left);
    // Around: the sense.
    assert_eq!(side(&[[3.0, 0.0], [3.0, 3.0]], true), BulgeSide::Left);
    assert_eq!(side(&[[3.0, 3.0], [3.0, 0.0]], true), BulgeSide::Right);
    assert_eq!(side(&[[3.0, 3.0]], true), BulgeSide::Left);
    assert_eq!(BulgeSide::Left.mirrored(), BulgeSide::Right);
}

#[test]
fn a_ramp_that_almost_closes_almost_goes_around() {
    let own = places(&[[0.0, 0.0], [1.0, 2.0], [-1.0, 2.0], [0.0011, 0.0]]);
    let moved = place_on_circle(&own, 10.0, BulgeSide::Left, false).unwrap();
    for pair in moved.windows(2) {
        near((pair[1] - pair[0]).norm(), 10.0);
    }
}

proptest! {
    #![proptest_config(crate::support::property(128))]

    #[test]
    fn every_leg_is_one_chord_of_one_circle_on_the_side_asked_for(
        [x, y, angle] in [-50.0..50.0f64, -50.0..50.0, 0.0..TAU],
        s in 0.01..60.0f64,
        more in 1.001..6.0f64,
        legs in 2..9usize,
        left in any::<bool>(),
    ) {
        let first = Point2::new(x, y);
        let along = nalgebra::Rotation2::new(angle) * nalgebra::Vector2::x();
        let own: Vec<_> = (0..=legs).map(|index| first + along * (s * index as f64 / legs as f64)).collect();
        let target = more * s / legs as f64;
        let side = if left { BulgeSide::Left } else { BulgeSide::Right };
        let moved = place_on_circle(&own, target, side, false).unwrap();
        prop_assert_eq!((moved[0], moved[legs]), (own[0], own[legs]));
        let centre = centre(moved[0], moved[1], moved[2]);
        let radius = (moved[0] - centre).norm();
        for pair in moved.windows(2) {
            prop_assert!(((pair[1] - pair[0]).norm() - target).abs() < 1e-8);
        }
        for point in &moved {
            prop_assert!(((point - centre).norm() / radius - 1.0).abs() < 1e-6, "{:?} {:?}", centre, moved);
        }
        for point in &moved[1..legs] {
            let aside = along.perp(&(point - first));
            prop_assert_eq!(left, aside > 0.0);
        }
    }

    #[test]
    fn longer_legs_need_a_farther_centre(
        s in 0.01..60.0f64,
        more in 1.001..6.0f64,
        less in 0.0..1.0f64,
        legs in 2..9usize,
    ) {
        let longer = more * s / legs as f64;
        let shorter = (1.0 + (more - 1.0) * less) * s / legs as f64;
        let e = centre_distance(s, find_arc_angle(s, longer, legs).unwrap());
        prop_assert!((leg(s, e, legs) - longer).abs() < 1e-8);
        if let Some(arc) = find_arc_angle(s, shorter, legs) {
            prop_assert!(centre_distance(s, arc) <= e + 1e-9 * e.abs());
        }
    }
}
