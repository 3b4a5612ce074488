//! This module draws a sheet of small panels with a legend below. The drawings of layers and of diagrams use
//! it.
//!
//! Sizes are fixed and no fonts are measured, so the same chips give the same bytes.

use crate::report::svg_chart::{SvgArea, draw_svg, drawing_error};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use std::io;

/// Height of the legend below the panels, pixels.
const LEGEND: u32 = 44;

/// The space left of the legend and between its entries, pixels.
const MARGIN: i32 = 16;

pub(super) const WORKPIECE: RGBColor = RGBColor(205, 205, 205);
pub(super) const CHIP: RGBColor = RGBColor(235, 130, 40);
pub(super) const EDGE: RGBColor = RGBColor(0, 70, 150);
pub(super) const ADVANCING: RGBColor = RGBColor(250, 214, 170);
pub(super) const RETREATING: RGBColor = RGBColor(214, 228, 244);
pub(super) const OUTSIDE: RGBColor = RGBColor(190, 190, 190);
pub(super) const BRANCH: RGBColor = RGBColor(180, 30, 40);

/// A sample in the legend.
#[derive(Debug, Clone, Copy)]
pub(super) enum LegendSample {
    Filled(RGBColor),
    Line(RGBColor),
    Dashes(RGBColor),
    Dot(RGBColor),
    Ring(RGBColor),
}

/// Draws panels in rows and columns, as SVG. `panel` is the width and height of a panel in pixels. `draw`
/// gets the index of each panel, row by row, and its area.
pub(super) fn draw_sheet(
    (columns, rows): (usize, usize),
    panel: (u32, u32),
    legend: &[(LegendSample, &str)],
    mut draw: impl FnMut(usize, &SvgArea<'_>) -> io::Result<()>,
) -> io::Result<String> {
    let pixels = |count: usize, size: u32| u32::try_from(count).unwrap_or(1) * size;
    let (wide, high) = (pixels(columns, panel.0), pixels(rows, panel.1));
    // A single panel still needs enough width for the legend.
    let size = (wide.max(pixels(legend.len(), 170)), high + LEGEND);
    draw_svg(size, |root| {
        let (panels, below) = root.split_vertically(high);
        let (panels, _) = panels.split_horizontally(wide);
        for (number, area) in panels.split_evenly((rows, columns)).iter().enumerate() {
            draw(number, area)?;
        }
        draw_legend(&below, legend)
    })
}

fn draw_legend(area: &SvgArea<'_>, legend: &[(LegendSample, &str)]) -> io::Result<()> {
    let middle = i32::try_from(LEGEND / 2).unwrap_or_default();
    let mut x = MARGIN;
    for (sample, text) in legend {
        let line = |style: ShapeStyle| PathElement::new(vec![(x, middle), (x + 24, middle)], style);
        let drawn = match sample {
            LegendSample::Filled(color) => {
                area.draw(&Rectangle::new([(x, middle - 7), (x + 24, middle + 7)], color.filled()))
            }
            LegendSample::Line(color) => area.draw(&line(color.stroke_width(2))),
            LegendSample::Dashes(color) => {
                let ends = [(x, middle), (x + 24, middle)];
                area.draw(&DashedPathElement::new(ends, 5, 3, color.stroke_width(2)))
            }
            LegendSample::Dot(color) => area.draw(&Circle::new((x + 12, middle), 4, color.filled())),
            LegendSample::Ring(color) => area.draw(&Circle::new((x + 12, middle), 4, color.stroke_width(2))),
        };
        drawn.map_err(drawing_error)?;
        area.draw(&Text::new(*text, (x + 32, middle - 7), ("sans-serif", 13))).map_err(drawing_error)?;
        // A letter is about seven pixels wide. Measured widths would depend on the fonts of the machine.
        x += 32 + 7 * i32::try_from(text.len()).unwrap_or_default() + MARGIN;
    }
    Ok(())
}
