//! What `correct_ramp` found and did, as a table.

mod panels;

pub use panels::panels;

use super::render::text::one_line;
use super::table::{duration, fixed, table};
use crate::transform::correct_ramp::{Outcome, RampReport, Report};
use std::fmt::Write;

/// Ramps told one by one at most; the rest is counted.
const TOLD: usize = 40;

/// The report as text.
pub fn to_text(report: &Report) -> String {
    let count = |outcome: Outcome| report.ramps.iter().filter(|ramp| ramp.outcome == outcome).count();
    let (fit, corrected, kept) = (count(Outcome::Fits), count(Outcome::Corrected), count(Outcome::Kept));
    let mut out = format!(
        "\ncorrect_ramp: {} ramps; {fit} within the cutter's limits, {corrected} corrected and measured again, {kept} kept\n",
        report.ramps.len()
    );
    let told: Vec<&RampReport> = report.ramps.iter().filter(|ramp| ramp.outcome != Outcome::Fits).collect();
    let fitting = report.ramps.iter().filter(|ramp| ramp.outcome == Outcome::Fits);
    let shown: Vec<&RampReport> = told.iter().copied().chain(fitting).take(TOLD).collect();
    if shown.is_empty() {
        return out;
    }
    let mut rows = vec![
        [
            "line",
            "operation",
            "ramp",
            "legs",
            "shortest mm",
            "limit",
            "steepest deg",
            "limit",
            "height mm",
            "passes",
            "added mm",
            "time",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for ramp in &shown {
        rows.extend(rows_of(ramp));
    }
    out.push_str(&table(&rows));
    let more = report.ramps.len() - shown.len();
    if more > 0 {
        let _ = writeln!(out, "  and {more} more");
    }
    out
}

/// A row for the ramp as it came, and one for what it became.
fn rows_of(ramp: &RampReport) -> Vec<Vec<String>> {
    let passes = |count: usize| if count == 0 { String::new() } else { count.to_string() };
    let row = |line: String,
               name: String,
               kind: String,
               measured: &crate::transform::correct_ramp::limits::Measured| {
        vec![
            line,
            name,
            kind,
            measured.legs.to_string(),
            fixed(measured.shortest_leg_mm, 3),
            fixed(ramp.limit_leg_mm, 3),
            fixed(measured.steepest_degrees, 2),
            fixed(ramp.limit_degrees, 2),
            fixed(measured.height_mm, 3),
        ]
    };
    let state = match ramp.outcome {
        Outcome::Kept => format!("{}, kept", ramp.kind),
        _ => ramp.kind.to_owned(),
    };
    let mut before = row(ramp.line.to_string(), one_line(&ramp.operation), state, &ramp.before);
    before.extend([passes(1), String::new(), String::new()]);
    let Some(measured) = &ramp.after else { return vec![before] };
    let mut after = row(String::new(), String::new(), "corrected".to_owned(), measured);
    let time = ramp.added_seconds.map_or_else(|| "?".to_owned(), signed_duration);
    after.extend([passes(ramp.passes), signed(ramp.added_mm), time]);
    vec![before, after]
}

fn signed(value: f64) -> String {
    format!("{}{}", if value < 0.0 { "-" } else { "+" }, fixed(value.abs(), 1))
}

fn signed_duration(seconds: f64) -> String {
    format!("{}{}", if seconds < 0.0 { "-" } else { "+" }, duration(seconds.abs()))
}
