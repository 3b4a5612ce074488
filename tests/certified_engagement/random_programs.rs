//! Random programs: no point of a brute-force cloud is above the upper bound, and every witness is material.

use super::cloud::*;
use super::oracle::Polygon;
use clsmith::certified_engagement::*;
use nalgebra::Vector3;

/// Axes: all upright, all tilted alike, several, or turning.
fn random_program(seed: u64) -> RandomProgram {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    for _ in 0..8 {
        random.next();
    }
    let polygons: Vec<Polygon> = (0..1 + random.below(2)).map(|_| random_cutter(&mut random)).collect();
    let kind = random.below(8);
    let tilt = |random: &mut Random, most: f64| {
        Vector3::new(random.within(-most, most), random.within(-most, most), 1.0).normalize()
    };
    let mut axis = if kind < 4 { Vector3::z() } else { tilt(&mut random, 0.6) };
    let place = |random: &mut Random| {
        Vector3::new(random.within(-9.0, 9.0), random.within(-9.0, 9.0), random.within(-4.0, 1.0))
    };
    let mut tip = Vector3::new(random.within(-20.0, 20.0), -20.0, 12.0);
    let mut blocks = Vec::new();
    let mut cutter = random.below(polygons.len());
    for _ in 0..3 + random.below(6) {
        if random.next() < 0.15 {
            cutter = random.below(polygons.len());
        }
        let from = CutterPose { tip, axis };
        let mut to = from;
        let mut arc = None;
        match random.below(8) {
            0 => to.tip.z = random.within(-4.0, 8.0),
            1 | 2 => {
                to.tip = place(&mut random);
                to.tip.z = tip.z;
            }
            3 => to.tip = place(&mut random),
            4 => to.tip = tip + Vector3::new(random.within(-0.6, 0.6), random.within(-0.6, 0.6), 0.0),
            5 => {
                // Back beside the block before, as the next pass of a raster.
                let aside = random.within(-2.0, 2.0);
                if let Some(last) = blocks.last() {
                    let last: &BlockMotion = last;
                    to.tip = last.from.tip + Vector3::new(aside * 0.1, aside, 0.0);
                }
            }
            6 if kind < 5 => {
                let center = tip + Vector3::new(random.within(-8.0, 8.0), random.within(-8.0, 8.0), 0.0);
                let angle = random.within(-3.0, 3.0);
                let made = TipArc { center, normal: Vector3::z(), angle };
                let rise = if random.next() < 0.3 { random.within(-2.0, 2.0) } else { 0.0 };
                let turned = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), angle) * (tip - center);
                to.tip = center + turned + Vector3::z() * rise;
                arc = Some(made);
            }
            _ => to.tip += axis * random.within(-3.0, 3.0),
        }
        match kind {
            5 if random.next() < 0.4 => {
                // A change of the fixed axis is a motion that turns; it happens above the stock.
                tip.z = 40.0;
                axis = tilt(&mut random, 0.6);
                continue;
            }
            6 | 7 => {
                to.axis = (axis + Vector3::new(random.within(-0.08, 0.08), random.within(-0.08, 0.08), 0.0))
                    .normalize();
                if random.next() < 0.5 {
                    to.tip = tip + (to.tip - tip) * 0.1;
                }
            }
            _ => {}
        }
        if (to.tip - from.tip).norm() > 1e-3 || kind > 5 {
            blocks.push(BlockMotion { from, to, arc, cutter });
            (tip, axis) = (to.tip, to.axis);
        }
    }
    let low = Vector3::new(-random.within(4.0, 12.0), -random.within(4.0, 12.0), -8.0);
    let high = Vector3::new(random.within(4.0, 12.0), random.within(4.0, 12.0), random.within(-1.0, 2.0));
    RandomProgram { low, high, bar: random.next() < 0.3, polygons, blocks }
}

#[test]
fn random_programs_have_no_point_above() {
    assert_none_above(1..=60, 2000, random_program);
}

#[test]
fn the_cloud_finds_bounds_that_are_too_low() {
    assert_low_bounds_are_found(1..=40, (3000, 17), random_program);
}

#[test]
fn small_budgets_give_wider_intervals_that_hold() {
    assert_small_budgets_hold(random_program);
}
