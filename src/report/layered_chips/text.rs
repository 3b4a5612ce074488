//! This module writes chips as text for people.

use super::sum_columns::operation_columns;
use super::{ChipReport, OperationChips};
use crate::presentation::safe_text::to_safe_line;
use crate::report::table::{DisplayUnits, PrintedTable, TableLooks};
use crate::report::text_format::{format_count, format_counted, format_fixed, format_short};
use std::fmt::Write;

/// The number of rows of a table that are shown. The JSON has all of them.
const MOST_ROWS: usize = 24;

/// Chips are reported in mm, whatever the program's unit.
const LOOKS: TableLooks = TableLooks::plain(DisplayUnits::MM);

/// Returns the chips as tables.
pub fn to_text(report: &ChipReport) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", to_safe_line(&report.file));
    let (totals, options) = (&report.totals, &report.options);
    let layers = report.left.layers().len();
    let _ = writeln!(
        out,
        "  {} layers of {} mm, boundaries within {} mm",
        format_count(layers as u64),
        format_short(options.layer_mm),
        format_short(options.tolerance_mm),
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
        "  stock {} mm3, chips {} mm3, left {} mm3",
        format_fixed(totals.stock_mm3, 1),
        format_fixed(totals.chips_mm3, 1),
        format_fixed(totals.left_mm3, 1),
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

fn format_motion_count(number: usize) -> String {
    format_counted(number, "motion", "motions")
}

fn append_operations(out: &mut String, report: &ChipReport) {
    if report.operations.is_empty() {
        return;
    }
    let table = PrintedTable::from_rows(&operation_columns(), &report.operations, LOOKS).keep_rows(MOST_ROWS);
    let _ = writeln!(out, "\n{}", table.to_text());
}

fn append_peaks(out: &mut String, report: &ChipReport) {
    let peaks = OperationChips::largest_of(&report.operations);
    for sentence in operation_columns().iter().filter_map(|column| LOOKS.word_peak(column, &peaks)) {
        let _ = writeln!(out, "  {sentence}");
    }
    if report.rows.iter().all(|row| row.volume_mm3 <= 0.0) {
        let _ = writeln!(out, "  nothing is cut");
    }
}
