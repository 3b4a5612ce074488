//! This module reports a simulation: a row for each motion, sums of operations and of the program, the
//! remaining stock, and the accuracy.
//!
//! [`SimulationReport::simulate_program`] runs a [`Machining`] and keeps what it hears; [`to_text`], [`write_csv`] and [`to_json`] present it. Lengths are in mm,
//! and a reader sees them in [`SimulationReport::units`]. What is not known is an empty cell, `null` in JSON: the chip without teeth, forces without a material,
//! all that needs the feed of a rapid whose speed nobody says. A motion in air has zeros, and no angles.
//!
//! The JSON has the fields of [`SimulationReport`], with `"version": 1` and the unit of its lengths as `units`; the motions have the names of the CSV's
//! columns, and numbers are rounded to six decimals. `findings` is the run's list. `version` changes when a reader of the structure would have to, new
//! keys may be added without.

mod motion_row;
mod removal_peak;
mod simulation_collector;
mod simulation_document;
mod sum_columns;
mod sums;
mod target_comparison;
mod text;
pub mod time_plot;
mod unknown_feeds;

pub use motion_row::{MotionRow, write_csv};
pub use simulation_document::to_json;
pub use sums::{OperationSums, SimulationPeak, SimulationSums};
pub use target_comparison::{TargetComparison, TargetMismatch, ThickestMismatch};
pub use text::to_text;

use crate::diagnostic::{Diagnostic, Failure};
use crate::engagement::removal_window_mm;
use crate::report::table::DisplayUnits;
use crate::simulation_run::{
    Machining, RunWatcher, SimulationCost, SimulationRunOptions, chord_tolerance_mm,
};
use crate::stock::Dexels;
use serde::Serialize;

/// A program that was simulated.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::report::simulation::{SimulationReport, write_csv};
/// use clsmith::setup::Setup;
/// use clsmith::simulation_run::{Machining, SilentWatcher, SimulationRunOptions};
/// use clsmith::source::Source;
///
/// let shop = b"stock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }\n\
///     tools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]\n";
/// let setup = Setup::load(&Source::new("shop.yaml", shop.to_vec())?)?;
/// let part = b"LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-10,0,-2\nFEDRAT/MMPM,1000.\nGOTO/30,0,-2\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut Vec::new())?;
/// let options = SimulationRunOptions::default().with_cell_mm(0.5);
/// let report = SimulationReport::simulate_program(&machining, &options, &SilentWatcher)?;
/// let slot = report.motions.rows.last().expect("there is a row for each motion");
/// assert!(slot.chip_thickness_mm.is_some_and(|chip| (chip - 0.05).abs() < 1e-3));
/// let mut table = Vec::new();
/// write_csv(&report, &mut table)?;
/// assert!(String::from_utf8(table)?.lines().next().is_some_and(|head| head.contains("chip_thickness")));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
#[non_exhaustive]
pub struct SimulationReport {
    /// The file's name.
    pub file: String,
    /// The units that a reader sees: those of the program, until a caller sets others. All values here are in mm.
    pub units: DisplayUnits,
    /// What is cut, if the setup says its name.
    pub material: Option<String>,
    /// The cost of the run.
    pub cost: ReportedCost,
    /// The accuracy of the run.
    pub accuracy: SimulationAccuracy,
    /// The stock before and after.
    pub stock: StockVolumes,
    /// Sums of the whole program.
    pub totals: SimulationSums,
    /// Time at feed when the feed changes no faster than the machine's `max_acceleration`, s; `null` when that is not known.
    pub accelerated_seconds: Option<f64>,
    /// The numbers of faults.
    pub faults: SimulationFaultCounts,
    /// The assumptions of the run, in sentences.
    pub assumptions: Vec<String>,
    /// Sums of each operation that moves, in order.
    pub operations: Vec<OperationSums>,
    /// The comparison of the remaining stock with the target part, if
    /// [`SimulationReport::compare_with_target`] was called.
    pub target: Option<TargetComparison>,
    /// The motions.
    pub motions: MotionRows,
    /// What went wrong, with its places.
    pub findings: Vec<Diagnostic>,
    /// What is left.
    pub left: Dexels,
}

