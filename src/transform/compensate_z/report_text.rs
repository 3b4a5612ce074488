//! This module shows what `compensate_z` did, as a table and as drawings.

use super::report::{CompensateZReport, PassReport};
use crate::presentation::path_panel::{PanelPath, PanelPathStyle, PathPanel};
use crate::presentation::safe_text::to_safe_line;
use crate::presentation::text_format::{format_fixed, format_short, format_table};
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

    fn to_text(&self) -> String {
        describe_passes(self)
    }

    fn to_json(&self) -> serde_json::Value {
        to_json_value(self)
    }

    /// Draws the first passes as the paper does: the profile, the path that moving it point by point would
    /// give, and the compensated path.
    fn build_panels(&self) -> Vec<PathPanel> {
        let drawn = self.passes.iter().filter(|pass| !pass.path.is_empty());
        drawn.take(MOST_DRAWN).map(build_pass_panel).collect()
    }
}

fn describe_passes(report: &CompensateZReport) -> String {
    let cutter = if report.corner_radius_mm == report.radius_mm {
        format!("ball R{}", format_short(report.radius_mm))
    } else {
        format!("cutter D{} R{}", format_short(2.0 * report.radius_mm), format_short(report.corner_radius_mm))
    };
    let mut out = format!(
        "\ncompensate_z: {cutter} against {}, tolerance {} mm, measured again as written\n",
        report.against,
        format_short(report.tolerance_mm)
    );
    let mut rows = vec![
        ["", "line", "motions", "after", "deepest gouge mm", "largest gap mm", "left mm"]
            .map(str::to_owned)
            .to_vec(),
    ];
    rows.extend(report.passes.iter().take(MOST_ROWS).map(pass_cells));
    if report.passes.len() > 1 {
        rows.push(pass_cells(&summarize_passes(report)));
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

fn pass_cells(pass: &PassReport) -> Vec<String> {
    let line = if pass.line > 0 { pass.line.to_string() } else { String::new() };
    vec![
        to_safe_line(&pass.operation),
        line,
        pass.motions_before.to_string(),
        pass.motions_after.to_string(),
        format_fixed(pass.gouge_mm, 4),
        pass.gap_mm.map_or_else(String::new, |gap| format_fixed(gap, 4)),
        if pass.left_mm > 0.0 { format_fixed(pass.left_mm, 3) } else { String::new() },
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

fn build_pass_panel(pass: &PassReport) -> PathPanel {
    let name = if pass.operation.is_empty() { String::new() } else { format!("{}, ", pass.operation) };
    let path = |name: &str, look: PanelPathStyle, points: &[(f64, f64)]| PanelPath {
        name: name.to_owned(),
        look,
        points: points.to_vec(),
    };
    PathPanel {
        title: format!("{name}line {}", pass.line),
        right: "along the pass, mm",
        up: "z, mm",
        one_scale: true,
        paths: vec![
            path("profile", PanelPathStyle::Reference, &pass.profile),
            path("point by point", PanelPathStyle::Wrong, &pass.naive),
            path("compensated tip", PanelPathStyle::After, &pass.path),
        ],
    }
}
