//! Chip thickness over edges against closed forms: a slot, a ball, teeth that lag and teeth with runout.

use clsmith::certified_engagement::{ContactSection, ContourElement, CutterContour, SectionRow};
use clsmith::cutter::{Meridian, Teeth};
use clsmith::engagement::{CuttingCoefficients, EdgeForceModel, EdgeThicknessMap};
use clsmith::program::record::SpindleDirection::{Clockwise, CounterClockwise};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const NONE: CuttingCoefficients =
    CuttingCoefficients { k_tc: 0.0, k_te: 0.0, k_rc: 0.0, k_re: 0.0, k_ac: 0.0, k_ae: 0.0 };
const RPM: f64 = 3000.0;
const GRID: [usize; 2] = [360, 20];

fn section(element: ContourElement, range: [f64; 2], arc: [f64; 2]) -> ContactSection {
    ContactSection {
        rows: vec![SectionRow { element, range, arcs: vec![arc] }],
        frame: [Vector3::x(), Vector3::y(), Vector3::z()],
        has_heading: true,
        tip_speed: [1.0, 0.0],
        spin: [0.0; 2],
    }
}

/// The map of a slot 3 mm deep, and the thickness of a tooth, a rotation and a point of it.
fn slot(teeth: &Teeth, feed_per_turn: f64) -> EdgeThicknessMap {
    let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 30.0).unwrap();
    let contour = CutterContour::from_meridian(&profile).unwrap();
    let flank = *contour.elements().last().unwrap();
    let cut = section(flank, [0.0, 0.1], [-FRAC_PI_2, FRAC_PI_2]);
    let model = EdgeForceModel::new(&profile, teeth, NONE, Clockwise);
    model.map_edge_thickness(&cut, &contour, [feed_per_turn * RPM, RPM], GRID)
}

fn at(map: &EdgeThicknessMap, tooth: usize, rotation: usize, point: usize) -> f64 {
    map.teeth[tooth].thickness_mm[rotation * map.points.len() + point]
}

#[test]
fn a_slot_is_feed_per_tooth_times_the_cosine_from_ahead() {
    for helix_rad in [0.0, 0.6_f64] {
        let map = slot(&Teeth::evenly_spaced(4, helix_rad).unwrap(), 0.4);
        assert_eq!(
            (map.teeth.len(), map.points.len(), map.rotations_rad.len()),
            (1, 20, 360),
            "four teeth alike"
        );
        for (index, point) in map.points.iter().enumerate() {
            let height = 3.0 * (index as f64 + 0.5) / 20.0;
            assert!((point.height_mm - height).abs() < 1e-9 && (point.radius_mm - 5.0).abs() < 1e-12);
            assert!((point.along_mm - 5.0 - height).abs() < 1e-9, "the bottom is 5 mm long");
            for (number, rotation) in map.rotations_rad.iter().enumerate() {
                // A clockwise edge turns to the right, and its upper parts follow later.
                let angle = height * helix_rad.tan() / 5.0 - rotation;
                let wanted = 0.1 * angle.cos().max(0.0);
                let found = at(&map, 0, number, index);
                let is_end = angle.cos().abs() < 1e-9;
                assert!(is_end || (found - wanted).abs() < 1e-12, "{found} instead of {wanted} at {angle}");
            }
        }
        let (thickest, [tooth, ..]) = map.find_thickest().unwrap();
        assert!(tooth == 0 && thickest <= 0.1 && thickest > 0.0999);
    }
}

#[test]
fn a_ball_also_has_the_sine_of_the_immersion() {
    let profile = Meridian::new(10.0, 5.0, 0.0, 0.0, 30.0).unwrap();
    let contour = CutterContour::from_meridian(&profile).unwrap();
    let ball = contour.elements()[0];
    // Up to 60 degrees from straight down, on the left side ahead, and turning the other way.
    let cut = section(ball, [0.0, PI / 3.0], [0.0, FRAC_PI_2]);
    let teeth = Teeth::evenly_spaced(2, 0.0).unwrap();
    let model = EdgeForceModel::new(&profile, &teeth, NONE, CounterClockwise);
    let map = model.map_edge_thickness(&cut, &contour, [0.2 * RPM, RPM], GRID);
    for (index, point) in map.points.iter().enumerate() {
        let immersion = PI / 3.0 * (index as f64 + 0.5) / 20.0;
        assert!((point.radius_mm - 5.0 * immersion.sin()).abs() < 1e-9);
        assert!((point.height_mm - 5.0 * (1.0 - immersion.cos())).abs() < 1e-9);
        for (number, rotation) in map.rotations_rad.iter().enumerate() {
            let is_cut = *rotation < FRAC_PI_2 - 1e-9;
            let wanted = if is_cut { 0.1 * rotation.cos() * immersion.sin() } else { 0.0 };
            let found = at(&map, 0, number, index);
            assert!((found - wanted).abs() < 1e-12, "{found} instead of {wanted} at {rotation}");
        }
    }
}

#[test]
fn teeth_that_differ_have_maps_of_their_own() {
    let runout = Teeth::unevenly_spaced(vec![1.0, 1.0], vec![0.01, -0.01], 0.0).unwrap();
    let map = slot(&runout, 0.2);
    assert_eq!(map.teeth.len(), 2);
    // Straight ahead the one that stands out takes 0.02 mm more than its half, half a turn later the other one that much less.
    assert!((at(&map, 0, 0, 3) - 0.12).abs() < 1e-9, "{}", at(&map, 0, 0, 3));
    assert!((at(&map, 1, 180, 3) - 0.08).abs() < 1e-9, "{}", at(&map, 1, 180, 3));
    // Where an edge does not cut it has no chip, however far it stands out.
    assert_eq!(at(&map, 0, 180, 3), 0.0);
    assert!(map.trails_rad.iter().zip([0.0, PI]).all(|(found, wanted)| (found - wanted).abs() < 1e-12));
}

#[test]
fn in_air_the_whole_edge_has_no_chip() {
    let profile = Meridian::new(10.0, 2.0, 0.0, 0.0, 30.0).unwrap();
    let contour = CutterContour::from_meridian(&profile).unwrap();
    let mut air = section(contour.elements()[0], [0.0, 0.5], [0.0, TAU / 4.0]);
    air.rows.clear();
    let teeth = Teeth::evenly_spaced(3, 0.5).unwrap();
    let map = EdgeForceModel::new(&profile, &teeth, NONE, Clockwise).map_edge_thickness(
        &air,
        &contour,
        [600.0, RPM],
        GRID,
    );
    assert_eq!(map.find_thickest(), None);
    assert!(map.points.first().unwrap().along_mm < 1.0 && map.points.last().unwrap().height_mm > 28.0);
}
