//! Whole motions with known answers.

use super::{SETUP, codes, machine, near, nx, try_machine};
use clsmith::simulation_run::SimulationRunOptions;
use std::f64::consts::PI;

const FLAT: &str = "10.0000,0.0000,75.0000,0.0000,0.0000";
const BALL: &str = "10.0000,5.0000,75.0000,0.0000,0.0000";

#[test]
fn an_arc_mills_a_ring() {
    // A full circle of 12 mm radius about (50, 0), 3 mm deep, entered by a plunge.
    let body = "RAPID\nGOTO/62.0000,0.0000,5.0000\nGOTO/62.0000,0.0000,-3.0000\n\
        CIRCLE/50.0000,0.0000,-3.0000,0.0000000,0.0000000,1.0000000,12.0000,0.0600,0.5000,10.0000,0.0000\n\
        GOTO/62.0000,0.0000,-3.0000\nGOTO/62.0000,0.0000,5.0000\n";
    let (found, ran) = machine(&nx(FLAT, body), SETUP, 0.1);
    let ring = PI * (17.0_f64.powi(2) - 7.0_f64.powi(2)) * 3.0;
    let plunge = PI * 25.0 * 3.0;
    near(found[0].removed_mm3, plunge, 0.01 * plunge);
    near(found[0].removed_mm3 + found[1].removed_mm3, ring, 0.005 * ring);
    near(found[1].max_advance_ratio(), 1.0, 1e-3);
    near(ran.before_mm3 - ran.left.volume_mm3(), ring, 0.005 * ring);
    assert!(!found[2].has_removed_material(), "the way out of the hole is free");
    assert!(codes(&ran).is_empty(), "{:?}", ran.findings);
}

#[test]
fn a_helix_ends_as_deep_as_its_end() {
    let body = "RAPID\nGOTO/62.0000,0.0000,0.0000\n\
        CIRCLE/50.0000,0.0000,-2.0000,0.0000000,0.0000000,1.0000000,12.0000,0.0600,0.5000,10.0000,0.0000\n\
        GOTO/62.0000,0.0000,-2.0000\n\
        CIRCLE/50.0000,0.0000,-2.0000,0.0000000,0.0000000,1.0000000,12.0000,0.0600,0.5000,10.0000,0.0000\n\
        GOTO/62.0000,0.0000,-2.0000\n";
    let (found, ran) = machine(&nx(FLAT, body), SETUP, 0.1);
    let ring = PI * (17.0_f64.powi(2) - 7.0_f64.powi(2)) * 2.0;
    near(ran.before_mm3 - ran.left.volume_mm3(), ring, 0.005 * ring);
    // Descending 2 mm over the turn, the wall cuts the slope's cosine of the feed.
    let slope = (2.0 / (2.0 * PI * 12.0_f64)).atan();
    near(found[0].max_advance_ratio(), slope.cos(), 2e-3);
}

#[test]
fn holes_of_a_cycle_are_drilled() {
    let body = "CYCLE/DRILL,RAPTO,3.0000,FEDTO,-12.0000,MMPM,420.0000\nGOTO/20.0000,0.0000,0.0000\n\
        GOTO/50.0000,0.0000,0.0000\nCYCLE/OFF\n";
    let text = nx(FLAT, body).replace(
        "TLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000",
        "TLDATA/DRILL,MILL,8.0000,0.0000,120.0000,118.0000,60.0000",
    );
    let (found, ran) = machine(&text, &SETUP.replace(", flute_length: 40", ""), 0.1);
    let cone = 4.0 * 31.0_f64.to_radians().tan();
    let hole = PI * 16.0 * (12.0 - cone + cone / 3.0);
    near(ran.before_mm3 - ran.left.volume_mm3(), 2.0 * hole, 0.02 * hole);
    near(
        found.iter().map(|found| found.max_advance_ratio()).fold(0.0, f64::max),
        31f64.to_radians().cos(),
        1e-3,
    );
}

#[test]
fn the_same_part_in_another_frame() {
    let body = "GOTO/-8.0000,0.0000,-3.0000\nGOTO/50.0000,5.0000,-4.0000\n";
    let (plain, _) = machine(&nx(BALL, body), SETUP, 0.25);
    // A second path in a frame turned by 90 degrees about z and moved: the same places, printed otherwise.
    let turned = "GOTO/0.0000,8.0000,-3.0000\nGOTO/5.0000,-50.0000,-4.0000\n";
    let second = nx(BALL, turned)
        .replace(
            "1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000",
            "0.0000000,1.0000000,0.0000000,-1.0000000,0.0000000,0.0000000",
        )
        .replace("GOTO/-20.0000,0.0000,10.0000", "GOTO/0.0000,20.0000,10.0000");
    let first = nx(BALL, "");
    let (found, _) = machine(&format!("{first}{second}"), SETUP, 0.25);
    let sum =
        |found: &[clsmith::engagement::Engagement]| found.iter().map(|found| found.removed_mm3).sum::<f64>();
    assert!(sum(&plain) > 100.0);
    near(sum(&found), sum(&plain), 0.01 * sum(&plain));
}

