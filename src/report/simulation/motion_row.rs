//! This module defines the row of a motion, and writes the table of all motions as CSV.

use super::force_columns::{ForceRow, bending_columns, force_columns};
use super::{MotionRows, SimulationReport};
use crate::report::table::{Column, ColumnUnit, CsvTable, TableValue};
use crate::simulation_run::MotionForces;
use std::io::{self, Write};

/// The engagement of a motion and the loads of the tool. `None` means that a value is not known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MotionRow {
    /// The line of the statement that ends the motion, counted from 1. It is `None` for one that a step has
    /// inserted.
    pub line: Option<usize>,
    /// Index of its operation.
    pub operation: usize,
    /// Index of its tool.
    pub tool: usize,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// Whether it is a crash: shank or holder touches material, or a rapid removes some.
    pub is_crash: bool,
    /// Length of the path, mm.
    pub length_mm: f64,
    /// The feed of the tool's tip in mm/min. For a rapid it is the machine's rapid feed.
    pub feed_mm_min: Option<f64>,
    /// Time at that feed, s.
    pub seconds: Option<f64>,
    /// Time on the machine, s; `None` if the machine is not known.
    pub machine_seconds: Option<f64>,
    /// How long the machine stands before it, s: for a tool change, a start of the spindle, a dwell. One at the depth of a hole
    /// belongs to the motion that goes there. `None` if the machine is not known.
    pub standing_seconds: Option<f64>,
    /// The thickest chip, mm: one that a point is proved to have, or what columns tell
    /// ([`super::SimulationReport::certify_chips`]).
    pub chip_thickness_mm: Option<f64>,
    /// An upper bound of the thickest chip, mm: proved from the motions, or with what columns may have missed.
    pub chip_thickness_bound_mm: Option<f64>,
    /// The removed volume per time as the mean over the motion, mm3/min.
    pub removal_rate_mm3_min: Option<f64>,
    /// The largest removal rate over a window of path ([`super::SimulationAccuracy::removal_window_mm`]),
    /// mm3/min. A rapid has none, and a motion that is shorter than the window may have less than its mean.
    pub peak_removal_rate_mm3_min: Option<f64>,
    /// Height of the engaged part of the cutter along its axis, mm.
    pub axial_depth_mm: Option<f64>,
    /// The width of the cut across path and axis, in mm. It is at most the diameter at the highest engaged
    /// point.
    pub radial_depth_mm: Option<f64>,
    /// The angle at which a tooth enters, in degrees ([`crate::engagement::Engagement::immersion_deg`]).
    pub engagement_start_deg: Option<f64>,
    /// The angle at which a tooth leaves, in degrees.
    pub engagement_end_deg: Option<f64>,
    /// Largest resultant cutting force over a revolution, N.
    pub force_n: Option<f64>,
    /// Largest torque over a revolution, N m.
    pub torque_nm: Option<f64>,
    /// Largest power of a place as its mean over a revolution, kW.
    pub power_kw: Option<f64>,
    /// Means and extremes of the forces on the workpiece; `None` if they are not known, which is also so where only columns
    /// tell what a cutter engages.
    pub forces: Option<MotionForces>,
}

impl MotionRow {
    /// Fills in what is known of the forces.
    pub(super) fn fill_forces(&mut self, forces: &MotionForces) {
        self.force_n = Some(forces.resultant_peak_n);
        self.torque_nm = Some(forces.torque_peak_nm);
        self.power_kw = Some(forces.power_peak_kw);
        self.forces = Some(*forces);
    }

    /// Returns the largest force across the tool axis, N.
    pub fn bending_n(&self) -> Option<f64> {
        self.forces.map(|forces| forces.bending_peak_n)
    }

    /// Returns the largest deflection of the tool's tip, mm.
    pub fn deflection_mm(&self) -> Option<f64> {
        Some(self.forces?.bending?.deflection_peak_mm)
    }

    /// Returns the largest bending stress of the tool, MPa.
    pub fn bending_stress_mpa(&self) -> Option<f64> {
        Some(self.forces?.bending?.stress_peak_mpa)
    }

    /// Returns the larger error of the walls that a flank finishes, whatever its sign, mm.
    pub fn surface_error_mm(&self) -> Option<f64> {
        let walls = self.forces?.bending?.wall_error_mm;
        walls.into_iter().flatten().map(f64::abs).reduce(f64::max)
    }

