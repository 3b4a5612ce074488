//! This module writes a calibration: for people, as a material file, as JSON and as a drawing.

use super::{Calibration, CalibrationRow, CoefficientOrigin, NAMES, to_list};
use crate::diagnostic::Diagnostic;
use crate::presentation::to_safe_line;
use crate::report::plot::{CurvePanel, PlotCurve, PlotSegment, draw_curve_panels};
use crate::report::render::json::FindingsJson;
use crate::report::to_json_text;
use serde_json::json;
use std::fmt::Write as _;
use std::io;

impl Calibration {
    /// Returns the coefficients and the residuals of all rows, for people.
    pub fn to_text(&self) -> String {
        let mut out = format!("rank {} of 6, condition {:.1}\n\n", self.rank, self.condition);
        for ((name, value), origin) in self.named_coefficients() {
            let unit = unit_of(name);
            let told = match origin {
                CoefficientOrigin::Fitted(error) => format!("+- {error:.2}"),
                CoefficientOrigin::Kept => "kept from the setup".to_owned(),
                CoefficientOrigin::InOtherNumber => "in the number above".to_owned(),
            };
            let _ = writeln!(out, "  {name}  {value:>9.2} {unit:<5}  {told}");
        }
        let _ = writeln!(out, "\n  row                         off    left out    power");
        for row in &self.rows {
            let percent = |part: f64| format!("{:.1} %", part * 100.0);
            let left_out = row.left_out_part.map_or("-".to_owned(), percent);
            let power = row.power_ratio.map_or("-".to_owned(), |ratio| format!("{ratio:.2}"));
            let mark = match (row.is_outlier, row.is_likely_vibration) {
                (true, _) => "  outlier, left out",
                (_, true) => "  likely a vibration",
                _ => "",
            };
            let name = to_safe_line(&row.measured.name());
            let off = percent(row.residual_part);
            let _ = writeln!(out, "  {name:<24} {off:>8} {left_out:>11} {power:>8}{mark}");
        }
        let _ = writeln!(
            out,
            "\n  rows are off by {:.1} % (root of the mean square), left out one by one by {:.1} %",
            self.residual_part * 100.0,
            self.left_out_part * 100.0,
        );
        out
    }

    /// Returns a material file. `source` says where the measurement is, `date` when it was made.
    pub fn to_material_file(&self, source: &str, date: &str) -> String {
        let mut out =
            "# Coefficients of own cuts, made by `clsmith calibrate`. They hold for cuts like these.\n"
                .to_owned();
        let quoted = |text: &str| serde_json::Value::from(to_safe_line(text)).to_string();
        if let Some(name) = &self.name {
            let _ = writeln!(out, "name: {}", quoted(name));
        }
        for ((name, value), _) in self.named_coefficients() {
            let _ = writeln!(out, "{name}: {value:.6}");
        }
        let _ = writeln!(out, "source: {}", quoted(source));
        let kept: Vec<&str> = self
            .named_coefficients()
            .filter(|(_, origin)| !matches!(origin, CoefficientOrigin::Fitted(_)))
            .map(|((name, _), _)| name)
            .collect();
        if !kept.is_empty() {
            let _ = writeln!(out, "sources:");
            for ((name, _), origin) in self.named_coefficients().filter(|((name, _), _)| kept.contains(name))
            {
                let told = match origin {
                    CoefficientOrigin::InOtherNumber => {
                        "not told apart from the cutting coefficient, which stands for both"
                    }
                    _ => "not measured: kept from the material of the setup",
                };
                let _ = writeln!(out, "  {name}: {}", quoted(told));
            }
        }
        let _ = writeln!(out, "date: {}\ntool: {}\nranges:", quoted(date), quoted(&self.tool));
        for (name, [low, high], decimals) in [
            ("chip", self.chip_range_mm, 4),
            ("cutting_speed", self.speed_range_m_min, 1),
            ("axial_depth", self.depth_range_mm, 3),
        ] {
            if low <= high {
                let _ = writeln!(out, "  {name}: [{low:.decimals$}, {high:.decimals$}]");
            }
        }
        let fitted = self.named_coefficients().filter_map(|((name, _), origin)| match origin {
            CoefficientOrigin::Fitted(error) if error.is_finite() => Some((name, error)),
            _ => None,
        });
        let fitted: Vec<(&str, f64)> = fitted.collect();
        if !fitted.is_empty() {
            let _ = writeln!(out, "errors:");
            for (name, error) in fitted {
                let _ = writeln!(out, "  {name}: {error:.6}");
            }
        }
        let _ = writeln!(out, "residual: {:.6}", self.residual_part);
        out
    }

