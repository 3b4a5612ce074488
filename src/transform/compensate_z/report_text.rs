//! This module shows what `compensate_z` did, as a table and as drawings.

use super::report::{CompensateZReport, PassReport};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::presentation::path_panel::{PanelPath, PanelPathStyle, PathPanel};
use crate::presentation::safe_text::to_safe_line;
use crate::presentation::text_format::{format_fixed, format_table, format_trimmed};
use crate::transform::step_report::{TransformReport, to_json_value};
use std::fmt::Write;

/// The largest number of passes that have a row of their own.
const MOST_ROWS: usize = 12;

/// The largest number of passes that are drawn.
const MOST_DRAWN: usize = 4;

impl TransformReport for CompensateZReport {
    fn step_name(&self) -> &'static str {
        "compensate_z"
    }

    fn to_text(&self, units: DisplayUnits) -> String {
        describe_passes(self, units)
    }

    fn to_json(&self) -> serde_json::Value {
        to_json_value(self)
    }

    /// The first passes as the paper draws them: the profile, the path that moving point by point would give, and
    /// the compensated path.
    fn build_panels(&self, units: DisplayUnits) -> Vec<PathPanel> {
        let drawn = self.passes.iter().filter(|pass| !pass.path.is_empty());
        drawn.take(MOST_DRAWN).map(|pass| build_pass_panel(pass, units).convert_lengths(units)).collect()
    }
}

fn describe_passes(report: &CompensateZReport, units: DisplayUnits) -> String {
    let unit = ColumnUnit::Length.symbol(units.shown_in);
    let short = |value: f64| {
        format_trimmed(units.convert(ColumnUnit::Length, value), units.decimals(ColumnUnit::Length, 3))
    };
    let cutter = if report.corner_radius_mm == report.radius_mm {
        format!("ball R{}", short(report.radius_mm))
    } else {
        format!("cutter D{} R{}", short(2.0 * report.radius_mm), short(report.corner_radius_mm))
    };
    let mut out = format!(
        "\ncompensate_z: {cutter} against {}, tolerance {} {unit}, measured again as written\n",
        report.against,
        short(report.tolerance_mm)
    );
    let mut rows = vec![
        [
            "",
            "line",
            "motions",
            "after",
            &format!("deepest gouge {unit}"),
            &format!("largest gap {unit}"),
            &format!("left {unit}"),
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    rows.extend(report.passes.iter().take(MOST_ROWS).map(|pass| pass_cells(pass, units)));
    if report.passes.len() > 1 {
        rows.push(pass_cells(&summarize_passes(report), units));
    }
    out.push_str(&format_table(&rows));
    if report.passes.len() > MOST_ROWS {
        let _ = writeln!(out, "  {} passes, {MOST_ROWS} of them shown", report.passes.len());
    }
    if report.beside > 0 {
        let _ = writeln!(out, "  {} passes lie beside the model and were left as they are", report.beside);
    }
    out
}

fn pass_cells(pass: &PassReport, units: DisplayUnits) -> Vec<String> {
    let length = |value: f64, decimals: usize| {
        format_fixed(units.convert(ColumnUnit::Length, value), units.decimals(ColumnUnit::Length, decimals))
    };
    let line = if pass.line > 0 { pass.line.to_string() } else { String::new() };
    vec![
        to_safe_line(&pass.operation),
        line,
        pass.motions_before.to_string(),
        pass.motions_after.to_string(),
        length(pass.gouge_mm, 4),
        pass.gap_mm.map_or_else(String::new, |gap| length(gap, 4)),
        if pass.left_mm > 0.0 { length(pass.left_mm, 3) } else { String::new() },
    ]
}

fn summarize_passes(report: &CompensateZReport) -> PassReport {
    let most = |value: fn(&PassReport) -> f64| report.passes.iter().map(value).fold(0.0, f64::max);
    PassReport {
        operation: "all".to_owned(),
        line: 0,
        motions_before: report.passes.iter().map(|pass| pass.motions_before).sum(),
        motions_after: report.passes.iter().map(|pass| pass.motions_after).sum(),
        gouge_mm: most(|pass| pass.gouge_mm),
        gap_mm: report.passes.iter().filter_map(|pass| pass.gap_mm).reduce(f64::max),
        left_mm: most(|pass| pass.left_mm),
        profile: Vec::new(),
        path: Vec::new(),
        naive: Vec::new(),
    }
}

fn build_pass_panel(pass: &PassReport, units: DisplayUnits) -> PathPanel {
    let name = if pass.operation.is_empty() { String::new() } else { format!("{}, ", pass.operation) };
    let path = |name: &str, look: PanelPathStyle, points: &[(f64, f64)]| PanelPath {
        name: name.to_owned(),
        look,
        points: points.to_vec(),
    };
    PathPanel {
        title: format!("{name}line {}", pass.line),
        right: units.title("along the pass", ColumnUnit::Length),
        up: units.title("z", ColumnUnit::Length),
        one_scale: true,
        paths: vec![
            path("profile", PanelPathStyle::Reference, &pass.profile),
            path("point by point", PanelPathStyle::Wrong, &pass.naive),
            path("compensated tip", PanelPathStyle::After, &pass.path),
        ],
    }
}
