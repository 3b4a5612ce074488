//! Forces edge by edge against closed forms, and means against the mean of the revolution.

use clsmith::certified_engagement::{ContactSection, ContourElement, SectionRow};
use clsmith::cutter::{Meridian, Teeth};
use clsmith::engagement::{CuttingCoefficients, CuttingLaw, EdgeForceModel, KienzleTerm};
use clsmith::program::record::SpindleDirection::{Clockwise, CounterClockwise};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub const STEEL: CuttingCoefficients =
    CuttingCoefficients { k_tc: 1800.0, k_te: 25.0, k_rc: 600.0, k_re: 30.0, k_ac: 200.0, k_ae: 5.0 };
pub const RPM: f64 = 3000.0;

/// The flank of a cylinder of 10 mm up to a depth, cut between two angles from ahead, left positive.
pub fn flank(depth: f64, arc: [f64; 2]) -> ContactSection {
    let element = ContourElement::Line { from: [5.0, 0.0], to: [5.0, depth], normal: [1.0, 0.0] };
    ContactSection {
        rows: vec![SectionRow { element, range: [0.0, 1.0], arcs: vec![arc] }],
        frame: [Vector3::x(), Vector3::y(), Vector3::z()],
        has_heading: true,
        tip_speed: [1.0, 0.0],
        spin: [0.0; 2],
    }
}

fn model(teeth: &Teeth, law: impl Into<CuttingLaw>) -> EdgeForceModel {
    let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 30.0).unwrap();
    EdgeForceModel::new(&profile, teeth, law, Clockwise)
}

#[track_caller]
pub fn close(found: f64, wanted: f64, part: f64) {
    assert!((found - wanted).abs() <= part * wanted.abs().max(1e-6), "{found} instead of {wanted}");
}

#[test]
fn a_full_slot_is_the_closed_form() {
    let teeth = Teeth::evenly_spaced(4, 0.6).unwrap();
    let (depth, chip) = (3.0, 0.06);
    let section = flank(depth, [-FRAC_PI_2, FRAC_PI_2]);
    let found = model(&teeth, STEEL).forces_of_section(&section, chip * 4.0 * RPM, RPM);
    let along = |k_c: f64, k_e: f64| 4.0 * depth / 4.0 * k_c * chip + 4.0 * depth / PI * k_e;
    close(found.tool_mean_n[0], along(STEEL.k_rc, STEEL.k_re), 1e-9);
    close(found.tool_mean_n[1], -along(STEEL.k_tc, STEEL.k_te), 1e-9);
    close(found.tool_mean_n[2], 4.0 * depth * (STEEL.k_ac * chip / PI + STEEL.k_ae / 2.0), 1e-9);
    let torque = 4.0 * depth * 10.0 / (4.0 * PI) * (2.0 * STEEL.k_tc * chip + PI * STEEL.k_te);
    close(found.torque_mean_nm, torque * 1e-3, 1e-9);
    close(found.swept_mm2, 30.0, 1e-9);
}

#[test]
fn half_a_slot_up_and_down() {
    let teeth = Teeth::evenly_spaced(3, 0.5).unwrap();
    let (depth, chip) = (2.0, 0.08);
    // From the left (0) to straight ahead (90), and from there to the right.
    for (arc, [from, to]) in [([0.0, FRAC_PI_2], [0.0, FRAC_PI_2]), ([-FRAC_PI_2, 0.0], [FRAC_PI_2, PI])] {
        let found = model(&teeth, STEEL).forces_of_section(&flank(depth, arc), chip * 3.0 * RPM, RPM);
        let CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae } = STEEL;
        let (of_chip, of_edge) = (3.0 * depth * chip / (8.0 * PI), 3.0 * depth / TAU);
        let at = |phi: f64| {
            let turn = 2.0 * phi - (2.0 * phi).sin();
            [
                -(of_chip * (k_tc * (2.0 * phi).cos() - k_rc * turn)
                    + of_edge * (-k_te * phi.sin() + k_re * phi.cos())),
                -(of_chip * (k_tc * turn + k_rc * (2.0 * phi).cos())
                    - of_edge * (k_te * phi.cos() + k_re * phi.sin())),
                of_edge * (-k_ac * chip * phi.cos() + k_ae * phi),
            ]
        };
        for ((end, start), found) in at(to).into_iter().zip(at(from)).zip(found.tool_mean_n) {
            close(found, end - start, 1e-9);
        }
    }
}

