//! Deflection, bending stress and errors of walls against beam theory: closed forms, and an integration of M / (E I).

use super::section_forces::{RPM, STEEL, close, flank};
use clsmith::cutter::{BeamForces, BeamStep, FLUTE_DIAMETER_FACTOR, Meridian, Teeth, ToolBeam};
use clsmith::engagement::EdgeForceModel;
use clsmith::program::record::SpindleDirection::{self, Clockwise, CounterClockwise};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

fn step(from_mm: f64, to_mm: f64, diameter_mm: f64) -> BeamStep {
    BeamStep { from_mm, to_mm, diameter_mm }
}

fn inertia(diameter: f64) -> f64 {
    PI * diameter.powi(4) / 64.0
}

/// A mill of 10 mm with flutes of 22 mm, a neck of 9 mm and a shank of 12 mm.
fn stepped() -> ToolBeam {
    ToolBeam::new(vec![step(0.0, 22.0, 8.0), step(22.0, 37.0, 9.0), step(37.0, 60.0, 12.0)], 580.0).unwrap()
}

/// The deflection at a height under 1 N at another one, by integrating the slope's change M / (E I) twice from the clamp down.
fn integrate(beam: &ToolBeam, modulus_mpa: f64, at: f64, force_at: f64) -> f64 {
    let (count, end) = (200_000, beam.stick_out_mm());
    let size = end / f64::from(count);
    let (mut slope, mut deflection) = (0.0, 0.0);
    for number in (0..count).rev() {
        let height = (f64::from(number) + 0.5) * size;
        if height < at {
            break;
        }
        let diameter = beam.steps().iter().find(|step| height < step.to_mm).unwrap().diameter_mm;
        let bend = (height - force_at).max(0.0) / (modulus_mpa * inertia(diameter)) * size;
        slope += bend / 2.0;
        deflection += slope * size;
        slope += bend / 2.0;
    }
    deflection
}

#[test]
fn a_cylinder_bends_as_in_the_books() {
    let beam = ToolBeam::new(vec![step(0.0, 50.0, 10.0)], 580.0).unwrap();
    let stiffness = 580e3 * inertia(10.0);
    close(beam.deflection_mm_per_n(0.0, 0.0), 50.0_f64.powi(3) / 3.0 / stiffness, 1e-12);
    // A force at 20 mm from the tip: its own deflection, and its slope up to the tip.
    let arm: f64 = 30.0;
    let known = arm.powi(3) / 3.0 / stiffness + arm.powi(2) / 2.0 / stiffness * 20.0;
    close(beam.deflection_mm_per_n(0.0, 20.0), known, 1e-12);
    close(beam.deflection_mm_per_n(20.0, 0.0), known, 1e-12);
    let forces = BeamForces { force_n: [300.0, 400.0], ..BeamForces::default() };
    close(beam.largest_stress_mpa(&forces, 0.0), 500.0 * 50.0 * 32.0 / (PI * 1000.0), 1e-12);
}

#[test]
fn steps_bend_as_an_integration_says() {
    let beam = stepped();
    for (at, force_at) in [(0.0, 0.0), (0.0, 5.0), (3.0, 10.0), (12.0, 2.0), (0.0, 30.0), (25.0, 40.0)] {
        close(beam.deflection_mm_per_n(at, force_at), integrate(&beam, 580e3, at, force_at), 1e-4);
    }
    // 100 N at the tip: 9 mm at the upper end of the neck are worse than 12 mm at the clamp.
    let forces = BeamForces { force_n: [0.0, 100.0], ..BeamForces::default() };
    let at = |height: f64, diameter: f64| 100.0 * height * 32.0 / (PI * diameter.powi(3));
    assert!(at(37.0, 9.0) > at(60.0, 12.0) && at(37.0, 9.0) > at(22.0, 8.0));
    close(beam.largest_stress_mpa(&forces, 0.0), at(37.0, 9.0), 1e-12);
    // Steps that leave a gap, or nothing at all, are no beam.
    assert!(ToolBeam::new(vec![step(0.0, 5.0, 8.0), step(6.0, 9.0, 8.0)], 580.0).is_none());
    assert!(
        ToolBeam::new(Vec::new(), 580.0).is_none() && ToolBeam::new(vec![step(0.0, 5.0, 8.0)], 0.0).is_none()
    );
}

#[test]
fn flutes_are_thinner_and_tapers_are_stairs_inside() {
    let mill = Meridian::new(10.0, 2.0, 0.0, 0.0, 22.0).unwrap();
    assert_eq!(ToolBeam::flute_steps(&mill, FLUTE_DIAMETER_FACTOR, 40.0), [step(0.0, 22.0, 8.0)]);
    let cone = Meridian::new(4.0, 2.0, 0.1, 0.0, 22.0);
    let cone = cone.unwrap_or_else(|_| Meridian::new(4.0, 1.0, 0.1, 0.0, 22.0).unwrap());
    let steps = ToolBeam::flute_steps(&cone, 1.0, 40.0);
    assert!(steps.len() > 20 && (steps.last().unwrap().to_mm - 22.0).abs() < 1e-9);
    for step in &steps {
        let radius = cone.radius_at_height_mm((step.from_mm + step.to_mm) / 2.0);
        assert!(step.from_mm == 0.0 || step.diameter_mm / 2.0 <= radius + 1e-9, "{step:?}");
    }
    assert!(ToolBeam::new(steps, 580.0).is_some());
}

