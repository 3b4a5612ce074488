//! This module shows what `optimize_feed` did, as a table.

use super::report::{OperationFeedReport, OptimizeFeedReport};
use crate::number::format_significant_number;
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::presentation::safe_text::to_safe_line;
use crate::presentation::text_format::{format_count, format_duration, format_fixed, format_table};
use crate::transform::optimize_feed::measure::LoadCriterion;
use crate::transform::step_report::{TransformReport, to_json_value};
use std::fmt::Write;

impl TransformReport for OptimizeFeedReport {
    fn step_name(&self) -> &'static str {
        "optimize_feed"
    }

    fn to_text(&self, units: DisplayUnits) -> String {
        describe_optimized_feed(self, units)
    }

    fn to_json(&self) -> serde_json::Value {
        to_json_value(self)
    }
}

fn describe_optimized_feed(report: &OptimizeFeedReport, units: DisplayUnits) -> String {
    let load = LoadFormat { unit: report.criterion.column_unit(), units };
    let mut out = String::new();
    let name = report.criterion.display_name();
    let _ = writeln!(
        out,
        "\noptimize_feed: {name} to {}, simulated again after the change",
        load.format_with_unit(report.target),
    );
    if let (Some(before), Some(after)) = (report.machine_seconds_before, report.machine_seconds_after) {
        let change = if before > 0.0 { 100.0 * (after / before - 1.0) } else { 0.0 };
        let _ = writeln!(
            out,
            "  on the machine {} instead of {} ({change:+.1} %), with corners, axes, rapids and tool changes",
            format_duration(after),
            format_duration(before),
        );
    }
    let mut rows = vec![
        ["", "time at feed", "after", "saved", "largest before", "after", "at target before", "after"]
            .map(str::to_owned)
            .to_vec(),
    ];
    if report.operations.len() > 1 {
        rows.extend(
            report.operations.iter().map(|operation| operation_cells(&operation.name, operation, load)),
        );
    }
    rows.push(operation_cells("all", &report.whole, load));
    out.push_str(&format_table(&rows));
    let with = report.acceleration.map_or_else(
        || "without acceleration".to_owned(),
        |acceleration| {
            let feed = ColumnUnit::FeedPerMinute;
            let acceleration = format_fixed(units.convert(feed, acceleration), 0);
            format!("with acceleration, {acceleration} ({})/s", feed.symbol(units.shown_in))
        },
    );
    let _ = writeln!(
        out,
        "  {} FEDRATs put in, {} changed, {} points put in; times at feed {with}",
        format_count(report.feeds_added as u64),
        format_count(report.feeds_changed as u64),
        format_count(report.points_added as u64),
    );
    let length = LoadFormat { unit: ColumnUnit::Length, units };
    if report.is_certified && report.criterion == LoadCriterion::ChipThickness {
        let tested = match report.proof_points.zip(report.proof_largest_mm) {
            Some((points, largest)) => format!(
                "of {} points that were tested the thickest chip has {}, and none is above its bound",
                format_count(points),
                load.format_with_unit(largest)
            ),
            None => "not tested at points, since the stock is a mesh or what another program left".to_owned(),
        };
        let _ = writeln!(
            out,
            "  bounded from the motions themselves: no chip is more than {} above what is told; {tested}",
            load.format_with_unit(report.uncertainty),
        );
        return out;
    }
    let grain = match (report.cell_mm, report.layer_mm) {
        (_, Some(layer)) => format!("layers of {}; for them", length.format_with_unit(layer)),
        (cell, None) => {
            format!("cell {}; for the grid", length.format_with_unit(cell.unwrap_or_default()))
        }
    };
    let _ = writeln!(
        out,
        "  {grain}, the {name} may be up to {} above what is told",
        load.format_with_unit(report.uncertainty),
    );
    out
}

fn operation_cells(name: &str, figures: &OperationFeedReport, load: LoadFormat) -> Vec<String> {
    let share = |share: f64| format!("{:.0} %", share * 100.0);
    vec![
        to_safe_line(name),
        format_duration(figures.seconds_before),
        format_duration(figures.seconds_after),
        format!("{:.1} %", figures.saved_fraction() * 100.0),
        load.format(figures.largest_before),
        load.format(figures.largest_after),
        share(figures.at_target_before),
        share(figures.at_target_after),
    ]
}

/// How loads and lengths are printed: with four significant digits, in the units that a reader sees.
#[derive(Debug, Clone, Copy)]
struct LoadFormat {
    unit: ColumnUnit,
    units: DisplayUnits,
}

impl LoadFormat {
    fn format(self, value: f64) -> String {
        format_significant_number(self.units.convert(self.unit, value), 4, 9)
    }

    fn format_with_unit(self, value: f64) -> String {
        format!("{} {}", self.format(value), self.unit.symbol(self.units.shown_in))
    }
}
