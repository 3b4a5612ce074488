//! This module reports a simulation: a row for each motion, sums of operations and of the program, the
//! remaining stock, and the accuracy.
//!
//! [`SimulationReport::simulate_program`] runs a [`Machining`] and keeps the results of each motion.
//! [`to_text`], [`write_csv`] and [`to_json`] write them. Lengths are in mm; a reader sees them in the units
//! of [`SimulationReport::units`]. A value that is not known is an empty cell in CSV and `null` in JSON: the
//! chip of a tool whose teeth are not given, forces without a material, and the times of rapids if the
//! machine's rapid feed is not given. A motion in air has zeros, and no angles.
//!
//! The JSON has the fields of [`SimulationReport`], with `"version": 1` and the unit of its lengths as
//! `units`. Its motions have the names of the CSV's columns as keys, and numbers are rounded to six decimals.
//! `findings` are those of the whole run. `version` goes up when a reader of the old structure would fail.
//! New keys may be added without that.

mod certified_chips;
mod column_arrays;
mod edge_drawing;
mod edge_maps;
mod edge_picture;
mod force_columns;
mod force_places;
mod motion_row;
mod range_watch;
mod removal_peak;
mod simulation_attempt;
mod simulation_collector;
mod simulation_document;
mod stock_height_field;
mod stock_states;
mod stock_window;
mod sum_columns;
mod sums;
mod target_comparison;
mod text;
pub mod time_plot;
mod tooth_period_plot;
mod unknown_feeds;

pub use certified_chips::ChipCertainty;
pub use column_arrays::{ColumnArray, ColumnValues};
pub use edge_drawing::{MOST_DRAWN_MAPS, draw_edge_maps};
pub use edge_maps::{EdgeMapReport, write_edges_csv};
pub use force_places::{
    ForcePlaceRow, RotationRow, ToothPeriodReport, write_places_csv, write_tooth_period_csv,
};
pub use motion_row::{MotionRow, write_csv};
pub use simulation_attempt::SimulationAttempt;
pub use simulation_document::to_json;
pub use sums::{OperationSums, SimulationPeak, SimulationSums};
pub use target_comparison::{TargetComparison, TargetMismatch, ThickestMismatch};
pub use text::to_text;
pub use tooth_period_plot::draw_tooth_period;

pub(in crate::report) use force_columns::{ForceRow, force_columns, peak_columns};
pub(in crate::report) use force_places::{refuse_stock, rotation_columns};
pub(in crate::report) use stock_states::StockStates;

use crate::diagnostic::{Diagnostic, Failure};
use crate::engagement::removal_window_mm;
use crate::report::table::DisplayUnits;
use crate::simulation_run::{
    Machining, RunWatcher, SimulationCost, SimulationRunOptions, chord_tolerance_mm,
};
use crate::stock::Dexels;
use serde::Serialize;
use std::cell::Cell;

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
    /// The units that a reader sees: those of the program, until a caller sets others. All values here are in
    /// mm.
    pub units: DisplayUnits,
    /// The name of the material that is cut, if the setup states one.
    pub material: Option<String>,
    /// The cost of the run.
    pub cost: ReportedCost,
    /// The accuracy of the run.
    pub accuracy: SimulationAccuracy,
    /// The stock before and after.
    pub stock: StockVolumes,
    /// Sums of the whole program.
    pub totals: SimulationSums,
    /// The time at feed in s if the feed changes no faster than the machine's `max_acceleration` allows. It
    /// is `None` if that is not known.
    pub accelerated_seconds: Option<f64>,
    /// How the chips were found; `None` if all are those of columns, because nobody asked for others.
    pub chips: Option<ChipCertainty>,
    /// The number of motions with each fault.
    pub faults: SimulationFaultCounts,
    /// The assumptions of the run, in sentences.
    pub assumptions: Vec<String>,
    /// Sums of each operation that moves, in order.
    pub operations: Vec<OperationSums>,
    /// The comparison of the remaining stock with the target part, if
    /// [`SimulationReport::compare_with_target`] was called.
    pub target: Option<TargetComparison>,
    /// The forces inside motions, if [`SimulationReport::find_forces_along`] was called.
    pub force_places: Vec<ForcePlaceRow>,
    /// The forces over one revolution, if [`SimulationReport::find_tooth_period`] was called.
    pub tooth_period: Option<ToothPeriodReport>,
    /// The chips over edges in the middle of motions, if [`SimulationReport::find_edge_maps`] was called.
    pub edge_maps: Vec<EdgeMapReport>,
    /// The motions.
    pub motions: MotionRows,
    /// The findings of the run and of this report.
    pub findings: Vec<Diagnostic>,
    /// The remaining stock.
    pub left: Dexels,
    /// What the stock looks like at steps of the run.
    pub(in crate::report) states: Option<StockStates>,
    /// How far the remaining stock is above the target part in each cell of `states`, mm, if the two were compared.
    pub(in crate::report) deviations_mm: Option<Vec<f32>>,
}

