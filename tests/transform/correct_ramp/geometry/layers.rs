//! Compression, layers and turns.

use super::{LIMITS, Turns, all_near, near, points, ramp};
use clsmith::internals::transform::correct_ramp::ramp::Ramp;
use clsmith::internals::transform::correct_ramp::ramp_kind::RampKind;
use clsmith::internals::transform::correct_ramp::ramp_passes::{
    MOST_PASSES, TooManyPasses, add_passes_or_turns, build_helix_steps, compress_heights, count_passes,
    repeat_in_passes,
};
use clsmith::internals::transform::correct_ramp::tool_region::ToolRegion;
use nalgebra::Point2;

fn shallower(ramp: &Ramp) -> (Ramp, usize) {
    add_passes_or_turns(ramp, &LIMITS, 0.0, &ToolRegion::Everywhere).unwrap()
}

#[test]
fn compression_takes_a_share_of_every_height_over_the_end() {
    let compressed = compress_heights(&ramp(&[[0.0, 0.0, 9.0], [20.0, 0.0, 4.0], [0.0, 5.0, -1.0]]), 0.4);
    all_near(&points(&compressed), &[[0.0, 0.0, 3.0], [20.0, 0.0, 1.0], [0.0, 5.0, -1.0]]);
    near(compressed.steepest_slope(), 0.4 * 5.0 / 20.0);
}

#[test]
fn passes_are_the_least_that_keep_the_limit() {
    // nu = 0.4: 1.5 layers more around, 0.75 there and back.
    assert_eq!(count_passes(0.25, 0.1, true), Ok(3));
    assert_eq!(count_passes(0.25, 0.1, false), Ok(3));
    // nu = 0.24: 3.17 and 1.58.
    assert_eq!(count_passes(0.25, 0.06, true), Ok(5));
    assert_eq!(count_passes(0.25, 0.06, false), Ok(5));
    assert_eq!(count_passes(0.1, 0.1, true), Ok(1));
    assert_eq!(count_passes(0.1, 0.2, false), Ok(1));
    for limit in [0.1, 0.07, 1.0 / 3.0, 0.6] {
        for exact in 1..60usize {
            let steep = limit * exact as f64;
            assert_eq!(count_passes(steep, limit, true), Ok(exact), "exactly on the limit");
            assert_eq!(count_passes(steep * (1.0 + 1e-12), limit, true), Ok(exact), "but for rounding");
            assert_eq!(count_passes(steep * (1.0 + 1e-6), limit, true), Ok(exact + 1));
            let odd = exact + 1 - exact % 2;
            assert_eq!(count_passes(steep, limit, false), Ok(odd));
        }
    }
}

#[test]
fn no_end_of_passes_is_refused() {
    assert_eq!(count_passes(0.1 * 1000.0, 0.1, true), Ok(MOST_PASSES));
    assert_eq!(count_passes(0.1 * 1001.0, 0.1, true), Err(TooManyPasses(1001.0)));
    assert_eq!(count_passes(0.1 * 1000.0, 0.1, false), Err(TooManyPasses(1001.0)));
    assert_eq!(count_passes(f64::INFINITY, 0.1, true), Err(TooManyPasses(f64::INFINITY)));
    assert!(count_passes(1.0, 0.0, true).is_err() && count_passes(f64::NAN, 0.1, true).is_err());
}

#[test]
fn layers_around_repeat_the_loop_and_fill_the_height() {
    let loop_ = ramp(&[[0.0, 0.0, 6.0], [10.0, 0.0, 4.0], [10.0, 10.0, 1.0], [0.0, 0.0, 0.0]]);
    let expected = [
        [0.0, 0.0, 6.0],
        [10.0, 0.0, 5.0],
        [10.0, 10.0, 3.5],
        [0.0, 0.0, 3.0],
        [10.0, 0.0, 2.0],
        [10.0, 10.0, 0.5],
        [0.0, 0.0, 0.0],
    ];
    all_near(&points(&repeat_in_passes(&loop_, 2)), &expected);
}

#[test]
fn layers_to_and_fro_go_back_over_the_same_points() {
    let open = ramp(&[[0.0, 0.0, 6.0], [10.0, 0.0, 3.0], [10.0, 10.0, 0.0]]);
    let expected = [
        [0.0, 0.0, 6.0],
        [10.0, 0.0, 5.0],
        [10.0, 10.0, 4.0],
        [10.0, 0.0, 3.0],
        [0.0, 0.0, 2.0],
        [10.0, 0.0, 1.0],
        [10.0, 10.0, 0.0],
    ];
    let all = repeat_in_passes(&open, 3);
    all_near(&points(&all), &expected);
    near(all.steepest_slope(), open.steepest_slope() / 3.0);
    for once in [repeat_in_passes(&open, 1), repeat_in_passes(&open, 0)] {
        all_near(&points(&once), &points(&open));
    }
}

