//! Cuts with known answers. Tolerances come from the cell: a border of the ground is known to half a cell.

use super::{at, block, cutter, path, run};
use clsmith::engagement::{Engagement, PathPiece, Simulation};
use std::f64::consts::PI;

const CELL: f64 = 0.1;
const R: f64 = 5.0;

fn near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "found {found}, wanted {wanted} within {tolerance}");
}

/// A level pass at y through a 40 x 30 x 10 block with its top at 0, steady part.
fn pass(profile: (f64, f64, f64, f64), y: f64, z: f64) -> Engagement {
    let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
    let cutter = cutter(profile.0, profile.1, profile.2, profile.3);
    let (_, found) = run(stock, &cutter, &[[-20.0, y, z], [10.0, y, z], [20.0, y, z]]);
    found[1].clone()
}

#[test]
fn a_full_slot_has_share_one_over_the_whole_front() {
    let found = pass((2.0 * R, 0.0, 0.0, 0.0), 0.0, -3.0);
    near(found.max_advance_ratio(), 1.0, 1e-6);
    near(found.removed_mm3, 10.0 * 2.0 * R * 3.0, 10.0 * 3.0 * CELL);
    near(found.lateral_mm[0], -R, CELL);
    near(found.lateral_mm[1], R, CELL);
    near(found.height_mm[1], 3.0, 1e-4);
    let engaged: Vec<usize> = (0..found.bins.len()).filter(|bin| found.bins[*bin].is_engaged()).collect();
    assert!(engaged.iter().all(|bin| (29..=90).contains(bin)), "the front half: {engaged:?}");
    assert!(engaged.len() >= 58, "{engaged:?}");
}

#[test]
fn radial_depths_from_a_twentieth_to_the_whole_diameter() {
    for share in [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9, 1.0] {
        let depth = share * 2.0 * R;
        for side in [-1.0, 1.0] {
            // The block's side is at y = 15 side; the tool comes from outside.
            let found = pass((2.0 * R, 0.0, 0.0, 0.0), side * (15.0 - depth + R), -3.0);
            let classic = |depth: f64| {
                if depth >= R { 1.0 } else { 2.0 * (depth / (2.0 * R) * (1.0 - depth / (2.0 * R))).sqrt() }
            };
            let (low, high) = (classic(depth - CELL), classic(depth + CELL));
            assert!(
                (low..=high).contains(&found.max_advance_ratio()),
                "{share}: {} not in {low}..{high}",
                found.max_advance_ratio()
            );
            let bound = found.bins.iter().map(|bin| bin.advance_ratio_bound).fold(0.0, f32::max);
            assert!(f64::from(bound) >= classic(depth) - 1e-6, "the bound holds");
            near(found.removed_mm3, 10.0 * depth * 3.0, 10.0 * 3.0 * CELL);
            let [right, left] = found.lateral_mm;
            let wanted = if side > 0.0 { [-R, -R + depth] } else { [R - depth, R] };
            near(right, wanted[0], CELL);
            near(left, wanted[1], CELL);
        }
    }
}

#[test]
fn shallow_bull_and_ball_cut_by_the_axial_immersion() {
    for (corner, depth) in [(3.0, 0.5), (1.0, 0.2), (5.0, 0.3), (5.0, 2.0)] {
        let found = pass((2.0 * R, corner, 0.0, 0.0), 0.0, -depth);
        let kappa = (1.0 - depth / corner).acos();
        near(found.max_advance_ratio(), kappa.sin(), 2e-3);
        near(found.height_mm[1], depth, 1e-3);
    }
}

#[test]
fn a_ramp_cuts_with_flank_and_bottom() {
    let slope = 5f64.to_radians();
    let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
    let flat = cutter(2.0 * R, 0.0, 0.0, 0.0);
    let down = 10.0 * slope.tan();
    let (_, found) = run(stock, &flat, &[[15.0, 0.0, 0.0], [25.0, 0.0, -down]]);
    near(found[0].max_advance_ratio(), slope.cos(), 1e-3);
    let bottom = found[0].bins.iter().filter(|bin| bin.is_engaged() && bin.radial < 0.5);
    for bin in bottom {
        near(f64::from(bin.advance_ratio), slope.sin(), 1e-6);
    }
    // Behind the axis only the bottom cuts.
    assert!(found[0].bins[..28].iter().any(|bin| bin.is_engaged() && bin.radial == 0.0));
}

