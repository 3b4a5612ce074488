//! A reground ball: tip path, contact profile, and the other ball's tip path.

use super::brute::{assert_runs, polyline};
use clsmith::internals::surface::profile::{
    Chain, ChainPiece, Point, check_tip_path, compensate_profile, recover_profile,
};
use std::f64::consts::PI;

/// The largest distance of either chain's samples from the other, on samples.
fn apart(a: &Chain, b: &Chain) -> f64 {
    let samples = |chain: &Chain| -> Vec<Point> {
        chain
            .pieces()
            .iter()
            .flat_map(|piece| {
                let count = (piece.length_mm() / 0.1).ceil().max(1.0) as usize;
                let piece = *piece;
                (0..=count).map(move |index| piece.point_at(index as f64 / count as f64))
            })
            .collect()
    };
    let distance = |point: Point, chain: &Chain| {
        let of = |piece: &ChainPiece| match piece {
            ChainPiece::Line(line) => {
                let (du, dz) = (line.to.u - line.from.u, line.to.z - line.from.z);
                let along = (point.u - line.from.u) * du + (point.z - line.from.z) * dz;
                let share = (along / (du * du + dz * dz)).clamp(0.0, 1.0);
                piece.point_at(if share.is_nan() { 0.0 } else { share }).distance(point)
            }
            ChainPiece::Arc(arc) => {
                let angle = (point.z - arc.centre.z).atan2(point.u - arc.centre.u);
                let along = ((angle - arc.start_rad) * arc.sweep_rad.signum()).rem_euclid(2.0 * PI);
                if along <= arc.sweep_rad.abs() {
                    (arc.centre.distance(point) - arc.radius_mm).abs()
                } else {
                    piece.start().distance(point).min(piece.end().distance(point))
                }
            }
        };
        let mut best = f64::INFINITY;
        for piece in chain.pieces() {
            // Pieces that are too far away anyway.
            let start = match piece {
                ChainPiece::Line(line) => line.from,
                ChainPiece::Arc(arc) => arc.centre,
            };
            let reach = match piece {
                ChainPiece::Line(_) => piece.length_mm(),
                ChainPiece::Arc(arc) => arc.radius_mm,
            };
            if start.distance(point) - reach < best {
                best = best.min(of(piece));
            }
        }
        best
    };
    let one = samples(a).into_iter().map(|point| distance(point, b)).fold(0.0, f64::max);
    samples(b).into_iter().map(|point| distance(point, a)).fold(one, f64::max)
}

fn parts() -> Vec<Chain> {
    let smooth = Chain::new(vec![
        ChainPiece::line(Point::new(-30.0, 0.0), Point::new(0.0, 0.0)),
        ChainPiece::arc(Point::new(0.0, 12.0), 12.0, -PI / 2.0, PI / 3.0),
        ChainPiece::line(
            Point::new(12.0 * 0.75_f64.sqrt(), 6.0),
            Point::new(12.0 * 0.75_f64.sqrt() + 5.0, 6.0 + 5.0 * 3.0_f64.sqrt()),
        ),
        ChainPiece::line(
            Point::new(12.0 * 0.75_f64.sqrt() + 5.0, 6.0 + 5.0 * 3.0_f64.sqrt()),
            Point::new(50.0, 10.0),
        ),
    ])
    .unwrap();
    let wavy: Vec<[f64; 2]> =
        (0..800).map(|index| f64::from(index) * 0.1).map(|u| [u, 6.0 * (u * 0.2).sin()]).collect();
    let pocket = polyline(&[[0.0, 30.0], [20.0, 30.0], [20.0, 0.0], [60.0, 0.0], [60.0, 30.0], [90.0, 30.0]]);
    vec![smooth.clone(), smooth.reversed(), polyline(&wavy), pocket]
}

#[test]
fn to_a_smaller_ball_and_back() {
    for profile in parts() {
        let first = compensate_profile(&profile, 5.0).unwrap();
        let contact = recover_profile(&first, 5.0).unwrap();
        assert_runs(&contact, profile.end().u >= profile.start().u);
        // The ball of the recovered profile goes where it went.
        let again = compensate_profile(&contact, 5.0).unwrap();
        assert!(apart(&first, &again) < 1e-6, "{}", apart(&first, &again));
        let smaller = compensate_profile(&contact, 4.8).unwrap();
        let verdict = check_tip_path(&contact, &smaller, 4.8, 0.01);
        assert!(verdict.gouge_mm <= verdict.bound_mm.max(1e-7), "{verdict:?}");
        let back = compensate_profile(&recover_profile(&smaller, 4.8).unwrap(), 5.0).unwrap();
        assert!(apart(&first, &back) < 1e-6, "{}", apart(&first, &back));
    }
}

#[test]
fn a_profile_that_the_ball_fits_comes_back() {
    for profile in parts().into_iter().take(3) {
        let contact = recover_profile(&compensate_profile(&profile, 1.0).unwrap(), 1.0).unwrap();
        // In the hollows of the wavy polyline each corner is rounded by the ball: 0.1 mm chords, far below a micrometre.
        assert!(apart(&profile, &contact) < 1e-4, "{}", apart(&profile, &contact));
    }
}
