//! This module draws boundary construction diagrams ([`crate::layered_chips`] names the paper): the angle
//! theta on the edge goes to the right, and time goes up.

use super::ChipReport;
use super::layer_drawing::format_layer_height;
use super::move_scene::{MoveScene, MoveSceneLayer};
use super::panel_sheet::{ADVANCING, BRANCH, EDGE, LegendSample, OUTSIDE, RETREATING, draw_sheet};
use crate::layered_chips::MillStep;
use crate::layered_chips::boundary_diagram::{BoundaryDiagram, BranchEnd, EdgeState, EnvelopeBranch};
use crate::layered_chips::section_family::{DiagramCurve, SectionFamily};
use crate::report::svg_chart::{ChartFrame, SvgArea, draw_line, drawing_error};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use std::f64::consts::TAU;
use std::io;

const PANEL: (u32, u32) = (480, 330);

/// The number of panels in a row.
const IN_A_ROW: usize = 2;

/// The number of rows of the shading, and the number of angles at which each row is first evaluated.
const ROWS: usize = 100;
const ANGLES: usize = 180;

/// The number of points of a branch between two events.
const STEPS: usize = 32;

/// Draws the diagram of each move that was kept as a scene, on the layer at a height or on the layer with its
/// largest chip.
///
/// An arc is cut in straight pieces, and the diagram shows the first of them.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_diagrams(report: &ChipReport, at_z_mm: Option<f64>) -> io::Result<String> {
    let columns = report.scenes.len().clamp(1, IN_A_ROW);
    let rows = report.scenes.len().div_ceil(columns).max(1);
    let legend = [
        (LegendSample::Filled(ADVANCING), "advances"),
        (LegendSample::Filled(RETREATING), "retreats"),
        (LegendSample::Filled(OUTSIDE), "no edge"),
        (LegendSample::Line(BRANCH), "envelope"),
        (LegendSample::Dot(BRANCH), "fold"),
        (LegendSample::Ring(BRANCH), "split"),
    ];
    draw_sheet((columns, rows), PANEL, &legend, |number, area| match report.scenes.get(number) {
        Some(scene) => draw_diagram(area, scene, at_z_mm, report),
        None => Ok(()),
    })
}

/// Returns the layer whose diagram is drawn.
fn choose_diagram_layer(scene: &MoveScene, at: Option<f64>) -> Option<&MoveSceneLayer> {
    let area = |layer: &MoveSceneLayer| layer.chip.iter().map(|piece| piece.area_mm2()).sum::<f64>();
    match at {
        // A height on the boundary between two layers belongs to both. The upper one counts, as in the
        // picture of layers.
        Some(z) => scene.layers.iter().rfind(|layer| layer.contains_height(z)),
        None => scene.layers.iter().reduce(|a, b| if area(b) > area(a) { b } else { a }),
    }
}

fn draw_diagram(
    area: &SvgArea<'_>,
    scene: &MoveScene,
    at: Option<f64>,
    report: &ChipReport,
) -> io::Result<()> {
    let (Some(layer), Some(piece)) = (choose_diagram_layer(scene, at), scene.pieces.first()) else {
        return Ok(());
    };
    let Ok(step) = MillStep::new(scene.mill, piece) else { return Ok(()) };
    let diagram = BoundaryDiagram::new(&SectionFamily::new(&step, layer.z_mm));
    let height = format_layer_height(layer.z_mm, report.units);
    let mut title = format!("line {}, {} {height}", scene.line, report.height_word());
    if scene.pieces.len() > 1 {
        title.push_str(&format!(", first of {} pieces", scene.pieces.len()));
    }
    let frame = ChartFrame {
        title: Some((&title, 14)),
        margin: 10,
        left_labels: 44,
        bottom_labels: 40,
        grid_lines: false,
        label_counts: [9, 6],
        label_font: 11,
        whole_right_labels: true,
        axis_texts: Some((["theta, degrees", "t"], 13)),
    };
    let mut chart = frame.draw(area, 0.0..360.0, 0.0..1.0)?;
    chart.draw_series(shade_edge_states(&diagram)).map_err(drawing_error)?;
    for line in trace_flute_ends(&diagram) {
        draw_line(&mut chart, line, RGBColor(90, 90, 90).stroke_width(1), "", 1)?;
    }
    let branches = diagram.trace_branches(STEPS);
    for line in branches.iter().flat_map(|branch| wrap_angles(&branch.points)) {
        draw_line(&mut chart, line, BRANCH.stroke_width(2), "", 2)?;
    }
    for (point, end) in branches.iter().flat_map(branch_end_points) {
        let style = match end {
            BranchEnd::Edge => continue,
            BranchEnd::Fold => BRANCH.filled(),
            BranchEnd::Open => BRANCH.stroke_width(2),
        };
        chart.draw_series([Circle::new(point, 4, style)]).map_err(drawing_error)?;
    }
    // These are the first edge and the last one, as in the picture of layers.
    let first = DashedPathElement::new(vec![(0.0, 0.0), (360.0, 0.0)], 8, 5, EDGE.stroke_width(3));
    chart.draw_series(std::iter::once(first)).map_err(drawing_error)?;
    draw_line(&mut chart, [(0.0, 1.0), (360.0, 1.0)], EDGE.stroke_width(3), "", 3)
}

