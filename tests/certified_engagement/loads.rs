//! Bounds of removal rates, torque, power and force, against closed forms, and against sums over points of the cutter's
//! surface whose membership is asked one by one.

use super::cloud::{Random, RandomProgram};
use super::oracle::{self, Polygon};
use clsmith::certified_engagement::*;
use clsmith::cutter::{BeamStep, FLUTE_DIAMETER_FACTOR, Meridian, Teeth, ToolBeam};
use clsmith::engagement::{CuttingCoefficients, LoadBound, LoadModel, bound_swept_area_mm2};
use clsmith::program::record::SpindleDirection;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const STEEL: CuttingCoefficients =
    CuttingCoefficients { k_tc: 2000.0, k_te: 20.0, k_rc: 700.0, k_re: 25.0, k_ac: 200.0, k_ae: 2.0 };
const RPM: f64 = 5000.0;
const FEED: f64 = 1000.0;

/// A mill with its teeth.
pub struct Mill {
    pub numbers: [f64; 5],
    pub teeth: Teeth,
    pub left: f64,
}

impl Mill {
    fn meridian(&self) -> Meridian {
        let [diameter, corner, taper, tip, height] = self.numbers;
        Meridian::new(diameter, corner, taper, tip, height).unwrap()
    }

    fn model(&self) -> LoadModel {
        let sense =
            if self.left > 0.0 { SpindleDirection::Clockwise } else { SpindleDirection::CounterClockwise };
        let model = LoadModel::new(&self.meridian(), &self.teeth, STEEL, sense);
        model.with_beam(Some(Arc::new(self.beam())))
    }

    /// The mill with a shank of its diameter, clamped at 55 mm.
    fn beam(&self) -> ToolBeam {
        let mut steps = ToolBeam::flute_steps(&self.meridian(), FLUTE_DIAMETER_FACTOR, 55.0);
        steps.push(BeamStep { from_mm: 30.0, to_mm: 55.0, diameter_mm: self.numbers[0] });
        ToolBeam::new(steps, 580.0).unwrap()
    }

    fn lag(&self) -> f64 {
        self.teeth.helix_rad.tan() / self.meridian().radius_mm()
    }
}

/// A program for its engagement.
pub fn certified(made: &RandomProgram) -> CertifiedProgram {
    let contours = made.polygons.iter().map(|polygon| {
        let [a, b, c, d, e] = polygon.numbers;
        CutterContour::from_meridian(&Meridian::new(a, b, c, d, e).unwrap()).unwrap()
    });
    let mut program =
        CertifiedProgram::new(vec![made.stock()], contours.collect(), StepLimits::default()).unwrap();
    for block in &made.blocks {
        program.push_block(block).unwrap();
    }
    program
}

fn contacts(made: &RandomProgram, block: usize, mill: &Mill) -> Vec<ContactGrid> {
    let program = certified(made);
    let options = EngagementOptions { most_patches: 4000, ..EngagementOptions::default() };
    program.bound_contacts(block, mill.lag(), &options)
}

pub fn block_at(from: [f64; 3], to: [f64; 3]) -> BlockMotion {
    let pose = |tip: [f64; 3]| CutterPose { tip: tip.into(), axis: Vector3::z() };
    BlockMotion { from: pose(from), to: pose(to), arc: None, cutter: 0 }
}

pub fn one_mill(mill: &Mill, blocks: Vec<BlockMotion>) -> RandomProgram {
    let [a, b, c, d, e] = mill.numbers;
    let (low, high) = (Vector3::new(-40.0, -40.0, -20.0), Vector3::new(40.0, 40.0, 0.0));
    RandomProgram { low, high, bar: false, polygons: vec![Polygon::new(a, b, c, d, e)], blocks }
}

