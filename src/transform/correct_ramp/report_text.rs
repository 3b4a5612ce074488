//! This module shows what `correct_ramp` found and did, as a table.

use super::ramp_panels::build_ramp_panels;
use super::report::{CorrectRampReport, RampOutcome, RampPillar, RampReport};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::presentation::path_panel::PathPanel;
use crate::presentation::safe_text::to_safe_line;
use crate::presentation::text_format::{format_duration, format_fixed, format_table};
use crate::transform::step_report::{TransformReport, to_json_value};
use std::fmt::Write;

/// The largest number of ramps with rows of their own. The rest is counted.
const MOST_ROWS: usize = 40;

impl TransformReport for CorrectRampReport {
    fn step_name(&self) -> &'static str {
        "correct_ramp"
    }

    fn to_text(&self, units: DisplayUnits) -> String {
        describe_ramps(self, units)
    }

    fn to_json(&self) -> serde_json::Value {
        to_json_value(self)
    }

    fn build_panels(&self, units: DisplayUnits) -> Vec<PathPanel> {
        build_ramp_panels(self, units)
    }
}

fn describe_ramps(report: &CorrectRampReport, units: DisplayUnits) -> String {
    let unit = ColumnUnit::Length.symbol(units.shown_in);
    let count = |outcome: RampOutcome| report.ramps.iter().filter(|ramp| ramp.outcome == outcome).count();
    let (fit, corrected, kept) =
        (count(RampOutcome::Fits), count(RampOutcome::Corrected), count(RampOutcome::Kept));
    let mut out = format!(
        "\ncorrect_ramp: {} ramps; {fit} within the cutter's limits, {corrected} corrected and measured again, {kept} kept\n",
        report.ramps.len()
    );
    let told: Vec<&RampReport> =
        report.ramps.iter().filter(|ramp| ramp.outcome != RampOutcome::Fits).collect();
    let fitting = report.ramps.iter().filter(|ramp| ramp.outcome == RampOutcome::Fits);
    let shown: Vec<&RampReport> = told.iter().copied().chain(fitting).take(MOST_ROWS).collect();
    if shown.is_empty() {
        return out;
    }
    let pillars = |of: fn(&RampReport) -> Option<RampPillar>| {
        report.ramps.iter().filter_map(of).filter(|pillar| pillar.left_over_mm > 0.0).count()
    };
    if report.ramps.iter().any(|ramp| ramp.pillar_before.is_some()) {
        let _ = writeln!(
            out,
            "  cut out of a block, {} ramps run into a pillar under the middle of the cutter before, {} of the corrected ones after",
            pillars(|ramp| ramp.pillar_before),
            pillars(|ramp| ramp.pillar_after)
        );
    }
    let mut rows = vec![
        [
            "line",
            "operation",
            "ramp",
            "legs",
            &format!("shortest {unit}"),
            "limit",
            "steepest deg",
            "limit",
            &format!("height {unit}"),
            "passes",
            &format!("added {unit}"),
            "time",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for ramp in &shown {
        rows.extend(ramp_rows(ramp, units));
    }
    out.push_str(&format_table(&rows));
    let more = report.ramps.len() - shown.len();
    if more > 0 {
        let _ = writeln!(out, "  and {more} more");
    }
    out
}

/// A row for the ramp as it came, and one for what it became.
fn ramp_rows(ramp: &RampReport, units: DisplayUnits) -> Vec<Vec<String>> {
    let length = |value: f64, decimals: usize| {
        format_fixed(units.convert(ColumnUnit::Length, value), units.decimals(ColumnUnit::Length, decimals))
    };
    let passes = |count: usize| if count == 0 { String::new() } else { count.to_string() };
    let row = |line: String, name: String, kind: String, measured: &super::ramp_limits::RampMeasurement| {
        vec![
            line,
            name,
            kind,
            measured.legs.to_string(),
            length(measured.shortest_leg_mm, 3),
            length(ramp.limit_leg_mm, 3),
            format_fixed(measured.steepest_degrees, 2),
            format_fixed(ramp.limit_degrees, 2),
            length(measured.height_mm, 3),
        ]
    };
    let state = match ramp.outcome {
        RampOutcome::Kept => format!("{}, kept", ramp.kind),
        _ => ramp.kind.to_owned(),
    };
    let mut before = row(ramp.line.to_string(), to_safe_line(&ramp.operation), state, &ramp.before);
    before.extend([passes(1), String::new(), String::new()]);
    let Some(measured) = &ramp.after else { return vec![before] };
    let mut after = row(String::new(), String::new(), "corrected".to_owned(), measured);
    let time = ramp.added_seconds.map_or_else(|| "?".to_owned(), format_signed_duration);
    after.extend([
        passes(ramp.passes),
        format!("{}{}", sign(ramp.added_mm), length(ramp.added_mm.abs(), 1)),
        time,
    ]);
    vec![before, after]
}

fn sign(value: f64) -> &'static str {
    if value < 0.0 { "-" } else { "+" }
}

fn format_signed_duration(seconds: f64) -> String {
    format!("{}{}", sign(seconds), format_duration(seconds.abs()))
}
