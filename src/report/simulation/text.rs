//! This module writes a simulation as text for people.

use super::SimulationReport;
use super::edge_maps::describe_edge_maps;
use super::sum_columns::{operation_columns, sum_columns};
use super::target_comparison::TargetMismatch;
use crate::number::format_named_point;
use crate::presentation::safe_text::to_safe_line;
use crate::report::table::{ColumnUnit, PrintedTable, TableLooks, pick_columns};
use crate::report::text_format::{format_count, format_counted, format_duration, format_fixed};
use std::fmt::Write;

/// The number of rows of a table that are shown. The JSON has all of them.
const MOST_ROWS: usize = 24;

/// Returns the simulation as text with tables.
pub fn to_text(simulated: &SimulationReport) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", to_safe_line(&simulated.file));
    append_stock(&mut out, simulated);
    append_times(&mut out, simulated);
    append_operations(&mut out, simulated);
    append_peaks(&mut out, simulated);
    append_faults(&mut out, simulated);
    append_target(&mut out, simulated);
    for sentence in describe_edge_maps(simulated) {
        let _ = writeln!(out, "  {sentence}");
    }
    for assumption in &simulated.assumptions {
        let _ = writeln!(out, "  assumed: {assumption}");
    }
    out
}

fn append_stock(out: &mut String, simulated: &SimulationReport) {
    let (cost, accuracy, units) = (&simulated.cost, &simulated.accuracy, simulated.units);
    let _ = writeln!(
        out,
        "  {} columns {} apart ({} MiB), about {:.0e} readings of them along {} of path",
        format_count(cost.columns),
        units.tell_trimmed(ColumnUnit::Length, accuracy.cell_mm, 3),
        format_fixed(cost.bytes as f64 / f64::from(1 << 20), 1),
        cost.visits,
        units.tell_fixed(ColumnUnit::Length, cost.path_mm, 1),
    );
    let _ = writeln!(
        out,
        "  boundaries of material are known to {} across z, curves to {}",
        units.tell_trimmed(ColumnUnit::Length, accuracy.lateral_mm, 4),
        units.tell_trimmed(ColumnUnit::Length, accuracy.chord_mm, 4),
    );
    let stock = &simulated.stock;
    let _ = writeln!(
        out,
        "  stock {}, removed {}, left {}",
        units.tell_fixed(ColumnUnit::Volume, stock.before_mm3, 1),
        units.tell_fixed(ColumnUnit::Volume, stock.removed_mm3, 1),
        units.tell_fixed(ColumnUnit::Volume, stock.left_mm3, 1),
    );
}

fn append_times(out: &mut String, simulated: &SimulationReport) {
    let totals = &simulated.totals;
    let at_least = if totals.untimed > 0 { "> " } else { "" };
    let (seconds, how) = match totals.accelerated_seconds {
        Some(seconds) => (seconds, "with the machine's acceleration"),
        None => (totals.feed_seconds, "without acceleration"),
    };
    // A time that leaves out motions is a lower bound, so it is marked with `>`.
    let mut parts = vec![format!("{at_least}{} at feed {how}", format_duration(seconds))];
    if let Some(rapid) = totals.rapid_seconds {
        parts.push(format!("{} at rapid", format_duration(rapid)));
    }
    if let Some(standing) = totals.standing_seconds.filter(|standing| *standing > 0.0) {
        parts.push(format!("{} for tool changes, spindle starts and dwells", format_duration(standing)));
    }
    let _ = writeln!(out, "  time: {}", parts.join(", "));
    if totals.untimed > 0 {
        let motions = format_counted(totals.untimed, "motion", "motions");
        let _ = writeln!(out, "  {motions} at a feed that is not known, and without a time");
    }
}

/// The keys of the sums in the table of operations, in this order.
const SUMS: [&str; 9] = [
    "motions",
    "feed",
    "feed_time",
    "removed",
    "chip_thickness",
    "chip_thickness_bound",
    "removal_rate_peak",
    "axial_depth",
    "radial_depth",
];

fn append_operations(out: &mut String, simulated: &SimulationReport) {
    let mut columns = operation_columns().to_vec();
    let time = if simulated.totals.accelerated_seconds.is_some() { "accelerated_time" } else { "feed_time" };
    columns
        .extend(pick_columns(&sum_columns(), &SUMS.map(|key| if key == "feed_time" { time } else { key })));
    if simulated.motions.rows.iter().any(|row| row.force_n.is_some()) {
        columns.extend(pick_columns(&sum_columns(), &["force_peak", "power_peak"]));
    }
    if simulated.totals.deflection_mm.is_some() {
        columns.extend(pick_columns(&sum_columns(), &["deflection_peak", "bending_stress_peak"]));
    }
    let table = PrintedTable::from_rows(&columns, &simulated.operations, TableLooks::plain(simulated.units))
        .keep_rows(MOST_ROWS);
    let _ = writeln!(out, "\n{}", table.to_text());
}

fn append_peaks(out: &mut String, simulated: &SimulationReport) {
    let (totals, looks) = (&simulated.totals, TableLooks::plain(simulated.units));
    for sentence in sum_columns().iter().filter_map(|column| looks.word_peak(column, totals)) {
        let _ = writeln!(out, "  {sentence}");
    }
    if totals.chip_thickness_bound_mm.is_some() {
        let _ = writeln!(out, "  ({})", simulated.describe_chip_certainty(simulated.units));
    }
    if totals.removal_rate_mm3_min.is_some() {
        let window = simulated.accuracy.removal_window_mm;
        let window = simulated.units.tell_trimmed(ColumnUnit::Length, window, 3);
        let _ = writeln!(out, "  (the largest removal rate is a mean over {window} of path)");
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
        let _ = writeln!(out, "  cuts while the spindle does not turn: {}", motions(faults.spindle_stands));
    }
    if faults.unknown_feeds > 0 {
        let _ =
            writeln!(out, "  cuts at a feed or speed that is not known: {}", motions(faults.unknown_feeds));
    }
}

fn append_target(out: &mut String, simulated: &SimulationReport) {
    let Some(compared) = &simulated.target else { return };
    let name = to_safe_line(&compared.file);
    let units = simulated.units;
    let tolerance = units.tell_trimmed(ColumnUnit::Length, compared.tolerance_mm, 4);
    let _ = writeln!(out, "  against {name}, tolerance {tolerance}:");
    let mut side = |what: &str, found: &TargetMismatch| {
        let _ = match &found.thickest {
            None => writeln!(out, "    no {what}"),
            Some(thickest) => {
                writeln!(
                    out,
                    "    {what} {}, at most {} along z, at {} {}",
                    units.tell_fixed(ColumnUnit::Volume, found.volume_mm3, 1),
                    units.tell_fixed(ColumnUnit::Length, thickest.thickness_mm, 3),
                    format_named_point(
                        thickest.at_mm.map(|at| units.convert(ColumnUnit::Length, at)),
                        units.decimals(ColumnUnit::Length, 3)
                    ),
                    ColumnUnit::Length.symbol(units.shown_in),
                )
            }
        };
    };
    side("gouge", &compared.gouge);
    side("excess", &compared.excess);
}
