//! Ramps that no system writes on purpose.

use super::{LIMITS, Turns, all_near, points, ramp};
use clsmith::internals::transform::correct_ramp::ramp::{Ramp, RampArc};
use clsmith::internals::transform::correct_ramp::ramp_kind::RampKind;
use clsmith::internals::transform::correct_ramp::ramp_limits::{
    RampLimits, RampMeasurement, is_within_limits,
};
use clsmith::internals::transform::correct_ramp::tool_region::ToolRegion;
use clsmith::internals::transform::correct_ramp::{
    ImpossibleCorrection, LengtheningMethod, RampTask, correct_ramp,
};
use nalgebra::{Point2, Vector2};

const ANYWHERE: RampTask<'_> =
    RampTask { limits: LIMITS, begin: None, region: &ToolRegion::Everywhere, passes: &[], rounding: 0.0 };

fn corrected(points: &[[f64; 3]]) -> Ramp {
    let found = correct_ramp(&ramp(points), &ANYWHERE).unwrap().unwrap().ramp;
    assert!(is_within_limits(&found, &LIMITS, 0.0));
    found
}

#[test]
fn what_is_no_number_is_refused() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for place in 0..4 {
            for coordinate in 0..3 {
                let mut all = [[0.0, 0.0, 5.0], [3.0, 1.0, 4.0], [5.0, 3.0, 2.0], [7.0, 0.0, 0.0]];
                all[place][coordinate] = bad;
                assert_eq!(correct_ramp(&ramp(&all), &ANYWHERE), Err(ImpossibleCorrection::Limits));
                // Measuring it says nothing sensible, but comes back.
                let _ = (RampMeasurement::measure_ramp(&ramp(&all)), RampKind::classify_ramp(&ramp(&all)));
            }
        }
        let good = ramp(&[[0.0, 0.0, 5.0], [3.0, 1.0, 0.0]]);
        for limits in [RampLimits { shortest_leg: bad, ..LIMITS }, RampLimits { steepest: bad, ..LIMITS }] {
            assert_eq!(
                correct_ramp(&good, &RampTask { limits, ..ANYWHERE }),
                Err(ImpossibleCorrection::Limits)
            );
        }
        let passes = &[Vector2::new(bad, 0.0)];
        assert!(correct_ramp(&good, &RampTask { passes, ..ANYWHERE }).is_ok());
        let plunge = ramp(&[[0.0, 0.0, 5.0], [0.0, 0.0, 0.0]]);
        assert_eq!(
            correct_ramp(&plunge, &RampTask { passes, ..ANYWHERE }),
            Err(ImpossibleCorrection::NoDirection)
        );
        let mut arcs =
            Turns { centre: [0.0; 2], radius: 2.0, turns: 2.0, height: 2.0, steps: 8, arcs: true }.ramp();
        arcs.steps[3].bend = Some(RampArc { centre: Point2::new(0.0, bad), sweep: 1.0 });
        assert_eq!(correct_ramp(&arcs, &ANYWHERE), Err(ImpossibleCorrection::Limits));
        let _ = RampMeasurement::measure_ramp(&arcs);
    }
}

#[test]
fn heights_to_begin_at_that_lie_at_or_below_the_end_do_not_count() {
    let deep = ramp(&[[0.0, 0.0, 2.0], [10.0, 0.0, 0.0]]);
    for begin in [0.0, -1.0, f64::NAN] {
        let found = correct_ramp(&deep, &RampTask { begin: Some(begin), ..ANYWHERE }).unwrap().unwrap();
        assert_eq!((found.compression, found.passes), (1.0, 3));
    }
}

#[test]
fn a_ramp_without_steps_or_without_descent_keeps_every_limit() {
    let none = Ramp { start: [1.0, 2.0, 3.0].into(), steps: Vec::new() };
    assert_eq!(correct_ramp(&none, &ANYWHERE), Ok(None));
    assert_eq!(correct_ramp(&ramp(&[[0.0, 0.0, 1.0], [3.0, 0.0, 1.0]]), &ANYWHERE), Ok(None));
    assert_eq!(correct_ramp(&ramp(&[[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]), &ANYWHERE), Ok(None));
}

#[test]
fn a_point_given_twice_changes_nothing() {
    let once = corrected(&[[0.0, 0.0, 1.0], [6.0, 2.0, 0.5], [12.0, 0.0, 0.0]]);
    let twice = corrected(&[
        [0.0, 0.0, 1.0],
        [0.0, 0.0, 1.0],
        [3.0, 1.0, 0.75],
        [3.0, 1.0, 0.75],
        [6.0, 2.0, 0.5],
        [6.0, 2.0, 0.5],
        [12.0, 0.0, 0.0],
        [12.0, 0.0, 0.0],
    ]);
    all_near(&points(&twice), &points(&once));
}

#[test]
fn level_legs_have_no_part_but_the_ends_stay() {
    let found = corrected(&[
        [0.0, 0.0, 1.0],
        [-1.0, 0.0, 1.0],
        [5.0, 1.0, 0.5],
        [6.0, 0.0, 0.5],
        [11.0, 1.0, 0.0],
        [12.0, 0.0, 0.0],
    ]);
    all_near(&points(&found), &[[0.0, 0.0, 1.0], [6.0, 8.0, 0.5], [12.0, 0.0, 0.0]]);
}

#[test]
fn a_straight_descent_between_legs_becomes_a_leg_like_the_others() {
    let found = corrected(&[[0.0, 0.0, 3.0], [20.0, 0.0, 2.0], [20.0, 0.0, 1.0], [0.0, 6.0, 0.0]]);
    assert_eq!(found.steps.len(), 3);
    let legs = found.descending_legs();
    assert!(legs.iter().all(|leg| (leg.extent - legs[0].extent).abs() < 1e-9));
}

#[test]
fn almost_closed_ramps_end_where_they_ended() {
    for gap in [0.9e-3, 1.1e-3, 0.01] {
        let deep = [[0.0, 0.0, 9.0], [4.0, 0.0, 6.0], [4.0, 4.0, 3.0], [gap, 0.0, 0.0]];
        let found = corrected(&deep);
        assert_eq!((points(&found)[0], found.end_point()), (deep[0], deep[3].into()));
        let long = [[0.0, 0.0, 4.0], [10.0, 0.0, 2.0], [gap, 0.0, 0.0]];
        let found = corrected(&long);
        assert_eq!((points(&found)[0], found.end_point()), (long[0], long[2].into()));
    }
}

#[test]
fn a_tiny_helix_for_a_huge_cutter_has_no_end_of_chords() {
    let helix = Turns { centre: [0.0; 2], radius: 0.01, turns: 2.0, height: 2.0, steps: 48, arcs: false };
    let limits = RampLimits { shortest_leg: 1e5, steepest: 0.1 };
    let found = correct_ramp(&helix.ramp(), &RampTask { limits, ..ANYWHERE }).unwrap().unwrap();
    assert_eq!((found.lengthened, found.ramp.steps.len()), (LengtheningMethod::WidenedHelix, 7202));
}

#[test]
fn many_legs_in_many_passes_take_no_time() {
    let all: Vec<[f64; 3]> =
        (0..=20).map(|leg| [10.0 * f64::from(leg % 2), 0.0, 90.0 * f64::from(20 - leg)]).collect();
    let found = correct_ramp(&ramp(&all), &ANYWHERE).unwrap().unwrap();
    assert_eq!((found.passes, found.ramp.steps.len()), (90, 1800));
}
