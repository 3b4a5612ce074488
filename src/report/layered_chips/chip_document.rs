//! Chips as CSV and JSON.

use super::chip_columns::{ChipLayerOfMotion, layer_columns, motion_columns};
use super::json_formatter::DepthLimitedFormatter;
use super::{ChipLayerRow, ChipReport, ChipRow, ChipTotals, OperationChips, UncutMotion};
use crate::diagnostic::Diagnostic;
use crate::presentation::safe_json::SafeJsonWriter;
use crate::report::render::json::FindingsJson;
use crate::report::rounding::{round_to_micro, serialize_rounded};
use crate::report::table::{CsvTable, DisplayUnits, JsonColumns, RecordNumbers};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};
use std::io::{self, Write};

/// A boundary as the JSON has it.
struct BoundaryJson<'a>(&'a [[f64; 2]]);

impl Serialize for BoundaryJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|point| point.map(round_to_micro)))
    }
}

/// The document.
#[derive(Serialize)]
struct ChipDocument<'a> {
    /// Version of the structure: 1. It changes when a reader would have to; new keys may be added without.
    version: u32,
    file: &'a str,
    #[serde(serialize_with = "serialize_rounded")]
    layer_mm: f64,
    #[serde(serialize_with = "serialize_rounded")]
    tolerance_mm: f64,
    totals: &'a ChipTotals,
    assumptions: &'a [String],
    operations: &'a [OperationChips],
    skipped: &'a [UncutMotion],
    findings: FindingsJson<'a>,
    motions: MotionList<'a>,
}

/// Writes the chips as one JSON document, a line for each layer, with a line end. The borders of pieces are
/// in it where they were kept. `findings` are those of the whole run, as the policy left them.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_json(report: &ChipReport, findings: &[Diagnostic], out: &mut dyn Write) -> io::Result<()> {
    let columns = ChipJsonColumns::new();
    let document = ChipDocument {
        version: 1,
        file: &report.file,
        layer_mm: report.options.layer_mm,
        tolerance_mm: report.options.tolerance_mm,
        totals: &report.totals,
        assumptions: &report.assumptions,
        operations: &report.operations,
        skipped: &report.skipped,
        findings: FindingsJson::from_findings(findings),
        motions: MotionList { rows: &report.rows, columns: &columns },
    };
    let mut serializer =
        serde_json::Serializer::with_formatter(SafeJsonWriter(&mut *out), DepthLimitedFormatter::default());
    document.serialize(&mut serializer)?;
    out.write_all(b"\n")
}

/// The columns of motions and of their layers.
struct ChipJsonColumns {
    motion: JsonColumns<ChipRow>,
    layer: JsonColumns<ChipLayerRow>,
}

impl ChipJsonColumns {
    fn new() -> Self {
        let (units, numbers) = (DisplayUnits::MM, RecordNumbers::Rounded);
        Self {
            motion: JsonColumns::new(&motion_columns(), units, numbers),
            layer: JsonColumns::new(&layer_columns(), units, numbers),
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
        map.end()
    }
}

/// A layer: its columns and its pieces. `pieces` are outer boundaries, `holes` are holes, and `hole_of` says
/// for each of these the number of the piece that it is in, from 0.
struct LayerJson<'a> {
    layer: &'a ChipLayerRow,
    columns: &'a ChipJsonColumns,
}

impl Serialize for LayerJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let polygons = &self.layer.polygons;
        let holes = || {
            let pieces = polygons.iter().enumerate();
            pieces.flat_map(|(index, polygon)| polygon.holes.iter().map(move |hole| (index, hole)))
        };
        let pieces: Vec<_> = polygons.iter().map(|polygon| BoundaryJson(&polygon.outer)).collect();
        let hole_borders: Vec<_> = holes().map(|(_, hole)| BoundaryJson(hole)).collect();
        let hole_of: Vec<usize> = holes().map(|(index, _)| index).collect();
        let mut map = serializer.serialize_map(None)?;
        self.columns.layer.object(self.layer).serialize_entries(&mut map)?;
        map.serialize_entry("pieces", &pieces)?;
        map.serialize_entry("holes", &hole_borders)?;
        map.serialize_entry("hole_of", &hole_of)?;
        map.end()
    }
}

/// Writes the chips as a table, one row for each motion and layer with a chip: comma-separated, a head line,
/// numbers with a decimal point, empty cells for what is not known. Arcs of engagement are `from to`, several
/// of them with a semicolon between.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_csv(report: &ChipReport, out: &mut dyn Write) -> io::Result<()> {
    let mut columns = motion_columns().to_vec();
    columns.extend(layer_columns());
    let mut table = CsvTable::begin(&columns, DisplayUnits::MM, out)?;
    for motion in &report.rows {
        for layer in &motion.layers {
            table.write_row(&ChipLayerOfMotion { motion, layer })?;
        }
    }
    table.finish()
}
