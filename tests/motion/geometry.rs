//! Arcs and helices in closed form.

use clsmith::program::geometry::{CircularArc, MotionPath, SAME_POINT};
use nalgebra::{Point3, Unit, Vector3};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

fn up() -> Unit<Vector3<f64>> {
    Vector3::z_axis()
}

fn about_origin(start: [f64; 3], end: [f64; 3], axis: Unit<Vector3<f64>>, turns: u32) -> CircularArc {
    CircularArc::from_endpoints(start.into(), end.into(), Point3::origin(), axis, turns)
}

fn close(a: Point3<f64>, b: [f64; 3]) -> bool {
    (a - Point3::from(b)).norm() < 1e-12
}

#[test]
fn a_quarter_is_a_quarter() {
    let arc = about_origin([10.0, 0.0, 0.0], [0.0, 10.0, 0.0], up(), 0);
    assert!((arc.sweep - FRAC_PI_2).abs() < 1e-15);
    assert!((arc.length() - 10.0 * FRAC_PI_2).abs() < 1e-12);
    let half = 10.0 * std::f64::consts::FRAC_1_SQRT_2;
    assert!(close(arc.point_at(0.0), [10.0, 0.0, 0.0]));
    assert!(close(arc.point_at(0.5), [half, half, 0.0]));
    assert!(close(arc.point_at(1.0), [0.0, 10.0, 0.0]));
    assert!((arc.tangent_at(0.0) - Vector3::y()).norm() < 1e-12);
    assert!((arc.tangent_at(1.0) + Vector3::x()).norm() < 1e-12);
}

#[test]
fn the_other_axis_goes_the_other_way_round() {
    let arc = about_origin([10.0, 0.0, 0.0], [0.0, 10.0, 0.0], -up(), 0);
    assert!((arc.sweep - 1.5 * PI).abs() < 1e-12);
    assert!((arc.tangent_at(0.0) + Vector3::y()).norm() < 1e-12);
}

#[test]
fn equal_ends_make_a_full_circle() {
    let start = [3.0, 4.0, 1.0];
    let arc = about_origin(start, start, up(), 0);
    assert_eq!((arc.sweep, arc.rise), (TAU, 0.0));
    assert!((arc.length() - TAU * 5.0).abs() < 1e-12);
    // Ends that differ by the rounding of four decimals are equal.
    let rounded = about_origin(start, [3.0 + SAME_POINT * 0.7, 4.0, 1.0], up(), 0);
    assert_eq!(rounded.sweep, TAU);
}

#[test]
fn half_a_circle_goes_by_its_axis() {
    for (axis, side) in [(up(), 1.0), (-up(), -1.0)] {
        let arc = about_origin([5.0, 0.0, 0.0], [-5.0, 0.0, 0.0], axis, 0);
        assert!((arc.sweep - PI).abs() < 1e-12);
        assert!(close(arc.point_at(0.5), [0.0, 5.0 * side, 0.0]));
    }
}

#[test]
fn a_helix_rises_evenly() {
    let arc = about_origin([5.0, 0.0, 10.0], [0.0, 5.0, 4.0], up(), 2);
    assert!((arc.sweep - (2.0 * TAU + FRAC_PI_2)).abs() < 1e-12);
    assert_eq!(arc.rise, -6.0);
    assert!((arc.length() - (5.0 * arc.sweep).hypot(6.0)).abs() < 1e-12);
    assert!(close(arc.point_at(1.0), [0.0, 5.0, 4.0]));
    assert!((arc.point_at(0.5).z - 7.0).abs() < 1e-12);
    // About the axis turned over the same helix has the same rise in space.
    let over = about_origin([5.0, 0.0, 10.0], [0.0, 5.0, 4.0], -up(), 0);
    assert!(close(over.point_at(1.0), [0.0, 5.0, 4.0]));
    assert!(over.tangent_at(0.0).z < 0.0);
}

#[test]
fn the_centre_may_lie_anywhere_on_the_axis() {
    // NX prints the centre at the end's height, other systems at the start's.
    let low = CircularArc::from_endpoints(
        [5.0, 0.0, 10.0].into(),
        [-5.0, 0.0, 4.0].into(),
        [0.0, 0.0, -99.0].into(),
        up(),
        0,
    );
    assert_eq!(low.radius, 5.0);
    assert!(close(low.point_at(1.0), [-5.0, 0.0, 4.0]));
    assert!(low.end_deviation([0.0, 5.001, 77.0].into()) - 0.001 < 1e-12);
}

#[test]
fn an_arc_without_radius_has_no_tangent_and_does_no_harm() {
    let arc = about_origin([0.0; 3], [0.0; 3], up(), 0);
    assert_eq!((arc.length(), arc.tangent_at(0.5)), (0.0, Vector3::zeros()));
    assert!(MotionPath::Arc(Box::new(arc)).end_tangent(Point3::origin(), Point3::origin()).is_none());
}

#[test]
fn samples_reach_both_ends_in_steps_of_fifteen_degrees() {
    let arc = about_origin([10.0, 0.0, 0.0], [0.0, 10.0, 0.0], up(), 0);
    let samples = MotionPath::Arc(Box::new(arc)).sample_points(Point3::origin(), Point3::origin());
    assert_eq!(samples.len(), 7);
    assert!(close(samples[0], [10.0, 0.0, 0.0]) && close(samples[6], [0.0, 10.0, 0.0]));
}

proptest! {
    #![proptest_config(crate::support::property(500))]

    #[test]
    fn any_arc_starts_ends_and_moves_as_it_says(
        angle in 0.0f64..TAU, sweep in 0.01f64..6.27, radius in 0.1f64..500.0, rise in -20.0f64..20.0,
        turns in 0u32..4, axis in (-1.0f64..1.0, -1.0f64..1.0, 0.1f64..1.0), center in (-100.0f64..100.0, -100.0f64..100.0, -100.0f64..100.0),
    ) {
        let axis = Unit::new_normalize(Vector3::new(axis.0, axis.1, axis.2));
        let center = Point3::new(center.0, center.1, center.2);
        let u = Unit::new_normalize(axis.cross(&Vector3::y()));
        let v = axis.cross(&u);
        let at = |angle: f64, rise: f64| center + (u.into_inner() * angle.cos() + v * angle.sin()) * radius + axis.into_inner() * rise;
        let (start, end) = (at(angle, 0.0), at(angle + sweep, rise));
        let arc = CircularArc::from_endpoints(start, end, center, axis, turns);
        prop_assert!((arc.sweep - sweep - TAU * f64::from(turns)).abs() < 1e-9);
        prop_assert!((arc.radius - radius).abs() < 1e-9 && (arc.rise - rise).abs() < 1e-9);
        prop_assert!((arc.point_at(1.0) - end).norm() < 1e-9);
        // The tangent is the derivative of the point.
        let (t, step) = (0.37, 1e-6);
        let chord = (arc.point_at(t + step) - arc.point_at(t - step)).normalize();
        prop_assert!((arc.tangent_at(t) - chord).norm() < 1e-5);
        // So is the length: many chords come close to it from below.
        let steps = 2000;
        let chords: f64 = (0..steps).map(|i| (arc.point_at(f64::from(i + 1) / f64::from(steps)) - arc.point_at(f64::from(i) / f64::from(steps))).norm()).sum();
        prop_assert!(chords <= arc.length() * (1.0 + 1e-9) && chords > arc.length() * 0.9999);
    }
}