#[test]
fn plunges() {
    for (corner, tip, wanted) in [(0.0, 0.0, 1.0), (5.0, 0.0, 1.0), (0.0, 31.0, 31f64.to_radians().cos())] {
        let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
        let tool = cutter(2.0 * R, corner, 0.0, tip);
        let (_, found) = run(stock, &tool, &[[20.0, 0.0, 1.0], [20.0, 0.0, -4.0]]);
        near(found[0].max_advance_ratio(), wanted, 2e-3);
        let volume = match (corner > 0.0, tip > 0.0) {
            (true, _) => PI * 4.0 * 4.0 * (R - 4.0 / 3.0),
            (_, true) => {
                let height = R * tip.to_radians().tan();
                PI * R * R * (height / 3.0 + 4.0 - height)
            }
            _ => PI * R * R * 4.0,
        };
        near(found[0].removed_mm3, volume, 0.01 * volume);
    }
}

#[test]
fn air_and_cut_ground_engage_nothing() {
    let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
    let flat = cutter(2.0 * R, 0.0, 0.0, 0.0);
    let points =
        [[-20.0, 0.0, 2.0], [50.0, 0.0, 2.0], [50.0, 0.0, -3.0], [-20.0, 0.0, -3.0], [50.0, 0.0, -3.0]];
    let (_, found) = run(stock, &flat, &points);
    assert!(!found[0].has_removed_material() && found[0].graze == 0.0);
    assert!(found[2].has_removed_material());
    assert!(
        !found[3].has_removed_material(),
        "nothing is left for the second pass: {}",
        found[3].removed_mm3
    );
    assert!(found[3].graze > 0.0, "but walls closer than a cell are known");
}

#[test]
fn what_is_removed_is_what_is_missing_and_nothing_grows() {
    let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
    let before = stock.volume_mm3();
    let ball = cutter(2.0 * R, R, 0.0, 0.0);
    let mut points = vec![[-6.0, -10.0, -1.0]];
    for index in 0..60 {
        let t = f64::from(index);
        points.push([20.0 + 15.0 * (t * 0.9).sin(), 12.0 * (t * 1.7).cos(), -3.0 + 2.5 * (t * 2.3).sin()]);
    }
    let mut simulation = Simulation::new(stock, true);
    let mut left = before;
    for piece in path(&points) {
        let found = simulation.sweep_pieces(&[piece], std::slice::from_ref(&ball));
        let now = simulation.stock().volume_mm3();
        assert!(now <= left);
        near(found[0].removed_mm3, left - now, 1e-2);
        left = now;
    }
    assert!(left < before - 1000.0);
}

/// The sweep of a straight piece is the union of the cutter's places on it.
#[test]
fn sweeps_equal_many_places() {
    let shapes = [
        (10.0, 0.0, 0.0, 0.0),
        (10.0, 5.0, 0.0, 0.0),
        (10.0, 2.0, 0.0, 0.0),
        (6.0, 1.0, 10.0, 0.0),
        (8.0, 0.0, 0.0, 31.0),
        (8.0, 4.0, 5.0, 0.0),
    ];
    let ends = [
        [8.0, 3.0, 0.0],
        [6.0, -4.0, 2.5],
        [5.0, 5.0, -2.5],
        [0.5, 0.2, -3.0],
        [-3.0, 7.0, 6.0],
        [0.0, 0.0, -3.0],
    ];
    for (d, r, taper, tip) in shapes {
        let tool = cutter(d, r, taper, tip);
        for end in ends {
            let stock = || block([-15.0, -15.0, -20.0], [15.0, 15.0, 0.0], 0.6);
            let start = [0.3, -0.2, -6.0];
            let to = [start[0] + end[0], start[1] + end[1], start[2] + end[2]];
            let (swept, _) = run(stock(), &tool, &[start, to]);
            let layout = *swept.grid();
            for row in 0..layout.rows {
                for column in 0..layout.columns {
                    let [x, y] = layout.column_center(column, row);
                    let lowest = (0..=1000)
                        .filter_map(|step| {
                            let t = f64::from(step) / 1000.0;
                            let place = [0, 1, 2].map(|axis| start[axis] + end[axis] * t);
                            let rho = (x - place[0]).hypot(y - place[1]);
                            (rho <= tool.radius_mm())
                                .then(|| place[2] + tool.profile.height_at_radius_mm(rho))
                        })
                        .fold(0.0, f64::min)
                        .min(0.0);
                    let found = swept
                        .column_spans(column, row)
                        .first()
                        .map_or(-20.0, |[_, top]| f64::from(*top) - 20.0);
                    // At the rim the places' discs end between two steps.
                    let rim = (0..=200).any(|step| {
                        let t = f64::from(step) / 200.0;
                        let rho = (x - start[0] - end[0] * t).hypot(y - start[1] - end[1] * t);
                        (rho - tool.radius_mm()).abs() < 0.03
                    });
                    let steep = if rim { 3.0 } else { 5e-3 };
                    assert!(
                        (found - lowest).abs() < steep,
                        "{d} {r} {taper} {tip} to {end:?}: column {x} {y}: {found} is not {lowest}"
                    );
                }
            }
        }
    }
}

