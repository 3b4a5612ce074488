//! This module holds areas as boundaries on the integer grid.

use super::AreaGrid;
use i_overlay::i_float::int::point::IntPoint;
use i_overlay::i_shape::flat::buffer::FlatContoursBuffer;

/// An area on the grid: boundaries that wind around it. In the results of a [`super::Clipper`] they wind
/// around every point of it once; outer boundaries go counter-clockwise and holes clockwise, and they have no
/// order.
#[derive(Debug, Clone, Default)]
pub struct GridArea {
    pub(super) borders: FlatContoursBuffer,
}

/// A box on the grid, with its sides included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct GridBox {
    pub(crate) low: [i32; 2],
    pub(crate) high: [i32; 2],
}

impl GridBox {
    /// Returns whether the box has a point in common with another one.
    pub(crate) fn intersects(&self, other: &Self) -> bool {
        let ([x0, y0], [x1, y1]) = (self.low, self.high);
        let ([u0, v0], [u1, v1]) = (other.low, other.high);
        x0 <= u1 && u0 <= x1 && y0 <= v1 && v0 <= y1
    }

    /// Returns the outer sides of the box on which a point is, with one bit for each side.
    fn outer_sides(&self, point: IntPoint) -> u8 {
        let ([x0, y0], [x1, y1]) = (self.low, self.high);
        u8::from(point.x < x0)
            | u8::from(point.x > x1) << 1
            | u8::from(point.y < y0) << 2
            | u8::from(point.y > y1) << 3
    }
}

impl PartialEq for GridArea {
    /// Returns whether both areas have the same boundaries, vertex by vertex.
    fn eq(&self, other: &Self) -> bool {
        self.borders.ranges == other.borders.ranges && self.borders.points == other.borders.points
    }
}

