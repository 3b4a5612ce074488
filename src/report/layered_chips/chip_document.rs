//! This module writes the chips of a program as CSV and as JSON.

use super::chip_columns::{
    ChipLayerOfMotion, layer_columns, moment_columns, moment_of_layer_columns, motion_columns,
};
use super::json_formatter::DepthLimitedFormatter;
use super::sum_columns::{operation_columns, totals_columns};
use super::{ChipLayerRow, ChipMoment, ChipReport, ChipRow};
use crate::diagnostic::Diagnostic;
use crate::presentation::safe_json::SafeJsonWriter;
use crate::report::render::json::FindingsJson;
use crate::report::rounding::round_to_micro;
use crate::report::simulation::{RotationRow, rotation_columns};
use crate::report::table::{ColumnUnit, CsvTable, DisplayUnits, JsonColumns, RecordNumbers};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::io::{self, Write};

/// A boundary in the JSON: its points in the reader's unit.
struct BoundaryJson<'a> {
    points: &'a [[f64; 2]],
    units: DisplayUnits,
}

impl Serialize for BoundaryJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.points.iter().map(|point| point.map(|at| round_length(at, self.units))))
    }
}

/// The whole JSON document.
struct ChipDocument<'a> {
    report: &'a ChipReport,
    findings: &'a [Diagnostic],
}

impl Serialize for ChipDocument<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let (report, units) = (self.report, self.report.units);
        let length = |value: f64| round_length(value, units);
        let mut map = serializer.serialize_map(None)?;
        // The version goes up when a reader of the old structure would fail. New keys may be added without
        // that.
        map.serialize_entry("version", &1)?;
        map.serialize_entry("file", &report.file)?;
        map.serialize_entry("units", &units.shown_in)?;
        map.serialize_entry(&units.key("layer", ColumnUnit::Length), &length(report.options.layer_mm))?;
        map.serialize_entry(
            &units.key("tolerance", ColumnUnit::Length),
            &length(report.options.tolerance_mm),
        )?;
        let [x, y, z] = report.frame.axes().map(|axis| axis.map(round_to_micro));
        map.serialize_entry("layer_frame", &LayerFrameJson { x, y, z })?;
        let totals = JsonColumns::new(&totals_columns(), units, RecordNumbers::Rounded);
        map.serialize_entry("totals", &totals.object(&report.totals))?;
        map.serialize_entry("assumptions", &report.assumptions)?;
        let operations = JsonColumns::new(&operation_columns(), units, RecordNumbers::Rounded);
        let rows: Vec<_> = report.operations.iter().map(|row| operations.object(row)).collect();
        map.serialize_entry("operations", &rows)?;
        map.serialize_entry("skipped", &report.skipped)?;
        map.serialize_entry("findings", &FindingsJson::from_findings(self.findings))?;
        let columns = ChipJsonColumns::new(units);
        map.serialize_entry("motions", &MotionList { rows: &report.rows, columns: &columns })?;
        map.end()
    }
}

/// The axes of the frame in which heights and boundaries are told, as directions in the workpiece frame. Both frames
/// have the same origin.
#[derive(Serialize)]
struct LayerFrameJson {
    x: [f64; 3],
    y: [f64; 3],
    z: [f64; 3],
}

fn round_length(value_mm: f64, units: DisplayUnits) -> f64 {
    round_to_micro(units.convert(ColumnUnit::Length, value_mm))
}

/// Writes the chips as one JSON document, a line for each layer, with a line end. It has the boundaries of
/// pieces if they were kept. `findings` are those of the whole run, as the policy left them.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_json(report: &ChipReport, findings: &[Diagnostic], out: &mut dyn Write) -> io::Result<()> {
    let mut serializer =
        serde_json::Serializer::with_formatter(SafeJsonWriter(&mut *out), DepthLimitedFormatter::default());
    ChipDocument { report, findings }.serialize(&mut serializer)?;
    out.write_all(b"\n")
}

/// The columns of motions and of their layers.
struct ChipJsonColumns {
    motion: JsonColumns<ChipRow>,
    layer: JsonColumns<ChipLayerRow>,
    moment: JsonColumns<ChipMoment>,
    rotation: JsonColumns<RotationRow>,
    units: DisplayUnits,
}

