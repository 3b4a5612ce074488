//! A simulation as text for people.

use super::target_comparison::TargetMismatch;
use super::{OperationSums, SimulationPeak, SimulationReport, SimulationSums};
use crate::number::format_named_point;
use crate::presentation::safe_text::to_safe_line;
use crate::report::text_format::{
    format_count, format_counted, format_duration, format_fixed, format_short, format_table, format_trimmed,
};
use std::fmt::Write;

/// Rows of a table that are shown; the JSON has all.
const MOST_ROWS: usize = 24;

/// The simulation as tables.
pub fn to_text(simulated: &SimulationReport) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", to_safe_line(&simulated.file));
    append_stock(&mut out, simulated);
    append_times(&mut out, simulated);
    append_operations(&mut out, simulated);
    append_peaks(&mut out, &simulated.totals);
    append_faults(&mut out, simulated);
    append_target(&mut out, simulated);
    for assumption in &simulated.assumptions {
        let _ = writeln!(out, "  assumed: {assumption}");
    }
    out
}

fn append_stock(out: &mut String, simulated: &SimulationReport) {
    let (cost, accuracy) = (&simulated.cost, &simulated.accuracy);
    let _ = writeln!(
        out,
        "  {} columns {} mm apart ({} MiB), about {:.0e} looks at them along {} mm of path",
        format_count(cost.columns),
        format_short(accuracy.cell_mm),
        format_fixed(cost.bytes as f64 / f64::from(1 << 20), 1),
        cost.visits,
        format_fixed(cost.path_mm, 1),
    );
    let _ = writeln!(
        out,
        "  borders of material are known to {} mm across z, curves to {} mm",
        format_trimmed(accuracy.lateral_mm, 4),
        format_trimmed(accuracy.chord_mm, 4),
    );
    let stock = &simulated.stock;
    let _ = writeln!(
        out,
        "  stock {} mm3, removed {} mm3, left {} mm3",
        format_fixed(stock.before_mm3, 1),
        format_fixed(stock.removed_mm3, 1),
        format_fixed(stock.left_mm3, 1),
    );
}

fn append_times(out: &mut String, simulated: &SimulationReport) {
    let totals = &simulated.totals;
    let mut parts = vec![format!("{} at feed", format_feed_time(totals))];
    if let Some(with) = simulated.accelerated_seconds.filter(|_| totals.untimed == 0) {
        parts.push(format!("{} with the machine's acceleration", format_duration(with)));
    }
    if let Some(rapid) = totals.rapid_seconds {
        parts.push(format!("{} at rapid", format_duration(rapid)));
    }
    let _ = writeln!(out, "  time: {}", parts.join(", "));
    if totals.untimed > 0 {
        let motions = format_counted(totals.untimed, "motion", "motions");
        let _ = writeln!(out, "  {motions} at a feed that is not known, and without a time");
    }
}

/// A time that leaves motions out is a lower bound, and says so.
fn format_feed_time(sums: &SimulationSums) -> String {
    format!("{}{}", if sums.untimed > 0 { "> " } else { "" }, format_duration(sums.feed_seconds))
}

fn append_operations(out: &mut String, simulated: &SimulationReport) {
    let forces = simulated.motions.rows.iter().any(|row| row.force_n.is_some());
    let mut head = vec![
        "operation",
        "tool",
        "motions",
        "at feed, mm",
        "time",
        "mm3",
        "chip, mm",
        "mm3/min",
        "deep",
        "wide",
    ];
    if forces {
        head.extend(["N", "kW"]);
    }
    let mut rows: Vec<Vec<String>> = vec![head.into_iter().map(str::to_owned).collect()];
    rows.extend(
        simulated.operations.iter().take(MOST_ROWS).map(|operation| operation_cells(operation, forces)),
    );
    out.push('\n');
    out.push_str(&format_table(&rows));
    let more = simulated.operations.len().saturating_sub(MOST_ROWS);
    if more > 0 {
        let _ = writeln!(out, "  and {} more", format_count(more as u64));
    }
    out.push('\n');
}

fn operation_cells(operation: &OperationSums, forces: bool) -> Vec<String> {
    let sums = &operation.sums;
    let peak = |peak: Option<SimulationPeak>, decimals: usize| {
        peak.map_or_else(|| "-".to_owned(), |peak| format_fixed(peak.value, decimals))
    };
    let mut row = vec![
        to_safe_line(&operation.name),
        to_safe_line(&operation.tool),
        format_count(sums.motions as u64),
        format_fixed(sums.feed_mm, 1),
        format_feed_time(sums),
        format_fixed(sums.removed_mm3, 1),
        peak(sums.chip_thickness_mm, 4),
        peak(sums.removal_rate_mm3_min, 0),
        peak(sums.axial_depth_mm, 2),
        peak(sums.radial_depth_mm, 2),
    ];
    if forces {
        row.extend([peak(sums.force_n, 0), peak(sums.power_kw, 3)]);
    }
    row
}

fn append_peaks(out: &mut String, totals: &SimulationSums) {
    let all = [
        ("thickest chip", totals.chip_thickness_mm, 4, "mm"),
        ("largest removal rate", totals.removal_rate_mm3_min, 0, "mm3/min"),
        ("largest force", totals.force_n, 0, "N"),
        ("largest torque", totals.torque_nm, 2, "N m"),
        ("largest power", totals.power_kw, 3, "kW"),
    ];
    for (what, peak, decimals, unit) in all {
        let Some(peak) = peak else { continue };
        let line = peak.line.map_or_else(String::new, |line| format!(" on line {line}"));
        let _ = writeln!(out, "  {what}: {} {unit}{line}", format_fixed(peak.value, decimals));
    }
    if totals.cutting == 0 {
        let _ = writeln!(out, "  nothing is cut");
    }
}

fn append_faults(out: &mut String, simulated: &SimulationReport) {
    let faults = simulated.faults;
    let motions = |number: usize| format_counted(number, "motion", "motions");
    let _ = match faults.collisions {
        0 => writeln!(out, "  no collision of shank or holder"),
        some => writeln!(out, "  shank or holder in material: {}", motions(some)),
    };
    if faults.rapids_in_material > 0 {
        let _ = writeln!(out, "  rapids through material: {}", motions(faults.rapids_in_material));
    }
    if faults.spindle_stands > 0 {
        let _ = writeln!(out, "  cuts while the spindle stands: {}", motions(faults.spindle_stands));
    }
    if faults.unknown_feeds > 0 {
        let _ =
            writeln!(out, "  cuts at a feed or speed that is not known: {}", motions(faults.unknown_feeds));
    }
}

fn append_target(out: &mut String, simulated: &SimulationReport) {
    let Some(compared) = &simulated.target else { return };
    let name = to_safe_line(&compared.file);
    let _ = writeln!(out, "  against {name}, tolerance {} mm:", format_trimmed(compared.tolerance_mm, 4));
    let mut side = |what: &str, found: &TargetMismatch| {
        let _ = match &found.thickest {
            None => writeln!(out, "    no {what}"),
            Some(thickest) => {
                writeln!(
                    out,
                    "    {what} {} mm3, at most {} mm along z, at {} mm",
                    format_fixed(found.volume_mm3, 1),
                    format_fixed(thickest.thickness_mm, 3),
                    format_named_point(thickest.at_mm, 3),
                )
            }
        };
    };
    side("gouge", &compared.gouge);
    side("excess", &compared.excess);
}