#[test]
fn an_inner_corner_is_a_peak() {
    // Along a wall with 1 mm of stock, into a corner where another wall stands.
    let setup = SETUP.replace("block: { from: [0, -30, -20], to: [100, 30, 0] }", "bodies: [ { block: { from: [0, 5, -20], to: [60, 6, 0] } }, { block: { from: [59, -30, -20], to: [60, 30, 0] } } ]");
    let body = "GOTO/-20.0000,1.0000,-5.0000\nGOTO/40.0000,1.0000,-5.0000\nGOTO/55.0000,1.0000,-5.0000\n";
    let (found, _) = machine(&nx(FLAT, body), &setup, 0.1);
    let along = 2.0 * (0.1_f64 * 0.9).sqrt();
    near(found[1].max_advance_ratio(), along, 0.04);
    near(found[2].max_advance_ratio(), 1.0, 1e-3);
}

#[test]
fn stepped_stock_changes_the_depth_and_not_the_share() {
    let setup = SETUP.replace("block: { from: [0, -30, -20], to: [100, 30, 0] }", "bodies: [ { block: { from: [0, -30, -20], to: [50, 30, -2] } }, { block: { from: [50, -30, -20], to: [100, 30, 0] } } ]");
    let body = "GOTO/-20.0000,0.0000,-5.0000\nGOTO/40.0000,0.0000,-5.0000\nGOTO/110.0000,0.0000,-5.0000\n";
    let (found, _) = machine(&nx(FLAT, body), &setup, 0.25);
    near(found[1].axial_depth_mm(), 3.0, 1e-3);
    near(found[2].axial_depth_mm(), 5.0, 1e-3);
    near(found[1].max_advance_ratio(), 1.0, 1e-3);
}

#[test]
fn finer_cells_come_closer() {
    let body = "GOTO/-20.0000,-28.3000,-4.0000\nGOTO/110.0000,-27.1000,-4.0000\n";
    let wanted = |cell: f64| machine(&nx(BALL, body), SETUP, cell).0[1].removed_mm3;
    // The ground's border runs slanted through the cells.
    let exact = wanted(0.02);
    let errors = [0.8, 0.4, 0.1].map(|cell| (wanted(cell) - exact).abs() / exact);
    assert!(errors[2] < 2e-3 && errors[0] < 0.05, "{errors:?}");
}

#[test]
fn crashes_have_their_places() {
    let rapid = nx(FLAT, "RAPID\nGOTO/50.0000,0.0000,-5.0000\nRAPID\nGOTO/50.0000,0.0000,10.0000\n");
    let (_, ran) = machine(&rapid, SETUP, 0.25);
    assert_eq!(codes(&ran), ["CL0510"]);
    let stands = nx(FLAT, "GOTO/-8.0000,0.0000,-3.0000\nGOTO/50.0000,0.0000,-3.0000\n")
        .replace("SPINDL/RPM,5000,CLW\n", "");
    let (_, ran) = machine(&stands, SETUP, 0.25);
    assert_eq!(codes(&ran), ["CL0512"]);
    let short = SETUP.replace("flute_length: 40", "flute_length: 6, shank: { diameter: 12, length: 60 }");
    let deep = nx(FLAT, "GOTO/-8.0000,0.0000,-9.0000\nGOTO/50.0000,0.0000,-9.0000\n");
    let (_, ran) = machine(&deep, &short, 0.25);
    assert_eq!(codes(&ran), ["CL0511"]);
    assert!(ran.findings[0].message.starts_with("the shank stands 3.00 mm deep"), "{:?}", ran.findings);
}

#[test]
fn an_allowance_is_material() {
    let above = nx(FLAT, "GOTO/-20.0000,0.0000,0.5000\nGOTO/110.0000,0.0000,0.5000\n");
    let (found, _) = machine(&above, SETUP, 0.25);
    assert!(found.iter().all(|found| !found.has_removed_material()));
    let grown = SETUP.replace("[100, 30, 0] } }", "[100, 30, 0] }, allowance: 1 }");
    let (found, _) = machine(&above, &grown, 0.25);
    near(found[1].axial_depth_mm(), 0.5, 1e-3);
}

#[test]
fn too_much_is_refused_before_it_begins() {
    let text = nx(FLAT, "GOTO/110.0000,0.0000,-3.0000\n");
    let with = |cell: f64| try_machine(&text, SETUP, SimulationRunOptions::default().with_cell_mm(cell));
    assert_eq!(with(0.0005).unwrap_err()[0].code.id(), "CL0514");
    assert_eq!(with(2.0).unwrap_err()[0].code.id(), "CL0513");
}