#[test]
fn means_are_those_of_the_revolution() {
    let even = Teeth::evenly_spaced(4, 0.6).unwrap();
    let uneven = Teeth::unevenly_spaced(vec![1.4, 1.7, 1.5, 1.68], vec![0.0; 4], 0.6).unwrap();
    let runout = Teeth::with_eccentricity(vec![1.0; 3], 0.01, 0.0, 0.6).unwrap();
    let term = |k11, m| KienzleTerm { k11, m };
    let kienzle = CuttingLaw::Kienzle {
        tangential: term(1700.0, 0.25),
        radial: term(700.0, 0.35),
        axial: term(300.0, 0.3),
    };
    for teeth in [even, uneven, runout] {
        for law in [CuttingLaw::Linear(STEEL), kienzle] {
            let section = flank(4.0, [-1.2, 0.7]);
            let model = model(&teeth, law);
            let found = model.forces_of_section(&section, 700.0, RPM);
            let turns = model.forces_over_revolution(&section, 700.0, RPM, 2880);
            let count = turns.len() as f64;
            for axis in 0..3 {
                let mean = turns.iter().map(|turn| turn.1[axis]).sum::<f64>() / count;
                close(mean, found.mean_n[axis], 3e-3);
            }
            let torque = turns.iter().map(|turn| turn.2).sum::<f64>() / count;
            close(torque, found.torque_mean_nm, 3e-3);
            let largest =
                |axis: usize| turns.iter().map(|turn| turn.1[axis]).fold(f64::NEG_INFINITY, f64::max);
            for axis in 0..3 {
                close(found.largest_n[axis], largest(axis), 5e-3);
            }
        }
    }
}

#[test]
fn a_spindle_that_turns_the_other_way_mirrors() {
    let teeth = Teeth::evenly_spaced(3, 0.6).unwrap();
    let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 30.0).unwrap();
    let forces = |direction, arc| {
        EdgeForceModel::new(&profile, &teeth, STEEL, direction).forces_of_section(
            &flank(3.0, arc),
            600.0,
            RPM,
        )
    };
    let (one, other) = (forces(Clockwise, [-0.3, 1.2]), forces(CounterClockwise, [-1.2, 0.3]));
    for (axis, sign) in [1.0, -1.0, 1.0].into_iter().enumerate() {
        close(other.mean_n[axis], sign * one.mean_n[axis], 1e-9);
    }
    close(other.torque_mean_nm, one.torque_mean_nm, 1e-9);
    close(other.largest_n[1], -one.least_n[1], 1e-3);
    // The axial force of a positive coefficient lifts the workpiece.
    assert!(one.mean_n[2] > 0.0);
}

#[test]
fn a_flat_bottom_that_goes_down_presses_on_the_workpiece() {
    let teeth = Teeth::evenly_spaced(4, 0.6).unwrap();
    let element = ContourElement::Line { from: [0.0, 0.0], to: [5.0, 0.0], normal: [0.0, -1.0] };
    let section = ContactSection {
        rows: vec![SectionRow { element, range: [0.0, 1.0], arcs: vec![[-PI, PI]] }],
        has_heading: false,
        tip_speed: [0.0, -1.0],
        ..flank(1.0, [0.0, 0.0])
    };
    let chip = 0.02;
    let found = model(&teeth, STEEL).forces_of_section(&section, chip * 4.0 * RPM, RPM);
    close(found.mean_n[2], -4.0 * 5.0 * (STEEL.k_rc * chip + STEEL.k_re), 1e-9);
    close(found.torque_mean_nm, 4.0 * 25.0 / 2.0 * (STEEL.k_tc * chip + STEEL.k_te) * 1e-3, 1e-9);
    assert!(found.mean_n[0].abs() < 1e-9 && found.bending_peak_n < 1e-6);
}
