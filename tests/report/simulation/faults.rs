//! What is missing or wrong is a finding with its place.

use super::{SHOP, SLOT, close, setup, simulate};
use crate::support::{program, snapshots};
use clsmith::diagnostic::{Diagnostic, Failure, Severity};
use clsmith::program::LengthUnit;
use clsmith::report::render::line;
use clsmith::report::simulation::SimulationReport;
use clsmith::simulation_run::{Machining, RunWatcher, SilentWatcher, SimulationRunOptions};

fn told(found: &[Diagnostic]) -> String {
    let mut out = Vec::new();
    line::render_lines(&mut out, found, None).unwrap();
    String::from_utf8(out).unwrap()
}

fn findings(text: &str, shop: &str) -> Vec<Diagnostic> {
    match simulate(text, shop, LengthUnit::Mm) {
        Ok(found) => found.findings,
        Err(found) => found,
    }
}

#[test]
fn bad_input_is_told_with_its_place() {
    let spindle = "SPINDL/RPM,4000.0000,CLW";
    let per_turn = SLOT.replace("MMPM,800.0000", "MMPR,0.2000");
    let cases = [
        ("no stock", findings(SLOT, "machine: {}\n")),
        ("no tool", findings(&SLOT.replace("TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\n", ""), SHOP)),
        ("no teeth", findings(SLOT, &SHOP.replace("    teeth: 4\n", ""))),
        ("spindle of zero", findings(&SLOT.replace("4000.0000", "0.0000"), SHOP)),
        ("no spindle", findings(&SLOT.replace(&format!("{spindle}\n"), ""), SHOP)),
        ("no feed", findings(&SLOT.replace("FEDRAT/MMPM,800.0000\n", ""), SHOP)),
        ("feed of zero", findings(&SLOT.replace("MMPM,800.0000", "MMPM,0.0000"), SHOP)),
        ("per revolution", findings(&per_turn.replace(spindle, "SPINDL/SMM,100.0000,CLW"), SHOP)),
    ];
    let text: String = cases.iter().map(|(what, found)| format!("{what}:\n{}", told(found))).collect();
    snapshots("report").bind(|| insta::assert_snapshot!("simulation_faults", text));
}

#[test]
fn missing_teeth_are_a_warning_and_leave_cells_empty() {
    let found = simulate(SLOT, &SHOP.replace("    teeth: 4\n", ""), LengthUnit::Mm).unwrap();
    let severities: Vec<Severity> = found.findings.iter().map(|found| found.severity).collect();
    assert_eq!(severities, [Severity::Warning]);
    let row = &found.motions.rows[2];
    assert_eq!((row.chip_thickness_mm, row.force_n), (None, None));
    close(row.removal_rate_mm3_min, 16_000.0, 1.0);
}

#[test]
fn a_feed_per_revolution_is_known_with_the_speed() {
    let found = simulate(&SLOT.replace("MMPM,800.0000", "MMPR,0.2000"), SHOP, LengthUnit::Mm).unwrap();
    assert!(found.findings.is_empty());
    close(found.motions.rows[2].feed_mm_min, 800.0, 1e-9);
}

#[test]
fn rapids_have_no_feed_unless_the_machine_is_known() {
    let found = simulate(SLOT, &SHOP.replace("rapid_feed: 10000,", ""), LengthUnit::Mm).unwrap();
    assert_eq!((found.motions.rows[0].feed_mm_min, found.totals.rapid_seconds), (None, None));
    assert_eq!(found.motions.rows[0].chip_thickness_mm, Some(0.0));
}

#[test]
fn collisions_and_rapids_through_material_are_counted() {
    let short = SHOP.replace("flute_length: 20", "flute_length: 1\n    shank: { diameter: 10, length: 50 }");
    let found = simulate(SLOT, &short, LengthUnit::Mm).unwrap();
    assert_eq!(found.faults.collisions, 4);
    let rapid = SLOT.replace("GOTO/20.0000,20.0000,-2.0000", "RAPID\nGOTO/20.0000,20.0000,-2.0000");
    let found = simulate(&rapid, SHOP, LengthUnit::Mm).unwrap();
    assert_eq!((found.faults.rapids_in_material, found.findings[0].code.id()), (1, "CL0510"));
}

#[test]
fn a_run_that_costs_too_much_proposes_a_cell_that_fits() {
    let (program, setup) = (program(SLOT), setup(SHOP));
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let run = |cell: f64| {
        SimulationReport::simulate_program(
            &machining,
            &SimulationRunOptions::default().with_cell_mm(cell),
            &SilentWatcher,
        )
        .unwrap_err()
        .into_findings()
    };
    snapshots("report").bind(|| {
        insta::assert_snapshot!("simulation_cost", told(&[run(0.001), run(3.0)].concat()));
    });
}

#[test]
fn a_stopped_run_gives_nothing() {
    struct Stop;
    impl RunWatcher for Stop {
        fn report_progress(&self, _: f64, _: f64) {}
        fn is_stop_requested(&self) -> bool {
            true
        }
    }
    let (program, setup) = (program(SLOT), setup(SHOP));
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let stopped = SimulationReport::simulate_program(&machining, &SimulationRunOptions::default(), &Stop);
    assert!(matches!(stopped, Err(Failure::Interrupted)), "{stopped:?}");
}
