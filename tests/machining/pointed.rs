//! Shallow grooves of pointed cutters, whose width is a small part of the cutter's.

use super::{codes, near, nx, try_machine};
use clsmith::simulation_run::SimulationRunOptions;

/// The volume of a groove through a block of 60 mm, with the columns that are chosen for it.
fn groove_mm3(data: &str, depth: f64) -> f64 {
    let setup =
        "stock: { block: { from: [0, -30, -25], to: [60, 30, 0] } }\ntools: [ { match: {}, teeth: 2 } ]\n";
    let text = nx(data, &format!("GOTO/-60.,0.,{:.4}\nGOTO/120.,0.,{:.4}\n", -depth, -depth));
    let (cuts, ran) = try_machine(&text, setup, SimulationRunOptions::default()).unwrap();
    assert_eq!(codes(&ran), [""; 0]);
    cuts.iter().map(|cut| cut.removed_mm3).sum()
}

/// The section of a cone's groove is its depth squared times the tangent of half its angle.
#[test]
fn shallow_grooves_have_their_volume_whatever_the_width_of_the_cutter() {
    for depth in [0.2, 0.5, 1.0, 3.0] {
        // Cones as tapers, as a bottom, and with a small flat tip.
        near(
            groove_mm3("0.0000,0.0000,50.0000,45.0000,0.0000", depth),
            60.0 * depth * depth,
            0.02 * 60.0 * depth * depth,
        );
        near(
            groove_mm3("20.0000,0.0000,50.0000,0.0000,45.0000", depth),
            60.0 * depth * depth,
            0.02 * 60.0 * depth * depth,
        );
        let tip = 60.0 * depth * (0.1 + depth * 30_f64.to_radians().tan());
        near(groove_mm3("0.1000,0.0000,50.0000,30.0000,0.0000", depth), tip, 0.02 * tip);
    }
}
