//! One motion, and the table of them all.

use super::{MotionRows, SimulationReport};
use crate::report::rounding::{serialize_rounded, serialize_rounded_option};
use serde::Serialize;
use std::io::{self, Write};

/// What a motion engaged and what the tool had to bear. `None` is not known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionRow {
    /// 1-based line of the statement that ends the motion; `None` for one that a step put in.
    pub line: Option<usize>,
    /// Index of its operation.
    pub operation: usize,
    /// Index of its tool.
    pub tool: usize,
    /// Whether it is a rapid.
    pub rapid: bool,
    /// Length of the path, mm.
    pub length_mm: f64,
    /// Feed of the tool's tip, mm/min; of a rapid, the machine's.
    pub feed_mm_min: Option<f64>,
    /// Time at that feed, s.
    pub seconds: Option<f64>,
    /// The thickest chip, mm.
    pub chip_thickness_mm: Option<f64>,
    /// Removed volume by time, mm3/min: the mean over the motion.
    pub removal_rate_mm3_min: Option<f64>,
    /// Height of the engaged part of the cutter along its axis, mm.
    pub axial_depth_mm: Option<f64>,
    /// Width of the cut across path and axis, mm; no more than the diameter at the highest engaged point.
    pub radial_depth_mm: Option<f64>,
    /// Angle at which a tooth enters, degrees ([`crate::engagement::Engagement::immersion_deg`]).
    pub engagement_start_deg: Option<f64>,
    /// Angle at which it leaves, degrees.
    pub engagement_end_deg: Option<f64>,
    /// Largest cutting force over a revolution, N.
    pub force_n: Option<f64>,
    /// Largest torque over a revolution, N m.
    pub torque_nm: Option<f64>,
    /// Largest mean power over a revolution, kW.
    pub power_kw: Option<f64>,
}

/// A row as it is printed: the columns of the CSV and the keys of the JSON.
#[derive(Debug, Serialize)]
pub(super) struct PrintedMotionRow<'a> {
    line: Option<usize>,
    operation: &'a str,
    tool: &'a str,
    #[serde(serialize_with = "serialize_rounded")]
    length_mm: f64,
    #[serde(serialize_with = "serialize_rounded_option")]
    feed_mm_min: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    chip_thickness_mm: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    removal_rate_mm3_min: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    axial_depth_mm: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    radial_depth_mm: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    engagement_start_deg: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    engagement_end_deg: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    force_n: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    torque_nm: Option<f64>,
    #[serde(serialize_with = "serialize_rounded_option")]
    power_kw: Option<f64>,
}

/// The columns, for a table without rows.
const COLUMNS: [&str; 14] = [
    "line",
    "operation",
    "tool",
    "length_mm",
    "feed_mm_min",
    "chip_thickness_mm",
    "removal_rate_mm3_min",
    "axial_depth_mm",
    "radial_depth_mm",
    "engagement_start_deg",
    "engagement_end_deg",
    "force_n",
    "torque_nm",
    "power_kw",
];

impl<'a> PrintedMotionRow<'a> {
    pub(super) fn from_row(row: &MotionRow, motions: &'a MotionRows) -> Self {
        let name = |names: &'a [String], index: usize| names.get(index).map_or("", String::as_str);
        Self {
            line: row.line,
            operation: name(&motions.operations, row.operation),
            tool: name(&motions.tools, row.tool),
            length_mm: row.length_mm,
            feed_mm_min: row.feed_mm_min,
            chip_thickness_mm: row.chip_thickness_mm,
            removal_rate_mm3_min: row.removal_rate_mm3_min,
            axial_depth_mm: row.axial_depth_mm,
            radial_depth_mm: row.radial_depth_mm,
            engagement_start_deg: row.engagement_start_deg,
            engagement_end_deg: row.engagement_end_deg,
            force_n: row.force_n,
            torque_nm: row.torque_nm,
            power_kw: row.power_kw,
        }
    }
}

/// The motions as a table: comma-separated, a head line, numbers with a decimal point, empty cells for what is not known.
///
/// # Errors
/// What `out` returns.
pub fn write_csv(simulated: &SimulationReport, out: &mut dyn Write) -> io::Result<()> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    writer.write_record(COLUMNS).map_err(to_io_error)?;
    for cells in simulated.motions.printed_rows() {
        writer.serialize(cells).map_err(to_io_error)?;
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
