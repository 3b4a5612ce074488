//! This module shows what `optimize_feed` did, as a table.

use super::report::{OperationFeedReport, OptimizeFeedReport};
use crate::number::format_significant_number;
use crate::presentation::safe_text::to_safe_line;
use crate::presentation::text_format::{format_count, format_duration, format_fixed, format_table};
use crate::transform::step_report::{TransformReport, to_json_value};
use std::fmt::Write;

impl TransformReport for OptimizeFeedReport {
    fn step_name(&self) -> &'static str {
        "optimize_feed"
    }

    fn to_text(&self) -> String {
        describe_optimized_feed(self)
    }

    fn to_json(&self) -> serde_json::Value {
        to_json_value(self)
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
    let resolution = match (report.cell_mm, report.layer_mm) {
        (_, Some(layer)) => format!("layers of {} mm; for them", format_significant(layer)),
        (Some(cell), None) => format!("cell {} mm; for the grid", format_significant(cell)),
        // A report has either cells or layers, so this sentence without a size is never printed.
        (None, None) => "for the grid".to_owned(),
    };
    let _ = writeln!(
        out,
        "  {resolution}, the {name} may be up to {} {} above these figures",
        format_significant(report.uncertainty),
        report.unit,
    );
    out
}

fn operation_cells(name: &str, figures: &OperationFeedReport) -> Vec<String> {
    let percent = |fraction: f64| format!("{:.0} %", fraction * 100.0);
    vec![
        to_safe_line(name),
        format_duration(figures.seconds_before),
        format_duration(figures.seconds_after),
        format!("{:.1} %", figures.saved_fraction() * 100.0),
        format_significant(figures.largest_before),
        format_significant(figures.largest_after),
        percent(figures.at_target_before),
        percent(figures.at_target_after),
    ]
}

/// Formats a load or a feed with four significant digits.
fn format_significant(value: f64) -> String {
    format_significant_number(value, 4, 9)
}
