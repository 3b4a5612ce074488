//! This module draws panels of curves as SVG.

use crate::report::svg_chart::{ChartFrame, SvgArea, draw_line, draw_line_names, draw_svg};
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

/// The largest number of segments that are drawn one by one. A longer curve is divided into as many
/// intervals, and each is drawn from its least to its largest value.
const MOST_SEGMENTS: usize = 2000;

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
    /// The curves. All but the last are grey and behind it: the state before, and the state after.
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
    let last = panel.curves.len().saturating_sub(1);
    for (index, curve) in panel.curves.iter().enumerate() {
        let color = if index < last { RGBColor(170, 170, 170) } else { RGBColor(0, 90, 181) };
        let mut lines = to_polylines(&curve.segments, end).into_iter();
        let first = lines.next().unwrap_or_default();
        draw_line(&mut chart, first, color.stroke_width(1), &curve.name, 3)?;
        for line in lines {
            draw_line(&mut chart, line, color.stroke_width(1), "", 3)?;
        }
    }
    if names { draw_line_names(&mut chart, 14, 1.0) } else { Ok(()) }
}

/// Returns a curve as lines. Where its values are not known, a line ends and the next one begins after it.
fn to_polylines(segments: &[PlotSegment], end: f64) -> Vec<Vec<(f64, f64)>> {
    let mut lines = PolylineBuilder::default();
    if segments.len() <= MOST_SEGMENTS {
        for segment in segments {
            lines.extend_or_break(
                segment.values.map(|[first, last]| [(segment.from, first), (segment.to, last)]),
            );
        }
        return lines.into_polylines();
    }
    let width = end / MOST_SEGMENTS as f64;
    let mut spans: Vec<Option<[f64; 2]>> = vec![None; MOST_SEGMENTS];
    for segment in segments {
        let Some([start, stop]) = segment.values else { continue };
        let first = (segment.from / width) as usize;
        let last = ((segment.to / width) as usize).min(MOST_SEGMENTS - 1);
        // A long segment is straight between its ends.
        let at = |place: f64| {
            let share = (place - segment.from) / (segment.to - segment.from);
            start + (stop - start) * if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 }
        };
        for (index, span) in spans.iter_mut().enumerate().take(last + 1).skip(first) {
            for value in [at(index as f64 * width), at((index + 1) as f64 * width)] {
                let [least, most] = span.unwrap_or([value; 2]);
                *span = Some([least.min(value), most.max(value)]);
            }
        }
    }
    for (index, span) in spans.into_iter().enumerate() {
        let at = (index as f64 + 0.5) * width;
        lines.extend_or_break(span.map(|[least, most]| [(at, least), (at, most)]));
    }
    lines.into_polylines()
}

/// Lines while they are built.
#[derive(Default)]
struct PolylineBuilder {
    done: Vec<Vec<(f64, f64)>>,
    open: Vec<(f64, f64)>,
}

impl PolylineBuilder {
    fn extend_or_break(&mut self, points: Option<[(f64, f64); 2]>) {
        match points {
            Some(points) => self.open.extend(points),
            None if !self.open.is_empty() => self.done.push(std::mem::take(&mut self.open)),
            None => {}
        }
    }

    fn into_polylines(mut self) -> Vec<Vec<(f64, f64)>> {
        self.extend_or_break(None);
        self.done
    }
}
