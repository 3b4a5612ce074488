//! What steps have to say about themselves, as text for people.

use super::picture::Panel;
use super::render::text::one_line;
use super::table::{count, duration, fixed, table};
use crate::transform::StepReport;
use crate::transform::optimize_feed::{OperationReport, Report};
use std::fmt::Write;

/// A step's report.
pub fn to_text(report: &StepReport) -> String {
    match report {
        StepReport::CompensateZ(report) => super::compensated::to_text(report),
        StepReport::CorrectRamp(report) => super::ramps::to_text(report),
        StepReport::OptimizeFeed(report) => optimized(report),
    }
}

/// What a step's report draws; empty for a step that draws nothing.
pub fn panels(report: &StepReport) -> Vec<Panel> {
    match report {
        StepReport::CompensateZ(report) => super::compensated::panels(report),
        StepReport::CorrectRamp(report) => super::ramps::panels(report),
        StepReport::OptimizeFeed(_) => Vec::new(),
    }
}

fn optimized(report: &Report) -> String {
    let mut out = String::new();
    let name = report.criterion.name();
    let _ = writeln!(
        out,
        "\noptimize_feed: {name} to {} {}, simulated again after the change",
        significant(report.target),
        report.unit
    );
    let mut rows = vec![
        ["", "time before", "after", "saved", "largest before", "after", "at target before", "after"]
            .map(str::to_owned)
            .to_vec(),
    ];
    if report.operations.len() > 1 {
        rows.extend(report.operations.iter().map(|operation| row(&operation.name, operation)));
    }
    rows.push(row("all", &report.whole));
    out.push_str(&table(&rows));
    let with = report.acceleration.map_or_else(
        || "feeds that change at once".to_owned(),
        |acceleration| format!("{} (mm/min)/s", fixed(acceleration, 0)),
    );
    let _ = writeln!(
        out,
        "  {} FEDRATs put in, {} changed, {} points put in; times at feed with {with}",
        count(report.feeds_added as u64),
        count(report.feeds_changed as u64),
        count(report.points_added as u64),
    );
    let grain = match (report.cell_mm, report.layer_mm) {
        (_, Some(layer)) => format!("layers of {} mm; for them", significant(layer)),
        (cell, None) => format!("cell {} mm; for the grid", significant(cell.unwrap_or_default())),
    };
    let _ = writeln!(
        out,
        "  {grain}, the {name} may be up to {} {} above what is told",
        significant(report.uncertainty),
        report.unit,
    );
    out
}

fn row(name: &str, figures: &OperationReport) -> Vec<String> {
    let share = |share: f64| format!("{:.0} %", share * 100.0);
    vec![
        one_line(name),
        duration(figures.seconds_before),
        duration(figures.seconds_after),
        format!("{:.1} %", figures.saved() * 100.0),
        significant(figures.largest_before),
        significant(figures.largest_after),
        share(figures.at_target_before),
        share(figures.at_target_after),
    ]
}

/// A number with four significant digits.
fn significant(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let decimals = (3.0 - value.abs().log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
