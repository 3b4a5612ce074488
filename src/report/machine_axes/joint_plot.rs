//! This module draws the values of axes over time or the line of the program.

use super::joint_table::JointTable;
use crate::report::plot::{CurvePanel, PlotCurve, PlotSegment, draw_curve_panels};
use std::io;

/// The quantity of the horizontal axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum JointAbscissa {
    /// Time. Motions of unknown time are left out.
    Time,
    /// The line of the program.
    Line,
}

/// Draws a panel for each axis as SVG.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_joints(table: &JointTable, along: JointAbscissa) -> io::Result<String> {
    let right = match along {
        JointAbscissa::Time => "time, s",
        JointAbscissa::Line => "line",
    };
    let panels: Vec<CurvePanel> = table
        .axes
        .iter()
        .enumerate()
        .map(|(index, (name, unit))| CurvePanel {
            up: format!("{name}, {unit}"),
            from_zero: false,
            curves: vec![PlotCurve {
                name: table.file.clone(),
                segments: list_segments(table, index, along),
            }],
        })
        .collect();
    draw_curve_panels(right, &panels)
}

fn list_segments(table: &JointTable, index: usize, along: JointAbscissa) -> Vec<PlotSegment> {
    let mut segments = Vec::new();
    let mut before: Option<(f64, Option<f64>)> = None;
    for row in &table.rows {
        let at = match along {
            JointAbscissa::Time => row.time,
            JointAbscissa::Line => row.line.map(|line| line as f64),
        };
        let Some(at) = at else { continue };
        let value = row.joints.get(index).copied();
        if let Some((from, first)) = before {
            segments.push(PlotSegment { from, to: at, values: first.zip(value).map(|(a, b)| [a, b]) });
        }
        before = Some((at, value));
    }
    segments
}
