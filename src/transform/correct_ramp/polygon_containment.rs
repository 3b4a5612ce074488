//! This module tells whether a line lies in a polygon.

use geo::line_intersection::{LineIntersection, line_intersection};
use geo::{Contains, Distance, Euclidean, Line, LineString, Polygon};

/// Points that are this far outside (mm) still count as on the boundary. It is below what any dialect prints.
const BOUNDARY: f64 = 1e-5;

/// Returns whether a line lies in a polygon. Between two crossings with the boundary, a line is inside or
/// outside as a whole. So testing the middles of these segments is enough.
pub(super) fn contains_line(polygon: &Polygon, line: Line) -> bool {
    let delta = line.delta();
    let length_squared = delta.x * delta.x + delta.y * delta.y;
    let share =
        |at: geo::Coord| ((at.x - line.start.x) * delta.x + (at.y - line.start.y) * delta.y) / length_squared;
    // Between two neighbouring cuts a line does not cross the boundary, so the middle decides for all of that
    // part.
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
            || boundary_rings(polygon).any(|ring| Euclidean.distance(&point, ring) <= BOUNDARY)
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