/// Returns rectangles in the colours of the edge's states, row by row. Boundaries between states are found to
/// a thousandth of a degree.
fn shade_edge_states(diagram: &BoundaryDiagram) -> Vec<Rectangle<(f64, f64)>> {
    let mut boxes = Vec::new();
    for row in 0..ROWS {
        let [low, middle, high] = [0.0, 0.5, 1.0].map(|part| (row as f64 + part) / ROWS as f64);
        let region = |theta: f64| diagram.edge_state_at(theta, middle);
        let mut add = |from: f64, to: f64, region: EdgeState| {
            let color = match region {
                EdgeState::Advancing => ADVANCING,
                EdgeState::Retreating => RETREATING,
                EdgeState::Outside => OUTSIDE,
            };
            let corners = [(from.to_degrees(), low), (to.to_degrees(), high)];
            boxes.push(Rectangle::new(corners, color.filled()));
        };
        let (mut start, mut now) = (0.0, region(0.0));
        for index in 1..=ANGLES {
            let [mut from, mut to] = [index - 1, index].map(|index| TAU * index as f64 / ANGLES as f64);
            let next = region(to);
            if next == now {
                continue;
            }
            // Eleven bisections reduce the two degrees between angles to a thousandth of a degree.
            for _ in 0..11 {
                let between = f64::midpoint(from, to);
                if region(between) == now { from = between } else { to = between }
            }
            add(start, to, now);
            (start, now) = (to, next);
        }
        add(start, TAU, now);
    }
    boxes
}

/// Returns the lines at which the ends of the flutes cut off the ellipse.
fn trace_flute_ends(diagram: &BoundaryDiagram) -> Vec<Vec<(f64, f64)>> {
    let of_stretch = |stretch: &crate::layered_chips::boundary_diagram::time_segments::TimeSegment| {
        let tracks = stretch
            .tracks
            .iter()
            .filter(|track| matches!(track.curve, DiagramCurve::Bottom | DiagramCurve::Top));
        let lines = tracks.flat_map(|track| {
            let [from, to] = stretch.t;
            let point = |index: usize| {
                let t = from + (to - from) * index as f64 / STEPS as f64;
                [stretch.track_angle_at(diagram.family(), track, t), t]
            };
            wrap_angles(&(0..=STEPS).map(point).collect::<Vec<_>>())
        });
        lines.collect::<Vec<_>>()
    };
    diagram.time_segments().iter().flat_map(of_stretch).collect()
}

/// Returns angles in radians and times as lines between 0 and 360 degrees. The lines are split where they
/// pass 360 degrees.
fn wrap_angles(points: &[[f64; 2]]) -> Vec<Vec<(f64, f64)>> {
    let turn = |theta: f64| (theta / TAU).floor();
    let mut lines: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut last: Option<[f64; 2]> = None;
    for &[theta, t] in points {
        let at = |theta: f64, t: f64, turns: f64| ((theta - turns * TAU).to_degrees(), t);
        match (last, lines.last_mut()) {
            (Some([before, t0]), Some(line)) if turn(before) != turn(theta) => {
                let border = TAU * turn(before).max(turn(theta));
                let share = if theta == before { 0.0 } else { (border - before) / (theta - before) };
                let crossing = t0 + (t - t0) * share;
                line.push(at(border, crossing, turn(before)));
                lines.push(vec![at(border, crossing, turn(theta)), at(theta, t, turn(theta))]);
            }
            (Some(_), Some(line)) => line.push(at(theta, t, turn(theta))),
            _ => lines.push(vec![at(theta, t, turn(theta))]),
        }
        last = Some([theta, t]);
    }
    lines
}

/// Returns both ends of a branch.
fn branch_end_points(branch: &EnvelopeBranch) -> Vec<((f64, f64), BranchEnd)> {
    let point = |point: Option<&[f64; 2]>, end: BranchEnd| {
        point.map(|[theta, t]| ((theta.rem_euclid(TAU).to_degrees(), *t), end))
    };
    let both = [point(branch.points.first(), branch.begins), point(branch.points.last(), branch.ends)];
    both.into_iter().flatten().collect()
}
