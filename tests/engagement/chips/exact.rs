//! The exact tooth mode against closed forms, and the fast formulas against it.

use super::{close, cutter};
use clsmith::cutter::{Meridian, Teeth};
use clsmith::engagement::{ExactChipThickness, ToothMotion, ToothSampling, measure_exact_chips};
use clsmith::program::record::SpindleDirection::{self, Clockwise, CounterClockwise};
use nalgebra::{Point3, Vector3};
use std::f64::consts::PI;

const RPM: f64 = 1000.0;

/// Cuts from the origin for some turns in a direction.
fn cut(
    profile: &Meridian,
    teeth: &Teeth,
    spindle: SpindleDirection,
    way: (Vector3<f64>, f64, f64),
    fineness: ToothSampling,
    material: impl Fn(Point3<f64>) -> bool,
) -> ExactChipThickness {
    let (direction, per_turn, turns) = way;
    let motion = ToothMotion {
        from: Point3::origin(),
        to: Point3::origin() + direction.normalize() * per_turn * turns,
        feed_mm_min: per_turn * RPM,
        rpm: RPM,
        spindle,
    };
    measure_exact_chips(profile, teeth, &motion, fineness, material)
}

/// Looks every degree, a few points up to a height, 1e-5 mm.
fn degrees(looks: u32, points: u32, height: f64) -> ToothSampling {
    ToothSampling { looks, points, height_mm: height, tolerance_mm: 1e-5 }
}

#[test]
fn a_slot_has_the_feed_per_tooth() {
    let profile = cutter(10.0, 0.0);
    for (count, helix, spindle) in [(1, 0.0, Clockwise), (2, 0.6, Clockwise), (4, 0.6, CounterClockwise)] {
        let teeth = Teeth::evenly_spaced(count, helix).unwrap();
        let way = (Vector3::x(), 0.1 * f64::from(count), 4.0);
        let found = cut(&profile, &teeth, spindle, way, degrees(360, 3, 2.0), |_| true);
        close(found.largest_mm, 0.1, 0.01);
        for chip in &found.by_edge_mm {
            close(*chip, 0.1, 0.01);
        }
    }
}

#[test]
fn side_milling_stays_below_the_classic_thickness() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.5).unwrap());
    for part in [0.05, 0.1, 0.25, 0.5, 0.75, 1.0_f64] {
        let classic = if part < 0.5 { 0.2 * (part * (1.0 - part)).sqrt() } else { 0.1 };
        // At the left it is milled up by a clockwise spindle, at the right down.
        for side in [1.0, -1.0] {
            let way = (Vector3::x(), 0.2, 3.0);
            let wall = 5.0 - part * 10.0;
            let found =
                cut(&profile, &teeth, Clockwise, way, degrees(1440, 1, 2.0), |place| place.y * side > wall);
            let ratio = found.largest_mm / classic;
            println!("a_e/D {part}, side {side}: {ratio:.4} of the classic thickness");
            assert!((0.90..=1.002).contains(&ratio), "a_e/D {part}: {ratio}");
        }
    }
}

#[test]
fn a_ball_stays_below_the_classic_thickness() {
    let (profile, teeth) = (cutter(10.0, 5.0), Teeth::evenly_spaced(2, 0.5).unwrap());
    for depth in [0.2, 0.5, 1.0, 3.0] {
        let classic = 0.1 * (1.0 - (1.0 - depth / 5.0_f64).powi(2)).sqrt();
        let way = (Vector3::x(), 0.2, 2.5);
        let found = cut(&profile, &teeth, Clockwise, way, degrees(120, 120, depth), |place| place.z < depth);
        let ratio = found.largest_mm / classic;
        println!("ball, depth {depth}: {ratio:.4} of the classic thickness");
        assert!((0.88..=1.002).contains(&ratio), "depth {depth}: {ratio}");
    }
}

#[test]
fn going_down_the_bottom_cuts() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.5).unwrap());
    // Straight down the feed per tooth; at 60 degrees its part along the axis, which exceeds the flank's.
    // Near the axis the travel across turns the teeth's way, 0.1 mm in 2 pi r, so passes are not quite as far apart.
    for (slope, tolerance) in [(90.0_f64, 1e-3), (60.0, 0.03)] {
        let (sin, cos) = slope.to_radians().sin_cos();
        let way = (Vector3::new(cos, 0.0, -sin), 0.2, 3.0);
        let found = cut(&profile, &teeth, Clockwise, way, degrees(180, 9, 0.0), |_| true);
        close(found.largest_mm, 0.1 * sin, tolerance);
    }
    // A ramp of 10 degrees: its flank.
    let (sin, cos) = 10_f64.to_radians().sin_cos();
    let way = (Vector3::new(cos, 0.0, -sin), 0.2, 3.0);
    let found = cut(&profile, &teeth, Clockwise, way, degrees(360, 5, 2.0), |_| true);
    close(found.largest_mm, 0.1 * cos, 0.01);
    // A ball going down 30 degrees is fullest where its normal follows the motion.
    let ball = cutter(10.0, 5.0);
    let way = (Vector3::new(3_f64.sqrt() / 2.0, 0.0, -0.5), 0.2, 3.0);
    let found = cut(&ball, &teeth, Clockwise, way, degrees(180, 25, 5.0), |_| true);
    close(found.largest_mm, 0.1, 0.01);
}

