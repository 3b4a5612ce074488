//! Where the tool's centre may go across its axis.

use super::milled_area::MilledArea;
use super::ramp::is_sensible;
use geo::line_intersection::{LineIntersection, line_intersection};
use geo::{
    Area, Contains, ConvexHull, Distance, Euclidean, Line, LineString, MultiPoint, Polygon, Validation,
};
use nalgebra::Point2;

/// Points this far outside (mm) are on the border: below what any dialect prints.
const BORDER: f64 = 1e-5;

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

/// Between its crossings with the border a line is inside or outside as a whole, so the middles tell.
pub(super) fn contains_line(polygon: &Polygon, line: Line) -> bool {
    let delta = line.delta();
    let length_squared = delta.x * delta.x + delta.y * delta.y;
    let share =
        |at: geo::Coord| ((at.x - line.start.x) * delta.x + (at.y - line.start.y) * delta.y) / length_squared;
    let mut cuts = vec![0.0, 1.0];
    if length_squared > 0.0 {
        for edge in boundary_rings(polygon).flat_map(LineString::lines) {
            match line_intersection(line, edge) {
                Some(LineIntersection::SinglePoint { intersection, .. }) => cuts.push(share(intersection)),
                Some(LineIntersection::Collinear { intersection }) => {
                    cuts.extend([share(intersection.start), share(intersection.end)]);
                }
                None => {}
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    let middle = |low: f64, high: f64| line.start + delta * (0.5 * (low + high));
    let inside = |at: geo::Coord| {
        let point = geo::Point::from(at);
        polygon.contains(&point)
            || boundary_rings(polygon).any(|ring| Euclidean.distance(&point, ring) <= BORDER)
    };
    let ends = [line.start, line.end].into_iter().all(inside);
    ends && cuts.windows(2).all(|pair| match pair {
        [low, high] => inside(middle(*low, *high)),
        _ => true,
    })
}

fn boundary_rings(polygon: &Polygon) -> impl Iterator<Item = &LineString> {
    std::iter::once(polygon.exterior()).chain(polygon.interiors())
}