/// The rows, and the names that they have in common.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionRows {
    /// A row for each motion, in order. The first point of a program is no motion, because no path leads to
    /// it.
    pub rows: Vec<MotionRow>,
    /// Names of operations; [`MotionRow::operation`] is an index.
    pub operations: Vec<String>,
    /// Tools: the number where it is known, else the name; [`MotionRow::tool`] is an index.
    pub tools: Vec<String>,
}

/// What a run cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReportedCost {
    /// Columns of the stock.
    pub columns: u64,
    /// Bytes of the stock, overhangs aside.
    pub bytes: u64,
    /// About how many times a column was looked at, at most.
    pub visits: f64,
    /// Length of the path, mm.
    pub path_mm: f64,
}

/// How exact a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationAccuracy {
    /// Distance of columns, mm.
    pub cell_mm: f64,
    /// Across z, boundaries of material are known to this, mm: half a cell.
    pub lateral_mm: f64,
    /// Arcs and splines run as chords that are no further than this from them, mm.
    pub chord_mm: f64,
    /// The length of path that the largest removal rate is the mean over, mm.
    pub removal_window_mm: f64,
}

/// Volumes in mm3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StockVolumes {
    /// Before the first cut.
    pub before_mm3: f64,
    /// Removed by all motions.
    pub removed_mm3: f64,
    /// After the last.
    pub left_mm3: f64,
}

/// The number of motions with each fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct SimulationFaultCounts {
    /// Shank or holder touches material.
    pub collisions: usize,
    /// A rapid removes material.
    pub rapids_in_material: usize,
    /// The tool cuts while the spindle does not turn.
    pub spindle_stands: usize,
    /// The tool cuts, but its feed or its speed in rev/min is not known.
    pub unknown_feeds: usize,
}

impl SimulationReport {
    /// Runs a program over its stock. Forces are computed if the setup has a material, whatever `options`
    /// state. Returns `None` if `watch` has stopped it.
    ///
    /// Returns the errors of [`Machining::simulate_program`]: the run costs too much, or the cell is too
    /// coarse.
    pub fn simulate_program(
        machining: &Machining<'_>,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
    ) -> Result<Self, Failure> {
        let material = machining.setup().require_material().ok();
        let options = SimulationRunOptions {
            forces: material.is_some(),
            removal_peaks: true,
            ..options.within_limits(watch)
        };
        let plan = machining.estimate_cost(&options)?;
        let mut gathering = simulation_collector::SimulationCollector::new(machining, plan.cell_mm);
        let mut sink = |cut: &crate::simulation_run::EngagedMotion<'_>| gathering.add_motion(cut);
        let ran = machining.simulate_program(&options, watch, &mut sink)?;
        let gathered = gathering.into_collected();
        let mut findings = ran.findings;
        findings.extend(gathered.findings);
        let left_mm3 = ran.left.volume_mm3();
        let removed_mm3 = gathered.totals.removed_mm3;
        Ok(Self {
            file: machining.program().source().name().to_owned(),
            units: DisplayUnits::of_program(machining.length_unit(), None),
            material: material.and_then(|material| material.name.clone()),
            cost: plan.into(),
            accuracy: SimulationAccuracy {
                cell_mm: ran.cell_mm,
                lateral_mm: ran.cell_mm / 2.0,
                chord_mm: chord_tolerance_mm(ran.cell_mm),
                removal_window_mm: removal_window_mm(ran.cell_mm),
            },
            stock: StockVolumes { before_mm3: ran.before_mm3, removed_mm3, left_mm3 },
            totals: gathered.totals,
            accelerated_seconds: gathered.totals.accelerated_seconds,
            faults: gathered.faults,
            assumptions: gathered.assumptions,
            operations: gathered.operations,
            target: None,
            motions: gathered.motions,
            findings,
            left: ran.left,
        })
    }
}

impl From<SimulationCost> for ReportedCost {
    fn from(plan: SimulationCost) -> Self {
        Self { columns: plan.columns, bytes: plan.bytes, visits: plan.visits, path_mm: plan.path_mm }
    }
}