    /// Returns the calibration as a JSON document, with the findings of the run.
    pub fn to_json(&self, findings: &[Diagnostic]) -> String {
        let coefficients: serde_json::Map<String, serde_json::Value> = self
            .named_coefficients()
            .map(|((name, value), origin)| {
                let (told, error) = match origin {
                    CoefficientOrigin::Fitted(error) => {
                        ("fitted", Some(error).filter(|error| error.is_finite()))
                    }
                    CoefficientOrigin::Kept => ("kept", None),
                    CoefficientOrigin::InOtherNumber => ("in_other_number", None),
                };
                (name.to_owned(), json!({ "value": value, "error": error, "origin": told }))
            })
            .collect();
        let rows: Vec<serde_json::Value> = self.rows.iter().map(row_to_json).collect();
        to_json_text(&json!({
            "version": 1,
            "rank": self.rank,
            "condition": self.condition,
            "coefficients": coefficients,
            "residual": self.residual_part,
            "left_out": self.left_out_part,
            "rows": rows,
            "findings": serde_json::to_value(FindingsJson::from_findings(findings)).unwrap_or_default(),
        }))
    }

    /// Draws how far each row is off the fit, and the powers, as SVG.
    ///
    /// # Errors
    /// Returns the errors of the drawing library. A drawing in memory has none.
    pub fn draw(&self) -> io::Result<String> {
        let curve = |name: &str, value: &dyn Fn(&CalibrationRow) -> Option<f64>| PlotCurve {
            name: name.to_owned(),
            segments: self
                .rows
                .iter()
                .enumerate()
                .map(|(index, row)| PlotSegment {
                    from: index as f64,
                    to: (index + 1) as f64,
                    values: value(row).map(|value| [value; 2]),
                })
                .collect(),
        };
        let panel = |up: &str, curve: PlotCurve| CurvePanel {
            up: up.to_owned(),
            from_zero: true,
            curves: vec![curve],
        };
        draw_curve_panels(
            "measured row",
            &[
                panel("off the fit, %", curve("residuals", &|row| Some(row.residual_part * 100.0))),
                panel(
                    "off without the row, %",
                    curve("left out", &|row| row.left_out_part.map(|part| part * 100.0)),
                ),
                panel("power by what forces explain", curve("power", &|row| row.power_ratio)),
            ],
        )
    }

    fn named_coefficients(&self) -> impl Iterator<Item = ((&'static str, f64), CoefficientOrigin)> {
        NAMES.into_iter().zip(to_list(&self.coefficients)).zip(self.origins)
    }
}

fn unit_of(name: &str) -> &'static str {
    if name.ends_with('c') { "N/mm2" } else { "N/mm" }
}

fn row_to_json(row: &CalibrationRow) -> serde_json::Value {
    json!({
        "row": row.measured.name(),
        "measured_n": row.measured.force_n,
        "fitted_n": row.fitted_n,
        "measured_kw": row.measured.power_kw,
        "fitted_kw": row.fitted_kw,
        "residual": row.residual_part,
        "left_out": row.left_out_part,
        "power_ratio": row.power_ratio,
        "is_outlier": row.is_outlier,
        "is_likely_vibration": row.is_likely_vibration,
    })
}
