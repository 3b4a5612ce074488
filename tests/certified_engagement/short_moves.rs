//! Programs of short moves on nearly one line, which are joined to runs: no point of a cloud is above.

use super::cloud::*;
use clsmith::certified_engagement::*;
use nalgebra::Vector3;

/// Passes over a block and back beside, divided in short moves with some noise; some curved.
fn short_moves(seed: u64) -> RandomProgram {
    let mut random = Random(seed.wrapping_mul(0xBF58_476D_1CE4_E5B9) | 1);
    for _ in 0..8 {
        random.next();
    }
    let polygons = vec![random_cutter(&mut random), random_cutter(&mut random)];
    let axis = if random.next() < 0.7 {
        Vector3::z()
    } else {
        Vector3::new(random.within(-0.4, 0.4), random.within(-0.4, 0.4), 1.0).normalize()
    };
    let noise = [0.0, 1e-4, 0.008, 0.03][random.below(4)];
    let bend = if random.next() < 0.5 { 0.0 } else { random.within(-0.3, 0.3) };
    let mut tip = Vector3::new(-7.0, random.within(-6.0, 0.0), random.within(-3.0, -0.3));
    let mut blocks = Vec::new();
    let mut cutter = 0;
    for pass in 0..4 {
        let along = if pass % 2 == 0 { 14.0 } else { -14.0 };
        let count = 6 + random.below(18);
        let (from, slope) = (tip, random.within(-0.3, 0.3) * f64::from(random.below(2) as u32));
        for part in 1..=count {
            let share = part as f64 / count as f64;
            let mut off = || noise * random.within(-1.0, 1.0);
            let bulge = bend * (share * std::f64::consts::PI).sin();
            let to = from + Vector3::new(along * share + off(), bulge + off(), slope * share + off());
            let [from, to] = [tip, to].map(|tip| CutterPose { tip, axis });
            blocks.push(BlockMotion { from, to, arc: None, cutter });
            tip = to.tip;
        }
        if random.next() < 0.3 {
            cutter = 1 - cutter;
        }
        tip += Vector3::new(0.0, random.within(0.0, 2.5), random.within(-0.4, 0.1));
    }
    let (low, high) = (Vector3::new(-6.0, -8.0, -8.0), Vector3::new(6.0, 8.0, random.within(-0.5, 1.0)));
    RandomProgram { low, high, bar: false, polygons, blocks }
}

/// The same with an axis that turns on the way, nearly evenly, as in five-axis milling.
fn turning_moves(seed: u64) -> RandomProgram {
    let mut random = Random(seed.wrapping_mul(0x94D0_49BB_1331_11EB) | 1);
    for _ in 0..8 {
        random.next();
    }
    let mut program = short_moves(seed);
    let noise = [0.0, 1e-5, 3e-4, 3e-3][random.below(4)];
    let [lead, tilt] = [0, 1].map(|_| random.within(-0.03, 0.03));
    let [start, side] = [0, 1].map(|_| random.within(-0.3, 0.3));
    let mut last = None;
    for block in &mut program.blocks {
        let [x, y] = [block.to.tip.x, block.to.tip.y];
        let mut off = || noise * random.within(-1.0, 1.0);
        let axis = Vector3::new(start + lead * x + off(), side + tilt * y + off(), 1.0).normalize();
        block.from.axis = last.unwrap_or(axis);
        block.to.axis = axis;
        last = Some(axis);
    }
    program
}

#[test]
fn runs_of_turning_moves_have_no_point_above() {
    assert_none_above(1..=15, 250, turning_moves);
}

#[test]
fn the_cloud_finds_bounds_of_turning_moves_that_are_too_low() {
    assert_low_bounds_are_found(1..=20, (800, 10), turning_moves);
}

#[test]
fn runs_of_short_moves_have_no_point_above() {
    assert_none_above(1..=15, 250, short_moves);
}

#[test]
fn the_cloud_finds_bounds_of_short_moves_that_are_too_low() {
    assert_low_bounds_are_found(1..=30, (800, 12), short_moves);
}
