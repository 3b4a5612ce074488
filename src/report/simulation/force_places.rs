//! This module holds forces inside motions: on stretches of them, and over one revolution of the spindle.

use super::force_columns::{ForceRow, bending_columns, force_columns, peak_columns};
use super::{MotionRows, SimulationReport};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::geometry::MotionPath;
use crate::report::table::{Column, ColumnUnit, CsvTable, TableValue};
use crate::simulation_run::{ForceRequest, Machining, MotionForces, RunWatcher};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// The rotations of one revolution that are told.
const ROTATIONS: usize = 360;

/// The forces on a stretch of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ForcePlaceRow {
    /// The index of the motion's row ([`SimulationReport::motions`]).
    pub row: usize,
    /// The line of the statement that ends the motion.
    pub line: Option<usize>,
    /// Where the stretch begins and ends, mm from the start of the motion.
    pub along_mm: [f64; 2],
    /// The forces in its middle.
    pub forces: MotionForces,
}

/// The forces over one revolution in the middle of a motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ToothPeriodReport {
    /// The line of the motion.
    pub line: usize,
    /// The rotations, from a tooth straight ahead.
    pub rotations: Vec<RotationRow>,
    /// Means and extremes there.
    pub forces: MotionForces,
}

/// The forces at one rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RotationRow {
    /// The angle by which the spindle has turned, degrees.
    pub angle_deg: f64,
    /// The force on the workpiece in the axes of the workpiece frame, N.
    pub force_n: [f64; 3],
    /// The torque, N m.
    pub torque_nm: f64,
}

impl RotationRow {
    pub(in crate::report) fn from_parts((angle_deg, force_n, torque_nm): (f64, [f64; 3], f64)) -> Self {
        Self { angle_deg, force_n, torque_nm }
    }
}

/// A row of a stretch with the names of its motion.
pub(super) struct NamedPlaceRow<'a> {
    place: &'a ForcePlaceRow,
    motions: &'a MotionRows,
}

impl ForceRow for NamedPlaceRow<'_> {
    fn forces(&self) -> Option<&MotionForces> {
        Some(&self.place.forces)
    }
}

impl SimulationReport {
    /// Finds the forces inside all motions that cut, on stretches that are at most `spacing_mm` long.
    ///
    /// # Errors
    /// Returns [`codes::MATERIAL_MISSING`] without a material, a finding where the stock or the tools do not permit it, and
    /// [`Failure::Interrupted`] if `watch` has stopped the run.
    pub fn find_forces_along(
        &mut self,
        machining: &Machining<'_>,
        spacing_mm: f64,
        watch: &dyn RunWatcher,
    ) -> Result<(), Failure> {
        let law = machining.setup().require_material()?.law;
        let numbers = self.number_rows(machining);
        let cuts = |number: &usize| {
            let row = numbers.get(number).and_then(|row| self.motions.rows.get(*row));
            row.is_some_and(|row| !row.rapid && row.force_n.is_some_and(|force| force > 0.0))
        };
        let request = ForceRequest {
            law,
            speed_of: &|number, motion| machining.cutting_speed_of(motion).filter(|_| cuts(&number)),
        };
        let found = machining.find_forces_along(&request, spacing_mm, watch)?.ok_or_else(refuse_stock)?;
        self.force_places.clear();
        for (number, stretches) in found {
            let Some(row) = numbers.get(&number).copied() else { continue };
            let line = self.motions.rows.get(row).and_then(|row| row.line);
            self.force_places.extend(stretches.into_iter().map(|stretch| ForcePlaceRow {
                row,
                line,
                along_mm: stretch.along_mm,
                forces: stretch.forces,
            }));
        }
        Ok(())
    }

    /// Finds the forces over one revolution in the middle of the motion that ends at a line.
    ///
    /// # Errors
    /// Returns a finding if no motion at feed of a known cutter ends there, and the errors of
    /// [`SimulationReport::find_forces_along`].
    pub fn find_tooth_period(
        &mut self,
        machining: &Machining<'_>,
        line: usize,
        watch: &dyn RunWatcher,
    ) -> Result<(), Failure> {
        let law = machining.setup().require_material()?.law;
        let numbers = self.number_rows(machining);
        let is_meant = |number: &usize| {
            let row = numbers.get(number).and_then(|row| self.motions.rows.get(*row));
            row.is_some_and(|row| row.line == Some(line) && !row.rapid)
        };
        let request = ForceRequest {
            law,
            speed_of: &|number, motion| machining.cutting_speed_of(motion).filter(|_| is_meant(&number)),
        };
        let found = machining.find_tooth_periods(&request, ROTATIONS, watch)?.ok_or_else(refuse_stock)?;
        let Some(period) = found.into_values().next() else {
            let message = format!(
                "no motion at feed, with a feed, a speed and teeth that are known, ends at line {line}"
            );
            let help = "The line is that of the GOTO, as the first column of `--csv` tells it.";
            return Err(Diagnostic::new(codes::NO_FORCES_THERE, message).with_help(help).into());
        };
        let rotations = period.rotations.into_iter().map(RotationRow::from_parts);
        self.tooth_period =
            Some(ToothPeriodReport { line, rotations: rotations.collect(), forces: period.forces });
        Ok(())
    }