/// A full slot: the volume is width times depth, and power is k_tc times the removal rate with the edges' part.
#[test]
fn a_full_slot_in_closed_form() {
    let mill = Mill {
        numbers: [10.0, 0.0, 0.0, 0.0, 30.0],
        teeth: Teeth::evenly_spaced(4, 0.5).unwrap(),
        left: 1.0,
    };
    let made = one_mill(&mill, vec![block_at([-20.0, 0.0, -3.0], [20.0, 0.0, -3.0])]);
    let grids = contacts(&made, 0, &mill);
    let swept = bound_swept_area_mm2(&grids);
    assert!((30.0..30.0 * 1.02).contains(&swept), "{swept}");
    let bound = LoadBound::from_contacts(&mill.model(), &grids);
    let loads = bound.loads_at(FEED, RPM);
    // Each tooth has an edge of 3 mm in the material for half a turn.
    let cutting_w = STEEL.k_tc * 30.0 * FEED / 60.0 * 1e-3;
    let edge_w = STEEL.k_te * 3.0 * 4.0 * 0.5 * 5e-3 * TAU * RPM / 60.0;
    let power = (cutting_w + edge_w) * 1e-3;
    assert!((power..power * 1.02).contains(&loads.power_kw), "{} of {power}", loads.power_kw);
    // The limit is the inverse.
    let limits =
        |force_n, torque_nm, power_kw| clsmith::engagement::CuttingLoads { force_n, torque_nm, power_kw };
    let free = f64::INFINITY;
    for limit in [
        limits(loads.force_n, free, free),
        limits(free, loads.torque_nm, free),
        limits(free, free, loads.power_kw),
    ] {
        let feed = bound.feed_within_mm_min(RPM, limit);
        assert!((feed / FEED - 1.0).abs() < 1e-9, "{feed}");
    }
}

/// A plunge into the full: the bottom advances at the whole feed.
#[test]
fn a_plunge_in_closed_form() {
    let mill = Mill {
        numbers: [10.0, 0.0, 0.0, 0.0, 30.0],
        teeth: Teeth::evenly_spaced(2, 0.5).unwrap(),
        left: 1.0,
    };
    let made = one_mill(&mill, vec![block_at([0.0, 0.0, 5.0], [0.0, 0.0, -5.0])]);
    let grids = contacts(&made, 0, &mill);
    let swept = bound_swept_area_mm2(&grids);
    assert!((PI * 25.0..PI * 25.0 * 1.02).contains(&swept), "{swept}");
    let loads = LoadBound::from_contacts(&mill.model(), &grids).loads_at(FEED, RPM);
    // Torque: both edges are as long as the radius, and the chip is half the advance.
    let torque = 2.0 * (STEEL.k_tc * FEED / RPM / 2.0 + STEEL.k_te) * 25.0 / 2.0 * 1e-3;
    assert!((torque..torque * 1.03).contains(&loads.torque_nm), "{} of {torque}", loads.torque_nm);
}

/// What the points of a cutter's surface say at a time and a rotation.
struct Sums {
    swept: f64,
    mean_torque: f64,
    torque: f64,
    force: f64,
    deflection: f64,
    stress: f64,
}

