//! What `compensate_z` did, as a table and as drawings.

use super::picture::{Look, Panel, Path};
use super::render::text::one_line;
use super::table::{fixed, short, table};
use crate::transform::compensate_z::{PassReport, Report};
use std::fmt::Write;

/// Passes told one by one at most.
const TOLD: usize = 12;

/// Passes drawn at most.
const DRAWN: usize = 4;

/// The report as text.
pub fn to_text(report: &Report) -> String {
    let cutter = if report.corner_radius_mm == report.radius_mm {
        format!("ball R{}", short(report.radius_mm))
    } else {
        format!("cutter D{} R{}", short(2.0 * report.radius_mm), short(report.corner_radius_mm))
    };
    let mut out = format!(
        "\ncompensate_z: {cutter} against {}, tolerance {} mm, measured again as written\n",
        report.against,
        short(report.tolerance_mm)
    );
    let mut rows = vec![
        ["", "line", "motions", "after", "deepest gouge mm", "largest gap mm", "left mm"]
            .map(str::to_owned)
            .to_vec(),
    ];
    rows.extend(report.passes.iter().take(TOLD).map(row));
    if report.passes.len() > 1 {
        rows.push(row(&all(report)));
    }
    out.push_str(&table(&rows));
    if report.passes.len() > TOLD {
        let _ = writeln!(out, "  {} passes, {TOLD} of them shown", report.passes.len());
    }
    if report.beside > 0 {
        let _ = writeln!(out, "  {} passes lie beside the model and were left as they are", report.beside);
    }
    out
}

fn row(pass: &PassReport) -> Vec<String> {
    let line = if pass.line > 0 { pass.line.to_string() } else { String::new() };
    vec![
        one_line(&pass.operation),
        line,
        pass.motions_before.to_string(),
        pass.motions_after.to_string(),
        fixed(pass.gouge_mm, 4),
        pass.gap_mm.map_or_else(String::new, |gap| fixed(gap, 4)),
        if pass.left_mm > 0.0 { fixed(pass.left_mm, 3) } else { String::new() },
    ]
}

fn all(report: &Report) -> PassReport {
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

/// The first passes as the paper draws them: the profile, the path that moving point by point would give, and the compensated path.
pub fn panels(report: &Report) -> Vec<Panel> {
    let drawn = report.passes.iter().filter(|pass| !pass.path.is_empty());
    drawn.take(DRAWN).map(panel).collect()
}

fn panel(pass: &PassReport) -> Panel {
    let name = if pass.operation.is_empty() { String::new() } else { format!("{}, ", pass.operation) };
    let path = |name: &str, look: Look, points: &[(f64, f64)]| Path {
        name: name.to_owned(),
        look,
        points: points.to_vec(),
    };
    Panel {
        title: format!("{name}line {}", pass.line),
        right: "along the pass, mm",
        up: "z, mm",
        one_scale: true,
        paths: vec![
            path("profile", Look::Reference, &pass.profile),
            path("point by point", Look::Wrong, &pass.naive),
            path("compensated tip", Look::After, &pass.path),
        ],
    }
}
