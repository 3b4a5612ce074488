//! Few chords within the tolerance.

use super::brute::polyline;
use crate::support::within_seconds;
use clsmith::internals::surface::profile::{
    Chain, ChainPiece, ChordError, ChordSide, Point, compensate_profile, fit_chords,
};
use std::f64::consts::PI;

/// Signed distances of samples of `chain` from `other` that is near it: the largest to either side (above positive).
fn deviations(chain: &Chain, other: &Chain) -> (f64, f64) {
    let (mut above, mut below) = (0.0_f64, 0.0_f64);
    let pieces = other.pieces();
    let mut at = 0;
    // As many of the other's pieces as a few of the chain's take.
    let wide = 8 + 12 * pieces.len() / chain.pieces().len();
    let samples = if pieces.len() > chain.pieces().len() { 20 } else { 3 };
    for piece in chain.pieces() {
        for index in 0..=samples {
            let point = piece.point_at(f64::from(index) / f64::from(samples));
            let window = pieces.iter().enumerate().skip(at.max(4) - 4).take(wide);
            let (best, signed) = window
                .map(|(index, piece)| (index, signed(piece, point)))
                .min_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
                .unwrap();
            at = best;
            above = above.max(signed);
            below = below.max(-signed);
        }
    }
    (above, below)
}

fn signed(piece: &ChainPiece, point: Point) -> f64 {
    let (distance, share) = match piece {
        ChainPiece::Line(line) => {
            let (du, dz) = (line.to.u - line.from.u, line.to.z - line.from.z);
            let along = (point.u - line.from.u) * du + (point.z - line.from.z) * dz;
            let share = (along / (du * du + dz * dz)).clamp(0.0, 1.0);
            (piece.point_at(if share.is_nan() { 0.0 } else { share }).distance(point), share)
        }
        ChainPiece::Arc(arc) => {
            let angle = (point.z - arc.centre.z).atan2(point.u - arc.centre.u);
            let along =
                ((angle - arc.start_rad) * arc.sweep_rad.signum()).rem_euclid(2.0 * PI) / arc.sweep_rad.abs();
            if along <= 1.0 {
                ((arc.centre.distance(point) - arc.radius_mm).abs(), along)
            } else {
                let (start, end) = (piece.start().distance(point), piece.end().distance(point));
                if start < end { (start, 0.0) } else { (end, 1.0) }
            }
        }
    };
    let (foot, direction) = (piece.point_at(share), piece.direction_at(share));
    let left = direction.u * (point.z - foot.z) - direction.z * (point.u - foot.u);
    distance * left.signum()
}

fn assert_within(exact: &Chain, few: &Chain, tolerance: f64, side: ChordSide) {
    let (above, below) = deviations(few, exact);
    let (back_below, back_above) = deviations(exact, few);
    let allowed = |wanted: ChordSide| if side == wanted { 1e-9 } else { tolerance * (1.0 + 1e-9) };
    assert!(above.max(back_above) <= allowed(ChordSide::Below), "{above} {back_above} above");
    assert!(below.max(back_below) <= allowed(ChordSide::Above), "{below} {back_below} below");
}

#[test]
fn a_circle_takes_as_few_chords_as_the_closed_form() {
    for (radius, tolerance) in [(50.0_f64, 0.01_f64), (10.0, 0.002), (400.0, 0.05)] {
        let arc = Chain::new(vec![ChainPiece::arc(Point::new(0.0, 0.0), radius, PI, -PI)]).unwrap();
        let few = fit_chords(&arc, tolerance, false, ChordSide::Both).unwrap();
        let optimum = (PI / (2.0 * (1.0 - tolerance / radius).acos())).ceil();
        let count = few.pieces().len() as f64;
        println!("circle R{radius} within {tolerance}: {count} chords, optimum {optimum}");
        assert!(count >= optimum && count <= (optimum * 1.05).ceil(), "{count} {optimum}");
        assert_within(&arc, &few, tolerance, ChordSide::Both);
        assert!(
            few.pieces().iter().all(|piece| (piece.end().distance(Point::default()) - radius).abs() < 1e-9)
        );
        let kept = fit_chords(&arc, tolerance, true, ChordSide::Both).unwrap();
        assert_eq!(kept.pieces(), arc.pieces());
    }
}

#[test]
fn one_side_is_kept_to() {
    let wave: Vec<[f64; 2]> =
        (0..4000).map(|index| f64::from(index) * 0.02).map(|u| [u, 4.0 * (u * 0.25).sin()]).collect();
    let path = compensate_profile(&polyline(&wave), 3.0).unwrap();
    let both = fit_chords(&path, 0.02, false, ChordSide::Both).unwrap().pieces().len();
    for side in [ChordSide::Above, ChordSide::Below, ChordSide::Both] {
        for arcs in [false, true] {
            let few = fit_chords(&path, 0.02, arcs, side).unwrap();
            println!("wave, {side:?}, arcs {arcs}: {} of {}", few.pieces().len(), path.pieces().len());
            assert_within(&path, &few, 0.02, side);
            assert!(few.pieces().len() as f64 <= 1.65 * both as f64);
        }
    }
}