fn sum_points(made: &RandomProgram, number: usize, mill: &Mill, time: f64, turned: f64) -> Sums {
    let block = &made.blocks[number];
    let (tool, meridian) = (&made.polygons[block.cutter], mill.meridian());
    let pose = oracle::pose_at(block, time);
    let reference = oracle::reference(block, tool, meridian.radius_mm());
    let little = 1e-6;
    let [before, after] = [time - little, time + little].map(|time| oracle::pose_at(block, time));
    let frame = |pose: &CutterPose| {
        let x = Vector3::y().cross(&pose.axis).normalize();
        [x, pose.axis.cross(&x), pose.axis]
    };
    let [ex, ey, ez] = frame(&pose);
    let place = |pose: &CutterPose, local: [f64; 3]| {
        let [x, y, z] = frame(pose);
        pose.tip + x * local[0] + y * local[1] + z * local[2]
    };
    let share_at = |r: f64, z: f64, psi: f64, angle: f64| {
        let local = [r * angle.cos(), r * angle.sin(), z];
        let point = place(&pose, local);
        let normal = (ex * angle.cos() + ey * angle.sin()) * psi.sin() - ez * psi.cos();
        let speed = (place(&after, local) - place(&before, local)) / (2.0 * little) / reference;
        let share = speed.dot(&normal);
        // What a straight way with a fixed axis is about to cut, it has not cut before.
        let is_cut = share > 1e-3 && made.is_material(&point, number);
        if is_cut { share } else { 0.0 }
    };
    let advance = FEED / RPM;
    let mut sums =
        Sums { swept: 0.0, mean_torque: 0.0, torque: 0.0, force: 0.0, deflection: 0.0, stress: 0.0 };
    let mut force = Vector3::zeros();
    let beam = mill.beam();
    let places: Vec<[f64; 2]> = beam.stress_places().collect();
    let (mut bent, mut moments) = (Vector3::zeros(), vec![Vector3::zeros(); places.len()]);
    let (steps, around) = (90, 90);
    let highest = meridian.arc_length_mm().min(meridian.flank_start_arc_length_mm() + 10.0);
    let step = highest / f64::from(steps);
    let trail = mill.teeth.trail_angles_rad();
    for place in 0..steps {
        let at = meridian.point_at_arc_length((f64::from(place) + 0.5) * step);
        for direction in 0..around {
            let width = TAU / f64::from(around);
            let share = share_at(at.r, at.z, at.psi, f64::from(direction) * width);
            let is_cut = f64::from(u8::from(share > 0.0));
            sums.swept += share * at.r * step * width;
            let teeth = trail.len() as f64;
            sums.mean_torque +=
                (STEEL.k_tc * share * advance + STEEL.k_te * teeth * is_cut) * at.r * step * width / TAU;
        }
        for (tooth, trail) in trail.iter().enumerate() {
            let angle = turned + mill.left * (trail + at.z * mill.lag());
            let share = share_at(at.r, at.z, at.psi, angle);
            if share == 0.0 {
                continue;
            }
            let chip = share * advance * mill.teeth.pitch_angles_rad()[tooth] / TAU;
            let [tangential, radial, axial] = [
                STEEL.k_tc * chip + STEEL.k_te,
                STEEL.k_rc * chip + STEEL.k_re,
                STEEL.k_ac * chip + STEEL.k_ae,
            ];
            // On the cutter: the axial force points down the meridian.
            let outwards = -axial * at.psi.cos() - radial * at.psi.sin();
            let along = radial * at.psi.cos() - axial * at.psi.sin();
            let (sin, cos) = angle.sin_cos();
            let part = Vector3::new(
                outwards * cos - mill.left * tangential * sin,
                outwards * sin + mill.left * tangential * cos,
                along,
            ) * step;
            force += part;
            bent += part * beam.deflection_mm_per_n(0.0, at.z);
            for (moment, [height, _]) in moments.iter_mut().zip(&places) {
                *moment += part * (height - at.z).max(0.0);
            }
            sums.torque += tangential * at.r * step;
        }
    }
    sums.force = force.norm();
    sums.deflection = bent.xy().norm();
    let stresses = moments.iter().zip(&places).map(|(moment, [_, modulus])| moment.xy().norm() / modulus);
    sums.stress = stresses.fold(0.0, f64::max);
    sums
}

fn random_case(seed: u64) -> (RandomProgram, Mill) {
    let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    for _ in 0..8 {
        random.next();
    }
    let diameter = random.within(6.0, 16.0);
    let numbers = match random.below(4) {
        0 => [diameter, 0.0, 0.0, 0.0, 30.0],
        1 => [diameter, random.within(0.5, 2.0), 0.0, 0.0, 30.0],
        2 => [diameter, diameter / 2.0, 0.0, 0.0, 30.0],
        _ => [diameter, 1.0, 0.1, 0.0, 30.0],
    };
    let count = 2 + random.below(4) as u32;
    let helix = random.within(-0.1, 0.7);
    let left = if random.next() < 0.5 { 1.0 } else { -1.0 };
    let mill = Mill { numbers, teeth: Teeth::evenly_spaced(count, helix).unwrap(), left };
    let tilt = if random.next() < 0.5 { 0.0 } else { 0.3 };
    let axis = Vector3::new(random.within(-tilt, tilt), random.within(-tilt, tilt), 1.0).normalize();
    let mut tip = Vector3::new(random.within(-20.0, 20.0), -20.0, 10.0);
    let mut blocks: Vec<BlockMotion> = Vec::new();
    for _ in 0..3 + random.below(4) {
        let mut to =
            Vector3::new(random.within(-9.0, 9.0), random.within(-9.0, 9.0), random.within(-5.0, 1.0));
        match random.below(5) {
            0 => to.z = tip.z,
            1 => to = tip + axis * random.within(-4.0, 2.0),
            2 => to = tip + Vector3::new(random.within(-0.8, 0.8), random.within(-0.8, 0.8), 0.0),
            3 if blocks.len() > 1 => {
                let last = blocks[blocks.len() - 1].from.tip;
                to = last + Vector3::new(random.within(-2.0, 2.0), random.within(-2.0, 2.0), 0.0);
            }
            _ => {}
        }
        let pose = |tip| CutterPose { tip, axis };
        if (to - tip).norm() > 1e-3 {
            blocks.push(BlockMotion { from: pose(tip), to: pose(to), arc: None, cutter: 0 });
            tip = to;
        }
    }
    let mut made = one_mill(&mill, blocks);
    made.low = Vector3::new(-10.0, -8.0, -8.0);
    made.high = Vector3::new(9.0, 10.0, 0.5);
    (made, mill)
}

