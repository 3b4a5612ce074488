//! The proof by points: it finds what bounds claim, refutes bounds that are too low, and never a true one.

use super::cloud::*;
use super::mills::{mill, proof_mill};
use clsmith::certified_engagement::*;
use nalgebra::Vector3;

fn pose(x: f64, y: f64, z: f64) -> CutterPose {
    CutterPose { tip: Vector3::new(x, y, z), axis: Vector3::z() }
}

/// Random passes, ramps, plunges, flat arcs and turns of one mill.
fn motions(random: &mut Random) -> Vec<BlockMotion> {
    let mut at = pose(random.within(-6.0, 6.0), -14.0, random.within(-3.0, -0.5));
    let mut blocks = Vec::new();
    for _ in 0..6 {
        let mut to = at;
        let mut arc = None;
        match random.below(6) {
            0 => to.tip.z -= random.within(0.2, 1.0),
            1 => {
                let center = at.tip + Vector3::new(random.within(-8.0, 8.0), random.within(-5.0, 5.0), 0.0);
                let angle = random.within(-3.0, 3.0);
                let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
                // Files round.
                to.tip = (center + turn * (at.tip - center)).map(|part| (part * 1e4).round() / 1e4);
                to.tip.z = at.tip.z;
                let normal = at.axis;
                arc = (normal == Vector3::z()).then_some(TipArc { center, normal, angle });
            }
            2 => {
                let more = Vector3::new(random.within(-0.05, 0.05), random.within(-0.05, 0.05), 0.0);
                to.axis = (at.axis + more).normalize();
                to.tip += Vector3::new(random.within(-2.0, 2.0), random.within(0.5, 2.0), 0.0);
            }
            3 => {
                to.tip +=
                    Vector3::new(random.within(-6.0, 6.0), random.within(2.0, 9.0), random.within(-0.5, 0.3))
            }
            _ => to.tip += Vector3::new(random.within(-9.0, 9.0), random.within(1.0, 6.0), 0.0),
        }
        blocks.push(BlockMotion { from: at, to, arc, cutter: 0 });
        at = to;
    }
    blocks
}

fn numbers(random: &mut Random) -> [f64; 5] {
    let diameter = random.within(5.0, 10.0);
    match random.below(5) {
        0 => [diameter, 0.0, 0.0, 0.0, 20.0],
        1 => [diameter, diameter / 2.0, 0.0, 0.0, 20.0],
        2 => [diameter, diameter * 0.1, 0.0, random.within(0.1, 0.5), 20.0],
        3 => [diameter / 2.0, diameter * 0.1, random.within(0.05, 0.3), 0.0, 20.0],
        _ => [diameter, diameter * 0.3, 0.0, 0.0, 20.0],
    }
}

/// Returns the blocks tested, those refuted, and the part of the lower bounds that points reached.
fn run(seeds: std::ops::Range<u64>, scale: f64, samples: usize) -> (usize, usize, f64) {
    let (low, high) = (Vector3::new(-9.0, -9.0, -8.0), Vector3::new(9.0, 9.0, 0.2));
    let (mut blocks, mut refuted, mut reached) = (0, 0, Vec::new());
    for seed in seeds {
        let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        random.next();
        let [a, b, c, d, e] = numbers(&mut random);
        let motions = motions(&mut random);
        let contour = mill(a, b, c, d, e);
        let mut program = CertifiedProgram::new(
            vec![Box::new(BoxGap::new(low, high))],
            vec![contour],
            StepLimits::default(),
        )
        .unwrap();
        let stock = move |point: &Vector3<f64>| (point - low).min() > 0.0 && (high - point).min() > 0.0;
        let mut proof = EngagementProof::new(Box::new(stock), [low, high], vec![proof_mill(a, b, c, d, e)]);
        for motion in &motions {
            program.push_block(motion).unwrap();
            assert!(proof.push_block(motion));
        }
        let options = EngagementOptions { most_patches: 4000, ..EngagementOptions::default() };
        for (block, motion) in motions.iter().enumerate() {
            let fz = 0.07;
            let chips = EngagementCriterion::Chip { feed_per_tooth_mm: fz };
            let share =
                program.certify_block(block, EngagementCriterion::Share, &options, &mut WarmStart::default());
            let chip = program.certify_block(block, chips, &options, &mut WarmStart::default());
            let hint = share.witness.map(|witness| (witness.point, witness.at));
            let claim = ProofClaim {
                block,
                upper_share: share.upper * scale,
                chip: Some([fz, chip.upper * scale]),
                hint,
            };
            let found = proof.test_block(&claim, samples, 1);
            assert_eq!(found.samples, samples + samples / 2);
            blocks += 1;
            if let Some((point, time)) = found.refuted {
                refuted += 1;
                assert!(
                    scale < 1.0,
                    "seed {seed} block {block} {share:?} {chip:?} {found:?} {point:?} {time} {:?} {:?}",
                    motion,
                    [a, b, c, d, e]
                );
            }
            if share.lower > 0.01 {
                reached.push(found.largest_share / share.lower);
            }
        }
    }
    reached.sort_by(f64::total_cmp);
    (blocks, refuted, reached[reached.len() / 2])
}

#[test]
fn true_bounds_are_not_refuted() {
    let (blocks, refuted, reached) = run(1..150, 1.0, 1500);
    assert!(refuted == 0 && reached > 0.97, "{refuted} of {blocks}, half reach {reached}");
}

#[test]
fn bounds_that_are_too_low_are_refuted() {
    let (blocks, refuted, _) = run(200..240, 0.9, 3000);
    assert!(refuted * 3 > blocks, "{refuted} of {blocks}");
}