    /// Returns the indices of rows by the numbers of their motions. The first point of a program is no motion.
    pub(in crate::report) fn number_rows(&self, machining: &Machining<'_>) -> BTreeMap<usize, usize> {
        let motions = machining.program().motions().enumerate();
        let with_rows = motions.filter(|(_, motion)| motion.path != MotionPath::Start);
        with_rows.zip(0..self.motions.rows.len()).map(|((number, _), row)| (number, row)).collect()
    }
}

pub(in crate::report) fn refuse_stock() -> Diagnostic {
    let message = "the forces inside motions cannot be found for this stock";
    Diagnostic::new(codes::NO_FORCES_THERE, message)
        .with_help("The stock must be blocks, cylinders, closed meshes or what another program left.")
}

/// Returns the stretches with the names of their motions.
pub(super) fn named_places(simulated: &SimulationReport) -> impl Iterator<Item = NamedPlaceRow<'_>> {
    simulated.force_places.iter().map(|place| NamedPlaceRow { place, motions: &simulated.motions })
}

/// Returns the columns of stretches.
pub(super) fn place_columns<'a>() -> Vec<Column<NamedPlaceRow<'a>>> {
    type Row<'a> = NamedPlaceRow<'a>;
    let mut columns = vec![
        Column::new("line", ColumnUnit::None, |named: &Row<'a>| named.place.line.into()),
        Column::new("operation", ColumnUnit::None, |named: &Row<'a>| {
            let row = named.motions.rows.get(named.place.row);
            let name = row.and_then(|row| named.motions.operations.get(row.operation));
            TableValue::text(name.map_or("", String::as_str))
        }),
        Column::new("tool", ColumnUnit::None, |named: &Row<'a>| {
            let row = named.motions.rows.get(named.place.row);
            let name = row.and_then(|row| named.motions.tools.get(row.tool));
            TableValue::text(name.map_or("", String::as_str))
        }),
        Column::new("along_from", ColumnUnit::Length, |named: &Row<'a>| named.place.along_mm[0].into()),
        Column::new("along_to", ColumnUnit::Length, |named: &Row<'a>| named.place.along_mm[1].into()),
    ];
    columns.extend(force_columns());
    columns.extend(peak_columns());
    columns.extend(bending_columns());
    columns
}

/// Returns the columns of rotations.
pub(in crate::report) fn rotation_columns() -> [Column<RotationRow>; 5] {
    [
        Column::new("angle", ColumnUnit::Angle, |row: &RotationRow| row.angle_deg.into()),
        Column::new("fx", ColumnUnit::Force, |row: &RotationRow| row.force_n[0].into()),
        Column::new("fy", ColumnUnit::Force, |row: &RotationRow| row.force_n[1].into()),
        Column::new("fz", ColumnUnit::Force, |row: &RotationRow| row.force_n[2].into()),
        Column::new("torque", ColumnUnit::Torque, |row: &RotationRow| row.torque_nm.into()),
    ]
}

/// Writes the forces inside motions as a table.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_places_csv(simulated: &SimulationReport, out: &mut dyn Write) -> io::Result<()> {
    let mut table = CsvTable::begin(&place_columns(), simulated.units, out)?;
    for named in named_places(simulated) {
        table.write_row(&named)?;
    }
    table.finish()
}

/// Writes the forces over one revolution as a table; nothing but its head if there are none.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_tooth_period_csv(simulated: &SimulationReport, out: &mut dyn Write) -> io::Result<()> {
    let mut table = CsvTable::begin(&rotation_columns(), simulated.units, out)?;
    for row in simulated.tooth_period.iter().flat_map(|period| &period.rotations) {
        table.write_row(row)?;
    }
    table.finish()
}