    /// Returns a load as drawings show it, which is `None` for a rapid through material: that is a crash and
    /// not a cut, so its loads are no loads of the program's cuts.
    pub(in crate::report) fn cut_load(&self, load: Option<f64>) -> Option<f64> {
        load.filter(|load| !self.rapid || *load == 0.0)
    }
}

impl ForceRow for NamedMotionRow<'_> {
    fn forces(&self) -> Option<&MotionForces> {
        self.row.forces.as_ref()
    }
}

/// A row, and the lists of names in which it has indices.
pub(super) struct NamedMotionRow<'a> {
    row: &'a MotionRow,
    motions: &'a MotionRows,
}

impl MotionRows {
    /// Returns every row with its names.
    pub(super) fn named_rows(&self) -> impl Iterator<Item = NamedMotionRow<'_>> {
        self.rows.iter().map(|row| NamedMotionRow { row, motions: self })
    }
}

/// Returns the columns of the CSV, which are the keys of the JSON as well.
pub(super) fn motion_columns<'a>() -> Vec<Column<NamedMotionRow<'a>>> {
    let mut columns = cut_columns().to_vec();
    columns.extend(force_columns());
    columns.extend(bending_columns());
    columns
}

fn cut_columns<'a>() -> [Column<NamedMotionRow<'a>>; 18] {
    use ColumnUnit as Unit;
    type Row<'a> = NamedMotionRow<'a>;
    [
        Column::new("line", Unit::None, |named: &Row<'a>| named.row.line.into()),
        Column::new("operation", Unit::None, |named: &Row<'a>| {
            name_at(&named.motions.operations, named.row.operation)
        }),
        Column::new("tool", Unit::None, |named: &Row<'a>| name_at(&named.motions.tools, named.row.tool)),
        Column::new("length", Unit::Length, |named: &Row<'a>| named.row.length_mm.into()),
        Column::new("feed", Unit::FeedPerMinute, |named: &Row<'a>| named.row.feed_mm_min.into()),
        Column::new("chip_thickness", Unit::Length, |named: &Row<'a>| named.row.chip_thickness_mm.into()),
        Column::new("chip_thickness_bound", Unit::Length, |named: &Row<'a>| {
            named.row.chip_thickness_bound_mm.into()
        }),
        Column::new("removal_rate_mean", Unit::RemovalRate, |named: &Row<'a>| {
            named.row.removal_rate_mm3_min.into()
        }),
        Column::new("removal_rate_peak", Unit::RemovalRate, |named: &Row<'a>| {
            named.row.peak_removal_rate_mm3_min.into()
        }),
        Column::new("axial_depth", Unit::Length, |named: &Row<'a>| named.row.axial_depth_mm.into()),
        Column::new("radial_depth", Unit::Length, |named: &Row<'a>| named.row.radial_depth_mm.into()),
        Column::new("engagement_start", Unit::Angle, |named: &Row<'a>| named.row.engagement_start_deg.into()),
        Column::new("engagement_end", Unit::Angle, |named: &Row<'a>| named.row.engagement_end_deg.into()),
        Column::new("f_resultant_peak", Unit::Force, |named: &Row<'a>| named.row.force_n.into()),
        Column::new("torque_peak", Unit::Torque, |named: &Row<'a>| named.row.torque_nm.into()),
        Column::new("power_peak", Unit::Power, |named: &Row<'a>| named.row.power_kw.into()),
        Column::new("machine_time", Unit::Duration, |named: &Row<'a>| {
            TableValue::duration(named.row.machine_seconds)
        }),
        Column::new("standing_time", Unit::Duration, |named: &Row<'a>| {
            TableValue::duration(named.row.standing_seconds)
        }),
    ]
}

fn name_at(names: &[String], index: usize) -> TableValue<'_> {
    TableValue::text(names.get(index).map_or("", String::as_str))
}

/// Writes the motions as a table: comma-separated, with a head line, a decimal point, and empty cells for
/// unknown values.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_csv(simulated: &SimulationReport, out: &mut dyn Write) -> io::Result<()> {
    let mut table = CsvTable::begin(&motion_columns(), simulated.units, out)?;
    for named in simulated.motions.named_rows() {
        table.write_row(&named)?;
    }
    table.finish()
}