#[test]
fn many_threads_find_the_same() {
    let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
    let bull = cutter(2.0 * R, 1.0, 0.0, 0.0);
    let points: Vec<[f64; 3]> = (0..200)
        .map(|index| {
            let t = f64::from(index) * 0.1;
            [20.0 + 15.0 * t.cos(), 12.0 * (1.3 * t).sin(), -1.0 - 0.02 * f64::from(index)]
        })
        .collect();
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| run(stock.clone(), &bull, &points))
    };
    let one = with(1);
    assert!(one == with(2) && one == with(5));
}

#[test]
fn a_piece_in_many_parts_removes_what_the_whole_does() {
    let stock = || block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
    for tool in [cutter(2.0 * R, 0.0, 0.0, 0.0), cutter(2.0 * R, 2.0, 0.0, 0.0), cutter(2.0 * R, R, 0.0, 0.0)]
    {
        for drop in [0.0, 2.0, -2.0] {
            let whole = [[-7.0, -3.0, -3.0], [33.0, 4.0, -3.0 - drop]];
            let parts: Vec<[f64; 3]> = (0..=80)
                .map(|step| {
                    let t = f64::from(step) / 80.0;
                    [0, 1, 2].map(|axis| whole[0][axis] + (whole[1][axis] - whole[0][axis]) * t)
                })
                .collect();
            let (a, one) = run(stock(), &tool, &whole);
            let (b, many) = run(stock(), &tool, &parts);
            let sum: f64 = many.iter().map(|part| part.removed_mm3).sum();
            near(sum, one[0].removed_mm3, 1e-4 * one[0].removed_mm3);
            near(a.volume_mm3(), b.volume_mm3(), 1e-4 * one[0].removed_mm3);
            let largest = many.iter().map(Engagement::max_advance_ratio).fold(0.0, f64::max);
            near(largest, one[0].max_advance_ratio(), 5e-3);
        }
    }
}

#[test]
fn overhangs_keep_what_is_above_the_flutes() {
    let mut stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], CELL);
    for row in 0..stock.grid().rows {
        for column in 0..stock.grid().columns {
            stock.set_column(column, row, &[[8.0, 10.0], [0.0, 4.0]]);
        }
    }
    let mut short = cutter(2.0 * R, 0.0, 0.0, 0.0);
    short.profile = clsmith::cutter::Meridian::new(2.0 * R, 0.0, 0.0, 0.0, 4.0).unwrap();
    let mut simulation = Simulation::new(stock, true);
    let pieces = [PathPiece { from: at(-10.0, 0.0, -8.0), to: at(50.0, 0.0, -8.0), cutter: 0 }];
    let found = simulation.sweep_pieces(&pieces, &[short]);
    near(found[0].removed_mm3, 40.0 * 2.0 * R * 2.0, 40.0 * 2.0 * CELL);
    assert_eq!(simulation.stock().column_spans(200, 150), vec![[8.0, 10.0], [0.0, 2.0]]);
}

/// Without detail most columns are passed over; the largest share must not be.
#[test]
fn the_largest_share_is_found_without_detail() {
    let cutters = [(10.0, 0.0, 0.0), (10.0, 5.0, 0.0), (10.0, 1.0, 0.0), (10.0, 3.0, 0.0), (8.0, 1.0, 8.0)];
    for (d, r, taper) in cutters {
        let tool = cutter(d, r, taper, 0.0);
        let mut points = vec![[-7.0, -10.0, -1.0]];
        for index in 0..80 {
            let t = f64::from(index);
            points.push([
                20.0 + 18.0 * (t * 0.9).sin(),
                12.0 * (t * 1.7).cos(),
                -3.0 + 2.5 * (t * 2.3).sin(),
            ]);
        }
        let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], 0.2);
        let with = |detail: bool| {
            Simulation::new(stock.clone(), detail).sweep_pieces(&path(&points), std::slice::from_ref(&tool))
        };
        for (close, lean) in with(true).iter().zip(with(false)) {
            near(lean.removed_mm3, close.removed_mm3, 1e-6 * close.removed_mm3);
            near(lean.max_advance_ratio(), close.max_advance_ratio(), 0.01);
            assert_eq!(lean.lateral_mm, close.lateral_mm);
        }
    }
}