#[test]
fn arcs_turn_back_on_the_way_back() {
    let half =
        Turns { centre: [1.0, 1.0], radius: 20.0, turns: 0.5, height: 9.0, steps: 2, arcs: true }.ramp();
    let (found, passes) = shallower(&half);
    assert_eq!(passes, 3);
    let quarter = std::f64::consts::FRAC_PI_2;
    let sweeps: Vec<f64> = found.steps.iter().map(|step| step.bend.unwrap().sweep / quarter).collect();
    assert_eq!(sweeps, [1.0, 1.0, -1.0, -1.0, 1.0, 1.0]);
    for (from, step) in found.steps_with_starts() {
        near((from.xy() - Point2::new(1.0, 1.0)).norm(), 20.0);
        near(step.length_across_mm(from), 20.0 * quarter);
        near(from.z - step.to.z, 1.5);
    }
}

#[test]
fn a_ramp_with_level_legs_keeps_them_level_in_every_pass() {
    let level = ramp(&[[0.0, 0.0, 4.0], [10.0, 0.0, 2.0], [10.0, 5.0, 2.0], [0.0, 5.0, 0.0]]);
    let (found, passes) = shallower(&level);
    assert_eq!(passes, 3);
    assert_eq!(
        found.steps_with_starts().filter(|(from, step)| (from.z - step.to.z).abs() < 1e-12).count(),
        3
    );
    near(found.steepest_slope(), 0.2 / 3.0);
}

#[test]
fn a_helix_gets_whole_turns_more_and_none_too_many() {
    for arcs in [false, true] {
        for sense in [1.0, -1.0] {
            for exact in [3usize, 4, 7] {
                // As high as the limit allows over `exact` turns, of 36 chords or arcs each.
                let half = std::f64::consts::PI / 36.0;
                let around = if arcs { half } else { half.sin() } * 72.0 * 6.0;
                let height = LIMITS.steepest * around * exact as f64;
                let helix =
                    Turns { centre: [5.0, -3.0], radius: 6.0, turns: 2.0 * sense, height, steps: 72, arcs };
                let (found, passes) = shallower(&helix.ramp());
                assert_eq!((passes, found.steps.len()), (exact - 1, 36 * exact));
                let RampKind::Helix(measured) = RampKind::classify_ramp(&found) else {
                    panic!("a helix stays one")
                };
                near(measured.sweep / std::f64::consts::TAU, exact as f64 * sense);
                near(found.steepest_slope(), LIMITS.steepest);
                assert_eq!((found.start, found.end_point()), (helix.ramp().start, helix.ramp().end_point()));
            }
        }
    }
}

#[test]
fn links_before_and_after_a_helix_stay_and_level_chords_in_it_count() {
    let helix =
        Turns { centre: [0.0, 0.0], radius: 6.0, turns: 1.0, height: 6.0, steps: 36, arcs: false }.ramp();
    let mut all = points(&helix);
    // A quarter of the way stays level.
    for point in &mut all[9..=18] {
        point[2] = 4.5;
    }
    all.insert(0, [1.0, 1.0, 6.0]);
    all.push([-2.0, 1.0, 0.0]);
    let (found, passes) = shallower(&ramp(&all));
    assert_eq!((passes, found.steps.len()), (2, 74));
    let got = points(&found);
    assert_eq!((got[0], got[1]), (all[0], all[1]));
    assert_eq!((got[73], got[74]), (all[37], all[38]));
    for pair in got[1..=73].windows(2) {
        near(
            (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]),
            12.0 * (std::f64::consts::PI / 36.0).sin(),
        );
        near(pair[0][2] - pair[1][2], 6.0 / 72.0);
    }
}

#[test]
fn a_helix_without_room_for_whole_turns_goes_to_and_fro() {
    // 300 degrees around a post in the way of the rest.
    let helix =
        Turns { centre: [0.0, 0.0], radius: 8.0, turns: 300.0 / 360.0, height: 8.0, steps: 30, arcs: false };
    let own: Vec<[f64; 2]> = points(&helix.ramp()).iter().map(|point| [point[0], point[1]]).collect();
    let region = ToolRegion::from_polygon(&own).unwrap();
    let (found, passes) = add_passes_or_turns(&helix.ramp(), &LIMITS, 0.0, &region).unwrap();
    assert_eq!((passes, found.steps.len()), (3, 90));
    assert!(found.points().all(|point| own.iter().any(|at| (point.xy() - Point2::from(*at)).norm() < 1e-9)));
    assert_eq!(shallower(&helix.ramp()).1, 2);
}

#[test]
fn the_steps_around_end_where_they_are_told() {
    let helix = Turns { centre: [2.0, 2.0], radius: 3.0, turns: 1.5, height: 3.0, steps: 18, arcs: false };
    let RampKind::Helix(measured) = RampKind::classify_ramp(&helix.ramp()) else {
        panic!("18 chords around are a helix")
    };
    let again = build_helix_steps(&measured, helix.ramp().start, helix.ramp().end_point());
    assert_eq!(again.last().map(|step| step.to), Some(helix.ramp().end_point()));
    let again: Vec<[f64; 3]> = again.iter().map(|step| [step.to.x, step.to.y, step.to.z]).collect();
    all_near(&again, &points(&helix.ramp())[1..]);
}
