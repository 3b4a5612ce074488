//! This module draws the stock around a tool as seen from behind and above, with the tool's edges in the colours of their
//! chips.
//!
//! It is a parallel projection: the stock's heights as faces, the farthest first, then the tool's rings and edges over them, as
//! if the tool were of glass.

use super::edge_drawing::ThicknessScale;
use super::edge_maps::EdgeMapReport;
use super::stock_window::StockWindow;
use crate::engagement::ToothThickness;
use crate::report::svg_chart::{SvgArea, drawing_error};
use nalgebra::Vector3;
use plotters::prelude::*;
use std::f64::consts::TAU;
use std::io;

/// How far the eye stands to the side of straight behind, and how high, radians.
const ASIDE: f64 = 0.5;
const ABOVE: f64 = 0.62;

/// The margin of the picture and the height of its title, pixels.
const MARGIN: f64 = 14.0;
const TITLE: f64 = 40.0;

/// The height of the tool that is seen above the highest place that cuts, in radii.
const SEEN_ABOVE: f64 = 0.5;

const NO_CHIP: RGBColor = RGBColor(120, 128, 140);
const TOOL: RGBColor = RGBColor(74, 82, 96);

/// A projection on the plane of the picture: right, up, and how far away.
struct PictureView {
    right: Vector3<f64>,
    up: Vector3<f64>,
    away: Vector3<f64>,
    scale: f64,
    offset: [f64; 2],
}

impl PictureView {
    /// Looks along a horizontal direction, from above.
    fn towards(heading: Vector3<f64>) -> Self {
        let level = heading.y.atan2(heading.x) + ASIDE;
        let (sin, cos) = level.sin_cos();
        let (sin_up, cos_up) = ABOVE.sin_cos();
        Self {
            right: Vector3::new(sin, -cos, 0.0),
            up: Vector3::new(cos * sin_up, sin * sin_up, cos_up),
            away: Vector3::new(cos * cos_up, sin * cos_up, -sin_up),
            scale: 1.0,
            offset: [0.0; 2],
        }
    }

    /// Chooses scale and offset so that points fill an area.
    fn fit(mut self, points: impl Iterator<Item = Vector3<f64>>, [width, height]: [f64; 2]) -> Self {
        let seen = points.map(|point| [point.dot(&self.right), -point.dot(&self.up)]);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in seen {
            for ((at, low), high) in point.iter().zip(&mut low).zip(&mut high) {
                (*low, *high) = (low.min(*at), high.max(*at));
            }
        }
        let sizes = [width - 2.0 * MARGIN, height - TITLE - MARGIN];
        self.scale = (sizes[0] / (high[0] - low[0]).max(1e-9)).min(sizes[1] / (high[1] - low[1]).max(1e-9));
        self.offset = [
            width / 2.0 - self.scale * (low[0] + high[0]) / 2.0,
            TITLE + sizes[1] / 2.0 - self.scale * (low[1] + high[1]) / 2.0,
        ];
        self
    }

    fn place(&self, point: &Vector3<f64>) -> (i32, i32) {
        let x = point.dot(&self.right) * self.scale + self.offset[0];
        let y = -point.dot(&self.up) * self.scale + self.offset[1];
        (x.round() as i32, y.round() as i32)
    }
}

/// Draws the stock and the edges of a map, turned so that its tooth cuts its thickest chip.
pub(super) fn draw_edge_picture(
    area: &SvgArea<'_>,
    edges: &EdgeMapReport,
    tooth: &ToothThickness,
    scale: ThicknessScale,
) -> io::Result<()> {
    let map = &edges.moment.map;
    let points = map.points.len().max(1);
    let thickest = tooth.thickness_mm.iter().enumerate().fold((0.0, 0), |most, (index, thickness)| {
        if *thickness > most.0 + 1e-12 { (*thickness, index / points) } else { most }
    });
    let rotation = map.rotations_rad.get(thickest.1).copied().unwrap_or(0.0);
    let (width, height) = area.dim_in_pixel();
    let tool = ToolShape::of_moment(edges, rotation);
    let window = edges.stock.as_ref();
    let faces = window.map(list_faces).unwrap_or_default();
    let seen = faces.iter().flat_map(|face| face.corners).chain(tool.list_corners());
    let view = PictureView::towards(Vector3::from(edges.moment.frame[0]))
        .fit(seen, [f64::from(width), f64::from(height)]);
    draw_faces(area, &view, faces)?;
    tool.draw_rings(area, &view)?;
    for (number, trail) in map.trails_rad.iter().enumerate() {
        // Teeth that cut alike share the first one's chips, each at its own time.
        let own = map.teeth.get(number);
        let (found, turned) = match own {
            Some(found) => (found, rotation),
            None => (tooth, rotation - trail),
        };
        tool.draw_edge(area, &view, *trail, (found, turned), scale)?;
    }
    let title = format!("turned by {:.0} deg, feed to the back", rotation.to_degrees());
    area.draw(&Text::new(title, (MARGIN as i32, 18), ("sans-serif", 14))).map_err(drawing_error)
}

