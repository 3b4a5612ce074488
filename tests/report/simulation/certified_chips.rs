//! Chips of a report that are proved from the motions, where columns are blind, and where a step knows them already.

use clsmith::parse::parse;
use clsmith::program::LengthUnit;
use clsmith::report::simulation::SimulationReport;
use clsmith::setup::Setup;
use clsmith::simulation_run::{KnownShares, Machining, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;
use clsmith::transform::optimize_feed::OptimizeFeedReport;
use clsmith::transform::{Recipe, run_recipe};

const SHOP: &str = "stock: { block: { from: [0, -30, -20], to: [100, 30, 0] } }\n\
    tools: [ { match: {}, diameter: 10, flute_length: 30, teeth: 4 } ]\n";

/// A slot, and a finishing pass that takes 0.05 mm of its wall.
const THIN: &str = "LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-10.0000,0.0000,-3.0000\nFEDRAT/MMPM,400.0000\n\
    GOTO/110.0000,0.0000,-3.0000\nRAPID\nGOTO/110.0000,0.0000,5.0000\nRAPID\nGOTO/-10.0000,0.0500,5.0000\nRAPID\n\
    GOTO/-10.0000,0.0500,-3.0000\nFEDRAT/MMPM,1000.0000\nGOTO/110.0000,0.0500,-3.0000\n";

fn simulate(text: &[u8], known: &KnownShares) -> SimulationReport {
    let setup = Setup::load(&Source::new("shop.yaml", SHOP.into()).unwrap()).unwrap();
    let program = parse(&Source::new("part.cls", text.to_vec()).unwrap(), None).program;
    let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new()).unwrap();
    let options = SimulationRunOptions::default().with_cell_mm(0.5);
    let mut report = SimulationReport::simulate_program(&machining, &options, &SilentWatcher).unwrap();
    assert!(report.chips.is_none(), "nobody has asked");
    report.certify_chips(&machining, known, &SilentWatcher).unwrap();
    report
}

#[test]
fn a_cut_thinner_than_a_column_has_its_chip() {
    let report = simulate(THIN.as_bytes(), &KnownShares::default());
    // The flank cuts where it is beyond the wall: the share is the cosine of the angle whose sine is 1 - e / R.
    let share = (1.0 - (1.0_f64 - 0.05 / 5.0).powi(2)).sqrt();
    let truth = share * 1000.0 / 5000.0 / 4.0;
    let last = report.motions.rows.last().unwrap();
    let (lower, upper) = (last.chip_thickness_mm.unwrap(), last.chip_thickness_bound_mm.unwrap());
    assert!(lower <= truth * (1.0 + 1e-6) && upper >= truth * (1.0 - 1e-6), "{lower} {truth} {upper}");
    assert!(upper <= lower * 1.02, "{lower} {upper}");
    // The slot's chip is 0.02 mm, so the sums tell it as the thickest.
    let slot = report.totals.chip_thickness_bound_mm.unwrap();
    assert!((slot.value - 0.02).abs() < 2e-4 && slot.line == Some(6), "{slot:?}");
    assert_eq!(report.operations[0].sums.chip_thickness_bound_mm, Some(slot));
    let chips = report.chips.unwrap();
    assert_eq!((chips.certified, chips.by_columns), (2, 0));
    let told = clsmith::report::simulation::to_text(&report);
    assert!(told.contains("chips are proved from the motions"), "{told}");
}

#[test]
fn a_report_tells_the_chips_of_the_step_that_wrote_the_feeds() {
    let recipe = format!(
        "version: 1\nunits: mm\nsetup:\n  {}\nsteps:\n  - optimize_feed: {{ target: 0.04, max_feed: 9000, cell: 0.5 }}\n",
        SHOP.trim_end().replace('\n', "\n  ")
    );
    let recipe = Recipe::load(&Source::new("recipe.yaml", recipe.into_bytes()).unwrap()).unwrap();
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    let program = parse(&Source::new("part.cls", THIN.into()).unwrap(), None).program;
    let outcome = run_recipe(&recipe, &setup, program).unwrap();
    let told = outcome.reports[0].downcast_ref::<OptimizeFeedReport>().unwrap().whole.largest_after;
    let report = simulate(&outcome.program.to_bytes(), &outcome.shares);
    let chip = report.totals.chip_thickness_mm.unwrap().value;
    assert!((chip - told).abs() < 1e-12, "{chip} is told, {told} by the step");
    assert!(report.totals.chip_thickness_bound_mm.unwrap().value <= 0.04 * (1.0 + 1e-12));
}