impl GridArea {
    /// Makes the area that boundaries (x, y in mm) wind around at all. The boundaries are stored as they are.
    pub fn new<'a>(grid: &AreaGrid, borders: impl IntoIterator<Item = &'a [[f64; 2]]>) -> Self {
        let mut region = Self::default();
        borders.into_iter().for_each(|border| region.add_boundary(grid, border));
        region
    }

    /// Adds a boundary with points in mm.
    pub(crate) fn add_boundary(&mut self, grid: &AreaGrid, border: &[[f64; 2]]) {
        let start = self.borders.points.len();
        grid.add_grid_points(border, &mut self.borders.points);
        self.close_boundary(start);
    }

    /// Returns whether the area has no boundary.
    pub fn is_empty(&self) -> bool {
        self.borders.ranges.is_empty()
    }

    /// Returns the number of vertices of all boundaries.
    pub(crate) fn vertex_count(&self) -> usize {
        self.borders.points.len()
    }

    /// Returns the sum of the areas that the boundaries enclose, mm2. This is the area if the boundaries wind
    /// around it once.
    pub fn area_mm2(&self, grid: &AreaGrid) -> f64 {
        let twice: i128 = self.contours().map(twice_area).sum();
        twice as f64 / 2.0 * grid.step_mm() * grid.step_mm()
    }

    /// Returns the box around the area, or `None` if it is empty.
    pub(crate) fn bounding_box(&self) -> Option<GridBox> {
        let first = self.borders.points.first()?;
        let start = GridBox { low: [first.x, first.y], high: [first.x, first.y] };
        Some(self.borders.points.iter().fold(start, |GridBox { low: [x0, y0], high: [x1, y1] }, point| {
            GridBox { low: [x0.min(point.x), y0.min(point.y)], high: [x1.max(point.x), y1.max(point.y)] }
        }))
    }

    pub(crate) fn clear(&mut self) {
        self.borders.clear_and_reserve(0, 0);
    }

    pub(super) fn contours(&self) -> impl Iterator<Item = &[IntPoint]> {
        self.borders.ranges.iter().filter_map(|range| self.borders.points.get(range.clone()))
    }

    pub(crate) fn append(&mut self, other: &Self) {
        other.contours().for_each(|contour| self.borders.add_contour(contour));
    }

    /// Makes the area of a box.
    pub(crate) fn from_box(window: &GridBox) -> Self {
        let ([x0, y0], [x1, y1]) = (window.low, window.high);
        let mut region = Self::default();
        let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)].map(|(x, y)| IntPoint::new(x, y));
        region.borders.add_contour(&corners);
        region
    }

    /// Adds boundaries that wind around every point of a window as the boundaries of another area do, but
    /// with fewer vertices: a part that runs along one outer side of the window becomes straight. Within the
    /// window no boundary point moves.
    pub(crate) fn add_simplified_within(&mut self, window: &GridBox, other: &Self) {
        for contour in other.contours() {
            let start = self.borders.points.len();
            let Some((&first, rest)) = contour.split_first() else { continue };
            let mut all = window.outer_sides(first);
            let (mut last, mut since) = (first, window.outer_sides(first));
            self.borders.points.push(first);
            for &point in rest.iter().chain([&first]) {
                let sides = window.outer_sides(point);
                // `since` holds the sides on which everything between the last kept vertex and `last` is. If
                // it becomes empty, a straight line might pass through the window, so `last` is kept.
                if since & sides == 0 {
                    if self.borders.points.get(start..).and_then(<[_]>::last) != Some(&last) {
                        self.borders.points.push(last);
                    }
                    since = window.outer_sides(last) & sides;
                }
                since &= sides;
                all &= sides;
                last = point;
            }
            // A boundary that is on one outer side as a whole does not wind around any point of the window.
            if all != 0 {
                self.borders.points.truncate(start);
            }
            self.close_boundary(start);
        }
    }

    /// Removes boundaries that enclose nothing thicker than rounding.
    pub(super) fn drop_slivers(&mut self) {
        let FlatContoursBuffer { points, ranges } = &mut self.borders;
        ranges.retain(|range| points.get(range.clone()).is_some_and(is_thick));
    }

    /// Makes a boundary of the points from `start` on, unless they enclose nothing.
    fn close_boundary(&mut self, start: usize) {
        let end = self.borders.points.len();
        if end >= start + 3 {
            self.borders.ranges.push(start..end);
        } else {
            self.borders.points.truncate(start);
        }
    }
}

/// The thickness in steps up to which a boundary counts as a sliver. Vertices are rounded to half a step, and
/// intersections to a step or two more.
const THINNEST: i128 = 2;

/// Returns whether a boundary encloses something thicker than rounding: whether its area is more than that
/// thickness times half its length.
pub(super) fn is_thick(contour: &[IntPoint]) -> bool {
    twice_area(contour).abs() > THINNEST * axis_parallel_length(contour)
}

/// Returns the edges of a closed boundary as pairs of vertices.
fn vertex_pairs(contour: &[IntPoint]) -> impl Iterator<Item = (&IntPoint, &IntPoint)> {
    contour.iter().zip(contour.iter().skip(1).chain(contour.first()))
}

/// Returns twice the area in square steps; positive if counter-clockwise.
pub(super) fn twice_area(contour: &[IntPoint]) -> i128 {
    let cross = |(a, b): (&IntPoint, &IntPoint)| {
        i128::from(i64::from(a.x) * i64::from(b.y) - i64::from(b.x) * i64::from(a.y))
    };
    vertex_pairs(contour).map(cross).sum()
}

/// Returns the length of a boundary in steps, measured along the axes.
fn axis_parallel_length(contour: &[IntPoint]) -> i128 {
    let way = |(a, b): (&IntPoint, &IntPoint)| i64::from(a.x.abs_diff(b.x)) + i64::from(a.y.abs_diff(b.y));
    i128::from(vertex_pairs(contour).map(way).sum::<i64>())
}
