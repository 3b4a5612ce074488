//! Simulations whose rows are known in closed form.

mod certified_chips;
mod faults;
mod outputs;
mod removal_peak;

use crate::support::program;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::program::LengthUnit;
use clsmith::report::simulation::{MotionRow, SimulationReport};
use clsmith::setup::Setup;
use clsmith::simulation_run::{Machining, SilentWatcher, SimulationRunOptions};
use clsmith::source::Source;

/// A slot of an end mill of 10 mm, 2 mm deep, from air through 60 mm of stock into air, in three motions; then half as wide on the way
/// back, where the material lies at the left: a clockwise tool climbs out of it.
pub const SLOT: &str = "TOOL PATH/SLOT,TOOL,EM10
TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000
MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000
LOAD/TOOL,3,ADJUST,3
SPINDL/RPM,4000.0000,CLW
RAPID
GOTO/-10.0000,20.0000,20.0000,0.0000000,0.0000000,1.0000000
RAPID
GOTO/-10.0000,20.0000,-2.0000
PAINT/COLOR,31
FEDRAT/MMPM,800.0000
GOTO/20.0000,20.0000,-2.0000
GOTO/40.0000,20.0000,-2.0000
GOTO/70.0000,20.0000,-2.0000
GOTO/70.0000,15.0000,-2.0000
GOTO/-10.0000,15.0000,-2.0000
RAPID
GOTO/-10.0000,15.0000,20.0000
END-OF-PATH
";

/// Its setup.
pub const SHOP: &str = "machine: { rapid_feed: 10000, max_acceleration: 60000 }
stock: { block: { from: [0, 0, -10], to: [60, 40, 0] } }
tools:
  - match: { number: 3 }
    teeth: 4
    flute_length: 20
material: { k_tc: 2000, name: C45 }
";

pub fn setup(text: &str) -> Setup {
    Setup::load(&Source::new("shop.yaml", text.as_bytes().to_vec()).unwrap()).unwrap()
}

pub fn simulate(text: &str, shop: &str, units: LengthUnit) -> Result<SimulationReport, Vec<Diagnostic>> {
    let (program, setup) = (program(text), setup(shop));
    let machining =
        Machining::new(&program, &setup, units, &mut Vec::new()).map_err(Failure::into_findings)?;
    SimulationReport::simulate_program(&machining, &SimulationRunOptions::default(), &SilentWatcher)
        .map_err(Failure::into_findings)
}

fn row(simulated: &SimulationReport, line: usize) -> MotionRow {
    *simulated.motions.rows.iter().find(|row| row.line == Some(line)).unwrap()
}

#[track_caller]
pub fn close(found: Option<f64>, wanted: f64, tolerance: f64) {
    let found = found.unwrap();
    assert!((found - wanted).abs() <= tolerance, "{found} is not {wanted}");
}

#[test]
fn a_slot_has_its_chip_rate_depths_and_angles() {
    let found = simulate(SLOT, SHOP, LengthUnit::Mm).unwrap();
    assert!(found.findings.is_empty(), "{:?}", found.findings);
    let row = row(&found, 13);
    // f / (n z), with the share of the feed in the middle of the slot: cos of what half a cell is from the middle.
    close(row.chip_thickness_mm, 800.0 / (4000.0 * 4.0), 1e-5);
    close(row.removal_rate_mm3_min, 10.0 * 2.0 * 800.0, 1.0);
    close(row.axial_depth_mm, 2.0, 1e-4);
    close(row.radial_depth_mm, 10.0, 1e-9);
    close(row.engagement_start_deg, 0.0, 1e-9);
    close(row.engagement_end_deg, 180.0, 1e-9);
    close(row.seconds, 1.5, 1e-9);
    assert!(row.force_n.unwrap() > 0.0 && row.torque_nm.unwrap() > 0.0 && row.power_kw.unwrap() > 0.0);
    // From air into air half of the path lies in the stock.
    let through = self::row(&found, 12);
    assert_eq!((through.length_mm, through.feed_mm_min), (30.0, Some(800.0)));
    assert!(through.removal_rate_mm3_min.unwrap() < 0.9 * 16000.0);
}

