//! The time on the machine, in all outputs alike: tool changes, starts of the spindle, dwells, also those in holes, and
//! the axes of charts.

use super::html::told;
use super::simulation::{setup, simulate};
use crate::support::program;
use clsmith::machine::time_program;
use clsmith::program::LengthUnit;
use clsmith::report::DisplayUnits;
use clsmith::report::changes::{RecipeChanges, to_text as changes_to_text};
use clsmith::report::plot::{PlotAbscissa, PlotQuantity, PlottedProgram, build_panels};
use clsmith::report::simulation::to_text as simulation_to_text;
use clsmith::report::stats::{ProgramStats, to_text};

const SHOP: &str = "machine:
  rapid_feed: 10000
  max_acceleration: 60000
  corner_constant: 0.0087
  tool_change: 6
  spindle_start: 1.5
stock: { block: { from: [0, 0, -100], to: [60, 40, -90] } }
tools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]
";

/// A spindle start, a dwell, a tool change, two holes with half a second at the depth, one with three turns, and a dwell
/// at the end.
const PART: &str = "PARTNO/A
UNITS/MM
LOADTL/1
SPINDL/RPM,1200,CLW
RAPID
GOTO/0,0,10
FEDRAT/600,MMPM
GOTO/0,0,0
DELAY/2
GOTO/60,0,0
RAPID
GOTO/60,0,10
LOADTL/2
SPINDL/RPM,600,CLW
CYCLE/DRILL,DEPTH,5,MMPM,300,CLEAR,2,DWELL,0.5
GOTO/10,10,0
GOTO/20,10,0
CYCLE/OFF
CYCLE/DRILL,DEPTH,5,MMPM,300,CLEAR,2,DWELL,REV,3
GOTO/30,10,0
CYCLE/OFF
RAPID
GOTO/0,0,50
DELAY/4
FINI
";

const FIRST_TOOL: f64 = 1.5 + 2.0;
const SECOND_TOOL: f64 = 6.0 + 2.0 * 0.5 + 3.0 * 60.0 / 600.0 + 4.0;

#[track_caller]
fn close(found: Option<f64>, wanted: f64) {
    let found = found.unwrap();
    assert!((found - wanted).abs() < 1e-9, "{found} is not {wanted}");
}

#[test]
fn what_the_machine_stands_is_in_all_totals() {
    let (program, shop) = (program(PART), setup(SHOP));
    let whole = time_program(&program, LengthUnit::Mm, &shop.machine.dynamics().unwrap());
    close(Some(whole.standing.iter().sum()), FIRST_TOOL + SECOND_TOOL);
    close(Some(whole.standing_s()), FIRST_TOOL + SECOND_TOOL);

    let stats = ProgramStats::from_program(&program, &shop);
    close(stats.totals.standing_seconds, FIRST_TOOL + SECOND_TOOL);
    close(stats.tools[0].totals.standing_seconds, FIRST_TOOL);
    close(stats.tools[1].totals.standing_seconds, SECOND_TOOL);
    let parts = stats.machine_time.unwrap();
    close(Some(parts.dwell), 2.0 + 1.0 + 0.3 + 4.0);
    let sum = stats.totals.accelerated_seconds.unwrap()
        + stats.totals.rapid_seconds.unwrap()
        + stats.totals.standing_seconds.unwrap();
    close(Some(sum), parts.seconds);
    assert!(to_text(&stats).contains("standing"), "{}", to_text(&stats));

    let simulated = simulate(PART, SHOP, LengthUnit::Mm).unwrap();
    close(simulated.totals.standing_seconds, FIRST_TOOL + SECOND_TOOL);
    let rows = &simulated.motions.rows;
    let by_rows: f64 =
        rows.iter().map(|row| row.machine_seconds.unwrap() + row.standing_seconds.unwrap()).sum();
    close(Some(by_rows), parts.seconds);
    let by_operations: f64 =
        simulated.operations.iter().map(|operation| operation.sums.standing_seconds.unwrap()).sum();
    close(Some(by_operations), FIRST_TOOL + SECOND_TOOL);
    assert!(simulation_to_text(&simulated).contains("for tool changes, spindle starts and dwells"));

    let changes =
        RecipeChanges::from_programs(&program, &program, &[], None).with_machine(&program, &program, &shop);
    close(changes.after.standing_seconds, FIRST_TOOL + SECOND_TOOL);
    assert!(changes_to_text(&changes).contains("time for tool changes, spindle starts and dwells"));

    let compared = told("a.cls", PART.as_bytes(), "  - scale_feed: { factor: 0.5 }\n", SHOP, |comparison| {
        (comparison.whole.before.unwrap(), comparison.whole.after.unwrap())
    });
    close(compared.0.machine_seconds(), parts.seconds);
    close(compared.1.standing_seconds, FIRST_TOOL + SECOND_TOOL);
    assert!(compared.1.machine_seconds().unwrap() > parts.seconds + 5.0);
}

#[test]
fn where_the_machine_is_not_known_nothing_stands() {
    let plain = "stock: { block: { from: [0, 0, -100], to: [60, 40, -90] } }\ntools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]\n";
    let stats = ProgramStats::from_program(&program(PART), &setup(plain));
    assert_eq!((stats.totals.standing_seconds, stats.machine_time), (None, None));
    let simulated = simulate(PART, plain, LengthUnit::Mm).unwrap();
    assert_eq!(simulated.totals.standing_seconds, None);
    assert!(simulated.motions.rows.iter().all(|row| row.machine_seconds.is_none()));
}

#[test]
fn charts_are_drawn_along_the_time_of_the_machine() {
    let (part, shop) = (program(PART), setup(SHOP));
    let whole = time_program(&part, LengthUnit::Mm, &shop.machine.dynamics().unwrap());
    let moving = whole.total() - whole.standing_s();
    let simulated = simulate(PART, SHOP, LengthUnit::Mm).unwrap();
    let series = simulated.to_time_series("a");
    close(series.moments.last().map(|moment| moment.to_s), moving);
    let plotted = PlottedProgram {
        name: "a",
        program: &part,
        units: LengthUnit::Mm,
        setup: &shop,
        simulated: Some(&simulated),
        lines: None,
    };
    for quantity in [PlotQuantity::Feed, PlotQuantity::Z, PlotQuantity::Chip] {
        let panels = build_panels(&[plotted], &[quantity], PlotAbscissa::Time, DisplayUnits::MM);
        close(panels[0].curves[0].segments.last().map(|segment| segment.to), moving);
    }
}