impl ChipJsonColumns {
    fn new(units: DisplayUnits) -> Self {
        let numbers = RecordNumbers::Rounded;
        Self {
            units,
            motion: JsonColumns::new(&motion_columns(), units, numbers),
            layer: JsonColumns::new(&layer_columns(), units, numbers),
            moment: JsonColumns::new(&moment_columns(), units, numbers),
            rotation: JsonColumns::new(&rotation_columns(), units, numbers),
        }
    }
}

struct MotionList<'a> {
    rows: &'a [ChipRow],
    columns: &'a ChipJsonColumns,
}

impl Serialize for MotionList<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let columns = self.columns;
        serializer.collect_seq(self.rows.iter().map(|row| MotionJson { row, columns }))
    }
}

/// A motion: its columns and its layers.
struct MotionJson<'a> {
    row: &'a ChipRow,
    columns: &'a ChipJsonColumns,
}

impl Serialize for MotionJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let columns = self.columns;
        let mut map = serializer.serialize_map(None)?;
        columns.motion.object(self.row).serialize_entries(&mut map)?;
        let layers: Vec<LayerJson<'_>> =
            self.row.layers.iter().map(|layer| LayerJson { layer, columns }).collect();
        map.serialize_entry("layers", &layers)?;
        if !self.row.moments.is_empty() {
            let moment = |moment| MomentJson { moment, columns };
            map.serialize_entry("moments", &self.row.moments.iter().map(moment).collect::<Vec<_>>())?;
        }
        map.end()
    }
}

/// A part of a motion: its columns, its layers, and the forces over one revolution.
struct MomentJson<'a> {
    moment: &'a ChipMoment,
    columns: &'a ChipJsonColumns,
}

impl Serialize for MomentJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { moment, columns } = *self;
        let mut map = serializer.serialize_map(None)?;
        columns.moment.object(moment).serialize_entries(&mut map)?;
        let layers: Vec<LayerJson<'_>> =
            moment.layers.iter().map(|layer| LayerJson { layer, columns }).collect();
        map.serialize_entry("layers", &layers)?;
        let rotations: Vec<_> = moment.rotations.iter().map(|row| columns.rotation.object(row)).collect();
        map.serialize_entry("rotations", &rotations)?;
        map.end()
    }
}

/// A layer: its columns and its pieces. `pieces` are outer boundaries, `holes` are the boundaries of holes,
/// and `hole_of` holds the index in `pieces` of the piece around each hole.
struct LayerJson<'a> {
    layer: &'a ChipLayerRow,
    columns: &'a ChipJsonColumns,
}

impl Serialize for LayerJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let polygons = &self.layer.polygons;
        let units = self.columns.units;
        let holes = || {
            let pieces = polygons.iter().enumerate();
            pieces.flat_map(|(index, polygon)| polygon.holes.iter().map(move |hole| (index, hole)))
        };
        let pieces: Vec<_> =
            polygons.iter().map(|polygon| BoundaryJson { points: &polygon.outer, units }).collect();
        let hole_borders: Vec<_> = holes().map(|(_, points)| BoundaryJson { points, units }).collect();
        let hole_of: Vec<usize> = holes().map(|(index, _)| index).collect();
        let mut map = serializer.serialize_map(None)?;
        self.columns.layer.object(self.layer).serialize_entries(&mut map)?;
        map.serialize_entry("pieces", &pieces)?;
        map.serialize_entry("holes", &hole_borders)?;
        map.serialize_entry("hole_of", &hole_of)?;
        map.end()
    }
}

/// Writes the chips as a table, one row for each motion (or part of it, if parts were asked for) and layer with a chip: comma-separated, a head line,
/// numbers with a decimal point, empty cells for unknown values. An arc of engagement is written as `from
/// to`, and several arcs are separated by semicolons.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_csv(report: &ChipReport, out: &mut dyn Write) -> io::Result<()> {
    let mut columns = motion_columns().to_vec();
    columns.extend(layer_columns());
    if report.options.moments > 1 {
        columns.extend(moment_of_layer_columns());
    }
    let mut table = CsvTable::begin(&columns, report.units, out)?;
    for motion in &report.rows {
        for moment in &motion.moments {
            for layer in &moment.layers {
                table.write_row(&ChipLayerOfMotion { motion, layer, moment: Some(moment) })?;
            }
        }
        for layer in motion.layers.iter().filter(|_| motion.moments.is_empty()) {
            table.write_row(&ChipLayerOfMotion { motion, layer, moment: None })?;
        }
    }
    table.finish()
}
