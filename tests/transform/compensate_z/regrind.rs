//! A path made for one ball, driven with another.

use super::{compensate, in_plane, operation};
use nalgebra::Point3;

#[test]
fn a_reground_ball_and_back_is_where_it_began() {
    let hills: Vec<(f64, f64)> =
        (0..=200).map(|i| f64::from(i) * 0.25).map(|u| (u, 4.0 * (u / 9.0).sin())).collect();
    let contact = operation(&[in_plane(&hills, [3.0, 4.0], 25.0)]);
    let first = compensate("radius: 5, tolerance: 0.002, arcs: chords", &contact).unwrap();
    let reground =
        compensate("radius: 4.8, input: tip, was_radius: 5, tolerance: 0.002", &first.text).unwrap();
    let back =
        compensate("radius: 5, input: tip, was_radius: 4.8, tolerance: 0.002", &reground.text).unwrap();
    assert!(reground.gouge() <= 0.0022 && back.gap() <= 0.0022);
    let (one, other) = (first.passes()[0].clone(), back.passes()[0].clone());
    // Each of the two runs may be off by its tolerance.
    for at in &other {
        assert!(distance(at, &one) < 0.0045, "{at}: {}", distance(at, &one));
    }
    let moved = reground.passes()[0].iter().map(|at| distance(at, &one)).fold(0.0, f64::max);
    assert!(moved > 0.005, "the smaller ball goes another way: {moved}");
}

#[test]
fn centres_and_tips_say_the_same() {
    let hills: Vec<(f64, f64)> =
        (0..=100).map(|i| f64::from(i) * 0.5).map(|u| (u, 4.0 * (u / 9.0).sin())).collect();
    let contact = operation(&[in_plane(&hills, [0.0, 0.0], 0.0)]);
    let tips = compensate("radius: 5, tolerance: 0.002", &contact).unwrap();
    let centres = compensate("radius: 5, tolerance: 0.002, output: centre", &contact).unwrap();
    let from_tips = compensate("radius: 4, input: tip, was_radius: 5, tolerance: 0.002", &tips.text).unwrap();
    let from_centres =
        compensate("radius: 4, input: centre, was_radius: 5, tolerance: 0.002", &centres.text).unwrap();
    let (one, other) = (from_tips.passes()[0].clone(), from_centres.passes()[0].clone());
    assert!(other.iter().all(|at| distance(at, &one) < 0.001));
}

/// Distance from a path.
fn distance(at: &Point3<f64>, path: &[Point3<f64>]) -> f64 {
    let one = |pair: &[Point3<f64>]| {
        let way = pair[1] - pair[0];
        let share = ((at - pair[0]).dot(&way) / way.norm_squared().max(1e-12)).clamp(0.0, 1.0);
        (at - (pair[0] + way * share)).norm()
    };
    path.windows(2).map(one).fold(f64::INFINITY, f64::min)
}