/// A face of the stock, with the part of light that it gets.
struct StockFace {
    corners: [Vector3<f64>; 4],
    light: f64,
}

/// Makes the tops of the cells, and the walls between cells of different heights and at the rim.
fn list_faces(window: &StockWindow) -> Vec<StockFace> {
    let [columns, rows] = window.counts;
    let half = window.cell_mm / 2.0;
    let mut faces = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let [x, y] = [
                window.first_mm[0] + column as f64 * window.cell_mm,
                window.first_mm[1] + row as f64 * window.cell_mm,
            ];
            let z = window.height_mm(column, row);
            let at = |right: f64, up: f64, z: f64| Vector3::new(x + right * half, y + up * half, z);
            faces.push(StockFace {
                corners: [at(-1.0, -1.0, z), at(1.0, -1.0, z), at(1.0, 1.0, z), at(-1.0, 1.0, z)],
                light: 1.0,
            });
            let beside = |column: Option<usize>, row: Option<usize>| match (column, row) {
                (Some(column), Some(row)) if column < columns && row < rows => window.height_mm(column, row),
                _ => window.floor_mm,
            };
            let sides: [([f64; 2], f64, f64); 4] = [
                ([1.0, 0.0], beside(Some(column + 1), Some(row)), 0.78),
                ([-1.0, 0.0], beside(column.checked_sub(1), Some(row)), 0.86),
                ([0.0, 1.0], beside(Some(column), Some(row + 1)), 0.7),
                ([0.0, -1.0], beside(Some(column), row.checked_sub(1)), 0.92),
            ];
            for ([right, up], lower, light) in sides {
                if lower < z - 1e-6 {
                    let along = |side: f64, z: f64| at(right + side * up.abs(), up + side * right.abs(), z);
                    let corners = [along(-1.0, lower), along(1.0, lower), along(1.0, z), along(-1.0, z)];
                    faces.push(StockFace { corners, light });
                }
            }
        }
    }
    faces
}

fn draw_faces(area: &SvgArea<'_>, view: &PictureView, mut faces: Vec<StockFace>) -> io::Result<()> {
    let middle = |face: &StockFace| face.corners.iter().sum::<Vector3<f64>>().dot(&view.away);
    faces.sort_by(|one, other| middle(other).total_cmp(&middle(one)));
    for face in faces {
        let tone = |full: f64| (full * face.light).round() as u8;
        let color = RGBColor(tone(216.0), tone(219.0), tone(224.0));
        let corners = face.corners.iter().map(|corner| view.place(corner)).collect::<Vec<_>>();
        area.draw(&Polygon::new(corners, color.filled())).map_err(drawing_error)?;
    }
    Ok(())
}

/// The tool at a rotation.
struct ToolShape<'a> {
    edges: &'a EdgeMapReport,
    rotation: f64,
    /// Places on the meridian up to where the tool is seen: distance from the axis, height, and length along it.
    places: Vec<[f64; 3]>,
}

