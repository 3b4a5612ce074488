//! Helices, ramps along a shape, and what printing takes away.

use super::{LIMITS, Turns, all_near, near, points, ramp};
use clsmith::internals::transform::correct_ramp::ramp::{Ramp, RampArc, RampStep};
use clsmith::internals::transform::correct_ramp::ramp_kind::RampKind;
use clsmith::internals::transform::correct_ramp::ramp_limits::{RampLimits, is_within_limits};
use clsmith::internals::transform::correct_ramp::tool_region::ToolRegion;
use clsmith::internals::transform::correct_ramp::{CorrectedRamp, LengtheningMethod, RampTask, correct_ramp};
use nalgebra::{Point2, Point3};
use std::f64::consts::{FRAC_PI_2, TAU};

const ANYWHERE: RampTask<'_> =
    RampTask { limits: LIMITS, begin: None, region: &ToolRegion::Everywhere, passes: &[], rounding: 0.0 };

fn corrected(ramp: &Ramp) -> CorrectedRamp {
    correct_ramp(ramp, &ANYWHERE).unwrap().unwrap()
}

#[test]
fn what_keeps_the_limits_is_left_alone() {
    assert_eq!(correct_ramp(&ramp(&[[0.0, 0.0, 1.0], [10.0, 0.0, 0.0]]), &ANYWHERE), Ok(None));
}

#[test]
fn a_narrow_helix_becomes_wider_about_its_axis() {
    for (steps, arcs) in [(48, false), (18, false), (16, true)] {
        for sense in [2.0, -2.0] {
            let helix = Turns { centre: [3.0, -1.0], radius: 2.0, turns: sense, height: 2.0, steps, arcs };
            let found = corrected(&helix.ramp());
            assert_eq!((found.lengthened, found.passes), (LengtheningMethod::WidenedHelix, 1));
            let RampKind::Helix(measured) = RampKind::classify_ramp(&found.ramp) else {
                panic!("a helix stays one")
            };
            near(measured.radius, 5.0);
            near(measured.sweep, TAU * sense);
            // Level links out and in; the rest is on the circle, the chords as close to it as before.
            let all = points(&found.ramp);
            all_near(&[all[0], all[1]], &[[5.0, -1.0, 2.0], [8.0, -1.0, 2.0]]);
            all_near(&all[all.len() - 2..], &[[8.0, -1.0, 0.0], [5.0, -1.0, 0.0]]);
            let sagitta = |radius: f64, sweep: f64| radius * (1.0 - (0.5 * sweep).cos());
            let (before, after) =
                (sagitta(2.0, 2.0 * TAU / steps as f64), sagitta(5.0, measured.widest_step));
            assert!(arcs || (after <= before + 1e-12 && after > 0.7 * before), "{after} of {before}");
            let at_axis = |point: &[f64; 3]| (point[0] - 3.0).hypot(point[1] + 1.0);
            all[1..all.len() - 1].iter().for_each(|point| near(at_axis(point), 5.0));
        }
    }
}

#[test]
fn a_helix_that_was_widened_is_widened_again_for_a_larger_cutter() {
    let helix = Turns { centre: [0.0, 0.0], radius: 2.0, turns: 2.0, height: 2.0, steps: 48, arcs: false };
    let once = corrected(&helix.ramp()).ramp;
    let limits = RampLimits { shortest_leg: 16.0, steepest: 0.1 };
    let twice = correct_ramp(&once, &RampTask { limits, ..ANYWHERE }).unwrap().unwrap();
    assert!(is_within_limits(&twice.ramp, &limits, 0.0));
    let all = points(&twice.ramp);
    all_near(&[all[0], all[1]], &[[2.0, 0.0, 2.0], [8.0, 0.0, 2.0]]);
    all[1..all.len() - 1].iter().for_each(|point| near(point[0].hypot(point[1]), 8.0));
}

#[test]
fn along_the_shape_goes_to_and_fro_over_the_shape() {
    let bend = RampArc { centre: Point2::new(20.0, 20.0), sweep: FRAC_PI_2 };
    let step = RampStep { to: Point3::new(40.0, 20.0, 0.0), bend: Some(bend) };
    let shape = Ramp {
        start: Point3::new(0.0, 0.0, 10.0),
        steps: vec![RampStep::straight_to(Point3::new(20.0, 0.0, 5.0)), step],
    };
    assert_eq!(RampKind::classify_ramp(&shape), RampKind::AlongShape);
    let found = corrected(&shape);
    assert_eq!((found.lengthened, found.passes), (LengtheningMethod::No, 3));
    let fall = 5.0 / 3.0;
    let expected: Vec<[f64; 3]> =
        [[0.0, 0.0], [20.0, 0.0], [40.0, 20.0], [20.0, 0.0], [0.0, 0.0], [20.0, 0.0], [40.0, 20.0]]
            .iter()
            .zip(0..)
            .map(|([x, y], index)| [*x, *y, 10.0 - fall * f64::from(index)])
            .collect();
    all_near(&points(&found.ramp), &expected);
    let sweeps: Vec<Option<f64>> =
        found.ramp.steps.iter().map(|step| step.bend.map(|bend| bend.sweep)).collect();
    let there = Some(FRAC_PI_2);
    assert_eq!(sweeps, [None, there, there.map(|sweep| -sweep), None, None, there]);
}

#[test]
fn legs_are_made_as_much_longer_as_printing_may_take_away() {
    let task = RampTask { rounding: 0.01, ..ANYWHERE };
    let found = correct_ramp(&ramp(&[[0.0, 0.0, 1.0], [6.0, 2.0, 0.5], [12.0, 0.0, 0.0]]), &task);
    let found = found.unwrap().unwrap().ramp;
    near(found.descending_legs()[0].extent, 10.01);
    // Half of the bound off at every coordinate, the limit is kept still.
    let printed: Vec<[f64; 3]> =
        points(&found).iter().map(|point| point.map(|value| (value * 200.0).round() / 200.0)).collect();
    assert!(is_within_limits(&ramp(&printed), &LIMITS, 0.01));
}
