//! The chips as CSV and JSON.

use super::json_formatter::DepthLimitedFormatter;
use super::{ChipReport, ChipRow, ChipTotals, OperationChips, UncutMotion};
use crate::report::rounding::{round_to_micro, serialize_rounded, serialize_rounded_option};
use serde::Serialize;
use std::io::{self, Write};

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
    motions: &'a [ChipRow],
}

/// The chips as one JSON document, a line for each layer, with a line end. The borders of pieces are in it where they were kept.
///
/// # Errors
/// What `out` returns.
pub fn write_json(report: &ChipReport, out: &mut dyn Write) -> io::Result<()> {
    let document = ChipDocument {
        version: 1,
        file: &report.file,
        layer_mm: report.options.layer,
        tolerance_mm: report.options.tolerance,
        totals: &report.totals,
        assumptions: &report.assumptions,
        operations: &report.operations,
        skipped: &report.skipped,
        motions: &report.rows,
    };
    let mut serializer = serde_json::Serializer::with_formatter(&mut *out, DepthLimitedFormatter::default());
    document.serialize(&mut serializer)?;
    out.write_all(b"\n")
}

/// A row of the CSV.
#[derive(Serialize)]
struct ChipCsvRow<'a> {
    line: usize,
    operation: &'a str,
    tool: &'a str,
    #[serde(serialize_with = "serialize_rounded")]
    length_mm: f64,
    #[serde(serialize_with = "serialize_rounded_option")]
    feed_mm_min: Option<f64>,
    #[serde(serialize_with = "serialize_rounded")]
    z_mm: f64,
    #[serde(serialize_with = "serialize_rounded")]
    thickness_mm: f64,
    #[serde(serialize_with = "serialize_rounded")]
    area_mm2: f64,
    #[serde(serialize_with = "serialize_rounded")]
    volume_mm3: f64,
    #[serde(serialize_with = "serialize_rounded")]
    inside_mm2: f64,
    pieces: usize,
    #[serde(serialize_with = "serialize_rounded_option")]
    chip_thickness_mm: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    engaged_deg: Option<f64>,
    arcs_deg: String,
}

/// The columns, for a table without rows.
const COLUMNS: [&str; 14] = [
    "line",
    "operation",
    "tool",
    "length_mm",
    "feed_mm_min",
    "z_mm",
    "thickness_mm",
    "area_mm2",
    "volume_mm3",
    "inside_mm2",
    "pieces",
    "chip_thickness_mm",
    "engaged_deg",
    "arcs_deg",
];

/// The chips as a table, one row for each motion and layer with a chip: comma-separated, a head line, numbers with a decimal point,
/// empty cells for what is not known. Arcs of engagement are `from to`, several of them with a semicolon between.
///
/// # Errors
/// What `out` returns.
pub fn write_csv(report: &ChipReport, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    writer.write_record(COLUMNS).map_err(to_io_error)?;
    for row in &report.rows {
        for layer in &row.layers {
            let arcs = layer
                .arcs_deg
                .iter()
                .map(|[from, to]| format!("{} {}", round_to_micro(*from), round_to_micro(*to)));
            // What has left the chip at the motion's end is engaged no longer; how it was before is not known.
            let known = layer.area_mm2 <= 0.0 || !layer.arcs_deg.is_empty();
            let cells = ChipCsvRow {
                line: row.line,
                operation: &row.operation,
                tool: &row.tool,
                length_mm: row.length_mm,
                feed_mm_min: row.feed_mm_min,
                z_mm: layer.z,
                thickness_mm: layer.thickness_mm,
                area_mm2: layer.area_mm2,
                volume_mm3: layer.area_mm2 * layer.thickness_mm,
                inside_mm2: layer.inside_mm2,
                pieces: layer.count,
                chip_thickness_mm: layer.chip_thickness_mm,
                engaged_deg: known.then(|| layer.engaged_deg()),
                arcs_deg: arcs.collect::<Vec<_>>().join("; "),
            };
            writer.serialize(cells).map_err(to_io_error)?;
        }
    }
    writer.flush()
}

/// The writer's own error, so that a stopped run is known as one.
fn to_io_error(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