impl<'a> ToolShape<'a> {
    fn of_moment(edges: &'a EdgeMapReport, rotation: f64) -> Self {
        let outline = &edges.moment.outline_mm;
        let radius = outline.iter().map(|[radius, _]| *radius).fold(1e-3, f64::max);
        let highest = edges.moment.map.points.last().map_or(0.0, |point| point.height_mm);
        let seen = highest + SEEN_ABOVE * radius;
        let mut places: Vec<[f64; 3]> = Vec::new();
        let mut along = 0.0;
        for ends in outline.windows(2) {
            let [[r0, z0], [r1, z1]] =
                [ends.first(), ends.last()].map(|end| end.copied().unwrap_or_default());
            let length = (r1 - r0).hypot(z1 - z0);
            let count = (length / radius * 40.0).ceil().clamp(1.0, 400.0);
            for number in 0..=count as usize {
                let share = number as f64 / count;
                let height = z0 + (z1 - z0) * share;
                if height <= seen {
                    places.push([r0 + (r1 - r0) * share, height, along + length * share]);
                }
            }
            along += length;
        }
        Self { edges, rotation, places }
    }

    /// Returns the point at an angle from ahead.
    fn point(&self, radius: f64, height: f64, angle: f64) -> Vector3<f64> {
        let moment = &self.edges.moment;
        let [ahead, left, axis] = moment.frame.map(Vector3::from);
        let (sin, cos) = angle.sin_cos();
        Vector3::from(moment.tip_mm) + (ahead * cos + left * sin) * radius + axis * height
    }

    fn ring(&self, [radius, height, _]: [f64; 3]) -> impl Iterator<Item = Vector3<f64>> + '_ {
        (0..=48).map(move |number| self.point(radius, height, TAU * f64::from(number) / 48.0))
    }

    fn list_corners(&self) -> impl Iterator<Item = Vector3<f64>> + '_ {
        self.places.iter().step_by(8).chain(self.places.last()).flat_map(|place| self.ring(*place))
    }

    fn draw_rings(&self, area: &SvgArea<'_>, view: &PictureView) -> io::Result<()> {
        let widest = self
            .places
            .iter()
            .copied()
            .reduce(|most, next| if next[0] > most[0] + 1e-9 { next } else { most });
        for place in [widest, self.places.last().copied()].into_iter().flatten() {
            let ring: Vec<(i32, i32)> = self.ring(place).map(|point| view.place(&point)).collect();
            area.draw(&Polygon::new(ring.clone(), TOOL.mix(0.08).filled())).map_err(drawing_error)?;
            area.draw(&PathElement::new(ring, TOOL.mix(0.7).stroke_width(1))).map_err(drawing_error)?;
        }
        Ok(())
    }

    /// Draws the edge of a tooth. `chips` are the thicknesses and the rotation at which they are this edge's.
    fn draw_edge(
        &self,
        area: &SvgArea<'_>,
        view: &PictureView,
        trail: f64,
        (found, turned): (&ToothThickness, f64),
        scale: ThicknessScale,
    ) -> io::Result<()> {
        let map = &self.edges.moment.map;
        let rotations = map.rotations_rad.len().max(1);
        let row = (turned.rem_euclid(TAU) / TAU * rotations as f64).round() as usize % rotations;
        let [first, last] =
            [map.points.first(), map.points.last()].map(|point| point.map_or(0.0, |at| at.along_mm));
        let spacing = (last - first) / (map.points.len().max(2) - 1) as f64;
        let thickness = |along: f64| {
            let index = ((along - first) / spacing.max(1e-12)).round();
            let is_mapped = index >= 0.0 && index < map.points.len() as f64;
            let cell = is_mapped.then(|| row * map.points.len() + index as usize)?;
            found.thickness_mm.get(cell).copied()
        };
        let places: Vec<((i32, i32), Option<RGBColor>)> = self
            .places
            .iter()
            .map(|[radius, height, along]| {
                let angle = map.edge_angle_rad(trail, self.rotation, *height);
                let color = thickness(*along).and_then(|thickness| scale.color(thickness));
                (view.place(&self.point(*radius, *height, angle)), color)
            })
            .collect();
        let mut begin = 0;
        for run in places.chunk_by(|one, next| one.1 == next.1) {
            let end = begin + run.len();
            // A piece goes on to the first place of the next one, so that the edge has no gaps.
            let points = places.iter().skip(begin).take(run.len() + 1).map(|(at, _)| *at);
            let style = match run.first().and_then(|(_, color)| *color) {
                Some(color) => color.stroke_width(4),
                None => NO_CHIP.stroke_width(1),
            };
            area.draw(&PathElement::new(points.collect::<Vec<_>>(), style)).map_err(drawing_error)?;
            begin = end;
        }
        Ok(())
    }
}
