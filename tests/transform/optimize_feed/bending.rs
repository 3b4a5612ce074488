//! Deflection and bending stress as limits, and limits that the error of a fit lowers.

use super::step::{feeds, program, snapshot};
use crate::transform::try_apply;
use clsmith::certified_engagement::{ContactSection, ContourElement, SectionRow};
use clsmith::cutter::{BeamStep, Meridian, Teeth, ToolBeam};
use clsmith::engagement::{CuttingCoefficients, EdgeForceModel, ToolBending};
use clsmith::program::record::SpindleDirection;
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// One pass through 100 mm of a block, 3 mm deep.
const PASS: &str = "FEDRAT/MMPM,500.0000\nGOTO/110.0000,0.0000,-3.0000\n";
const STIFF: &str = "stick_out: 50, tool_material: carbide, shank: { diameter: 10, length: 70 }";

fn recipe(tool: &str, material: &str, step: &str) -> String {
    format!(
        "version: 1\n\
         setup:\n\
         \x20 stock: {{ block: {{ from: [0, -30, -20], to: [100, 30, 0] }} }}\n\
         \x20 tools: [ {{ match: {{}}, teeth: 4, helix: 30, flute_length: 30, {tool} }} ]\n\
         \x20 material: {{ {material} }}\n\
         steps:\n\
         \x20 - optimize_feed: {{ {step} }}\n"
    )
}

fn feed_of(step: &str) -> f64 {
    let (text, findings) = try_apply(&recipe(STIFF, "k_tc: 2000, residual: 0.25", step), program(PASS))
        .unwrap_or_else(|found| panic!("{found:?}"));
    assert!(findings.iter().all(|found| !found.is_error()), "{findings:?}");
    feeds(&text)[0]
}

/// How the tool bends in the slot at a feed.
fn bending_at(feed: f64) -> ToolBending {
    let element = ContourElement::Line { from: [5.0, 0.0], to: [5.0, 3.0], normal: [1.0, 0.0] };
    let section = ContactSection {
        rows: vec![SectionRow { element, range: [0.0, 1.0], arcs: vec![[-FRAC_PI_2, FRAC_PI_2]] }],
        frame: [Vector3::x(), Vector3::y(), Vector3::z()],
        has_heading: true,
        tip_speed: [1.0, 0.0],
        spin: [0.0; 2],
    };
    let steps = vec![
        BeamStep { from_mm: 0.0, to_mm: 30.0, diameter_mm: 8.0 },
        BeamStep { from_mm: 30.0, to_mm: 50.0, diameter_mm: 10.0 },
    ];
    let beam = ToolBeam::new(steps, 580.0).map(Arc::new);
    let steel =
        CuttingCoefficients { k_tc: 2000.0, k_te: 0.0, k_rc: 600.0, k_re: 0.0, k_ac: 400.0, k_ae: 0.0 };
    let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 30.0).unwrap();
    let teeth = Teeth::evenly_spaced(4, 30.0_f64.to_radians()).unwrap();
    let model = EdgeForceModel::new(&profile, &teeth, steel, SpindleDirection::Clockwise).with_beam(beam);
    model.forces_of_section(&section, feed, 5000.0).bending.unwrap()
}

#[test]
fn no_feed_bends_the_tool_more_than_asked() {
    // Columns are an estimate: they look at rotations 3 degrees apart, and may miss 4e-4 of a peak.
    for (engagement, over) in [("certified", 1.0), ("columns", 1.0004)] {
        let common = format!("max_feed: 9000, cell: 0.25, engagement: {engagement}");
        let deflection = feed_of(&format!("criterion: deflection, target: 0.02, {common}"));
        let found = bending_at(deflection).deflection_peak_mm;
        assert!((0.02 * 0.75..=0.02 * over).contains(&found), "{engagement}: {found} at {deflection}");
        let stress = feed_of(&format!("criterion: bending_stress, target: 300, {common}"));
        let found = bending_at(stress).stress_peak_mpa;
        assert!((300.0 * 0.75..=300.0 * over).contains(&found), "{engagement}: {found} at {stress}");
        let both = feed_of(&format!(
            "target: 1, limits: [ {{ criterion: deflection, target: 0.02 }}, {{ criterion: bending_stress, target: 300 }} ], {common}"
        ));
        assert_eq!(both, deflection.min(stress));
    }
}

#[test]
fn the_error_of_the_fit_lowers_limits_of_forces_alone() {
    let plain = feed_of("criterion: deflection, target: 0.02, max_feed: 9000, cell: 0.25");
    let wide =
        feed_of("criterion: deflection, target: 0.02, fit_error_margin: true, max_feed: 9000, cell: 0.25");
    // Without edge terms deflection is proportional to the feed.
    assert!((plain / wide - 1.25).abs() < 0.01, "{plain} {wide}");
    let chip = "target: 0.05, limits: [ { criterion: force, target: 100000 } ], max_feed: 9000, cell: 0.25";
    assert_eq!(feed_of(chip), feed_of(&format!("{chip}, fit_error_margin: true")));
}

#[test]
fn what_is_missing_is_said_at_the_key() {
    let text = program(PASS);
    let step = "criterion: deflection, target: 0.02, max_feed: 9000";
    snapshot("deflection_without_stiffness", &recipe("corner_radius: 0", "k_tc: 2000", step), &text);
    let step = "criterion: force, target: 300, fit_error_margin: true, max_feed: 9000";
    snapshot("margin_without_error", &recipe(STIFF, "k_tc: 2000", step), &text);
    let step = "target: 0.05, fit_error_margin: true, max_feed: 9000";
    snapshot("margin_without_force", &recipe(STIFF, "k_tc: 2000, residual: 0.1", step), &text);
}
