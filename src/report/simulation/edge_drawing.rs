//! This module draws the chip thickness over edges: on the left a map over the rotation and the place on the edge, on the right
//! the stock around the tool in the middle of the motion, with the edges in the colours of the map. All maps of a drawing have
//! one scale of colours.

use super::SimulationReport;
use super::edge_maps::EdgeMapReport;
use super::edge_picture::draw_edge_picture;
use crate::engagement::ToothThickness;
use crate::report::svg_chart::{ChartFrame, SvgArea, draw_svg, drawing_error};
use crate::report::table::{ColumnUnit, DisplayUnits};
use plotters::prelude::*;
use std::io;

/// The most maps of one drawing.
pub const MOST_DRAWN_MAPS: usize = 24;

/// Width of a map, of the scale of colours and of the picture; height of all, pixels.
const WIDTHS: [u32; 3] = [640, 90, 470];
const HEIGHT: u32 = 420;

/// The colours from thin to thick chips: those of loads on the page of a report.
const RAMP: [[u8; 3]; 7] = [
    [248, 160, 58],
    [237, 121, 83],
    [216, 87, 107],
    [183, 45, 132],
    [139, 10, 165],
    [91, 2, 163],
    [43, 5, 148],
];

/// The number of different colours, so that neighbours of the same one are one shape.
const COLORS: f64 = 36.0;

/// Where an edge does not cut.
const NO_CHIP: RGBColor = RGBColor(240, 241, 243);

/// The scale of colours.
#[derive(Debug, Clone, Copy)]
pub(super) struct ThicknessScale {
    thickest_mm: f64,
}

impl ThicknessScale {
    /// Returns the step of a thickness on the scale; `None` where nothing cuts.
    fn step(self, thickness_mm: f64) -> Option<u8> {
        let part = thickness_mm / self.thickest_mm;
        (part > 1e-6).then(|| (part * COLORS).ceil().clamp(1.0, COLORS) as u8)
    }

    /// Returns the colour of a thickness; `None` where nothing cuts.
    pub(super) fn color(self, thickness_mm: f64) -> Option<RGBColor> {
        self.step(thickness_mm).map(color_of_step)
    }
}

fn color_of_step(step: u8) -> RGBColor {
    let at = (f64::from(step) - 1.0) / (COLORS - 1.0) * (RAMP.len() - 1) as f64;
    let low = (at.floor() as usize).min(RAMP.len() - 2);
    let [one, other] = [low, low + 1].map(|index| RAMP.get(index).copied().unwrap_or_default());
    let share = at - low as f64;
    let part = |index: usize| {
        let [one, other] = [one, other].map(|color| f64::from(color.get(index).copied().unwrap_or(0)));
        (one + (other - one) * share).round() as u8
    };
    RGBColor(part(0), part(1), part(2))
}

/// Draws the maps of a simulation as SVG, the first [`MOST_DRAWN_MAPS`] of them; `None` if there are none.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_edge_maps(simulated: &SimulationReport) -> io::Result<Option<String>> {
    let maps: Vec<(&EdgeMapReport, &ToothThickness)> = simulated
        .edge_maps
        .iter()
        .flat_map(|edges| edges.moment.map.teeth.iter().map(move |tooth| (edges, tooth)))
        .take(MOST_DRAWN_MAPS)
        .collect();
    if maps.is_empty() {
        return Ok(None);
    }
    let all = maps.iter().flat_map(|(_, tooth)| &tooth.thickness_mm);
    let scale = ThicknessScale { thickest_mm: all.fold(0.0_f64, |most, next| most.max(*next)).max(1e-9) };
    let rows = u32::try_from(maps.len()).unwrap_or(1);
    let size = (WIDTHS.iter().sum(), HEIGHT * rows);
    let drawing = draw_svg(size, |root| {
        for (area, (edges, tooth)) in root.split_evenly((maps.len(), 1)).iter().zip(&maps) {
            let (map, rest) = area.split_horizontally(WIDTHS[0]);
            let (legend, picture) = rest.split_horizontally(WIDTHS[1]);
            draw_map(&map, edges, tooth, scale, simulated.units)?;
            draw_scale(&legend, scale, simulated.units)?;
            draw_edge_picture(&picture, edges, tooth, scale)?;
        }
        Ok(())
    });
    drawing.map(Some)
}

