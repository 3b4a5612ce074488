//! Where an operation's own cutting reaches: the tool's centre may go wherever its disc covers nothing that the operation leaves.

use super::region::holds_line;
use geo::buffer::{BufferStyle, LineCap, LineJoin};
use geo::{Buffer, Intersects, Line, LineString, MultiLineString, MultiPolygon, Rect};
use nalgebra::Point2;

/// Rounded corners of buffers are polygons with steps of this angle (radians): off by a radius over 3,000.
const STEP: f64 = 0.05;

/// The tool may cover this much (mm) that is not covered by the operation: what polygons for circles make, and no more.
const MARGIN: f64 = 0.05;

/// The paths of an operation's cuts at one level, and the radius of the tool; mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Milled {
    paths: Vec<LineString>,
    radius: f64,
}

impl Milled {
    /// The area that a tool of a radius covers along paths across its axis; arcs are given as samples.
    pub fn new(paths: Vec<Vec<Point2<f64>>>, radius: f64) -> Self {
        let string = |path: Vec<Point2<f64>>| path.into_iter().map(|at| (at.x, at.y)).collect();
        Self { paths: paths.into_iter().map(string).collect(), radius }
    }

    /// Whether the tool, its centre going along a path, covers nothing but this area.
    ///
    /// The area is grown from the paths by the radius and shrunk by it again: a morphological closing, which lies between the
    /// paths and their hull. Only what is within reach of the path is looked at.
    pub fn holds(&self, path: &[Point2<f64>]) -> bool {
        let all: LineString = path.iter().map(|at| (at.x, at.y)).collect();
        let Some(reach) = geo::BoundingRect::bounding_rect(&all) else { return true };
        let aside = geo::Coord { x: 3.0 * self.radius, y: 3.0 * self.radius };
        let reach = Rect::new(reach.min() - aside, reach.max() + aside);
        let near = self.paths.iter().flat_map(LineString::lines).filter(|line| line.intersects(&reach));
        let near: Vec<LineString> = near.map(LineString::from).collect();
        if near.is_empty() {
            return false;
        }
        let free = self.closed(MultiLineString(near));
        all.lines().all(|line: Line| free.iter().any(|polygon| holds_line(polygon, line)))
    }

    fn closed(&self, paths: MultiLineString) -> MultiPolygon {
        let style = |distance: f64| {
            BufferStyle::new(distance).line_cap(LineCap::Round(STEP)).line_join(LineJoin::Round(STEP))
        };
        paths.buffer_with_style(style(self.radius)).buffer_with_style(style(MARGIN - self.radius))
    }
}
