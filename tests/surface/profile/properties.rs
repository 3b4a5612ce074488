//! What holds for any profile.

use super::brute::{assert_runs, clearance, polyline};
use clsmith::internals::surface::profile::{
    Chain, ChainPiece, ChordSide, LARGEST, Point, compensate_profile, find_unreachable_parts, fit_chords,
    recover_profile,
};
use proptest::prelude::*;

/// Pieces as steps: lines by (du, dz) and arcs by radius and angles.
#[derive(Debug, Clone)]
enum Step {
    Line(f64, f64),
    Arc(f64, f64, f64),
}

fn chain(steps: &[Step]) -> Chain {
    let mut at = Point::new(3.0, -2.0);
    let mut pieces = Vec::new();
    for step in steps {
        let piece = match *step {
            Step::Line(du, dz) => ChainPiece::line(at, Point::new(at.u + du, at.z + dz)),
            Step::Arc(radius, start, sweep) => {
                let centre = Point::new(at.u - radius * start.cos(), at.z - radius * start.sin());
                ChainPiece::arc(centre, radius, start, sweep)
            }
        };
        at = piece.end();
        pieces.push(piece);
    }
    Chain::new(pieces).unwrap()
}

/// Coordinates that often coincide: multiples of a half, zero, and any.
fn across() -> impl Strategy<Value = f64> {
    prop_oneof![
        (-4..12).prop_map(|half| f64::from(half) * 0.5),
        Just(0.0),
        -3.0..8.0,
        Just(1e-10),
        Just(1e-7)
    ]
}

fn up() -> impl Strategy<Value = f64> {
    prop_oneof![(-8..8).prop_map(|half| f64::from(half) * 0.5), Just(0.0), -5.0..5.0]
}

fn steps(most: usize) -> impl Strategy<Value = Vec<Step>> {
    let step = prop_oneof![
        3 => (across(), up()).prop_map(|(du, dz)| Step::Line(du, dz)),
        1 => (0.1..12.0, 0.0..6.3, -6.2..6.2).prop_map(|(radius, start, sweep)| Step::Arc(radius, start, sweep)),
        1 => ((1..20), (0..8), (-8..8)).prop_map(|(radius, start, sweep)| {
            let eighth = std::f64::consts::FRAC_PI_4;
            Step::Arc(f64::from(radius) * 0.5, f64::from(start) * eighth, f64::from(sweep) * eighth)
        }),
    ];
    prop::collection::vec(step, 1..most)
}

