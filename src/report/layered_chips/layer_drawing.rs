//! This module draws the layers of moves as small multiples, with a column for each move and a row for each
//! layer from the highest. The layers of a single move are side by side.

use super::ChipReport;
use super::move_scene::{MoveScene, MoveSceneLayer};
use super::panel_sheet::{CHIP, EDGE, LegendSample, WORKPIECE, draw_sheet};
use crate::engagement::PathPiece;
use crate::layered_chips::area::{AreaGrid, Clipper, GridArea};
use crate::layered_chips::boundary_diagram::BoundaryDiagram;
use crate::layered_chips::section_family::SectionFamily;
use crate::layered_chips::swept_area::{LayerSweptArea, RimDirections};
use crate::layered_chips::{MillStep, Polygon};
use crate::report::svg_chart::{ChartFrame, SvgArea, drawing_error};
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::report::text_format::format_trimmed;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use std::io;

/// The width and height of a panel in pixels, and how much of it are labels, title and margin.
const PANEL: (u32, u32) = (320, 310);
const AROUND: (u32, u32) = (60, 50);

/// The number of panels in a row if there is only one layer, or only one move.
const IN_A_ROW: usize = 6;

/// The number of layers that are drawn of several moves, and of a single one.
const LAYERS: usize = 4;
const LAYERS_OF_ONE: usize = 12;

/// A panel: one layer of one move.
struct LayerPanel<'r> {
    scene: &'r MoveScene,
    /// The layer, if the move cuts it.
    layer: Option<&'r MoveSceneLayer>,
    /// The section of the cutter with the layer at the start of the move.
    first: Vec<[f64; 2]>,
    /// The section of the cutter with the layer at the end of the move.
    last: Vec<[f64; 2]>,
}

/// Draws the moves that were kept as scenes, as SVG: the layer at the height `at_z_mm`, or a selection of all
/// layers.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_layers(report: &ChipReport, at_z_mm: Option<f64>) -> io::Result<String> {
    let heights = choose_layer_heights(report, at_z_mm);
    let panels: Vec<LayerPanel<'_>> = heights
        .iter()
        .flat_map(|z| {
            report.scenes.iter().map(|scene| LayerPanel::new(scene, *z, report.options.tolerance_mm))
        })
        .collect();
    let one_row = heights.len() == 1 || report.scenes.len() == 1;
    let columns = if one_row { panels.len().min(IN_A_ROW) } else { report.scenes.len() }.max(1);
    let rows = panels.len().div_ceil(columns).max(1);
    // All panels have the same scale, and each shows the surroundings of its move. `half` is half the size of
    // a panel's window, mm: half the largest move and a margin.
    let half = panels.iter().flat_map(|panel| panel.content_sizes_mm()).fold(1e-3, f64::max) * 0.56;
    let legend = [
        (LegendSample::Filled(WORKPIECE), "workpiece after the move"),
        (LegendSample::Filled(CHIP), "chip"),
        (LegendSample::Dashes(EDGE), "cutter before"),
        (LegendSample::Line(EDGE), "cutter after"),
    ];
    draw_sheet((columns, rows), PANEL, &legend, |number, area| match panels.get(number) {
        Some(panel) => panel.draw_panel(area, half, report),
        None => Ok(()),
    })
}

/// Returns the heights of the layers to draw, from the highest.
fn choose_layer_heights(report: &ChipReport, at: Option<f64>) -> Vec<f64> {
    let layers = report.scenes.iter().flat_map(|scene| &scene.layers);
    let shown = layers.filter(|layer| at.is_none_or(|z| layer.contains_height(z)));
    let mut heights: Vec<f64> = shown.map(|layer| layer.z_mm).collect();
    heights.sort_by(|a, b| b.total_cmp(a));
    heights.dedup();
    // A height on the boundary between two layers belongs to both. The upper one counts.
    let most = match (at, report.scenes.len()) {
        (Some(_), _) => 1,
        (None, 1) => LAYERS_OF_ONE,
        (None, _) => LAYERS,
    };
    let last = heights.len().saturating_sub(1);
    if heights.len() <= most {
        return heights;
    }
    let pick = |index: usize| index * last / most.saturating_sub(1).max(1);
    (0..most).filter_map(|index| heights.get(pick(index)).copied()).collect()
}

impl<'r> LayerPanel<'r> {
    fn new(scene: &'r MoveScene, z: f64, tolerance: f64) -> Self {
        let cover = |piece: Option<&PathPiece>| {
            let step = piece.and_then(|piece| MillStep::new(scene.mill, piece).ok());
            step.map(|step| {
                LayerSweptArea::new(
                    &BoundaryDiagram::new(&SectionFamily::new(&step, z)),
                    &RimDirections::new(&step, tolerance),
                )
            })
        };
        Self {
            scene,
            layer: scene.layers.iter().find(|layer| layer.z_mm == z),
            first: cover(scene.pieces.first()).unwrap_or_default().first,
            last: cover(scene.pieces.last()).unwrap_or_default().last,
        }
    }

