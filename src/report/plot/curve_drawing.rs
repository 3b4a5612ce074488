//! Panels of curves as SVG.

use crate::report::svg_chart::{ChartFrame, SvgArea, draw_line, draw_line_names, draw_svg};
use plotters::prelude::*;
use std::io;

/// Width of a drawing, and height of a panel.
const WIDTH: u32 = 1200;
const HEIGHT: u32 = 400;

/// Height of an axis that starts at zero, in largest values.
const ROOM: f64 = 1.08;

/// The same where the names of the curves stand above.
const ROOM_WITH_NAMES: f64 = 1.35;

/// More stretches than this are drawn by the least and largest value of each of as many spans.
const MOST: usize = 2000;

/// A part of a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlotSegment {
    /// Where it begins, along what the drawing goes along.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// The values at its ends; `None` where they are not known, and the line breaks off.
    pub values: Option<[f64; 2]>,
}

/// A curve.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotCurve {
    /// What it is called.
    pub name: String,
    /// Its stretches, in order.
    pub stretches: Vec<PlotSegment>,
}

/// A panel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurvePanel {
    /// What goes up.
    pub up: String,
    /// Whether the axis begins at zero.
    pub from_zero: bool,
    /// The curves; all but the last are grey and stand behind it: what was before, and what is after.
    pub curves: Vec<PlotCurve>,
}

impl CurvePanel {
    /// Whether no curve has a value anywhere.
    pub fn is_empty(&self) -> bool {
        let mut stretches = self.curves.iter().flat_map(|curve| &curve.stretches);
        !stretches.any(|stretch| stretch.values.is_some())
    }
}

/// Draws panels one above the other, over one axis to the right. Names of curves stand in the first.
///
/// # Errors
/// What the drawing library returns, which for a drawing in memory is nothing.
pub fn draw_curve_panels(right: &str, panels: &[CurvePanel]) -> io::Result<String> {
    let ends = panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.stretches);
    let end = ends.map(|stretch| stretch.to).fold(0.0, f64::max);
    // An axis without a length would have no marks.
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

/// The least and the largest value of an axis.
fn find_axis_range(panel: &CurvePanel, names: bool) -> [f64; 2] {
    let values = panel.curves.iter().flat_map(|curve| &curve.stretches).filter_map(|stretch| stretch.values);
    let values = values.flatten().filter(|value| value.is_finite());
    let [low, high] = values
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)]);
    if panel.from_zero {
        let high = if high > 0.0 { high } else { 1.0 };
        return [0.0, high * if names { ROOM_WITH_NAMES } else { ROOM }];
    }
    if low > high {
        return [0.0, 1.0];
    }
    let size = (high - low).max(1e-3);
    let above = if names { ROOM_WITH_NAMES } else { ROOM } - 1.0;
    [low - size * (ROOM - 1.0), high + size * above]
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
        let mut lines = to_polylines(&curve.stretches, end).into_iter();
        let first = lines.next().unwrap_or_default();
        draw_line(&mut chart, first, color.stroke_width(1), &curve.name, 3)?;
        for line in lines {
            draw_line(&mut chart, line, color.stroke_width(1), "", 3)?;
        }
    }
    if names { draw_line_names(&mut chart, 14, 1.0) } else { Ok(()) }
}

/// A curve as lines, which end where it is not known.
fn to_polylines(stretches: &[PlotSegment], end: f64) -> Vec<Vec<(f64, f64)>> {
    let mut lines = PolylineBuilder::default();
    if stretches.len() <= MOST {
        for stretch in stretches {
            lines.extend_or_break(
                stretch.values.map(|[first, last]| [(stretch.from, first), (stretch.to, last)]),
            );
        }
        return lines.into_polylines();
    }
    let width = end / MOST as f64;
    let mut spans: Vec<Option<[f64; 2]>> = vec![None; MOST];
    for stretch in stretches {
        let Some([start, stop]) = stretch.values else { continue };
        let first = (stretch.from / width) as usize;
        let last = ((stretch.to / width) as usize).min(MOST - 1);
        // Between its ends a long stretch is straight.
        let at = |place: f64| {
            let share = (place - stretch.from) / (stretch.to - stretch.from);
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

/// Lines in the making.
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
