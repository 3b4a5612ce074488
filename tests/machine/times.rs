//! Times by hand.

use clsmith::machine::{FeedMotion, rest_to_rest_s, time_feed_motions};
use nalgebra::Vector3;

#[track_caller]
fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} instead of {wanted}");
}

fn along(length: f64, speed: f64, direction: Vector3<f64>) -> FeedMotion {
    FeedMotion {
        length,
        speed,
        tangents: [direction.normalize(); 2],
        acceleration: Some(1000.0),
        jerk: None,
        is_from_rest: false,
    }
}

fn total(motions: &[FeedMotion]) -> f64 {
    time_feed_motions(motions, 0.0087, |_, _| {}).total()
}

#[test]
fn trapezoid_triangle_and_s_curve() {
    // 100 mm/s at 1000 mm/s2: 0.1 s and 5 mm up, the same down.
    close(rest_to_rest_s(60.0, 100.0, Some(1000.0), None), 0.1 + 0.5 + 0.1);
    close(rest_to_rest_s(2.5, 100.0, Some(1000.0), None), 2.0 * 0.05);
    // With 20,000 mm/s3 the acceleration takes 0.05 s to come and go: L/v + v/a + a/j.
    close(rest_to_rest_s(60.0, 100.0, Some(1000.0), Some(20_000.0)), 0.6 + 0.1 + 0.05);
    // So short that not even the acceleration is reached: four times the same jerk, L = 2 j t3.
    close(rest_to_rest_s(2.0 * 20_000.0 * 0.01f64.powi(3), 100.0, Some(1000.0), Some(20_000.0)), 0.04);
    close(rest_to_rest_s(30.0, 100.0, None, None), 0.3);
}

#[test]
fn a_chain_starts_and_stops_once() {
    let blocks = vec![along(0.5, 50.0, Vector3::x()); 100];
    close(total(&blocks), 1.0 + 0.05);
    let mut seconds = vec![0.0; 100];
    let parts = time_feed_motions(&blocks, 0.0087, |index, time| seconds[index] += time);
    close(seconds.iter().sum(), parts.total());
    // In the middle the blocks run at feed; the first one starts from rest: v2 = 2 a s.
    close(seconds[50], 0.01);
    close(seconds[0], (2.0 * 0.5 / 1000f64).sqrt());
    close(seconds[99], seconds[0]);
}

#[test]
fn single_blocks_of_an_s_curve_add_up() {
    let blocks: Vec<FeedMotion> =
        (0..100).map(|_| FeedMotion { jerk: Some(20_000.0), ..along(0.4, 50.0, Vector3::x()) }).collect();
    let mut seconds = vec![0.0; 100];
    let parts = time_feed_motions(&blocks, 0.0, |index, time| seconds[index] += time);
    close(parts.total(), 40.0 / 50.0 + 0.05 + 0.05);
    close(seconds.iter().sum(), parts.total());
    close(seconds[50], 0.008);
    // At the start the way is j t3 / 6.
    close(seconds[0], (6.0 * 0.4 / 20_000f64).cbrt());
}

#[test]
fn a_corner_costs_the_root_of_the_change_of_velocity() {
    let corner = [along(50.0, 20.0, Vector3::x()), along(50.0, 20.0, Vector3::y())];
    let lost = 0.0087 * (20.0 * 2f64.sqrt()).sqrt();
    close(total(&corner), 5.0 + 0.02 + lost);
    // Back on itself, the change is twice the speed.
    let back = [along(50.0, 20.0, Vector3::x()), along(50.0, 20.0, -Vector3::x())];
    close(total(&back), 5.0 + 0.02 + 0.0087 * 40f64.sqrt());
    // After a rest there is no corner.
    let mut rest = corner;
    rest[1].is_from_rest = true;
    close(total(&rest), 5.0 + 0.04);
}

#[test]
fn a_feed_that_is_never_reached_loses_what_the_ramps_lose() {
    let short = [along(0.4, 100.0, Vector3::x())];
    close(total(&short), 2.0 * (0.4 / 1000f64).sqrt());
    // A step up that has no room, seen from both sides.
    let climb =
        [along(10.0, 20.0, Vector3::x()), along(1.0, 200.0, Vector3::x()), along(10.0, 20.0, Vector3::x())];
    let peak = (20f64 * 20.0 + 1000.0 * 1.0).sqrt();
    let expected = (10.0 / 20.0 + 0.01) * 2.0 + 2.0 * (peak - 20.0) / 1000.0;
    close(total(&climb), expected);
}

#[test]
fn hostile_numbers_end() {
    for (length, speed) in [(1e-300, 1e300), (1e12, 1e-12), (1e-12, 1e-12), (1e300, 1e3)] {
        for jerk in [None, Some(1e-3), Some(1e12)] {
            let motions = [FeedMotion { jerk, ..along(length, speed, Vector3::x()) }];
            assert!(total(&motions) >= 0.0);
        }
    }
}