/// The rows, and the names that they have in common.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionRows {
    /// A row for each motion, in order. The first point of a program is no motion, because no path leads to
    /// it.
    pub rows: Vec<MotionRow>,
    /// The names of the operations. [`MotionRow::operation`] is an index in this list.
    pub operations: Vec<String>,
    /// The tools, each as its number if that is known, else as its name. [`MotionRow::tool`] is an index in
    /// this list.
    pub tools: Vec<String>,
}

/// What a run cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReportedCost {
    /// The number of columns of the stock.
    pub columns: u64,
    /// The memory of the stock in bytes, without overhangs.
    pub bytes: u64,
    /// An upper estimate of the number of times that columns are examined.
    pub visits: f64,
    /// Length of the path, mm.
    pub path_mm: f64,
}

/// How exact a run is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationAccuracy {
    /// The distance between columns, mm.
    pub cell_mm: f64,
    /// The largest error of material boundaries across z (in x and y), mm: half a cell.
    pub lateral_mm: f64,
    /// The largest distance of arcs and splines from the chords that are run instead, mm.
    pub chord_mm: f64,
    /// The length of path over which removal rates are averaged before the largest one is taken, mm.
    pub removal_window_mm: f64,
}

/// The volumes of the stock, in mm3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StockVolumes {
    /// The volume before the first cut.
    pub before_mm3: f64,
    /// The volume that all motions removed.
    pub removed_mm3: f64,
    /// The volume after the last cut.
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
    /// Runs a program over its stock. Forces are computed if the setup has a material, and the largest
    /// removal rates always are, whatever `options` states.
    ///
    /// # Errors
    /// Returns the errors of [`Machining::simulate_program`]: the run costs too much, the cell is too coarse,
    /// or `watch` stopped the run ([`Failure::Interrupted`]).
    pub fn simulate_program(
        machining: &Machining<'_>,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
    ) -> Result<Self, Failure> {
        let material = machining.setup().require_material().ok();
        let forces = machining.find_all_forces(watch)?;
        let options = SimulationRunOptions {
            // Only the loads of columns need all directions of an engagement.
            forces: material.is_some() && !forces.is_complete,
            removal_peaks: true,
            ..options.within_limits(watch)
        };
        let plan = machining.estimate_cost(&options)?;
        let mut gathering =
            simulation_collector::SimulationCollector::new(machining, plan.cell_mm, forces.of_motions);
        let counted = Cell::new(0);
        let mut keeper = stock_states::StockStateKeeper::new(&counted);
        let mut sink = |cut: &crate::simulation_run::EngagedMotion<'_>| {
            gathering.add_motion(cut);
            counted.set(gathering.motion_count());
        };
        let ran = machining.simulate_observed_program(&options, watch, &mut sink, &mut keeper)?;
        let states = keeper.into_states(&ran.left);
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
            chips: None,
            faults: gathered.faults,
            assumptions: gathered.assumptions,
            operations: gathered.operations,
            target: None,
            force_places: Vec::new(),
            tooth_period: None,
            edge_maps: Vec::new(),
            motions: gathered.motions,
            findings,
            left: ran.left,
            states,
            deviations_mm: None,
        })
    }
}

impl From<SimulationCost> for ReportedCost {
    fn from(plan: SimulationCost) -> Self {
        Self { columns: plan.columns, bytes: plan.bytes, visits: plan.visits, path_mm: plan.path_mm }
    }
}
