//! Equations (1) and (2), and what is measured against them.

use super::{LIMITS, Turns, near, ramp};
use clsmith::internals::transform::correct_ramp::ramp_limits::{
    IndexableCutter, RampMeasurement, is_long_enough, is_shallow_enough, is_within_limits,
};

#[test]
fn the_shortest_leg_is_the_blind_width_and_the_steepest_angle_sinks_one_insert_over_it() {
    for (diameter, insert_radius, insert_height) in [(25.0, 5.0, 3.0), (12.0, 1.0, 1.0), (80.0, 6.0, 4.5)] {
        let limits = IndexableCutter { diameter, insert_radius, insert_height }.ramp_limits().unwrap();
        near(limits.shortest_leg, diameter - 2.0 * insert_radius);
        near(limits.steepest.atan(), insert_height.atan2(diameter - 2.0 * insert_radius));
    }
    let limits =
        IndexableCutter { diameter: 25.0, insert_radius: 5.0, insert_height: 3.0 }.ramp_limits().unwrap();
    assert_eq!(limits.to_string(), "legs of at least 15.000 mm and at most 11.31 degrees");
}

#[test]
fn a_cutter_that_cuts_to_its_centre_has_no_limits() {
    for (diameter, insert_radius) in [(10.0, 5.0), (10.0, 6.0), (f64::NAN, 1.0)] {
        assert!(IndexableCutter { diameter, insert_radius, insert_height: 1.0 }.ramp_limits().is_err());
    }
}

#[test]
fn a_ramp_on_both_limits_keeps_them_and_one_beyond_does_not() {
    assert!(is_within_limits(&ramp(&[[0.0, 0.0, 1.0], [10.0, 0.0, 0.0]]), &LIMITS, 0.0));
    let short = ramp(&[[0.0, 0.0, 0.9], [9.9999, 0.0, 0.0]]);
    assert!(!is_long_enough(&short, &LIMITS, 0.0) && is_long_enough(&short, &LIMITS, 2e-4));
    let steep = ramp(&[[0.0, 0.0, 1.0001], [10.0, 0.0, 0.0]]);
    assert!(!is_shallow_enough(&steep, &LIMITS, 0.0) && is_shallow_enough(&steep, &LIMITS, 2e-4));
}

#[test]
fn chords_in_line_are_one_leg_and_a_leg_that_stays_level_is_none() {
    let line = [[0.0, 0.0, 1.0], [4.0, 0.0, 0.6], [8.0, 0.0, 0.2], [10.0, 0.0, 0.0]];
    let measured = RampMeasurement::measure_ramp(&ramp(&line));
    assert_eq!(measured.legs, 1);
    near(measured.shortest_leg_mm, 10.0);
    near(measured.steepest_degrees, 0.1f64.atan().to_degrees());
    near(measured.length_mm, 101f64.sqrt());
    let level = [[0.0, 0.0, 1.0], [10.0, 0.0, 0.5], [10.0, 2.0, 0.5], [0.0, 2.0, 0.0]];
    assert_eq!(ramp(&level).descending_legs().len(), 2);
    assert!(is_within_limits(&ramp(&level), &LIMITS, 0.0));
}

#[test]
fn a_point_given_twice_does_not_split_a_leg() {
    let twice = ramp(&[[0.0, 0.0, 1.0], [5.0, 0.0, 0.5], [5.0, 0.0, 0.5], [10.0, 0.0, 0.0]]);
    assert_eq!(twice.descending_legs().len(), 1);
    assert!(is_within_limits(&twice, &LIMITS, 0.0));
}

#[test]
fn a_straight_descent_within_a_ramp_is_a_leg_without_length() {
    let vertical = ramp(&[[0.0, 0.0, 2.0], [10.0, 0.0, 1.0], [10.0, 0.0, 0.9], [0.0, 0.0, 0.0]]);
    let measured = RampMeasurement::measure_ramp(&vertical);
    assert_eq!(measured.legs, 3);
    near(measured.shortest_leg_mm, 0.0);
    near(measured.steepest_degrees, 90.0);
}

#[test]
fn the_leg_of_a_helix_is_its_diameter() {
    for (steps, arcs) in [(48, false), (8, true)] {
        let helix = Turns { centre: [3.0, 4.0], radius: 4.0, turns: -2.0, height: 2.0, steps, arcs }.ramp();
        let measured = RampMeasurement::measure_ramp(&helix);
        assert_eq!(measured.legs, 1);
        near(measured.shortest_leg_mm, 8.0);
        assert!(!is_long_enough(&helix, &LIMITS, 0.0));
    }
}
