//! Dovetails, T-slot cutters and lollipops: the volumes they take, what stays above them, what is refused.

use super::{codes, machine, near, nx, try_machine};
use clsmith::setup::Setup;
use clsmith::simulation_run::SimulationRunOptions;

/// A setup with a block of 60 mm along x whose top is at z = 0, and one tool.
fn setup(tool: &str) -> String {
    format!(
        "stock: {{ block: {{ from: [0, -30, -30], to: [60, 30, 0] }} }}\n\
         tools: [ {{ match: {{}}, teeth: 4, helix: 0, {tool} }} ]\n"
    )
}

const DOVETAIL: &str = "diameter: 20, corner_radius: 0, dovetail_angle: 45, tip: 0, flute_length: 6, shank: { diameter: 8, length: 40 }";
const T_SLOT: &str = "diameter: 16, corner_radius: 0, taper: 0, tip: 0, flute_length: 5, upper_corner_radius: 1, \
    shank: { diameter: 8, length: 40 }";
const LOLLIPOP: &str = "diameter: 10, corner_radius: 5, taper: 0, tip: 0, flute_length: 9.5, upper_corner_radius: 5, \
    shank: { diameter: 4, length: 40 }";

/// A pass along x through the whole block at a height of the tip.
fn pass(tip: f64) -> String {
    nx("16.0000,0.0000,60.0000,0.0000,0.0000", &format!("GOTO/-20.,0.,{tip:.4}\nGOTO/80.,0.,{tip:.4}\n"))
}

/// The area across the path that a pass takes, from the volume in a block of 60 mm.
fn area_mm2(tool: &str, tip: f64) -> f64 {
    let (cuts, ran) = machine(&pass(tip), &setup(tool), 0.1);
    assert_eq!(codes(&ran), [""; 0]);
    cuts.iter().map(|cut| cut.removed_mm3).sum::<f64>() / 60.0
}

#[test]
fn a_pass_takes_the_section_of_the_cutter() {
    let pi = std::f64::consts::PI;
    // Trapezoid; rectangle with two rounded corners; circle without the segment that the neck cuts off.
    near(area_mm2(DOVETAIL, -6.0), 6.0 * (20.0 + 8.0) / 2.0, 0.6);
    near(area_mm2(T_SLOT, -5.0), 16.0 * 5.0 - 2.0 * (1.0 - pi / 4.0), 0.6);
    let segment = 25.0 * 0.9_f64.acos() - 4.5 * (25.0_f64 - 20.25).sqrt();
    near(area_mm2(LOLLIPOP, -9.5), 25.0 * pi - segment, 0.6);
}

#[test]
fn what_is_above_the_cutter_stays_and_the_neck_meets_it() {
    // The T-slot runs 3 mm below the top: the neck needs a slot that nobody has cut.
    let (cuts, ran) = machine(&pass(-8.0), &setup(T_SLOT), 0.1);
    near(cuts.iter().map(|cut| cut.removed_mm3).sum::<f64>() / 60.0, 80.0 - 0.429, 0.6);
    assert_eq!(codes(&ran), ["CL0511"]);
    // Under a top at the cutter's own upper end nothing is met.
    let open = setup(T_SLOT).replace("to: [60, 30, 0]", "to: [60, 30, -3]");
    assert_eq!(codes(&machine(&pass(-8.0), &open, 0.1).1), [""; 0]);
}

/// The half width of the cutter at a height above its tip, by definition.
fn radius_at(tool: &str, z: f64) -> Option<f64> {
    match tool {
        _ if z < 0.0 => None,
        DOVETAIL => (z <= 6.0).then_some(10.0 - z),
        LOLLIPOP => (z <= 9.5).then(|| (25.0 - (z - 5.0) * (z - 5.0)).max(0.0).sqrt()),
        _ => None,
    }
}

