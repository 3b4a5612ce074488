//! This module reports a simulation: a row for each motion, sums of operations and of the program, the
//! remaining stock, and the accuracy.
//!
//! [`SimulationReport::simulate_program`] runs a [`Machining`] and collects its results. [`to_text`],
//! [`write_csv`] and [`to_json`] present them. Lengths are in mm, whatever the file's unit. An unknown value
//! is an empty cell, `null` in JSON: the chip without teeth, forces without a material, and everything that
//! needs the unknown feed of a rapid. A motion in air has zeros, and no angles.
//!
//! The JSON is [`SimulationReport`] as it stands, with `"version": 1`; numbers are rounded to six decimals.
//! `findings` is the run's list. `version` changes when a reader of the structure would have to, new keys may
//! be added without.

mod motion_row;
mod simulation_collector;
mod sum_columns;
mod sums;
mod target_comparison;
mod text;
pub mod time_plot;
mod unknown_feeds;

pub use motion_row::{MotionRow, write_csv};
pub use sums::{OperationSums, SimulationPeak, SimulationSums};
pub use target_comparison::TargetComparison;
pub use text::to_text;

use crate::diagnostic::{Diagnostic, Failure};
use crate::report::render::json::FindingsJson;
use crate::report::rounding::{serialize_rounded, serialize_rounded_option};
use crate::report::table::{DisplayUnits, JsonColumns, RecordNumbers};
use crate::simulation_run::{
    Machining, RunWatcher, SimulationCost, SimulationRunOptions, chord_tolerance_mm,
};
use crate::stock::Dexels;
use motion_row::motion_columns;
use serde::{Serialize, Serializer};

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
#[derive(Debug, Serialize)]
#[non_exhaustive]
pub struct SimulationReport {
    /// Version of the JSON structure: 1.
    pub version: u32,
    /// The file's name.
    pub file: String,
    /// The name of the material, if the setup gives it.
    pub material: Option<String>,
    /// The cost of the run.
    pub cost: ReportedCost,
    /// The accuracy of the run.
    pub accuracy: SimulationAccuracy,
    /// The stock before and after.
    pub stock: StockVolumes,
    /// Sums of the whole program.
    pub totals: SimulationSums,
    /// The time at feed when the feed changes no faster than the machine's `max_acceleration`, in s; `null`
    /// if that is not known.
    #[serde(serialize_with = "serialize_rounded_option")]
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
    /// The motions. In JSON they have the names of the CSV's columns.
    #[serde(serialize_with = "serialize_motion_rows")]
    pub motions: MotionRows,
    /// The findings.
    #[serde(skip)]
    pub findings: Vec<Diagnostic>,
    /// The remaining stock.
    #[serde(skip)]
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

/// The cost of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReportedCost {
    /// Columns of the stock.
    pub columns: u64,
    /// Bytes of the stock, overhangs aside.
    pub bytes: u64,
    /// An upper estimate of how many times a column is read.
    #[serde(serialize_with = "serialize_rounded")]
    pub visits: f64,
    /// Length of the path, mm.
    #[serde(serialize_with = "serialize_rounded")]
    pub path_mm: f64,
}

/// The accuracy of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SimulationAccuracy {
    /// Distance of columns, mm.
    #[serde(serialize_with = "serialize_rounded")]
    pub cell_mm: f64,
    /// The accuracy of boundaries of material across z, in mm: half a cell.
    #[serde(serialize_with = "serialize_rounded")]
    pub lateral_mm: f64,
    /// The largest distance between arcs and splines and the chords that replace them, mm.
    #[serde(serialize_with = "serialize_rounded")]
    pub chord_mm: f64,
}

/// Volumes in mm3.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct StockVolumes {
    /// Before the first cut.
    #[serde(serialize_with = "serialize_rounded")]
    pub before_mm3: f64,
    /// Removed by all motions.
    #[serde(serialize_with = "serialize_rounded")]
    pub removed_mm3: f64,
    /// After the last.
    #[serde(serialize_with = "serialize_rounded")]
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
        let options = SimulationRunOptions { forces: material.is_some(), ..*options };
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
            version: 1,
            file: machining.program().source().name().to_owned(),
            material: material.and_then(|material| material.name.clone()),
            cost: plan.into(),
            accuracy: SimulationAccuracy {
                cell_mm: ran.cell_mm,
                lateral_mm: ran.cell_mm / 2.0,
                chord_mm: chord_tolerance_mm(ran.cell_mm),
            },
            stock: StockVolumes { before_mm3: ran.before_mm3, removed_mm3, left_mm3 },
            totals: gathered.totals,
            accelerated_seconds: gathered.accelerated_seconds,
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

fn serialize_motion_rows<S: Serializer>(motions: &MotionRows, serializer: S) -> Result<S::Ok, S::Error> {
    let columns = JsonColumns::new(&motion_columns(), DisplayUnits::MM, RecordNumbers::Rounded);
    columns.serialize_rows(motions.named_rows(), serializer)
}

/// Writes the simulation as one JSON document, indented and with a line end. `findings` are those of the
/// whole run, as the policy left them; they stand in it as `findings`.
pub fn to_json(simulated: &SimulationReport, findings: &[Diagnostic]) -> String {
    super::to_json_text(&SimulationDocument { simulated, findings: FindingsJson::from_findings(findings) })
}

#[derive(Serialize)]
struct SimulationDocument<'a> {
    #[serde(flatten)]
    simulated: &'a SimulationReport,
    findings: FindingsJson<'a>,
}
