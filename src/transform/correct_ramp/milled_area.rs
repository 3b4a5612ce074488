//! Where an operation's own cutting reaches: the tool's centre may go wherever its disc covers nothing that the operation leaves.

use super::polygon_containment::contains_line;
use geo::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{
    BoundingRect, Buffer, Coord, Intersects, Line, LineString, MultiLineString, MultiPolygon, Rect, Simplify,
};
use nalgebra::Point2;

/// Rounded corners of buffers are polygons with steps of this angle (radians): off by a radius over 800.
const STEP: f64 = 0.1;

/// The tool may cover this much (mm) that is not covered by the operation, or this share of its radius: what polygons for circles make.
const MARGIN: f64 = 0.05;
const SHARE: f64 = 1.0 / 400.0;

/// Chords within this (mm) of a path stand for it.
const COARSE: f64 = 0.01;

/// The area within reach of a ramp that an operation's cuts at one level leave to the tool's centre.
#[derive(Debug, Clone, PartialEq)]
pub struct MilledArea {
    free: MultiPolygon,
    reach: Rect,
}

impl MilledArea {
    /// The area for a tool of `radius` (mm) along paths across its axis, arcs as samples; within `reach` (mm) of `around`, farther away
    /// nothing is free.
    ///
    /// What the tool covers along the paths is shrunk by its radius: a morphological closing of the paths, which lies between
    /// them and their hull.
    pub fn new(paths: &[Vec<Point2<f64>>], radius: f64, around: &[Point2<f64>], reach: f64) -> Self {
        let at = |point: &Point2<f64>| Coord { x: point.x, y: point.y };
        let own: LineString = around.iter().map(at).collect();
        let nothing = Rect::new(Coord::zero(), Coord::zero());
        let grown = |by: f64| {
            let by = Coord { x: by, y: by };
            own.bounding_rect().map_or(nothing, |bounds| Rect::new(bounds.min() - by, bounds.max() + by))
        };
        let (reach, seen) = (grown(reach), grown(reach + 2.0 * radius));
        let mut near: Vec<LineString> = Vec::new();
        for path in paths {
            let whole: LineString = path.iter().map(at).collect();
            let whole = whole.simplify(COARSE);
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
        let style = |distance: f64| {
            BufferStyle::new(distance).line_cap(LineCap::Round(STEP)).line_join(LineJoin::Round(STEP))
        };
        let covered = MultiLineString(near).buffer_with_style(style(radius));
        let free = covered.buffer_with_style(style(MARGIN.max(radius * SHARE) - radius));
        Self { free, reach }
    }

    /// Whether the tool's centre may go along a path.
    pub fn contains_path(&self, path: &[Point2<f64>]) -> bool {
        let all: LineString = path.iter().map(|at| (at.x, at.y)).collect();
        let inside = |line: Line| {
            let ends = [line.start, line.end].iter().all(|end| end.intersects(&self.reach));
            ends && self.free.iter().any(|polygon| contains_line(polygon, line))
        };
        all.lines().all(inside)
    }
}