fn model(teeth: &Teeth, direction: SpindleDirection) -> EdgeForceModel {
    let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 22.0).unwrap();
    EdgeForceModel::new(&profile, teeth, STEEL, direction).with_beam(Some(Arc::new(stepped())))
}

/// The mean of the tip's deflection for 1 N along an edge from the tip up to a height.
fn mean_give(depth: f64) -> f64 {
    let beam = stepped();
    let at = |number: i32| beam.deflection_mm_per_n(0.0, (f64::from(number) + 0.5) * depth / 400.0);
    (0..400).map(at).sum::<f64>() / 400.0
}

#[test]
fn a_slot_bends_its_tool_by_its_forces() {
    let depth = 6.0;
    let section = flank(depth, [-FRAC_PI_2, FRAC_PI_2]);
    // Straight edges press alike all along their height, so deflections are forces times one number.
    let straight = Teeth::evenly_spaced(3, 0.0).unwrap();
    let found = model(&straight, Clockwise).forces_of_section(&section, 600.0, RPM);
    let bending = found.bending.unwrap();
    close(bending.deflection_peak_mm, found.bending_peak_n * mean_give(depth), 1e-3);
    close(bending.deflection_mean_mm[0], -found.tool_mean_n[0] * mean_give(depth), 1e-3);
    close(bending.deflection_mean_mm[1], -found.tool_mean_n[1] * mean_give(depth), 1e-3);
    let stress = found.bending_peak_n * (37.0 - depth / 2.0) * 32.0 / (PI * 9.0_f64.powi(3));
    close(bending.stress_peak_mpa, stress, 1e-3);
    // With a helix the edge is nowhere as a whole; means are the same.
    let helix = Teeth::evenly_spaced(3, 0.6).unwrap();
    let turned = model(&helix, Clockwise).forces_of_section(&section, 600.0, RPM).bending.unwrap();
    close(turned.deflection_mean_mm[1], bending.deflection_mean_mm[1], 1e-3);
    assert!(turned.deflection_peak_mm < bending.deflection_peak_mm);
    // Without a beam nothing is told of it.
    let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 22.0).unwrap();
    let bare =
        EdgeForceModel::new(&profile, &helix, STEEL, Clockwise).forces_of_section(&section, 600.0, RPM);
    assert_eq!(bare.bending, None);
}

#[test]
fn a_straight_edge_leaves_what_its_edge_terms_press() {
    let (depth, tooth) = (4.0, Teeth::evenly_spaced(1, 0.0).unwrap());
    // At the side there is no chip: one tooth presses with its radial edge term, away from the wall.
    let wanted = STEEL.k_re * depth * mean_give(depth);
    for (direction, arc, side) in [
        (Clockwise, [0.0, FRAC_PI_2], 0),
        (Clockwise, [-FRAC_PI_2, 0.0], 1),
        (CounterClockwise, [0.0, FRAC_PI_2], 0),
    ] {
        let found = model(&tooth, direction).forces_of_section(&flank(depth, arc), 200.0, RPM);
        let walls = found.bending.unwrap().wall_error_mm;
        close(walls[side].unwrap(), wanted, 2e-3);
        assert_eq!(walls[1 - side], None, "the other side finishes nothing");
    }
}

#[test]
fn a_helix_leaves_what_presses_when_it_passes() {
    let teeth = Teeth::evenly_spaced(4, 0.6).unwrap();
    let (depth, arc) = (8.0, [-FRAC_PI_2, 0.3]);
    let section = flank(depth, arc);
    let model = model(&teeth, Clockwise);
    let found = model.forces_of_section(&section, 800.0, RPM);
    let count = 3600;
    let turns = model.forces_over_revolution(&section, 800.0, RPM, count);
    let (gives, lag) = (mean_give(depth), 0.6_f64.tan() / 5.0);
    // What all edges press to the left when the edge at a height passes the right side; where it acts is within the depth.
    let at = |height: f64| {
        let turned = (height * lag + FRAC_PI_2 - 1e-5).rem_euclid(2.0 * PI);
        turns[(turned / (2.0 * PI) * count as f64).round() as usize % count].1[1]
    };
    let forces: Vec<f64> = (0..5).map(|number| -at(depth * f64::from(number) / 4.0)).collect();
    let farthest = forces.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
    let error = found.bending.unwrap().wall_error_mm[1].unwrap();
    close(error, farthest * gives, 0.2);
    assert_eq!(found.bending.unwrap().wall_error_mm[0], None);
}