#[test]
fn chords_of_one_circle_become_one_arc() {
    let mut points: Vec<[f64; 2]> = vec![[-40.0, 20.0]];
    points.extend(
        (0..=90)
            .map(|index| f64::from(index) * PI / 90.0)
            .map(|angle| [20.0 * -angle.cos(), 20.0 + 20.0 * angle.sin()]),
    );
    points.push([40.0, 20.0]);
    // Chords of two degrees bulge by 0.003 mm.
    let few = fit_chords(&polyline(&points), 0.01, true, ChordSide::Both).unwrap();
    assert_eq!(few.pieces().len(), 3, "{few:?}");
    let ChainPiece::Arc(arc) = few.pieces()[1] else { panic!("{few:?}") };
    assert!((arc.radius_mm - 20.0).abs() < 0.01 && (arc.sweep_rad + PI).abs() < 0.01);
    assert_within(&polyline(&points), &few, 0.01, ChordSide::Both);
    // Arcs that go on in one circle are one.
    let quarter = |start: f64| ChainPiece::arc(Point::new(0.0, 0.0), 10.0, start, -PI / 4.0);
    let parts: Vec<ChainPiece> = (0..4).map(|index| quarter(PI - PI / 4.0 * f64::from(index))).collect();
    assert_eq!(
        fit_chords(&Chain::new(parts).unwrap(), 0.01, true, ChordSide::Both).unwrap().pieces().len(),
        1
    );
}

#[test]
fn small_arcs_of_a_chorded_curve_are_swallowed() {
    let dome: Vec<[f64; 2]> = (0..=3000)
        .map(|index| PI - f64::from(index) * PI / 3000.0)
        .map(|angle| [40.0 * angle.cos(), 20.0 * angle.sin()])
        .collect();
    let path = compensate_profile(&polyline(&dome), 5.0).unwrap();
    // A chord and a small arc for every point.
    assert!(path.pieces().len() > 5900);
    let few = fit_chords(&path, 0.01, false, ChordSide::Both).unwrap();
    assert!(few.pieces().len() < 120, "{}", few.pieces().len());
    assert_within(&path, &few, 0.01, ChordSide::Both);
    let arcs = fit_chords(&path, 0.01, true, ChordSide::Both).unwrap();
    println!(
        "dome's path: {} pieces, {} chords, {} with arcs",
        path.pieces().len(),
        few.pieces().len(),
        arcs.pieces().len()
    );
    assert!(arcs.pieces().len() < few.pieces().len() / 2, "{}", arcs.pieces().len());
    assert_within(&path, &arcs, 0.01, ChordSide::Both);
}

#[test]
fn corners_and_lines_stay() {
    let corners = [
        [0.0, 0.0],
        [20.0, 0.0],
        [20.0, 10.0],
        [30.0, 15.0],
        [50.0, 15.0],
        [51.0, 3.0],
        [51.0, 3.02],
        [90.0, 3.02],
    ];
    let chain = polyline(&corners);
    let few = fit_chords(&chain, 0.001, false, ChordSide::Both).unwrap();
    assert_eq!(few, chain);
    // A corner that a chord could cut within the tolerance.
    let flat: Vec<[f64; 2]> = (0..=100)
        .map(|index| f64::from(index) * 0.02)
        .map(|u| [u, if u < 1.0 { 0.0 } else { (u - 1.0) * 0.5 }])
        .collect();
    let few = fit_chords(&polyline(&flat), 0.1, false, ChordSide::Both).unwrap();
    assert!(few.vertices().any(|point| point.distance(Point::new(1.0, 0.0)) < 1e-9), "{few:?}");
    // Straight pieces become one, a spike stays.
    let straight: Vec<[f64; 2]> = (0..500).map(|index| [f64::from(index), 0.5 * f64::from(index)]).collect();
    assert_eq!(fit_chords(&polyline(&straight), 1e-6, false, ChordSide::Both).unwrap().pieces().len(), 1);
    let spike = polyline(&[[0.0, 0.0], [9.0, 0.0], [9.0, 5.0], [9.0, 0.0], [20.0, 0.0]]);
    let few = fit_chords(&spike, 0.01, true, ChordSide::Both).unwrap();
    assert_eq!(few, spike);
}

#[test]
fn a_tolerance_must_be_one() {
    let line = polyline(&[[0.0, 0.0], [1.0, 0.0]]);
    for wrong in [0.0, -1.0, f64::NAN, 1e-9, f64::INFINITY] {
        assert!(matches!(fit_chords(&line, wrong, false, ChordSide::Both), Err(ChordError::Tolerance(_))));
    }
}

#[test]
fn many_pieces_take_linear_time() {
    let points: Vec<[f64; 2]> = (0..100_000)
        .map(|index| f64::from(index) * 1e-5)
        .map(|u| [100.0 * u, (7.0 * u).sin() + 1e-3 * ((u * 7919.0).sin() * 1e4).fract()])
        .collect();
    let chain = polyline(&points);
    for arcs in [false, true] {
        within_seconds(5.0, || fit_chords(&chain, 0.01, arcs, ChordSide::Both).unwrap());
    }
}