fn draw_map(
    area: &SvgArea<'_>,
    edges: &EdgeMapReport,
    tooth: &ToothThickness,
    scale: ThicknessScale,
    units: DisplayUnits,
) -> io::Result<()> {
    let map = &edges.moment.map;
    let which = if map.teeth.len() == 1 && map.trails_rad.len() > 1 {
        "each tooth alike".to_owned()
    } else {
        format!("tooth {}", tooth.tooth)
    };
    let title = format!("chip thickness on the edge, line {}, {which}", edges.line);
    let shown = |length_mm: f64| units.convert(ColumnUnit::Length, length_mm);
    let [first, last] =
        [map.points.first(), map.points.last()].map(|point| point.map_or(0.0, |at| at.along_mm));
    let half = (last - first) / (map.points.len().max(2) - 1) as f64 / 2.0;
    let [low, high] = [first - half, last + half].map(shown);
    let up = units.title("along the edge from the tip", ColumnUnit::Length);
    let frame = ChartFrame {
        title: Some((&title, 16)),
        left_labels: 72,
        label_counts: [9, 9],
        label_font: 13,
        grid_lines: false,
        axis_texts: Some((["rotation of the spindle, deg", &up], 15)),
        ..ChartFrame::default()
    };
    let mut chart = frame.draw(area, 0.0..360.0, low..high.max(low + 1e-6))?;
    let back = Rectangle::new([(0.0, low), (360.0, high)], NO_CHIP.filled());
    chart.draw_series([back]).map_err(drawing_error)?;
    let turn = 360.0 / map.rotations_rad.len().max(1) as f64;
    for (index, point) in map.points.iter().enumerate() {
        let of_point = tooth.thickness_mm.iter().skip(index).step_by(map.points.len().max(1));
        let steps: Vec<Option<u8>> = of_point.map(|thickness| scale.step(*thickness)).collect();
        let [from, to] = [point.along_mm - half, point.along_mm + half].map(shown);
        let mut begin = 0;
        for run in steps.chunk_by(|one, next| one == next) {
            let end = begin + run.len();
            if let Some(step) = run.first().copied().flatten() {
                let corners = [(begin as f64 * turn, from), (end as f64 * turn, to)];
                let cell = Rectangle::new(corners, color_of_step(step).filled());
                chart.draw_series([cell]).map_err(drawing_error)?;
            }
            begin = end;
        }
    }
    Ok(())
}

fn draw_scale(area: &SvgArea<'_>, scale: ThicknessScale, units: DisplayUnits) -> io::Result<()> {
    let [top, bottom] = [60, i32::try_from(HEIGHT).unwrap_or(0) - 60];
    let height = |step: f64| bottom - ((f64::from(bottom - top)) * step / COLORS).round() as i32;
    for step in 1..=COLORS as u8 {
        let corners = [(4, height(f64::from(step))), (22, height(f64::from(step) - 1.0))];
        area.draw(&Rectangle::new(corners, color_of_step(step).filled())).map_err(drawing_error)?;
    }
    let text = |text: String, y: i32| Text::new(text, (26, y - 7), ("sans-serif", 13));
    for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let shown = units.convert(ColumnUnit::Length, scale.thickest_mm * part);
        let decimals = units.decimals(ColumnUnit::Length, 4);
        area.draw(&text(format!("{shown:.decimals$}"), height(part * COLORS))).map_err(drawing_error)?;
    }
    area.draw(&Text::new(units.title("chip", ColumnUnit::Length), (4, 34), ("sans-serif", 13)))
        .map_err(drawing_error)?;
    area.draw(&Rectangle::new([(4, bottom + 12), (22, bottom + 24)], NO_CHIP.filled()))
        .map_err(drawing_error)?;
    area.draw(&Text::new("no cut", (26, bottom + 11), ("sans-serif", 13))).map_err(drawing_error)
}
