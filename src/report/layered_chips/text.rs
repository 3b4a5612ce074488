//! Chips as text for people.

use super::{ChipPeak, ChipReport, OperationChips};
use crate::presentation::safe_text::to_safe_line;
use crate::report::text_format::{format_count, format_counted, format_fixed, format_short, format_table};
use std::fmt::Write;

/// Rows of a table that are shown; the JSON has all.
const MOST_ROWS: usize = 24;

/// The chips as tables.
pub fn to_text(report: &ChipReport) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", to_safe_line(&report.file));
    let (totals, options) = (&report.totals, &report.options);
    let layers = report.left.layers().len();
    let _ = writeln!(
        out,
        "  {} layers of {} mm, borders within {} mm",
        format_count(layers as u64),
        format_short(options.layer_mm),
        format_short(options.tolerance_mm),
    );
    let (from, to) = (*options.lines.start(), *options.lines.end());
    let _ = match (from, to) {
        (1, usize::MAX) => writeln!(out, "  {} ran", format_motion_count(totals.motions)),
        (from, usize::MAX) => {
            writeln!(out, "  {} ran; lines {from} and on are asked for", format_motion_count(totals.motions))
        }
        _ => {
            writeln!(out, "  {} ran; lines {from} to {to} are asked for", format_motion_count(totals.motions))
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
        let _ =
            writeln!(out, "  not cut, or in part: {}; see the findings", format_motion_count(totals.skipped));
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
    let head =
        ["operation", "tool", "motions", "cutting", "mm3", "largest", "mm2", "chip, mm", "engaged", "pieces"];
    let mut rows: Vec<Vec<String>> = vec![head.map(str::to_owned).to_vec()];
    rows.extend(report.operations.iter().take(MOST_ROWS).map(operation_cells));
    out.push('\n');
    out.push_str(&format_table(&rows));
    let more = report.operations.len().saturating_sub(MOST_ROWS);
    if more > 0 {
        let _ = writeln!(out, "  and {} more", format_count(more as u64));
    }
    out.push('\n');
}

fn operation_cells(operation: &OperationChips) -> Vec<String> {
    let peak = |largest: Option<ChipPeak>, decimals: usize| {
        largest.map_or_else(|| "-".to_owned(), |largest| format_fixed(largest.value, decimals))
    };
    vec![
        to_safe_line(&operation.name),
        to_safe_line(&operation.tool),
        format_count(operation.motions as u64),
        format_count(operation.cutting as u64),
        format_fixed(operation.volume_mm3, 1),
        peak(operation.chip_mm3, 3),
        peak(operation.area_mm2, 3),
        peak(operation.chip_thickness_mm, 4),
        peak(operation.engaged_deg, 1),
        peak(operation.pieces, 0),
    ]
}

fn append_peaks(out: &mut String, report: &ChipReport) {
    let most = |of: fn(&OperationChips) -> Option<ChipPeak>| {
        let all = report.operations.iter().filter_map(of);
        // The first of equals, in the order of the file.
        all.reduce(|a, b| if b.value > a.value { b } else { a })
    };
    let all = [
        ("largest chip", most(|sums| sums.chip_mm3), 4, "mm3"),
        ("largest area on a layer", most(|sums| sums.area_mm2), 4, "mm2"),
        ("thickest chip of a tooth", most(|sums| sums.chip_thickness_mm), 4, "mm"),
        ("largest engagement", most(|sums| sums.engaged_deg), 1, "degrees"),
        ("most separate pieces", most(|sums| sums.pieces).filter(|most| most.value > 1.0), 0, ""),
    ];
    for (what, found, decimals, unit) in all {
        let Some(found) = found else { continue };
        let at = found.z_mm.map_or_else(String::new, |z| format!(" at z {}", format_short(z)));
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let _ = writeln!(
            out,
            "  {what}: {}{unit} on line {}{at}",
            format_fixed(found.value, decimals),
            found.line
        );
    }
    if report.rows.iter().all(|row| row.volume_mm3 <= 0.0) {
        let _ = writeln!(out, "  nothing is cut");
    }
}
