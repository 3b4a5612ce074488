//! This module writes chips as text for people.

use super::sum_columns::operation_columns;
use super::{ChipReport, OperationChips};
use crate::number::format_trimmed_number;
use crate::presentation::safe_text::to_safe_line;
use crate::report::table::{ColumnUnit, PrintedTable, TableLooks};
use crate::report::text_format::{format_count, format_counted};
use std::fmt::Write;

/// The number of rows of a table that are shown. The JSON has all of them.
const MOST_ROWS: usize = 24;

/// Returns the chips as text with tables.
pub fn to_text(report: &ChipReport) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", to_safe_line(&report.file));
    let (totals, options, units) = (&report.totals, &report.options, report.units);
    let layers = report.left.layers().len();
    let _ = writeln!(
        out,
        "  {} layers of {}{}, boundaries within {}",
        format_count(layers as u64),
        units.tell_trimmed(ColumnUnit::Length, options.layer_mm, 3),
        describe_direction(report),
        units.tell_trimmed(ColumnUnit::Length, options.tolerance_mm, 3),
    );
    let (from, to) = (*options.lines.start(), *options.lines.end());
    let _ = match (from, to) {
        (1, usize::MAX) => writeln!(out, "  {} ran", format_motion_count(totals.motions)),
        (from, usize::MAX) => {
            writeln!(out, "  {} ran; lines from {from} on are reported", format_motion_count(totals.motions))
        }
        _ => {
            writeln!(out, "  {} ran; lines {from} to {to} are reported", format_motion_count(totals.motions))
        }
    };
    let _ = writeln!(
        out,
        "  stock {}, chips {}, left {}",
        units.tell_fixed(ColumnUnit::Volume, totals.stock_mm3, 1),
        units.tell_fixed(ColumnUnit::Volume, totals.chips_mm3, 1),
        units.tell_fixed(ColumnUnit::Volume, totals.left_mm3, 1),
    );
    append_operations(&mut out, report);
    append_peaks(&mut out, report);
    if totals.skipped > 0 {
        let _ = writeln!(
            out,
            "  not cut, or only in part: {}; see the findings",
            format_motion_count(totals.skipped)
        );
    }
    for assumption in &report.assumptions {
        let _ = writeln!(out, "  assumed: {assumption}");
    }
    out
}

/// Returns across which direction the layers lie, to be read after their thickness; nothing for the workpiece's z.
fn describe_direction(report: &ChipReport) -> String {
    if report.frame.is_workpiece() {
        return String::new();
    }
    let [_, _, z] = report.frame.axes();
    let [i, j, k] = z.map(|part| format_trimmed_number(part, 6));
    format!(" across the direction {i},{j},{k}, along which z is told")
}

fn format_motion_count(number: usize) -> String {
    format_counted(number, "motion", "motions")
}

fn append_operations(out: &mut String, report: &ChipReport) {
    if report.operations.is_empty() {
        return;
    }
    let looks = TableLooks::plain(report.units);
    let table = PrintedTable::from_rows(&operation_columns(), &report.operations, looks).keep_rows(MOST_ROWS);
    let _ = writeln!(out, "\n{}", table.to_text());
}

fn append_peaks(out: &mut String, report: &ChipReport) {
    let peaks = OperationChips::largest_of(&report.operations);
    let looks = TableLooks::plain(report.units);
    for sentence in operation_columns().iter().filter_map(|column| looks.word_peak(column, &peaks)) {
        let _ = writeln!(out, "  {sentence}");
    }
    if report.rows.iter().all(|row| row.volume_mm3 <= 0.0) {
        let _ = writeln!(out, "  nothing is cut");
    }
}
