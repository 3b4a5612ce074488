//! Tilted and turning tools, against closed forms and against many places of the cutter.

use super::{at, block, cutter};
use clsmith::cutter::{CutterModel, Meridian};
use clsmith::engagement::{Engagement, PathPiece, Simulation};
use clsmith::program::geometry::Pose;
use clsmith::stock::Dexels;
use nalgebra::{Point3, Unit, UnitQuaternion, Vector3};
use std::f64::consts::PI;

pub type V = Vector3<f64>;

pub fn near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "found {found}, wanted {wanted} within {tolerance}");
}

/// An axis that leans from z by an angle in degrees, towards a direction in degrees from x.
pub fn leaning(tilt: f64, toward: f64) -> V {
    let (tilt, toward) = (tilt.to_radians(), toward.to_radians());
    V::new(tilt.sin() * toward.cos(), tilt.sin() * toward.sin(), tilt.cos())
}

pub fn place(point: [f64; 3], axis: V) -> Pose {
    Pose { point: Point3::from(point), axis }
}

pub fn run(stock: Dexels, cutter: &CutterModel, pieces: &[PathPiece]) -> (Dexels, Vec<Engagement>) {
    let mut simulation = Simulation::new(stock, true);
    let found = simulation.sweep_pieces(pieces, std::slice::from_ref(cutter));
    (simulation.into_stock(), found)
}

/// Every profile there is: diameter, corner radius, taper, tip's angle.
const SHAPES: [(f64, f64, f64, f64); 7] = [
    (10.0, 0.0, 0.0, 0.0),
    (10.0, 5.0, 0.0, 0.0),
    (10.0, 2.0, 0.0, 0.0),
    (6.0, 1.0, 10.0, 0.0),
    (8.0, 0.0, 0.0, 31.0),
    (8.0, 4.0, 5.0, 0.0),
    (9.0, 1.5, 4.0, 12.0),
];

/// Places of the cutter on a piece: tip and axis, the axis turned evenly.
fn places(piece: &PathPiece, count: usize) -> Vec<(V, V)> {
    let (from, to) = (piece.from, piece.to);
    let turn = from.axis.cross(&to.axis);
    let angle = turn.norm().atan2(from.axis.dot(&to.axis));
    (0..=count)
        .map(|step| {
            let t = step as f64 / count as f64;
            let tip = from.point.coords + (to.point - from.point) * t;
            let axis = match Unit::try_new(turn, 1e-12) {
                Some(around) => UnitQuaternion::from_axis_angle(&around, angle * t) * from.axis,
                None => from.axis,
            };
            (tip, axis)
        })
        .collect()
}

/// How far a point is inside (negative) or outside the cutter: a lower bound of the distance in either case is not needed, only
/// that the sign is right and that a margin in radius or height is one.
fn outside(profile: &Meridian, tip: &V, axis: &V, point: &V) -> f64 {
    let rest = point - tip;
    let z = rest.dot(axis);
    let rho = (rest.norm_squared() - z * z).max(0.0).sqrt();
    let radial = rho - profile.radius_at_height_mm(z.clamp(0.0, profile.height_mm()));
    radial.max(-z).max(z - profile.height_mm())
}

/// Compares a stock of -20..0 after a piece with the cutter in many places, at every `skip`th column and `levels` heights. Points
/// within `margin` of the border are left out.
fn compare(
    tool: &CutterModel,
    piece: &PathPiece,
    stock: &Dexels,
    count: usize,
    margin: f64,
    skip: usize,
    levels: usize,
) {
    let layout = *stock.grid();
    let places = places(piece, count);
    for row in (0..layout.rows).step_by(skip) {
        for column in (0..layout.columns).step_by(skip) {
            let [x, y] = layout.column_center(column, row);
            for level in 0..levels {
                let z = -20.0 * (level as f64 + 0.37) / levels as f64;
                let point = V::new(x, y, z);
                let least = places
                    .iter()
                    .map(|(tip, axis)| outside(&tool.profile, tip, axis, &point))
                    .fold(f64::INFINITY, f64::min);
                if least.abs() > margin {
                    let there = stock.contains([x, y, z]);
                    assert!(
                        there == (least > 0.0),
                        "{piece:?}: {point:?} is {least} outside, there: {there}"
                    );
                }
            }
        }
    }
}

pub fn cube(cell: f64) -> Dexels {
    block([-15.0, -15.0, -20.0], [15.0, 15.0, 0.0], cell)
}

