//! This module draws the forces over one revolution as a dynamometer shows them: Fx, Fy and Fz on the workpiece and the
//! torque, one panel each, over the angle of the spindle.

use super::{RotationRow, ToothPeriodReport};
use crate::report::plot::{CurvePanel, PlotCurve, PlotSegment, draw_curve_panels};
use std::io;

/// Draws the forces over one revolution as SVG.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_tooth_period(period: &ToothPeriodReport) -> io::Result<String> {
    let panel = |up: &str, value: fn(&RotationRow) -> f64| CurvePanel {
        up: up.to_owned(),
        from_zero: false,
        curves: vec![build_curve(&format!("line {}", period.line), &period.rotations, value)],
    };
    draw_curve_panels(
        "rotation of the spindle, deg",
        &[
            panel("Fx, N", |row| row.force_n[0]),
            panel("Fy, N", |row| row.force_n[1]),
            panel("Fz, N", |row| row.force_n[2]),
            panel("torque, N m", |row| row.torque_nm),
        ],
    )
}

/// Makes a closed curve: the revolution ends as it began.
fn build_curve(name: &str, rotations: &[RotationRow], value: fn(&RotationRow) -> f64) -> PlotCurve {
    let ends = rotations.iter().skip(1).map(|row| (row.angle_deg, value(row)));
    let ends = ends.chain(rotations.first().map(|first| (360.0, value(first))));
    let segments = rotations.iter().zip(ends).map(|(row, (to, end))| PlotSegment {
        from: row.angle_deg,
        to,
        values: Some([value(row), end]),
    });
    PlotCurve { name: name.to_owned(), segments: segments.collect() }
}
