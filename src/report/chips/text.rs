//! Chips as text for people.

use super::{ChipReport, Largest, OperationChips};
use crate::report::render::text::one_line;
use crate::report::table::{count, counted, fixed, short, table};
use std::fmt::Write;

/// Rows of a table that are shown; the JSON has all.
const MOST_ROWS: usize = 24;

/// The chips as tables.
pub fn to_text(report: &ChipReport) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", one_line(&report.file));
    let (totals, options) = (&report.totals, &report.options);
    let layers = report.left.layers().len();
    let _ = writeln!(
        out,
        "  {} layers of {} mm, borders within {} mm",
        count(layers as u64),
        short(options.layer),
        short(options.tolerance),
    );
    let (from, to) = (*options.lines.start(), *options.lines.end());
    let _ = match (from, to) {
        (1, usize::MAX) => writeln!(out, "  {} ran", motions(totals.motions)),
        (from, usize::MAX) => {
            writeln!(out, "  {} ran; lines {from} and on are asked for", motions(totals.motions))
        }
        _ => writeln!(out, "  {} ran; lines {from} to {to} are asked for", motions(totals.motions)),
    };
    let _ = writeln!(
        out,
        "  stock {} mm3, chips {} mm3, left {} mm3",
        fixed(totals.stock_mm3, 1),
        fixed(totals.chips_mm3, 1),
        fixed(totals.left_mm3, 1),
    );
    operations(&mut out, report);
    largest(&mut out, report);
    if totals.skipped > 0 {
        let _ = writeln!(out, "  not cut, or in part: {}; see the findings", motions(totals.skipped));
    }
    for assumption in &report.assumptions {
        let _ = writeln!(out, "  assumed: {assumption}");
    }
    out
}

fn motions(number: usize) -> String {
    counted(number, "motion", "motions")
}

fn operations(out: &mut String, report: &ChipReport) {
    if report.operations.is_empty() {
        return;
    }
    let head =
        ["operation", "tool", "motions", "cutting", "mm3", "largest", "mm2", "chip, mm", "engaged", "pieces"];
    let mut rows: Vec<Vec<String>> = vec![head.map(str::to_owned).to_vec()];
    rows.extend(report.operations.iter().take(MOST_ROWS).map(row));
    out.push('\n');
    out.push_str(&table(&rows));
    let more = report.operations.len().saturating_sub(MOST_ROWS);
    if more > 0 {
        let _ = writeln!(out, "  and {} more", count(more as u64));
    }
    out.push('\n');
}

fn row(operation: &OperationChips) -> Vec<String> {
    let peak = |largest: Option<Largest>, decimals: usize| {
        largest.map_or_else(|| "-".to_owned(), |largest| fixed(largest.value, decimals))
    };
    vec![
        one_line(&operation.name),
        one_line(&operation.tool),
        count(operation.motions as u64),
        count(operation.cutting as u64),
        fixed(operation.volume_mm3, 1),
        peak(operation.chip_mm3, 3),
        peak(operation.area_mm2, 3),
        peak(operation.chip_thickness_mm, 4),
        peak(operation.engaged_deg, 1),
        peak(operation.pieces, 0),
    ]
}

fn largest(out: &mut String, report: &ChipReport) {
    let most = |of: fn(&OperationChips) -> Option<Largest>| {
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
        let at = found.z.map_or_else(String::new, |z| format!(" at z {}", short(z)));
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let _ = writeln!(out, "  {what}: {}{unit} on line {}{at}", fixed(found.value, decimals), found.line);
    }
    if report.rows.iter().all(|row| row.volume_mm3 <= 0.0) {
        let _ = writeln!(out, "  nothing is cut");
    }
}