#[test]
fn variable_pitch_in_a_slot() {
    let profile = cutter(10.0, 0.0);
    let teeth = Teeth::unevenly_spaced(vec![70.0, 110.0, 80.0, 100.0], vec![0.0; 4], 0.5).unwrap();
    let way = (Vector3::x(), 0.4, 4.0);
    let found = cut(&profile, &teeth, Clockwise, way, degrees(360, 1, 2.0), |_| true);
    close(found.largest_mm, teeth.max_chip_thickness_mm(0.4, 1.0), 0.01);
    for (edge, chip) in found.by_edge_mm.iter().enumerate() {
        close(*chip, teeth.edge_chip_thickness_mm(edge, 0.4, 1.0), 0.01);
    }
}

#[test]
fn runout_in_a_slot() {
    let profile = cutter(10.0, 0.0);
    let pairs = Teeth::unevenly_spaced(vec![PI, PI], vec![0.01, -0.01], 0.3).unwrap();
    let shy = Teeth::unevenly_spaced(vec![1.0; 3], vec![0.02, -0.03, 0.0], 0.3).unwrap();
    let round = Teeth::with_eccentricity(vec![1.0; 4], 0.015, 0.4, 0.3).unwrap();
    for (teeth, per_turn) in [(pairs, 0.2), (shy, 0.12), (round, 0.3)] {
        for spindle in [Clockwise, CounterClockwise] {
            let way = (Vector3::x(), per_turn, 5.0);
            let found = cut(&profile, &teeth, spindle, way, degrees(360, 1, 2.0), |_| true);
            close(found.largest_mm, teeth.max_chip_thickness_mm(per_turn, 1.0), 0.01);
            for (edge, chip) in found.by_edge_mm.iter().enumerate() {
                let expected = teeth.edge_chip_thickness_mm(edge, per_turn, 1.0);
                assert!((chip - expected).abs() < 0.01 * per_turn, "edge {edge}: {chip} is not {expected}");
            }
        }
    }
}

#[test]
fn runout_counts_with_the_radial_part_of_the_normal() {
    // Down at 45 degrees, a ball cuts most where its normal is at 45 degrees.
    let profile = cutter(10.0, 5.0);
    let teeth = Teeth::unevenly_spaced(vec![PI, PI], vec![0.01, -0.01], 0.0).unwrap();
    let way = (Vector3::new(1.0, 0.0, -1.0), 0.2, 3.0);
    let found = cut(&profile, &teeth, Clockwise, way, degrees(180, 25, 5.0), |_| true);
    // The flank's side of it has less advance and more runout: the largest over the meridian ahead.
    let expected = (0..=90)
        .map(|psi| {
            let psi = f64::from(psi).to_radians();
            teeth.max_chip_thickness_mm(0.2 * (psi - PI / 4.0).cos(), psi.sin())
        })
        .fold(0.0, f64::max);
    close(found.largest_mm, expected, 0.01);
}

#[test]
fn a_skin_thinner_than_the_chip() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.5).unwrap());
    // A post of 0.02 x 1 mm ahead in the way.
    let skin = |place: Point3<f64>| (5.3..5.32).contains(&place.x) && place.y.abs() < 0.5;
    let found = cut(&profile, &teeth, Clockwise, (Vector3::x(), 0.2, 4.0), degrees(720, 1, 2.0), skin);
    assert!(found.largest_mm > 0.0199 && found.largest_mm < 0.0202, "{}", found.largest_mm);
    let air = cut(&profile, &teeth, Clockwise, (Vector3::x(), 0.2, 2.0), degrees(90, 1, 2.0), |_| false);
    assert_eq!((air.largest_mm, air.by_edge_mm), (0.0, vec![0.0, 0.0]));
}

#[test]
fn standing_still_cuts_nothing() {
    let (profile, teeth) = (cutter(10.0, 0.0), Teeth::evenly_spaced(2, 0.5).unwrap());
    let way = (Vector3::x(), 0.2, 0.0);
    assert_eq!(cut(&profile, &teeth, Clockwise, way, degrees(90, 3, 2.0), |_| true).largest_mm, 0.0);
}