#[test]
fn half_a_tool_is_engaged_over_a_quarter() {
    let found = simulate(SLOT, SHOP, LengthUnit::Mm).unwrap();
    let row = row(&found, 16);
    close(row.radial_depth_mm, 5.0, 0.26);
    close(row.axial_depth_mm, 2.0, 1e-4);
    // The stock stands at the left of a motion to -x at y 15: the strip from y 10 to 15.
    close(row.engagement_start_deg, 0.0, 1e-9);
    close(row.engagement_end_deg, 90.0, 3.0);
    // 60 mm of 80 are in the stock; the columns' border is off by half a cell at most.
    close(row.removal_rate_mm3_min, 5.0 * 2.0 * 800.0 * 60.0 / 80.0, 1.0);
}

#[test]
fn air_and_rapids_have_zeros_and_no_angles() {
    let found = simulate(SLOT, SHOP, LengthUnit::Mm).unwrap();
    for (line, feed) in [(9, 10_000.0), (15, 800.0), (18, 10_000.0)] {
        let row = row(&found, line);
        assert_eq!(row.feed_mm_min, Some(feed));
        let zeros =
            [row.chip_thickness_mm, row.removal_rate_mm3_min, row.axial_depth_mm, row.radial_depth_mm];
        assert_eq!((zeros, row.force_n), ([Some(0.0); 4], Some(0.0)));
        assert_eq!((row.engagement_start_deg, row.engagement_end_deg), (None, None));
    }
    assert_eq!(found.totals.motions, 7);
    assert_eq!(found.motions.tools, ["3"]);
}

#[test]
fn sums_are_of_the_rows() {
    let found = simulate(SLOT, SHOP, LengthUnit::Mm).unwrap();
    let totals = found.totals;
    assert_eq!((totals.cutting, totals.chip_thickness_mm.unwrap().line), (4, Some(12)));
    close(Some(totals.feed_mm), 165.0, 1e-9);
    close(Some(totals.feed_seconds), 165.0 / 800.0 * 60.0, 1e-9);
    // One chain at one feed, which it is entered and left with.
    close(found.accelerated_seconds, totals.feed_seconds, 1e-9);
    close(totals.rapid_seconds, 44.0 / 10_000.0 * 60.0, 1e-9);
    let stock = found.stock;
    close(Some(stock.before_mm3 - stock.left_mm3), stock.removed_mm3, 1e-2);
    close(Some(stock.removed_mm3), 60.0 * 15.0 * 2.0, 1e-2);
    assert_eq!(found.operations.len(), 1);
    assert_eq!(found.operations[0].sums.removed_mm3, totals.removed_mm3);
}

#[test]
fn a_program_in_inches_reports_millimetres() {
    let text = "TOOL PATH/SLOT,TOOL,EM10
TLDATA/MILL,0.5000,0.0000,2.0000,0.0000,0.0000
MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000
LOAD/TOOL,3,ADJUST,3
SPINDL/RPM,1000.0000,CLW
RAPID
GOTO/0.0000,1.0000,1.0000,0.0000000,0.0000000,1.0000000
FEDRAT/IPM,10.0000
GOTO/0.0000,1.0000,-0.1000
GOTO/2.0000,1.0000,-0.1000
END-OF-PATH
";
    let shop = "units: inch
stock: { block: { from: [-1, 0, -0.5], to: [3, 2, 0] } }
tools: [{ match: {}, teeth: 2 }]
";
    let found = simulate(text, shop, LengthUnit::Inch).unwrap();
    let row = row(&found, 10);
    close(Some(row.length_mm), 50.8, 1e-9);
    close(row.feed_mm_min, 254.0, 1e-9);
    close(row.chip_thickness_mm, 0.127, 2e-5);
    close(row.axial_depth_mm, 2.54, 1e-4);
    close(row.removal_rate_mm3_min, 12.7 * 2.54 * 254.0, 10.0);
    assert_eq!(row.force_n, None);
    assert!(found.assumptions.iter().any(|text| text.contains("no material")));
}
