//! Where a tip path starts and ends: free ends, walls, overhangs.

use super::brute::{assert_runs, assert_touches, polyline};
use clsmith::internals::surface::profile::{Chain, ChainPiece, Point, compensate_profile};
use std::f64::consts::PI;

const R: f64 = 5.0;

fn tip(chain: &Chain) -> Chain {
    let tip = compensate_profile(chain, R).unwrap();
    assert_runs(&tip, chain.end().u >= chain.start().u);
    assert_touches(chain, &tip, R, 1e-9);
    let back = compensate_profile(&chain.reversed(), R).unwrap();
    if chain.end().u > chain.start().u {
        assert!(back.start().distance(tip.end()) < 1e-9 && back.end().distance(tip.start()) < 1e-9);
    }
    tip
}

fn near(point: Point, u: f64, z: f64) {
    assert!(point.distance(Point::new(u, z)) < 1e-6, "{point:?} is not ({u}, {z})");
}

#[test]
fn a_wall_up_and_a_wall_down() {
    let path =
        tip(&polyline(&[[0.0, 0.0], [20.0, 0.0], [20.0, 30.0], [50.0, 30.0], [50.0, -4.0], [80.0, -4.0]]));
    near(path.start(), 0.0, 0.0);
    near(path.end(), 80.0, -4.0);
    // Floor, up beside the wall, about the edge, top, about the edge, down, floor.
    assert_eq!(path.pieces().len(), 7);
    let corners = [[15.0, 0.0], [15.0, 25.0], [20.0, 30.0], [50.0, 30.0], [55.0, 25.0], [55.0, -4.0]];
    for (vertex, [u, z]) in path.vertices().skip(1).zip(corners) {
        near(vertex, u, z);
    }
}

#[test]
fn walls_at_the_ends_are_followed() {
    // Up to the end.
    let path = tip(&polyline(&[[0.0, 0.0], [20.0, 0.0], [20.0, 30.0]]));
    near(path.end(), 15.0, 25.0);
    // Lower than the ball: it touches the floor and the edge.
    let path = tip(&polyline(&[[0.0, 0.0], [20.0, 0.0], [20.0, 2.0]]));
    near(path.end(), 20.0 - (R * R - 9.0_f64).sqrt(), 0.0);
    // A box: from foot to foot.
    let path = tip(&polyline(&[[0.0, 0.0], [0.0, 20.0], [50.0, 20.0], [50.0, -1.0]]));
    near(path.start(), -5.0, -5.0);
    near(path.end(), 55.0, -6.0);
    assert_eq!(path.pieces().len(), 5);
    // Walls of a file are upright to its last decimal.
    for slant in [-1e-4, 1e-4] {
        let path = tip(&polyline(&[[0.0, 0.0], [slant, 20.0], [50.0, 20.0], [50.0 + slant, -1.0]]));
        assert!(path.start().distance(Point::new(-5.0, -5.0)) < 2e-3, "{path:?}");
        assert!(path.end().distance(Point::new(55.0, -6.0)) < 2e-3, "{path:?}");
    }
    // A step back by the last decimal makes no other end.
    let path = tip(&polyline(&[[0.0, 0.0], [20.0, 0.0], [19.9999, 0.0]]));
    assert!(path.end().distance(Point::new(20.0, 0.0)) < 1e-9, "{path:?}");
    // Nothing but a wall.
    let path = tip(&polyline(&[[3.0, 0.0], [3.0, 20.0]]));
    assert!(path.pieces().iter().all(|piece| (piece.start().u + 2.0).abs() < 1e-6), "{path:?}");
}

#[test]
fn a_free_end_is_not_rolled_about() {
    let path = tip(&polyline(&[[0.0, 0.0], [0.5, 0.0]]));
    near(path.start(), 0.0, 0.0);
    near(path.end(), 0.5, 0.0);
    // Both ends touched at once: the ball stands still.
    let path = tip(&polyline(&[[0.0, 1.0], [0.5, 0.0], [1.0, 1.0]]));
    assert_eq!(path.pieces().len(), 1);
    near(path.start(), 0.5, 1.0 - R + (R * R - 0.25_f64).sqrt());
    assert!(path.length_mm() < 1e-9);
    // No extent at all.
    let path = tip(&polyline(&[[4.0, 1.0], [4.0, 1.0]]));
    near(path.start(), 4.0, 1.0);
    near(path.end(), 4.0, 1.0);
}

#[test]
fn an_end_behind_a_slope_is_touched_together_with_it() {
    let slope = 60.0_f64.to_radians();
    let profile = polyline(&[[0.0, 0.0], [1.0, 0.0], [1.0 + 20.0 * slope.cos(), 20.0 * slope.sin()]]);
    let path = tip(&profile);
    let start = path.start();
    // On the circle about the end and on the slope's offset.
    assert!((start.distance(Point::new(0.0, -R)) - R).abs() < 1e-9, "{start:?}");
    assert!(start.u < 0.0);
}

#[test]
fn an_overhang_is_bridged_and_its_outermost_place_kept() {
    // A mushroom: the cap overhangs the stem by 10 on both sides.
    let profile = polyline(&[
        [-40.0, 0.0],
        [-5.0, 0.0],
        [-5.0, 20.0],
        [-15.0, 20.0],
        [-15.0, 25.0],
        [15.0, 25.0],
        [15.0, 20.0],
        [5.0, 20.0],
        [5.0, 0.0],
        [40.0, 0.0],
    ]);
    let path = tip(&profile);
    let corners = [[-20.0, 0.0], [-20.0, 20.0], [-15.0, 25.0], [15.0, 25.0], [20.0, 20.0], [20.0, 0.0]];
    for (vertex, [u, z]) in path.vertices().skip(1).zip(corners) {
        near(vertex, u, z);
    }
    // The chain ends under its own cap.
    let hook = Chain::new(vec![
        ChainPiece::line(Point::new(-30.0, 10.0), Point::new(0.0, 10.0)),
        ChainPiece::arc(Point::new(0.0, 0.0), 10.0, PI / 2.0, -PI),
        ChainPiece::line(Point::new(0.0, -10.0), Point::new(-20.0, -10.0)),
    ])
    .unwrap();
    let path = tip(&hook);
    let far = path.vertices().map(|point| point.u).fold(f64::NEG_INFINITY, f64::max);
    assert!((far - 15.0).abs() < 1e-9);
}

#[test]
fn the_highest_of_crossing_lines_counts() {
    // A loop that crosses itself twice, and a spike in the middle of a line.
    let profile = polyline(&[[0.0, 0.0], [30.0, 20.0], [30.0, 0.0], [0.0, 18.0], [0.0, 25.0], [50.0, 5.0]]);
    tip(&profile);
    let spike = polyline(&[[0.0, 0.0], [20.0, 0.0], [20.0, 9.0], [20.0, 0.0], [40.0, 0.0]]);
    let path = tip(&spike);
    assert!(path.vertices().all(|point| point.z < 9.0 + 1e-9));
    assert!(path.pieces().iter().any(|piece| piece.length_mm() > 9.0 && matches!(piece, ChainPiece::Arc(_))));
}
