//! Random programs of arcs: no point of a brute-force cloud is above the upper bound, and every witness is material.

use super::cloud::*;
use super::oracle::Polygon;
use clsmith::certified_engagement::*;
use nalgebra::Vector3;

/// Programs of flat arcs and lines about one axis, with some helices, slopes and circles over little more than
/// the cutter's radius or much less.
fn arc_program(seed: u64) -> RandomProgram {
    let mut random = Random(seed.wrapping_mul(0xD134_2543_DE82_EF95) | 1);
    for _ in 0..8 {
        random.next();
    }
    let polygons: Vec<Polygon> = (0..1 + random.below(2)).map(|_| random_cutter(&mut random)).collect();
    let kind = random.below(4);
    let axis = if kind < 3 {
        Vector3::z()
    } else {
        Vector3::new(random.within(-0.5, 0.5), random.within(-0.5, 0.5), 1.0).normalize()
    };
    let across = axis.cross(&Vector3::new(0.2, 0.9, 0.1)).normalize();
    let other = axis.cross(&across);
    let mut tip = across * random.within(-9.0, 9.0) + other * random.within(-9.0, 9.0) + axis * 2.0;
    let mut blocks: Vec<BlockMotion> = Vec::new();
    let mut cutter = random.below(polygons.len());
    for number in 0..4 + random.below(6) {
        if random.next() < 0.15 {
            cutter = random.below(polygons.len());
        }
        let from = CutterPose { tip, axis };
        let mut to = from;
        let mut arc = None;
        let flat = |random: &mut Random| across * random.within(-8.0, 8.0) + other * random.within(-8.0, 8.0);
        match if number == 0 { 7 } else { random.below(8) } {
            0..=3 => {
                let mut center = tip + flat(&mut random) * random.next();
                if let (Some(BlockMotion { arc: Some(last), .. }), true) =
                    (blocks.last(), random.next() < 0.4)
                {
                    // On the same circle, or on one beside it.
                    center = last.center;
                }
                let normal = if random.next() < 0.5 { axis } else { -axis };
                let angle = random.within(-4.0, 6.2);
                let turn =
                    nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_normalize(normal), angle);
                to.tip = center + turn * (tip - center);
                if random.next() < 0.12 {
                    to.tip += axis * random.within(-1.5, 1.0);
                }
                arc = Some(TipArc { center, normal, angle });
            }
            4 => to.tip = tip + flat(&mut random) * 0.15,
            5 => to.tip = tip + flat(&mut random),
            6 => to.tip = tip + flat(&mut random) * 0.4 + axis * random.within(-1.0, 1.0),
            _ => to.tip += axis * (random.within(-3.0, -0.5) - tip.dot(&axis)),
        }
        if (to.tip - from.tip).norm() > 1e-3 || arc.is_some() {
            blocks.push(BlockMotion { from, to, arc, cutter });
            tip = to.tip;
        }
    }
    let low = Vector3::new(-random.within(4.0, 12.0), -random.within(4.0, 12.0), -8.0);
    let high = Vector3::new(random.within(4.0, 12.0), random.within(4.0, 12.0), random.within(-1.0, 0.5));
    RandomProgram { low, high, bar: random.next() < 0.3, polygons, blocks }
}

#[test]
fn random_arcs_have_no_point_above() {
    assert_none_above(1..=60, 3000, arc_program);
}

#[test]
fn the_cloud_finds_bounds_of_arcs_that_are_too_low() {
    assert_low_bounds_are_found(1..=40, (3000, 17), arc_program);
}

#[test]
fn small_budgets_give_wider_intervals_of_arcs_that_hold() {
    assert_small_budgets_hold(arc_program);
}
