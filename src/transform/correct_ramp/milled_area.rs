//! This module computes the area that an operation mills anyway. The tool's centre may be wherever its disc
//! covers nothing that the operation leaves.

use super::level_paths::LevelPaths;
use super::polygon_containment::contains_line;
use geo::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{
    BooleanOps, BoundingRect, Buffer, Coord, Intersects, Line, LineString, MultiLineString, MultiPolygon,
    Rect,
};
use nalgebra::Point2;
use std::collections::HashMap;

/// The angle between the vertices (radians) of the polygons that replace the arcs of buffers. They are off by
/// a radius over 800.
const STEP: f64 = 0.1;

/// The tool may cover this much (mm), or this fraction of its radius, that the operation does not cover. That
/// is the error of replacing circles by polygons.
const MARGIN: f64 = 0.05;
const MARGIN_FRACTION: f64 = 1.0 / 400.0;

/// The area near a ramp that the cuts of an operation at one level leave to the tool's centre.
#[derive(Debug, Clone, PartialEq)]
pub struct MilledArea {
    free: MultiPolygon,
    reach: Rect,
}

/// From this number of ramps on that end at a level, what the tool covers there is found for wide areas that several ramps
/// share.
const SHARING_RAMPS: usize = 4;

/// What a tool of one radius covers along the paths of a level, in the areas where ramps have asked for it.
#[derive(Debug, Default)]
pub(super) struct CoveredAreas {
    asked: usize,
    known: HashMap<[i64; 3], MultiPolygon>,
}

impl CoveredAreas {
    /// Returns what a tool covers along a level's paths in a rectangle, and maybe beyond it.
    fn find_covered(&mut self, level: &LevelPaths, radius: f64, seen: &Rect) -> MultiPolygon {
        self.asked += 1;
        if self.asked < SHARING_RAMPS {
            return buffer_lines(level.lines_within(seen), radius);
        }
        // Areas of one size stand so that each rectangle is in one of them.
        let side = seen.width().max(seen.height()).max(1.0).log2().ceil().exp2();
        let [column, row] = [seen.min().x, seen.min().y].map(|at| (at / side).floor());
        let whole = self.known.entry([column as i64, row as i64, side as i64]).or_insert_with(|| {
            let low = Coord { x: column * side, y: row * side };
            // The tool reaches one radius beyond a line.
            let far = 2.0 * side + radius;
            let around = Rect::new(low - Coord { x: radius, y: radius }, low + Coord { x: far, y: far });
            buffer_lines(level.lines_within(&around), radius)
        });
        whole.intersection(&seen.to_polygon())
    }
}

/// Returns what a tool of a radius covers along lines; its circles are polygons.
fn buffer_lines(lines: Vec<LineString>, radius: f64) -> MultiPolygon {
    if lines.is_empty() {
        return MultiPolygon::new(Vec::new());
    }
    MultiLineString(lines).buffer_with_style(round_style(radius))
}

fn round_style(distance: f64) -> BufferStyle<f64> {
    BufferStyle::new(distance).line_cap(LineCap::Round(STEP)).line_join(LineJoin::Round(STEP))
}

impl MilledArea {
    /// Computes the area for a tool of `radius` (mm) along the paths of a level and along `around`, the path of the ramp
    /// itself. It covers `reach` (mm) around that. Farther away nothing is free. `known` holds what other ramps have asked
    /// of the same level and radius.
    ///
    /// The area that the tool covers along the paths is shrunk by its radius. This is a morphological closing
    /// of the paths, which lies between the paths and their convex hull.
    pub(super) fn new(
        (level, known): (&LevelPaths, &mut CoveredAreas),
        radius: f64,
        around: &[Point2<f64>],
        reach: f64,
    ) -> Self {
        let own: LineString = around.iter().map(|point| Coord { x: point.x, y: point.y }).collect();
        let nothing = Rect::new(Coord::zero(), Coord::zero());
        let grown = |by: f64| {
            let by = Coord { x: by, y: by };
            own.bounding_rect().map_or(nothing, |bounds| Rect::new(bounds.min() - by, bounds.max() + by))
        };
        // The dilation and the erosion each reach one radius, so paths farther away cannot change the result.
        let (reach, seen) = (grown(reach), grown(reach + 2.0 * radius));
        let of_ramp = buffer_lines(LevelPaths::new(&[around.to_vec()]).lines_within(&seen), radius);
        let covered = known.find_covered(level, radius, &seen).union(&of_ramp);
        // Dilation by the radius gives what the tool covers; erosion by the radius gives its possible
        // centres. The erosion is a little smaller, so that a path lies inside its own closing in spite of
        // the polygons.
        let free = covered.buffer_with_style(round_style(MARGIN.max(radius * MARGIN_FRACTION) - radius));
        Self { free, reach }
    }

    /// Returns whether the tool's centre may go along a path.
    pub fn contains_path(&self, path: &[Point2<f64>]) -> bool {
        let all: LineString = path.iter().map(|at| (at.x, at.y)).collect();
        let inside = |line: Line| {
            let ends = [line.start, line.end].iter().all(|end| end.intersects(&self.reach));
            ends && self.free.iter().any(|polygon| contains_line(polygon, line))
        };
        all.lines().all(inside)
    }
}
