//! This module computes the area that an operation mills anyway. The tool's centre may be wherever its disc
//! covers nothing that the operation leaves.

use super::level_paths::LevelPaths;
use super::polygon_containment::contains_line;
use geo::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{BoundingRect, Buffer, Coord, Intersects, Line, LineString, MultiLineString, MultiPolygon, Rect};
use nalgebra::Point2;

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

impl MilledArea {
    /// Computes the area for a tool of `radius` (mm) along the paths of a level and along `around`, the path of the ramp
    /// itself. It covers `reach` (mm) around that. Farther away nothing is free.
    ///
    /// The area that the tool covers along the paths is shrunk by its radius. This is a morphological closing
    /// of the paths, which lies between the paths and their convex hull.
    pub(super) fn new(level: &LevelPaths, radius: f64, around: &[Point2<f64>], reach: f64) -> Self {
        let own: LineString = around.iter().map(|point| Coord { x: point.x, y: point.y }).collect();
        let nothing = Rect::new(Coord::zero(), Coord::zero());
        let grown = |by: f64| {
            let by = Coord { x: by, y: by };
            own.bounding_rect().map_or(nothing, |bounds| Rect::new(bounds.min() - by, bounds.max() + by))
        };
        // The dilation and the erosion each reach one radius, so paths farther away cannot change the result.
        let (reach, seen) = (grown(reach), grown(reach + 2.0 * radius));
        let mut near = level.lines_within(&seen);
        near.extend(LevelPaths::new(&[around.to_vec()]).lines_within(&seen));
        if near.is_empty() {
            return Self { free: MultiPolygon::new(Vec::new()), reach };
        }
        // Dilation by the radius gives what the tool covers; erosion by the radius gives its possible
        // centres. The erosion is a little smaller, so that a path lies inside its own closing in spite of
        // the polygons.
        let style = |distance: f64| {
            BufferStyle::new(distance).line_cap(LineCap::Round(STEP)).line_join(LineJoin::Round(STEP))
        };
        let covered = MultiLineString(near).buffer_with_style(style(radius));
        let free = covered.buffer_with_style(style(MARGIN.max(radius * MARGIN_FRACTION) - radius));
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
