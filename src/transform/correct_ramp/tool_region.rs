//! Where the tool's centre may go across its axis.

use super::milled_area::MilledArea;
use super::polygon_containment::contains_line;
use super::ramp::is_sensible;
use geo::{Area, ConvexHull, Line, LineString, MultiPoint, Polygon, Validation};
use nalgebra::Point2;

/// A region across the tool axis, mm.
#[derive(Debug, Clone, PartialEq)]
pub enum ToolRegion {
    /// Anywhere.
    Everywhere,
    /// Within a polygon, its border included.
    Polygon(Polygon),
    /// Where the operation's own cutting at the level reaches.
    Milled(MilledArea),
}

/// Why corners make no region.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ToolRegionError {
    /// Fewer than three corners.
    #[error("a region needs three corners or more")]
    TooFew,
    /// Its border crosses or touches itself, or it has no area.
    #[error("the region's border crosses itself, or encloses nothing")]
    Crossing,
}

impl ToolRegion {
    /// The region inside a polygon, either way around; the last corner need not repeat the first.
    ///
    /// # Errors
    /// [`ToolRegionError`].
    pub fn from_polygon(corners: &[[f64; 2]]) -> Result<Self, ToolRegionError> {
        let border: LineString = corners.iter().map(|[x, y]| (*x, *y)).collect();
        let polygon = Polygon::new(border, Vec::new());
        // A closed border repeats its first corner.
        if polygon.exterior().coords().count() < 4 {
            return Err(ToolRegionError::TooFew);
        }
        // Corners in line are valid to `geo`; mm^2, beyond any rounding.
        if !polygon.is_valid() || polygon.unsigned_area() <= 1e-6 {
            return Err(ToolRegionError::Crossing);
        }
        Ok(Self::Polygon(polygon))
    }

    /// The convex hull of points, of those on a line only that line; of none, nothing. What is no number
    /// of a sensible size is left out.
    pub fn from_hull(points: impl IntoIterator<Item = Point2<f64>>) -> Self {
        let sensible = points.into_iter().filter(|point| is_sensible(point.x) && is_sensible(point.y));
        let all: MultiPoint = sensible.map(|point| geo::Point::new(point.x, point.y)).collect();
        Self::Polygon(all.convex_hull())
    }

    /// Whether a path lies in it; arcs are given as their samples.
    pub fn contains_path(&self, path: &[Point2<f64>]) -> bool {
        let polygon = match self {
            Self::Everywhere => return true,
            Self::Milled(milled) => return milled.contains_path(path),
            Self::Polygon(polygon) => polygon,
        };
        // Distances to an empty border are 0.
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
