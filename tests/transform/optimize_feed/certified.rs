//! Feeds whose bounds come from the motions themselves: what columns miss does not pass the target.

use super::step::{corrected, feeds, program, recipe};
use crate::certified_engagement::cases::{keyed, split_row};
use crate::support::require_shared_folder;
use crate::transform::try_apply;
use clsmith::parse::parse;
use clsmith::program::LengthUnit;
use clsmith::report::DisplayUnits;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, run_recipe};

/// A finishing pass that takes 0.05 mm of a wall beside a pass that was cut before, with a flat mill of 10 mm.
const THIN: &str = "FEDRAT/MMPM,500.0000\nGOTO/110.0000,0.0000,-3.0000\nRAPID\nGOTO/110.0000,0.0000,5.0000\nRAPID\n\
    GOTO/-10.0000,0.0500,5.0000\nRAPID\nGOTO/-10.0000,0.0500,-3.0000\nFEDRAT/MMPM,500.0000\nGOTO/110.0000,0.0500,-3.0000\n";

#[test]
fn a_cut_that_is_thinner_than_a_column_is_bounded() {
    let done = corrected("target: 0.02, max_feed: 9000, cell: 0.25", &program(THIN));
    let told = feeds(&done);
    assert_eq!(told[0], 0.02 * 4.0 * 5000.0, "a full slot");
    // The flank cuts where it is beyond the wall that the slot has left: at heights of sin(angle) above 1 - e / R over
    // the middle, so the share there is at most the cosine of that angle.
    let share = (1.0 - (1.0_f64 - 0.05 / 5.0).powi(2)).sqrt();
    let largest = 0.02 * 4.0 * 5000.0 / share;
    let last = told[told.len() - 1];
    assert!(last <= largest && last > 0.98 * largest, "{last} of {largest}");
}

#[test]
fn a_stock_of_a_mesh_is_certified_too() {
    let folder = tempfile::tempdir().unwrap();
    let stl = box_stl([0.0, -30.0, -20.0], [100.0, 30.0, 0.0]);
    std::fs::write(folder.path().join("stock.stl"), stl).unwrap();
    let text = program("FEDRAT/MMPM,500.0000\nGOTO/110.0000,0.0000,-3.0000\n");
    let mesh = format!("stl: {:?}", folder.path().join("stock.stl"));
    let recipe = recipe("target: 0.06, max_feed: 9000, cell: 0.5")
        .replace("block: { from: [0, -30, -20], to: [100, 30, 0] }", &mesh);
    let (done, found) = try_apply(&recipe, &text).unwrap_or_else(|found| panic!("{found:?}"));
    assert!(found.iter().all(|found| found.code.to_string() != "CL0531"), "{found:?}");
    assert_eq!(feeds(&done), [1200.0]);
}

/// The ASCII STL of a box.
fn box_stl(low: [f64; 3], high: [f64; 3]) -> String {
    let at = |number: usize| -> Vec<String> {
        (0..3).map(|axis| if number >> axis & 1 == 1 { high[axis] } else { low[axis] }.to_string()).collect()
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let facet = |corners: [usize; 3]| {
        let vertices: String = corners.map(|corner| format!("vertex {}\n", at(corner).join(" "))).concat();
        format!("facet normal 0 0 0\nouter loop\n{vertices}endloop\nendfacet\n")
    };
    let facets: String =
        faces.iter().map(|[a, b, c, d]| facet([*a, *b, *c]) + &facet([*a, *c, *d])).collect();
    format!("solid box\n{facets}endsolid box\n")
}

/// What the step reports.
fn report(step: &str) -> String {
    let recipe = Recipe::load(&Source::new("recipe.yaml", recipe(step).into_bytes()).unwrap()).unwrap();
    let source = Source::new("part.cls", program(THIN).into_bytes()).unwrap();
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    let outcome = run_recipe(&recipe, &setup, clsmith::parse::parse(&source, None).program).unwrap();
    outcome.reports.iter().map(|report| report.to_text(DisplayUnits::MM)).collect()
}

#[test]
fn bounds_are_tested_at_points_and_the_report_says_so() {
    let certified = report("target: 0.06, max_feed: 9000");
    assert!(certified.contains("bounded from the motions themselves: no chip is more than"), "{certified}");
    assert!(
        certified.contains("of 216 points that were tested the thickest chip has")
            && certified.contains("none is above its bound"),
        "{certified}"
    );
    let columns = report("target: 0.06, max_feed: 9000, engagement: columns");
    assert!(!columns.contains("tested at") && columns.contains("for the grid"), "{columns}");
}

/// The shares of the shared cases are known by other means: at the feeds of the step no chip is thicker than the target, and
/// none is thinner than it had to be.
#[test]
fn the_shared_cases_run_at_their_target() {
    let Some(folder) = require_shared_folder("cases/engagement") else { return };
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    let target = 0.05;
    let step = format!(
        "version: 1\nunits: mm\nsteps:\n  - optimize_feed: {{ target: {target}, max_feed: 100000, min_change: 0, \
         round_down_to: 0, motions: [cut, engage, step_over, approach, retract] }}\n"
    );
    let recipe = Recipe::load(&Source::new("recipe.yaml", step.into_bytes()).unwrap()).unwrap();
    let mut rows = 0;
    for row in read("values.csv").lines().skip(1) {
        let fields = split_row(row);
        let (file, line, share) =
            (&fields[0], fields[1].parse::<usize>().unwrap(), fields[3].parse::<f64>().unwrap());
        let shop = read(&file.replace(".cls", ".yaml"));
        let setup = Setup::load(&Source::new("shop.yaml", shop.clone().into_bytes()).unwrap()).unwrap();
        let source = Source::new(file.clone(), read(file).into_bytes()).unwrap();
        let outcome = run_recipe(&recipe, &setup, parse(&source, None).program).unwrap();
        let program = outcome.program;
        let at_line = |at: u32| source.line_column(at).0 == line;
        let motion = program
            .motions()
            .find(|motion| at_line(program.statement(motion.last_statement()).origin().start))
            .unwrap();
        let rpm = motion.spindle_rpm().unwrap();
        let length = Some(motion.length());
        let feed = motion.feed.unwrap().mm_per_minute(LengthUnit::Mm, Some(rpm), length).unwrap();
        let chip = feed * share / rpm / keyed(&shop, "teeth:");
        if share > 0.0 && feed < 100_000.0 {
            // The table prints four decimals.
            assert!(chip <= target * 1.0005, "{file}:{line}: {chip}");
            assert!(chip >= target * 0.98, "{file}:{line}: {chip}");
            rows += 1;
        }
    }
    assert!(rows >= 15, "only {rows} rows were told");
}
