//! This module sets up all drawings: an SVG of a fixed size, a chart with axes in a part of it, and a legend
//! with the names of its lines.
//!
//! Sizes are fixed and no fonts are measured, so the same data give the same bytes.

use plotters::coord::Shift;
use plotters::coord::ranged1d::ValueFormatter;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use std::fmt::Display;
use std::io;
use std::ops::Range;

/// A part of a drawing.
pub(super) type SvgArea<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// A chart that is ready for its lines.
pub(super) type SvgChart<'area, 'text> =
    ChartContext<'area, SVGBackend<'text>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// The surroundings of a chart's lines. Sizes are in pixels.
#[derive(Clone, Copy)]
pub(super) struct ChartFrame<'a> {
    /// The text above the chart and the size of its letters.
    pub title: Option<(&'a str, u32)>,
    /// Empty pixels on all four sides.
    pub margin: u32,
    /// Width of the numbers and the text left of the chart.
    pub left_labels: u32,
    /// Height of the numbers and the text below the chart.
    pub bottom_labels: u32,
    /// Whether thin lines across the chart continue the marks of the axes.
    pub grid_lines: bool,
    /// The approximate number of numbers along the horizontal and the vertical axis.
    pub label_counts: [usize; 2],
    /// Size of the numbers along the axes.
    pub label_font: u32,
    /// Whether the horizontal axis has whole numbers.
    pub whole_right_labels: bool,
    /// The labels of the horizontal and the vertical axis, and the size of their letters.
    pub axis_texts: Option<([&'a str; 2], u32)>,
}

impl Default for ChartFrame<'_> {
    fn default() -> Self {
        Self {
            title: None,
            margin: 16,
            left_labels: 80,
            bottom_labels: 44,
            grid_lines: true,
            label_counts: [11, 11],
            label_font: 14,
            whole_right_labels: false,
            axis_texts: None,
        }
    }
}

impl ChartFrame<'_> {
    /// Draws the frame into `area` and returns its chart. `right` and `up` are the ranges of the axes.
    ///
    /// # Errors
    /// Returns the errors of the drawing library. A drawing in memory has none.
    pub(super) fn draw<'area, 'text>(
        &self,
        area: &'area SvgArea<'text>,
        right: Range<f64>,
        up: Range<f64>,
    ) -> io::Result<SvgChart<'area, 'text>> {
        let mut builder = ChartBuilder::on(area);
        if let Some((title, font)) = self.title {
            builder.caption(title, ("sans-serif", font));
        }
        let mut chart = builder
            .margin(self.margin)
            .set_label_area_size(LabelAreaPosition::Left, self.left_labels)
            .set_label_area_size(LabelAreaPosition::Bottom, self.bottom_labels)
            .build_cartesian_2d(right, up)
            .map_err(drawing_error)?;
        let mut mesh = chart.configure_mesh();
        if self.grid_lines {
            mesh.light_line_style(TRANSPARENT);
        } else {
            mesh.disable_mesh();
        }
        let [right_labels, up_labels] = self.label_counts;
        mesh.x_labels(right_labels).y_labels(up_labels).label_style(("sans-serif", self.label_font));
        let decimal = |value: &f64| drop_sign_of_zero(<RangedCoordf64 as ValueFormatter<f64>>::format(value));
        let whole = |value: &f64| drop_sign_of_zero(format!("{value:.0}"));
        mesh.y_label_formatter(&decimal);
        if self.whole_right_labels {
            mesh.x_label_formatter(&whole);
        } else {
            mesh.x_label_formatter(&decimal);
        }
        if let Some(([right, up], font)) = self.axis_texts {
            mesh.x_desc(right).y_desc(up).axis_desc_style(("sans-serif", font));
        }
        mesh.draw().map_err(drawing_error)?;
        Ok(chart)
    }
}

/// Drops the sign of `-0` or `-0.0`: systems do not agree on the zero that is left of a rounded number.
fn drop_sign_of_zero(number: String) -> String {
    match number.strip_prefix('-') {
        Some(digits) if digits.chars().all(|digit| matches!(digit, '0' | '.')) => digits.to_owned(),
        _ => number,
    }
}

/// Draws an SVG of a width and a height in pixels. `draw` gets the whole white area.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub(super) fn draw_svg(
    size: (u32, u32),
    draw: impl FnOnce(&SvgArea<'_>) -> io::Result<()>,
) -> io::Result<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).map_err(drawing_error)?;
        draw(&root)?;
        root.present().map_err(drawing_error)?;
    }
    Ok(text)
}

/// Adds a line to a chart. A name that is not empty is shown beside a sample of `sample_width` pixels, once
/// [`draw_line_names`] is called.
pub(super) fn draw_line(
    chart: &mut SvgChart<'_, '_>,
    points: impl IntoIterator<Item = (f64, f64)>,
    style: ShapeStyle,
    name: &str,
    sample_width: u32,
) -> io::Result<()> {
    let drawn = chart.draw_series(LineSeries::new(points, style)).map_err(drawing_error)?;
    if !name.is_empty() {
        let sample = style.stroke_width(sample_width);
        drawn.label(name).legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 18, y)], sample));
    }
    Ok(())
}

/// Writes the names of the lines into the upper right corner of a chart, on a white background of this
/// opacity.
pub(super) fn draw_line_names<'area, 'text: 'area>(
    chart: &mut SvgChart<'area, 'text>,
    font: u32,
    opacity: f64,
) -> io::Result<()> {
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .label_font(("sans-serif", font))
        .background_style(WHITE.mix(opacity))
        .border_style(RGBColor(200, 200, 200))
        .draw()
        .map_err(drawing_error)
}

/// Converts an error of the drawing library to an error of input and output.
pub(super) fn drawing_error(error: impl Display) -> io::Error {
    io::Error::other(format!("the drawing failed: {error}"))
}
