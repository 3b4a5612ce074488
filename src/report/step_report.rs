//! What steps have to say about themselves, as text for people.

use super::path_drawing::PathPanel;
use super::render::safe_text::to_safe_line;
use super::text_format::{format_count, format_duration, format_fixed, format_table};
use crate::transform::StepReport;
use crate::transform::optimize_feed::{OperationFeedReport, OptimizeFeedReport};
use std::fmt::Write;

/// A step's report.
pub fn to_text(report: &StepReport) -> String {
    match report {
        StepReport::CompensateZ(report) => super::compensate_z_report::to_text(report),
        StepReport::CorrectRamp(report) => super::correct_ramp_report::to_text(report),
        StepReport::OptimizeFeed(report) => describe_optimized_feed(report),
    }
}

/// What a step's report draws; empty for a step that draws nothing.
pub fn build_panels(report: &StepReport) -> Vec<PathPanel> {
    match report {
        StepReport::CompensateZ(report) => super::compensate_z_report::build_panels(report),
        StepReport::CorrectRamp(report) => super::correct_ramp_report::build_panels(report),
        StepReport::OptimizeFeed(_) => Vec::new(),
    }
}

fn describe_optimized_feed(report: &OptimizeFeedReport) -> String {
    let mut out = String::new();
    let name = report.criterion.display_name();
    let _ = writeln!(
        out,
        "\noptimize_feed: {name} to {} {}, simulated again after the change",
        format_significant(report.target),
        report.unit
    );
    let mut rows = vec![
        ["", "time before", "after", "saved", "largest before", "after", "at target before", "after"]
            .map(str::to_owned)
            .to_vec(),
    ];
    if report.operations.len() > 1 {
        rows.extend(report.operations.iter().map(|operation| operation_cells(&operation.name, operation)));
    }
    rows.push(operation_cells("all", &report.whole));
    out.push_str(&format_table(&rows));
    let with = report.acceleration.map_or_else(
        || "feeds that change at once".to_owned(),
        |acceleration| format!("{} (mm/min)/s", format_fixed(acceleration, 0)),
    );
    let _ = writeln!(
        out,
        "  {} FEDRATs put in, {} changed, {} points put in; times at feed with {with}",
        format_count(report.feeds_added as u64),
        format_count(report.feeds_changed as u64),
        format_count(report.points_added as u64),
    );
    let grain = match (report.cell_mm, report.layer_mm) {
        (_, Some(layer)) => format!("layers of {} mm; for them", format_significant(layer)),
        (cell, None) => format!("cell {} mm; for the grid", format_significant(cell.unwrap_or_default())),
    };
    let _ = writeln!(
        out,
        "  {grain}, the {name} may be up to {} {} above what is told",
        format_significant(report.uncertainty),
        report.unit,
    );
    out
}

fn operation_cells(name: &str, figures: &OperationFeedReport) -> Vec<String> {
    let share = |share: f64| format!("{:.0} %", share * 100.0);
    vec![
        to_safe_line(name),
        format_duration(figures.seconds_before),
        format_duration(figures.seconds_after),
        format!("{:.1} %", figures.saved_fraction() * 100.0),
        format_significant(figures.largest_before),
        format_significant(figures.largest_after),
        share(figures.at_target_before),
        share(figures.at_target_after),
    ]
}

/// A number with four significant digits.
fn format_significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3.0 - value.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
