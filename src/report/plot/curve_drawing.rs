//! This module draws panels of curves as SVG.

use super::curve_outline::{CurveOutline, outline_curve};
use crate::report::svg_chart::{ChartFrame, SvgArea, draw_line, draw_line_names, draw_svg, drawing_error};
use plotters::prelude::*;
use std::io;

/// Width of a drawing, and height of a panel.
const WIDTH: u32 = 1200;
const HEIGHT: u32 = 400;

/// The height of an axis that starts at zero, as a multiple of the largest value. Other axes have the same
/// margin, as a fraction of their range.
const HEADROOM: f64 = 1.08;

/// The same if the names of the curves are written above them.
const HEADROOM_WITH_NAMES: f64 = 1.35;

/// The colours of the state after and of the state before: those of the page of a report.
const AFTER: RGBColor = RGBColor(11, 99, 206);
const BEFORE: RGBColor = RGBColor(74, 82, 96);

/// The opacity of the band between least and largest values.
const BAND_OPACITY: f64 = 0.25;

/// A part of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlotSegment {
    /// Where it begins along the horizontal axis.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// The values at its ends. With `None` they are not known, and the line is interrupted.
    pub values: Option<[f64; 2]>,
}

/// A curve.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotCurve {
    /// The name of the curve.
    pub name: String,
    /// Its segments, in order.
    pub segments: Vec<PlotSegment>,
}

/// A panel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurvePanel {
    /// The label of the vertical axis.
    pub up: String,
    /// Whether the axis begins at zero.
    pub from_zero: bool,
    /// The curves. All but the last are thin grey lines over it: the state before, and the state after.
    pub curves: Vec<PlotCurve>,
}

impl CurvePanel {
    /// Returns whether no curve has a value.
    pub fn is_empty(&self) -> bool {
        let mut segments = self.curves.iter().flat_map(|curve| &curve.segments);
        !segments.any(|segment| segment.values.is_some())
    }
}

/// Draws panels one above the other, over a common horizontal axis. The names of curves are in the first
/// panel.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_curve_panels(right: &str, panels: &[CurvePanel]) -> io::Result<String> {
    let ends = panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.segments);
    let end = ends.map(|segment| segment.to).fold(0.0, f64::max);
    // An axis without length would have no marks.
    let end = if end > 0.0 && end.is_finite() { end } else { 1.0 };
    let count = u32::try_from(panels.len()).unwrap_or(1).max(1);
    draw_svg((WIDTH, HEIGHT * count), |root| {
        let areas = root.split_evenly((panels.len().max(1), 1));
        for (index, (area, panel)) in areas.iter().zip(panels).enumerate() {
            draw_curve_panel(area, right, end, panel, index == 0)?;
        }
        Ok(())
    })
}

/// Returns the least and the largest value of an axis.
fn find_axis_range(panel: &CurvePanel, names: bool) -> [f64; 2] {
    let values = panel.curves.iter().flat_map(|curve| &curve.segments).filter_map(|segment| segment.values);
    let values = values.flatten().filter(|value| value.is_finite());
    let [low, high] = values
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    if panel.from_zero {
        let high = if high > 0.0 { high } else { 1.0 };
        return [0.0, high * if names { HEADROOM_WITH_NAMES } else { HEADROOM }];
    }
    if low > high {
        return [0.0, 1.0];
    }
    let size = (high - low).max(1e-3);
    let above = if names { HEADROOM_WITH_NAMES } else { HEADROOM } - 1.0;
    [low - size * (HEADROOM - 1.0), high + size * above]
}

fn draw_curve_panel(
    area: &SvgArea<'_>,
    right: &str,
    end: f64,
    panel: &CurvePanel,
    names: bool,
) -> io::Result<()> {
    let [low, high] = find_axis_range(panel, names);
    let frame = ChartFrame { axis_texts: Some(([right, &panel.up], 16)), ..ChartFrame::default() };
    let mut chart = frame.draw(area, 0.0..end, low..high)?;
    // The state before is a thin line over the thick one of the state after, so that both are seen where they are the same.
    // The last curve is drawn first, and named last.
    let last = panel.curves.len().saturating_sub(1);
    let outlines: Vec<CurveOutline> =
        panel.curves.iter().map(|curve| outline_curve(&curve.segments, end, high - low)).collect();
    let after = AFTER.stroke_width(2);
    if let Some(outline) = outlines.get(last) {
        for band in &outline.bands {
            let area = Polygon::new(band.clone(), AFTER.mix(BAND_OPACITY).filled());
            chart.draw_series([area]).map_err(drawing_error)?;
        }
        for line in &outline.lines {
            draw_line(&mut chart, line.iter().copied(), after, "", 3)?;
        }
    }
    for (index, (curve, outline)) in panel.curves.iter().zip(outlines).enumerate() {
        let style = if index < last { BEFORE.stroke_width(1) } else { after };
        // An empty line gives the name to the legend.
        draw_line(&mut chart, [], style, &curve.name, style.stroke_width + 1)?;
        for line in outline.lines.into_iter().filter(|_| index < last) {
            draw_line(&mut chart, line, style, "", 3)?;
        }
    }
    if names { draw_line_names(&mut chart, 14, 1.0) } else { Ok(()) }
}
