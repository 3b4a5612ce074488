//! This module holds areas in a layer: polygons with holes, and the integer grid on which they are cut.
//!
//! All areas of a workpiece are on one integer grid (a millionth of a millimetre where the size allows). So
//! the boundary that one step leaves is met by the next step to the bit.

mod clipper;
mod grid;
mod grid_area;

pub use clipper::Clipper;
pub use grid::AreaGrid;
pub use grid_area::GridArea;
pub(crate) use grid_area::GridBox;

/// A connected area: an outer boundary and the holes in it. Points are x, y in mm. The outer boundary goes
/// counter-clockwise and holes go clockwise; no boundary repeats its first point.
///
/// ```
/// use clsmith::layered_chips::Polygon;
///
/// let frame = Polygon {
///     outer: vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]],
///     holes: vec![vec![[1.0, 1.0], [1.0, 3.0], [3.0, 3.0], [3.0, 1.0]]],
/// };
/// assert!((frame.area_mm2() - 12.0).abs() < 1e-12);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polygon {
    /// The outer boundary.
    pub outer: Vec<[f64; 2]>,
    /// The boundaries of the holes.
    pub holes: Vec<Vec<[f64; 2]>>,
}

impl Polygon {
    /// Returns the number of points of all its boundaries.
    pub fn vertex_count(&self) -> usize {
        self.outer.len() + self.holes.iter().map(Vec::len).sum::<usize>()
    }

    /// Returns the area, mm2.
    pub fn area_mm2(&self) -> f64 {
        std::iter::once(&self.outer).chain(&self.holes).map(|border| signed_area_mm2(border)).sum()
    }
}

/// Returns the area inside a closed boundary, mm2. It is negative if the boundary goes clockwise.
pub fn signed_area_mm2(border: &[[f64; 2]]) -> f64 {
    let Some(&[x0, y0]) = border.first() else { return 0.0 };
    // Coordinates count from the first point, so that nothing cancels for points far from the origin.
    let cross = |pair: &[[f64; 2]]| match pair {
        [[ax, ay], [bx, by]] => (ax - x0) * (by - y0) - (bx - x0) * (ay - y0),
        _ => 0.0,
    };
    border.windows(2).map(cross).sum::<f64>() / 2.0
}