proptest! {
    #![proptest_config(crate::support::property(200))]

    #[test]
    fn the_ball_touches_everywhere_and_gouges_nowhere(
        steps in steps(14), turn in any::<bool>(), far in any::<bool>(), radius in prop_oneof![Just(5.0), Just(0.5), 0.05..9.0],
    ) {
        let profile = if turn { chain(&steps).reversed() } else { chain(&steps) };
        let profile = if far { profile.shifted(1000.0, -300.0) } else { profile };
        let tip = compensate_profile(&profile, radius).unwrap();
        assert_runs(&tip, profile.end().u >= profile.start().u);
        // 1e-9 of the size, and what counts as upright.
        let tolerance = 1e-8;
        for piece in tip.pieces() {
            let upright = (piece.start().u - piece.end().u).abs() < 1e-8;
            for index in 0..=5 {
                let point = piece.point_at(f64::from(index) / 5.0);
                let clear = clearance(&profile, Point::new(point.u, point.z + radius)) - radius;
                prop_assert!(clear > -tolerance, "gouge {clear} at {point:?} of {piece:?}");
                prop_assert!(upright || clear < tolerance, "gap {clear} at {point:?} of {piece:?}");
            }
        }
    }

    #[test]
    fn the_balls_path_leaves_out_nothing_between_its_ends(steps in steps(10), radius in 0.3..6.0) {
        let profile = chain(&steps);
        let tip = compensate_profile(&profile, radius).unwrap();
        let (low, high) = profile.vertices().fold((f64::MAX, f64::MIN), |(low, high), point| (low.min(point.u), high.max(point.u)));
        prop_assert!(tip.start().u >= low - 2.0 * 12.0 - radius && tip.end().u <= high + 2.0 * 12.0 + radius);
        for part in find_unreachable_parts(&profile, radius, 1e-6).unwrap() {
            prop_assert!(part.first <= part.last && part.last < profile.pieces().len());
            prop_assert!(part.left_mm.is_finite());
        }
        // Where a recovered profile lies above the profile, the ball cannot have touched; it never lies below what it touched.
        let contact = recover_profile(&tip, radius).unwrap();
        // A lone wall has no side.
        if (contact.end().u - contact.start().u) * (profile.end().u - profile.start().u) < 1e-3 {
            return Ok(());
        }
        let again = compensate_profile(&contact, radius).unwrap();
        for point in again.vertices() {
            let clear = clearance(&profile, Point::new(point.u, point.z + radius)) - radius;
            prop_assert!(clear > -1e-6, "gouge {clear} at {point:?}");
        }
    }

    #[test]
    fn chords_keep_to_the_tolerance(
        steps in steps(20), tolerance in prop_oneof![Just(0.01), 0.001..0.5], arcs in any::<bool>(),
    ) {
        let exact = chain(&steps);
        let few = fit_chords(&exact, tolerance, arcs, ChordSide::Both).unwrap();
        Chain::new(few.pieces().to_vec()).unwrap();
        prop_assert!(few.start().distance(exact.start()) < 1e-9);
        prop_assert!(few.end().distance(exact.end()) < 1e-6);
        for (one, other) in [(&exact, &few), (&few, &exact)] {
            for piece in one.pieces() {
                for index in 0..=16 {
                    let point = piece.point_at(f64::from(index) / 16.0);
                    let distance = other.pieces().iter().map(|piece| from(piece, point)).fold(f64::MAX, f64::min);
                    prop_assert!(distance <= tolerance * (1.0 + 1e-6), "{distance} at {point:?}");
                }
            }
        }
    }

    #[test]
    fn chords_on_one_side_keep_to_it(steps in steps(12), tolerance in 0.01..0.5, arcs in any::<bool>()) {
        let exact = compensate_profile(&chain(&steps), 2.0).unwrap();
        let few = fit_chords(&exact, tolerance, arcs, ChordSide::Above).unwrap();
        Chain::new(few.pieces().to_vec()).unwrap();
        let sense = if exact.end().u >= exact.start().u { 1.0 } else { -1.0 };
        let bend = |pair: &[ChainPiece]| {
            let (a, b) = (pair[0].direction_at(1.0), pair[1].direction_at(0.0));
            (a.u * b.z - a.z * b.u).atan2(a.u * b.u + a.z * b.z) * sense
        };
        let sharp = exact.pieces().windows(2).map(bend).fold(0.0, f64::max) > 2.0;
        for piece in few.pieces() {
            for index in 0..=16 {
                let point = piece.point_at(f64::from(index) / 16.0);
                // Above, and beside what is upright.
                let clear = clearance(&exact, point);
                let distance = exact.pieces().iter().map(|piece| from(piece, point)).fold(f64::MAX, f64::min);
                prop_assert!(sharp || distance <= tolerance * (1.0 + 1e-6), "{distance} at {point:?}");
                prop_assert!(clear > 0.0 || distance < 1e-7, "{distance} below at {point:?}");
            }
        }
    }

    #[test]
    fn wild_numbers_do_no_harm(
        points in prop::collection::vec((wild(), wild()), 2..40), radius in prop_oneof![Just(1e-3), Just(LARGEST), 0.0..100.0],
        tolerance in 1e-6..10.0,
    ) {
        let points: Vec<[f64; 2]> = points.into_iter().map(|(u, z)| [u, z]).collect();
        let profile = polyline(&points);
        if let Ok(tip) = compensate_profile(&profile, radius) {
            prop_assert!(tip.vertices().all(|point| point.u.is_finite() && point.z.is_finite()));
            let _ = recover_profile(&tip, radius);
            let _ = find_unreachable_parts(&profile, radius, tolerance);
        }
        for side in [ChordSide::Both, ChordSide::Above, ChordSide::Below] {
            let few = fit_chords(&profile, tolerance, true, side).unwrap();
            prop_assert!(few.vertices().all(|point| point.u.is_finite() && point.z.is_finite()));
        }
    }
}

fn wild() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(-0.0),
        Just(LARGEST),
        Just(-LARGEST),
        Just(1e-300),
        Just(5e-324),
        -1.0..1.0,
        -LARGEST..LARGEST,
        (-3..3).prop_map(f64::from),
        (-3..3).prop_map(|step| 1.0 + f64::from(step) * f64::EPSILON),
    ]
}

fn from(piece: &ChainPiece, point: Point) -> f64 {
    let ends = piece.start().distance(point).min(piece.end().distance(point));
    match piece {
        ChainPiece::Line(line) => {
            let (du, dz) = (line.to.u - line.from.u, line.to.z - line.from.z);
            let share = ((point.u - line.from.u) * du + (point.z - line.from.z) * dz) / (du * du + dz * dz);
            if (0.0..=1.0).contains(&share) { ends.min(piece.point_at(share).distance(point)) } else { ends }
        }
        ChainPiece::Arc(arc) => {
            let angle = (point.z - arc.centre.z).atan2(point.u - arc.centre.u);
            let along = ((angle - arc.start_rad) * arc.sweep_rad.signum()).rem_euclid(std::f64::consts::TAU);
            if along <= arc.sweep_rad.abs() {
                (arc.centre.distance(point) - arc.radius_mm).abs()
            } else {
                ends
            }
        }
    }
}
