//! This module computes the area that an operation mills anyway. The tool's centre may be wherever its disc
//! covers nothing that the operation leaves.

use super::polygon_containment::contains_line;
use geo::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{
    BoundingRect, Buffer, Coord, Intersects, Line, LineString, MultiLineString, MultiPolygon, Rect, Simplify,
};
use nalgebra::Point2;

/// The angle between the vertices (radians) of the polygons that replace the arcs of buffers. They are off by
/// a radius over 800.
const STEP: f64 = 0.1;

/// The tool may cover this much (mm), or this fraction of its radius, that the operation does not cover. That
/// is the error of replacing circles by polygons.
const MARGIN: f64 = 0.05;
const MARGIN_FRACTION: f64 = 1.0 / 400.0;

/// Chords within this distance of a path (mm) replace it.
const CHORD_TOLERANCE: f64 = 0.01;

/// The area near a ramp that the cuts of an operation at one level leave to the tool's centre.
#[derive(Debug, Clone, PartialEq)]
pub struct MilledArea {
    free: MultiPolygon,
    reach: Rect,
}

impl MilledArea {
    /// Computes the area for a tool of `radius` (mm) along paths across its axis, with arcs given as samples.
    /// It covers `reach` (mm) around the path `around`. Farther away nothing is free.
    ///
    /// The area that the tool covers along the paths is shrunk by its radius. This is a morphological closing
    /// of the paths, which lies between the paths and their convex hull.
    pub fn new(paths: &[Vec<Point2<f64>>], radius: f64, around: &[Point2<f64>], reach: f64) -> Self {
        let at = |point: &Point2<f64>| Coord { x: point.x, y: point.y };
        let own: LineString = around.iter().map(at).collect();
        let nothing = Rect::new(Coord::zero(), Coord::zero());
        let grown = |by: f64| {
            let by = Coord { x: by, y: by };
            own.bounding_rect().map_or(nothing, |bounds| Rect::new(bounds.min() - by, bounds.max() + by))
        };
        // The dilation and the erosion each reach one radius, so paths farther away cannot change the result.
        let (reach, seen) = (grown(reach), grown(reach + 2.0 * radius));
        let mut near: Vec<LineString> = Vec::new();
        for path in paths {
            let whole: LineString = path.iter().map(at).collect();
            // The time for buffers grows with the number of points, and dense paths have many more than their
            // shape needs.
            let whole = whole.simplify(CHORD_TOLERANCE);
            let mut open: Vec<Coord> = Vec::new();
            for line in whole.lines() {
                if !line.intersects(&seen) {
                    near.extend((open.len() > 1).then(|| LineString::new(std::mem::take(&mut open))));
                    open.clear();
                    continue;
                }
                if open.is_empty() {
                    open.push(line.start);
                }
                open.push(line.end);
            }
            near.extend((open.len() > 1).then_some(LineString::new(open)));
        }
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