/// What 1000 N at the tip make: the deflection in mm, and the stress in MPa.
fn one_kilonewton(beam: &ToolBeam) -> (f64, f64) {
    let stress = beam.stress_places().map(|[height, modulus]| height / modulus).fold(0.0, f64::max);
    (1000.0 * beam.deflection_mm_per_n(0.0, 0.0), 1000.0 * stress)
}

/// Returns for each block of a program the largest sums of points and the bounds.
fn compare(seed: u64) -> Vec<[[f64; 2]; 6]> {
    let (made, mill) = random_case(seed);
    let mut random = Random(seed | 1);
    let mut found = Vec::new();
    for number in 0..made.blocks.len() {
        let grids = contacts(&made, number, &mill);
        let bound = LoadBound::from_contacts(&mill.model(), &grids);
        let loads = bound.loads_at(FEED, RPM);
        let omega = TAU * RPM / 60.0 * 1e-6;
        let bending = bound.bending_at(FEED, RPM);
        // As parts of what 1000 N at the tip make, so that all mills have one scale.
        let (give, lever) = one_kilonewton(&mill.beam());
        let bounds = [
            bound_swept_area_mm2(&grids),
            loads.power_kw,
            loads.torque_nm,
            loads.force_n,
            bending.deflection_mm / give,
            bending.stress_mpa / lever,
        ];
        let mut largest = [0.0_f64; 6];
        for _ in 0..6 {
            let (time, turned) = (random.within(0.01, 0.99), random.within(0.0, TAU));
            let sums = sum_points(&made, number, &mill, time, turned);
            let told = [
                sums.swept,
                sums.mean_torque * omega,
                sums.torque * 1e-3,
                sums.force,
                sums.deflection / give,
                sums.stress / lever,
            ];
            largest.iter_mut().zip(told).for_each(|(most, told)| *most = most.max(told));
        }
        let mut pairs = [[0.0; 2]; 6];
        pairs.iter_mut().zip(largest.iter().zip(bounds)).for_each(|(pair, (a, b))| *pair = [*a, b]);
        found.push(pairs);
    }
    found
}

/// The sums over points have an error of their own, since a point stands for its surroundings: a hundredth of a slot.
#[test]
fn no_sum_of_points_is_above_its_bound() {
    let mut ratios: [Vec<f64>; 6] = Default::default();
    for seed in 1..=60 {
        for (number, pairs) in compare(seed).into_iter().enumerate() {
            for (kind, [sum, bound]) in pairs.into_iter().enumerate() {
                let error = [0.3, 0.01, 0.15, 6.0, 0.006, 0.006][kind];
                assert!(
                    sum <= bound * 1.01 + error,
                    "seed {seed} block {number} kind {kind}: {sum} above {bound}"
                );
                if sum > 10.0 * error {
                    ratios[kind].push(bound / sum);
                }
            }
        }
    }
    for (kind, ratios) in ratios.iter_mut().enumerate() {
        ratios.sort_by(f64::total_cmp);
        assert!(ratios.len() > 20, "{}", ratios.len());
        let quantiles = [0.0, 0.1, 0.5, 0.9].map(|part| ratios[(ratios.len() as f64 * part) as usize]);
        println!("kind {kind}: {} {quantiles:?}", ratios.len());
        // Times and rotations of the sums are random, so the bound of a block is above the largest of them.
        // Deflection and stress are bounded at the lower end of each row, and bull-nosed tips press little of what they may.
        let most = if kind < 4 { 1.5 } else { 2.0 };
        assert!(quantiles[0] > 0.99 && quantiles[2] < most, "kind {kind}: {quantiles:?}");
    }
}
