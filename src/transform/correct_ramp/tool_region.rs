//! This module describes where the tool's centre may go across its axis.

use super::milled_area::MilledArea;
use super::polygon_containment::contains_line;
use super::ramp::is_sensible;
use geo::{Area, ConvexHull, Line, LineString, MultiPoint, Polygon, Validation};
use nalgebra::Point2;

/// A region across the tool axis, in mm.
#[derive(Debug, Clone, PartialEq)]
pub enum ToolRegion {
    /// Anywhere.
    Everywhere,
    /// Within a polygon, including its boundary.
    Polygon(Polygon),
    /// Where the operation's own cuts at the level reach.
    Milled(MilledArea),
}

/// The reason why vertices make no region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ToolRegionError {
    /// There are fewer than three vertices.
    #[error("a region needs at least three vertices")]
    TooFew,
    /// The boundary crosses or touches itself, or it encloses no area.
    #[error("the boundary of the region crosses itself or encloses no area")]
    Crossing,
}

impl ToolRegion {
    /// Makes the region inside a polygon, in either sense of rotation. The last vertex need not repeat the
    /// first.
    ///
    /// # Errors
    /// Returns [`ToolRegionError`].
    pub fn from_polygon(vertices: &[[f64; 2]]) -> Result<Self, ToolRegionError> {
        let border: LineString = vertices.iter().map(|[x, y]| (*x, *y)).collect();
        let polygon = Polygon::new(border, Vec::new());
        // A closed boundary repeats its first vertex.
        if polygon.exterior().coords().count() < 4 {
            return Err(ToolRegionError::TooFew);
        }
        // `geo` accepts collinear vertices as valid. The area in mm^2 is far above any rounding.
        if !polygon.is_valid() || polygon.unsigned_area() <= 1e-6 {
            return Err(ToolRegionError::Crossing);
        }
        Ok(Self::Polygon(polygon))
    }

    /// Makes the convex hull of points. Collinear points give a line, and no points give an empty region.
    /// Numbers of an implausible size are left out.
    pub fn from_hull(points: impl IntoIterator<Item = Point2<f64>>) -> Self {
        let sensible = points.into_iter().filter(|point| is_sensible(point.x) && is_sensible(point.y));
        let all: MultiPoint = sensible.map(|point| geo::Point::new(point.x, point.y)).collect();
        Self::Polygon(all.convex_hull())
    }

    /// Returns whether a path lies in the region. Arcs are given as samples.
    pub fn contains_path(&self, path: &[Point2<f64>]) -> bool {
        let polygon = match self {
            Self::Everywhere => return true,
            Self::Milled(milled) => return milled.contains_path(path),
            Self::Polygon(polygon) => polygon,
        };
        // `geo` returns the distance 0 to an empty boundary.
        if polygon.exterior().coords().next().is_none() {
            return false;
        }
        let at = |point: &Point2<f64>| geo::Coord { x: point.x, y: point.y };
        path.windows(2).all(|pair| match pair {
            [from, to] => contains_line(polygon, Line::new(at(from), at(to))),
            _ => true,
        })
    }
}
