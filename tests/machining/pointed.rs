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
        // A flat cone, whose width at the end of its flutes is a hundred millimetres and more.
        let flat = 60.0 * depth * depth * 60_f64.to_radians().tan();
        near(groove_mm3("0.0000,0.0000,50.0000,60.0000,0.0000", depth), flat, 0.02 * flat);
        let tip = 60.0 * depth * (0.1 + depth * 30_f64.to_radians().tan());
        near(groove_mm3("0.1000,0.0000,50.0000,30.0000,0.0000", depth), tip, 0.02 * tip);
    }
}

/// APT measures the diameter of a cone with a ball where the lines of bottom and flank meet, so it is less than the ball's.
#[test]
fn a_cone_with_a_ball_at_its_tip_has_its_volume() {
    let taper = 5_f64.to_radians();
    let (radius, depth) = (1.0, 4.0);
    let meeting = radius * (1.0 - taper.sin()) / taper.cos();
    // The ball up to where the flank touches it, then the flank.
    let touch = radius * (1.0 - taper.sin());
    let ball = (0..100_000).map(|step| (f64::from(step) + 0.5) / 100_000.0 * touch);
    let ball: f64 =
        ball.map(|z| 2.0 * (radius * radius - (radius - z).powi(2)).sqrt() * touch / 100_000.0).sum();
    let flank = (depth - touch) * (2.0 * meeting + (depth + touch) * taper.tan());
    let wanted = 60.0 * (ball + flank);
    let told = format!("{:.4},1.0000,50.0000,5.0000,0.0000", 2.0 * meeting);
    near(groove_mm3(&told, depth), wanted, 0.015 * wanted);
    let text = nx(&told, "GOTO/0.,0.,-4.\nGOTO/60.,0.,-4.\n");
    let (_, found) = clsmith::check::read_and_check(&crate::support::text(&text), None);
    assert!(found.iter().all(|found| found.code.to_string() != "CL0133"), "{found:?}");
    // A ball that is larger still is none of this flank.
    let larger = text.replace("1.8327,1.0000", "1.8327,1.1000");
    assert_ne!(larger, text);
    let (_, found) = clsmith::check::read_and_check(&crate::support::text(&larger), None);
    assert!(found.iter().any(|found| found.code.to_string() == "CL0133"), "{found:?}");
}
