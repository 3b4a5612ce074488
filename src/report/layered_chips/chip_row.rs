//! One motion and its layers, as CSV and JSON.

use super::json_formatter::DepthLimitedFormatter;
use super::{ChipReport, ChipTotals, OperationChips, UncutMotion};
use crate::layered_chips::Polygon;
use crate::report::rounding::{round_to_micro, serialize_rounded, serialize_rounded_option};
use serde::{Serialize, Serializer};
use std::io::{self, Write};

/// A motion and its chip.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ChipRow {
    /// 1-based line of the statement that ends the motion.
    pub line: usize,
    /// Its operation; empty where the file has none.
    pub operation: String,
    /// Its tool: the number where it is known, else the name.
    pub tool: String,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// Length of the path, mm.
    #[serde(serialize_with = "serialize_rounded")]
    pub length_mm: f64,
    /// Feed of the tool's tip, mm/min; of a rapid, the machine's.
    #[serde(serialize_with = "serialize_rounded_option")]
    pub feed_mm_min: Option<f64>,
    /// Volume of the chip, mm3.
    #[serde(serialize_with = "serialize_rounded")]
    pub volume_mm3: f64,
    /// Material that stood inside the cutter where the motion began and is part of no chip, mm3.
    #[serde(serialize_with = "serialize_rounded")]
    pub inside_mm3: f64,
    /// The thickest chip of a tooth, mm; 0 in air.
    #[serde(serialize_with = "serialize_rounded_option")]
    pub chip_thickness_mm: Option<f64>,
    /// Its layers from below, those with a chip or with material inside the cutter.
    pub layers: Vec<ChipLayerRow>,
}

/// The chip of a motion on one layer.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChipLayerRow {
    /// Number of the layer, from below.
    pub number: usize,
    /// Height of the layer's middle, mm.
    pub z_mm: f64,
    /// Its thickness, mm.
    pub thickness_mm: f64,
    /// Area of the chip, mm2.
    pub area_mm2: f64,
    /// Material that stood inside the cutter where the motion began and is part of no chip, mm2.
    pub inside_mm2: f64,
    /// The thickest chip of a tooth anywhere on the way, mm.
    pub chip_thickness_mm: Option<f64>,
    /// Where the edge was engaged at the end ([`crate::layered_chips::chip::LayerChip::arcs_deg`]); of several pieces of path, all that any of them was.
    pub arcs_deg: Vec<[f64; 2]>,
    /// How many separate pieces the chip is in.
    pub count: usize,
    /// These pieces, where borders are kept.
    pub polygons: Vec<Polygon>,
}

impl ChipLayerRow {
    /// Sum of the arcs of engagement, degrees.
    pub fn engaged_deg(&self) -> f64 {
        self.arcs_deg.iter().map(|[from, to]| to - from).sum()
    }
}

/// A border as the JSON has it.
struct BoundaryJson<'a>(&'a [[f64; 2]]);

impl Serialize for BoundaryJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|point| point.map(round_to_micro)))
    }
}

/// A layer as the JSON has it: `pieces` are outer borders, `holes` are holes, and `hole_of` says for each of these the number of
/// the piece that it is in, from 0.
#[derive(Serialize)]
struct ChipLayerJson<'a> {
    #[serde(serialize_with = "serialize_rounded")]
    z: f64,
    #[serde(serialize_with = "serialize_rounded")]
    thickness_mm: f64,
    #[serde(serialize_with = "serialize_rounded")]
    area_mm2: f64,
    #[serde(serialize_with = "serialize_rounded")]
    inside_mm2: f64,
    #[serde(serialize_with = "serialize_rounded_option")]
    chip_thickness_mm: Option<f64>,
    arcs_deg: Vec<[f64; 2]>,
    pieces: Vec<BoundaryJson<'a>>,
    holes: Vec<BoundaryJson<'a>>,
    hole_of: Vec<usize>,
}

impl Serialize for ChipLayerRow {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let holes = || {
            let pieces = self.polygons.iter().enumerate();
            pieces.flat_map(|(index, polygon)| polygon.holes.iter().map(move |hole| (index, hole)))
        };
        let layer = ChipLayerJson {
            z: self.z_mm,
            thickness_mm: self.thickness_mm,
            area_mm2: self.area_mm2,
            inside_mm2: self.inside_mm2,
            chip_thickness_mm: self.chip_thickness_mm,
            arcs_deg: self.arcs_deg.iter().map(|arc| arc.map(round_to_micro)).collect(),
            pieces: self.polygons.iter().map(|polygon| BoundaryJson(&polygon.outer)).collect(),
            holes: holes().map(|(_, hole)| BoundaryJson(hole)).collect(),
            hole_of: holes().map(|(index, _)| index).collect(),
        };
        layer.serialize(serializer)
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
        layer_mm: report.options.layer_mm,
        tolerance_mm: report.options.tolerance_mm,
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
                z_mm: layer.z_mm,
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