    /// Returns the lower and the upper corner of what must be visible. Returns `None` if there is nothing.
    fn content_corners(&self) -> Option<([f64; 2], [f64; 2])> {
        let chip = self.layer.iter().flat_map(|layer| layer.chip.iter().flat_map(|piece| &piece.outer));
        let points = self.first.iter().chain(&self.last).chain(chip);
        points.fold(None, |bounds, &[x, y]| {
            let ([x0, y0], [x1, y1]) = bounds.unwrap_or(([x, y], [x, y]));
            Some(([x0.min(x), y0.min(y)], [x1.max(x), y1.max(y)]))
        })
    }

    /// Returns width and height of what must be visible.
    fn content_sizes_mm(&self) -> impl Iterator<Item = f64> {
        self.content_corners().into_iter().flat_map(|([x0, y0], [x1, y1])| [x1 - x0, y1 - y0])
    }

    fn draw_panel(&self, area: &SvgArea<'_>, half: f64, report: &ChipReport) -> io::Result<()> {
        let (grid, units) = (report.left.grid(), report.units);
        // The chart is in the reader's unit; what is drawn into it is converted point by point.
        let shown = |value: f64| units.convert(ColumnUnit::Length, value);
        let Some(([x0, y0], [x1, y1])) = self.content_corners() else { return Ok(()) };
        let (x, y) = (f64::midpoint(x0, x1), f64::midpoint(y0, y1));
        let tall = half * f64::from(PANEL.1 - AROUND.1) / f64::from(PANEL.0 - AROUND.0);
        let (wide, tall) = (half * (half / tall).max(1.0), tall.max(half));
        let mut title = format!("line {}", self.scene.line);
        if let Some(layer) = self.layer {
            let height = format_layer_height(layer.z_mm, units);
            title.push_str(&format!(", {} {height}", report.height_word()));
        }
        let frame = ChartFrame {
            title: Some((&title, 14)),
            margin: 6,
            left_labels: 48,
            bottom_labels: 24,
            grid_lines: false,
            label_counts: [5, 5],
            label_font: 11,
            ..ChartFrame::default()
        };
        let mut chart =
            frame.draw(area, shown(x - wide)..shown(x + wide), shown(y - tall)..shown(y + tall))?;
        let window = [[x - wide, y - tall], [x + wide, y - tall], [x + wide, y + tall], [x - wide, y + tall]];
        let filled = |polygons: &[Polygon], color: RGBColor| {
            let seen = clip_to_window(polygons, &window, grid);
            let shapes = seen.into_iter().map(move |polygon| {
                let points = join_boundaries(&polygon).into_iter().map(|[x, y]| (shown(x), shown(y)));
                let points = points.collect::<Vec<_>>();
                plotters::element::Polygon::new(points, color.filled())
            });
            shapes.collect::<Vec<_>>()
        };
        if let Some(layer) = self.layer {
            chart.draw_series(filled(&layer.workpiece, WORKPIECE)).map_err(drawing_error)?;
            chart.draw_series(filled(&layer.chip, CHIP)).map_err(drawing_error)?;
        }
        let closed = |border: &[[f64; 2]]| {
            let points = border.iter().chain(border.first()).map(|[x, y]| (shown(*x), shown(*y)));
            points.collect::<Vec<_>>()
        };
        if !self.first.is_empty() {
            let dashes = DashedPathElement::new(closed(&self.first), 6, 4, EDGE.stroke_width(1));
            chart.draw_series(std::iter::once(dashes)).map_err(drawing_error)?;
        }
        let solid = PathElement::new(closed(&self.last), EDGE.stroke_width(2));
        chart.draw_series(std::iter::once(solid)).map_err(drawing_error)?;
        Ok(())
    }
}

/// Returns the parts of polygons that are visible in a window.
fn clip_to_window(polygons: &[Polygon], window: &[[f64; 2]], grid: &AreaGrid) -> Vec<Polygon> {
    let borders = polygons.iter().flat_map(|polygon| std::iter::once(&polygon.outer).chain(&polygon.holes));
    let area = GridArea::new(grid, borders.map(Vec::as_slice));
    let (mut clipper, mut inside, mut outside) =
        (Clipper::default(), GridArea::default(), GridArea::default());
    clipper.split_area(&area, &GridArea::new(grid, [window]), &mut inside, &mut outside);
    clipper.extract_polygons(&inside, grid).0
}

/// Joins the boundaries of a polygon: a line leads to each hole and back, which encloses nothing.
fn join_boundaries(polygon: &Polygon) -> Vec<[f64; 2]> {
    let mut border = polygon.outer.clone();
    let back = polygon.outer.first();
    for hole in &polygon.holes {
        border.extend(back);
        border.extend(hole);
        border.extend(hole.first());
    }
    border.extend(back.filter(|_| !polygon.holes.is_empty()));
    border
}

/// Returns the height of a layer in a title, in the unit of the axes.
pub(super) fn format_layer_height(z_mm: f64, units: DisplayUnits) -> String {
    format_trimmed(units.convert(ColumnUnit::Length, z_mm), units.decimals(ColumnUnit::Length, 3))
}