/// Pieces of all kinds: fixed, leaning over, turning, steeply, from below, about the tip.
fn pieces() -> Vec<PathPiece> {
    let piece = |from: [f64; 3], a: V, to: [f64; 3], b: V| PathPiece {
        from: place(from, a),
        to: place(to, b),
        cutter: 0,
    };
    vec![
        piece([0.3, -0.2, -6.0], leaning(30.0, 20.0), [7.0, 3.0, -5.0], leaning(30.0, 20.0)),
        piece([-6.3, -4.2, -6.0], leaning(80.0, 100.0), [5.0, 6.0, -9.0], leaning(80.0, 100.0)),
        piece([-6.3, -4.2, -8.0], leaning(90.0, 40.0), [5.0, 6.0, -8.0], leaning(90.0, 40.0)),
        piece([0.0, 0.0, -8.0], leaning(25.0, 200.0), [0.0, 0.0, -3.0], leaning(25.0, 200.0)),
        piece([-4.0, 0.0, -6.0], leaning(3.0, 90.0), [4.0, 1.0, -8.0], leaning(12.0, 10.0)),
        piece([-4.0, 0.0, -6.0], leaning(60.0, 90.0), [1.0, 4.0, -6.5], leaning(40.0, 180.0)),
        piece([0.5, 0.2, -6.0], leaning(20.0, 0.0), [0.5, 0.2, -6.0], leaning(20.0, 180.0)),
        piece([0.5, 0.2, -9.0], leaning(100.0, 30.0), [3.5, 0.2, -7.0], leaning(150.0, 70.0)),
        piece([-2.0, 2.0, -12.0], leaning(170.0, 30.0), [3.5, 0.2, -11.0], leaning(170.0, 30.0)),
    ]
}

#[test]
fn sweeps_equal_many_places() {
    for (d, r, taper, tip) in SHAPES {
        let tool = cutter(d, r, taper, tip);
        for piece in pieces() {
            let (stock, found) = run(cube(0.6), &tool, &[piece]);
            compare(&tool, &piece, &stock, 500, 0.03, 3, 17);
            near(found[0].removed_mm3, cube(0.6).volume_mm3() - stock.volume_mm3(), 1e-2);
        }
    }
}