#[test]
fn sloped_and_plunging_passes_agree_with_points_that_are_asked_one_by_one() {
    for tool in [DOVETAIL, LOLLIPOP] {
        for (from, to) in
            [([-15.0, -4.0, -14.0], [75.0, 6.0, -11.0]), ([-15.0, 2.0, -10.0], [75.0, 2.0, -16.0])]
        {
            let point = |[x, y, z]: [f64; 3]| format!("GOTO/{x:.4},{y:.4},{z:.4}\n");
            let text = nx("16.0000,0.0000,60.0000,0.0000,0.0000", &(point(from) + &point(to)));
            let removed: f64 = machine(&text, &setup(tool), 0.2).0.iter().map(|cut| cut.removed_mm3).sum();
            let step = 0.5;
            let mut inside = 0_usize;
            for index in 0..120 * 60 * 40 {
                let x = (f64::from(index % 120) + 0.5) * step;
                let y = (f64::from(index / 120 % 60) + 0.5) * step - 15.0;
                let z = (f64::from(index / 7200) + 0.5) * step - 20.0;
                // The tip passes within the cutter's radius of x only.
                let at = (x - from[0]) / (to[0] - from[0]);
                let cut = (-60..=60).any(|sample| {
                    let s = (at + f64::from(sample) / 60.0 * 11.0 / 90.0).clamp(0.0, 1.0);
                    let tip: [f64; 3] = std::array::from_fn(|axis| from[axis] + s * (to[axis] - from[axis]));
                    radius_at(tool, z - tip[2]).is_some_and(|radius| (x - tip[0]).hypot(y - tip[1]) <= radius)
                });
                inside += usize::from(cut);
            }
            let wanted = inside as f64 * step * step * step;
            near(removed, wanted, wanted * 0.015);
        }
    }
}

#[test]
fn a_taper_below_zero_in_the_file_is_a_dovetail() {
    let tool = "diameter: 20, flute_length: 6, shank: { diameter: 8, length: 40 }";
    let text = pass(-6.0).replace("TLDATA/MILL,16.0000,0.0000,60.0000,0.0000", "TLDATA/MILL,20.,0.,60.,-45.");
    let (cuts, _) = machine(&text, &setup(tool), 0.1);
    near(cuts.iter().map(|cut| cut.removed_mm3).sum::<f64>() / 60.0, 84.0, 0.6);
}

#[test]
fn a_tilted_dovetail_is_refused_at_its_motion() {
    let text = nx(
        "16.0000,0.0000,60.0000,0.0000,0.0000",
        "GOTO/-20.,0.,-6.\nGOTO/30.,0.,-6.,0.0995037,0.,0.9950372\n",
    );
    let found = try_machine(&text, &setup(DOVETAIL), SimulationRunOptions::default()).expect_err("tilted");
    assert_eq!(found[0].code.id(), "CL0529");
}

#[test]
fn shapes_that_cannot_be_are_refused() {
    let load = |tool: &str| Setup::load(&crate::support::text(setup(tool)));
    assert!(load("diameter: 20, taper: 5, dovetail_angle: 45, flute_length: 6").is_err());
    for tool in [
        "diameter: 20, dovetail_angle: 45, flute_length: 11",
        "diameter: 20, upper_corner_radius: 11, flute_length: 30",
        "diameter: 20, corner_radius: 4, upper_corner_radius: 4, flute_length: 7",
    ] {
        let found = try_machine(&pass(-6.0), &setup(tool), SimulationRunOptions::default()).expect_err(tool);
        assert!(found.iter().any(|found| found.is_error()), "{tool}");
    }
}

/// A pass with an NX tool and a setup that says nothing of its shape.
fn area_of_told_mm2(told: &str, tip: f64) -> f64 {
    let setup =
        "stock: { block: { from: [0, -30, -30], to: [60, 30, 0] } }\ntools: [ { match: {}, teeth: 2 } ]\n";
    let (cuts, ran) =
        machine(&nx(told, &format!("GOTO/-20.,0.,{tip:.4}\nGOTO/80.,0.,{tip:.4}\n")), setup, 0.1);
    assert_eq!(codes(&ran), [""; 0], "{told}");
    cuts.iter().map(|cut| cut.removed_mm3).sum::<f64>() / 60.0
}

#[test]
fn the_numbers_of_the_file_make_undercut_cutters() {
    let pi = std::f64::consts::PI;
    // Ten parameters: the upper radius and its centre stand behind the lower ones.
    let ball = "10.0000,5.0000,60.0000,0.0000,0.0000,0.0000,5.0000,5.0000,0.0000,5.0000";
    near(area_of_told_mm2(ball, -12.0), 25.0 * pi, 0.8);
    let slot = "20.0000,1.0000,60.0000,0.0000,0.0000,9.0000,1.0000,1.0000,9.0000,5.0000";
    near(area_of_told_mm2(slot, -12.0), 20.0 * 6.0 - 4.0 * (1.0 - pi / 4.0), 0.8);
}
