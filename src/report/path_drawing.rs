//! This module draws line drawings as SVG: panels in two columns, each with a few paths on top of each other.
//!
//! Sizes are fixed and no fonts are measured, so the same paths give the same bytes.

pub use crate::presentation::path_panel::{PanelPath, PanelPathStyle, PathPanel};

use super::svg_chart::{ChartFrame, SvgArea, draw_line, draw_line_names, draw_svg, drawing_error};
use plotters::prelude::*;
use std::io;

/// Width and height of a panel in pixels.
const PANEL: (u32, u32) = (640, 380);

/// The space around the drawing inside a panel: margins and labels.
const LABELS: (u32, u32) = (100, 61);

/// Height of a panel's title.
const TITLE: u32 = 30;

fn shape_style(look: PanelPathStyle) -> ShapeStyle {
    match look {
        PanelPathStyle::Before => RGBColor(160, 160, 160).stroke_width(2),
        PanelPathStyle::After => RGBColor(11, 99, 206).stroke_width(2),
        PanelPathStyle::Reference => RGBColor(40, 40, 40).stroke_width(1),
        PanelPathStyle::Wrong => RGBColor(200, 50, 40).stroke_width(2),
    }
}

/// Draws panels as SVG. Returns `None` if there are none.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_path_panels(panels: &[PathPanel]) -> io::Result<Option<String>> {
    if panels.is_empty() {
        return Ok(None);
    }
    let columns = panels.len().min(2);
    let rows = panels.len().div_ceil(columns);
    let size = (PANEL.0 * columns as u32, PANEL.1 * u32::try_from(rows).unwrap_or(1));
    let drawing = draw_svg(size, |root| {
        for (area, panel) in root.split_evenly((rows, columns)).iter().zip(panels) {
            draw_path_panel(area, panel)?;
        }
        Ok(())
    });
    drawing.map(Some)
}

fn draw_path_panel(area: &SvgArea<'_>, panel: &PathPanel) -> io::Result<()> {
    let [right, up] = find_axis_ranges(panel);
    let frame = ChartFrame {
        title: Some((&panel.title, 16)),
        margin: 12,
        left_labels: 76,
        label_font: 13,
        axis_texts: Some(([&panel.right, &panel.up], 14)),
        ..ChartFrame::default()
    };
    let mut chart = frame.draw(area, right.0..right.1, up.0..up.1)?;
    for path in &panel.paths {
        let style = shape_style(path.look);
        draw_line(&mut chart, path.points.iter().copied(), style, &path.name, style.stroke_width)?;
        if path.look == PanelPathStyle::After && path.points.len() <= 60 {
            let dots = path.points.iter().map(|at| Circle::new(*at, 3, style.filled()));
            chart.draw_series(dots).map_err(drawing_error)?;
        }
    }
    if panel.paths.iter().all(|path| path.name.is_empty()) {
        return Ok(());
    }
    draw_line_names(&mut chart, 13, 0.85)
}

/// Returns the ranges of both axes: all points with a margin of 8 % on each side. If the panel has one scale,
/// the ranges are widened until a unit is equally long along both axes.
fn find_axis_ranges(panel: &PathPanel) -> [(f64, f64); 2] {
    let points = || panel.paths.iter().flat_map(|path| &path.points);
    let range = |value: fn(&(f64, f64)) -> f64| {
        let bounds = points().map(value).filter(|value| value.is_finite());
        let (low, high) = bounds
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high { (0.0, 1.0) } else { (low, high) }
    };
    let ranges = [range(|at| at.0), range(|at| at.1)];
    let mut sizes = ranges.map(|(low, high)| ((high - low) * 1.16).max(1e-3));
    if panel.one_scale {
        let [wide, high] = [(PANEL.0 - LABELS.0), (PANEL.1 - LABELS.1 - TITLE)].map(f64::from);
        let [x, y] = sizes;
        let scale = (x / wide).max(y / high);
        sizes = [scale * wide, scale * high];
    }
    let around = |((low, high), size): ((f64, f64), f64)| {
        let middle = 0.5 * (low + high);
        (middle - size / 2.0, middle + size / 2.0)
    };
    let [x, y] = ranges;
    let [wide, tall] = sizes;
    [around((x, wide)), around((y, tall))]
}