/// Few columns, very many places: the stated bound is 0.002 mm along the normal.
#[test]
fn the_error_is_below_its_bound() {
    for (d, r, taper, tip) in SHAPES {
        let tool = cutter(d, r, taper, tip);
        for piece in pieces() {
            let (stock, _) = run(cube(0.6), &tool, &[piece]);
            let layout = *stock.grid();
            let places = places(&piece, 1500);
            for row in (2..layout.rows).step_by(9) {
                for column in (1..layout.columns).step_by(7) {
                    let [x, y] = layout.column_center(column, row);
                    // Just inside and just outside of what is left; a wall is tested where it is, along z.
                    for [low, top] in stock.column_spans(column, row) {
                        for (height, inward) in [(f64::from(top), -1.0), (f64::from(low), 1.0)] {
                            let least = |z: f64| {
                                let point = V::new(x, y, z - 20.0);
                                let outside =
                                    |(tip, axis): &(V, V)| outside(&tool.profile, tip, axis, &point);
                                places.iter().map(outside).fold(f64::INFINITY, f64::min)
                            };
                            let left = least(height + inward * 0.003);
                            assert!(
                                left > -0.0022,
                                "{d} {r} {piece:?}: {x} {y} {height} is left {left} inside"
                            );
                            let taken = height - inward * 0.003;
                            if taken > 0.0 && taken < 20.0 {
                                let taken = least(taken);
                                assert!(
                                    taken < 0.003,
                                    "{d} {r} {piece:?}: {x} {y} {height} taken {taken} outside"
                                );
                            }
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn hardly_tilted_is_straight() {
    for (d, r, taper, tip) in SHAPES {
        let tool = cutter(d, r, taper, tip);
        for end in [[6.0, 3.0, -5.0], [6.0, 3.0, -7.0], [6.0, 3.0, -3.0], [0.0, 0.0, -9.0]] {
            let tilted = leaning(6e-6, 30.0);
            let start = [-3.0, -2.0, -5.0];
            let upright = [PathPiece {
                from: at(start[0], start[1], start[2]),
                to: at(end[0], end[1], end[2]),
                cutter: 0,
            }];
            let nearly = [PathPiece { from: place(start, tilted), to: place(end, tilted), cutter: 0 }];
            let (one, found) = run(cube(0.25), &tool, &upright);
            let (two, also) = run(cube(0.25), &tool, &nearly);
            near(also[0].removed_mm3, found[0].removed_mm3, 2e-3 * found[0].removed_mm3);
            near(also[0].max_advance_ratio(), found[0].max_advance_ratio(), 0.02);
            near(also[0].lateral_mm[0], found[0].lateral_mm[0], 0.13);
            near(also[0].lateral_mm[1], found[0].lateral_mm[1], 0.13);
            near(also[0].height_mm[1], found[0].height_mm[1], 0.05);
            // Straight also looks ahead of its end, so it knows of a sliver wherever the tilted sweep does.
            assert!(found[0].graze > 0.0 || also[0].graze == 0.0);
            near(one.volume_mm3(), two.volume_mm3(), 2e-3 * found[0].removed_mm3);
        }
    }
}

/// A cylinder through the middle of a block leaves what is above and below it.
#[test]
fn from_the_side_and_from_below_overhangs_stay() {
    let flat = cutter(6.0, 0.0, 0.0, 0.0);
    let level = leaning(90.0, 0.0);
    let piece =
        PathPiece { from: place([0.0, -5.0, -10.0], level), to: place([0.0, 5.0, -10.0], level), cutter: 0 };
    let (stock, _) = run(cube(0.6), &flat, &[piece]);
    let column = stock.column_spans(40, 25);
    assert_eq!(column.len(), 2, "{column:?}");
    near(f64::from(column[0][0]), 13.0, 1e-3);
    near(f64::from(column[1][1]), 7.0, 1e-3);
    assert_eq!(stock.column_spans(10, 25), vec![[0.0, 20.0]], "in front of the tip nothing is cut");

    let down = leaning(180.0, 0.0);
    let piece =
        PathPiece { from: place([-20.0, 0.0, -10.0], down), to: place([20.0, 0.0, -10.0], down), cutter: 0 };
    let (stock, found) = run(cube(0.6), &flat, &[piece]);
    assert_eq!(stock.column_spans(25, 25), vec![[10.0, 20.0]]);
    near(found[0].max_advance_ratio(), 1.0, 1e-6);
    near(found[0].removed_mm3, 30.0 * 6.0 * 10.0, 30.0 * 10.0 * 0.6);
}

/// In planes along the turn, a long flat cutter that turns about its tip sweeps a sector between its outermost flanks.
#[test]
fn a_turn_about_the_tip_sweeps_a_sector() {
    let flat = cutter(4.0, 0.0, 0.0, 0.0);
    let stock = block([-12.0, -4.0, -20.0], [12.0, 4.0, 0.0], 0.1);
    let tip = [0.0, 0.0, -10.0];
    let (a, b) = (leaning(30.0, 180.0), leaning(30.0, 0.0));
    let piece = PathPiece { from: place(tip, a), to: place(tip, b), cutter: 0 };
    let (stock, found) = run(stock, &flat, &[piece]);
    // Above the tip by z the sector's half width is z tan 30 + 2 / cos 30.
    for (column, row) in [(120, 40), (140, 45), (175, 40), (60, 35)] {
        let [x, y] = stock.grid().column_center(column, row);
        let half = (4.0 - y * y).sqrt();
        let slope = 30f64.to_radians().tan();
        let wall = |z: f64| z * slope + half / 30f64.to_radians().cos();
        let left = stock.column_spans(column, row).first().map_or(0.0, |[_, top]| f64::from(*top)) - 10.0;
        // Within the bottom disc at its steepest, that; further out the flank.
        if x.abs() > half * 30f64.to_radians().cos() {
            near(wall(left), x.abs(), 2e-3);
        } else {
            near(left, -x.abs() * slope, 4e-3);
        }
    }
    near(found[0].length_mm, PI / 3.0 * 50f64.hypot(2.0), 1e-6);
    assert!(
        found[0].max_advance_ratio() <= 1.0 && found[0].max_advance_ratio() > 0.1,
        "{}",
        found[0].max_advance_ratio()
    );
}

#[test]
fn many_parts_are_the_whole() {
    for (d, r, taper, tip) in SHAPES {
        let tool = cutter(d, r, taper, tip);
        for piece in pieces() {
            let parts: Vec<PathPiece> = places(&piece, 24)
                .windows(2)
                .map(|pair| {
                    let at = |(tip, axis): (V, V)| Pose { point: Point3::from(tip), axis };
                    PathPiece { from: at(pair[0]), to: at(pair[1]), cutter: 0 }
                })
                .collect();
            let (a, one) = run(cube(0.5), &tool, &[piece]);
            let (b, many) = run(cube(0.5), &tool, &parts);
            let sum: f64 = many.iter().map(|part| part.removed_mm3).sum();
            near(sum, one[0].removed_mm3, 1e-3 * one[0].removed_mm3);
            near(a.volume_mm3(), b.volume_mm3(), 1e-3 * one[0].removed_mm3);
        }
    }
}

#[test]
fn many_threads_find_the_same() {
    let bull = cutter(10.0, 2.0, 0.0, 0.0);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(cube(0.25), &bull, &pieces()))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(5));
}
