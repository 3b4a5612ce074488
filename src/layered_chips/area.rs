//! Areas in a layer: polygons with holes, and the integer grid on which they are cut.

mod clipper;
mod grid;
mod grid_area;

pub use clipper::Clipper;
pub use grid::AreaGrid;
pub use grid_area::{GridArea, GridBox};

/// A connected area: an outer border and the holes in it. Points are x, y in mm; the outer border goes counter-clockwise, holes
/// go clockwise; no border repeats its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Polygon {
    /// The outer border.
    pub outer: Vec<[f64; 2]>,
    /// The holes.
    pub holes: Vec<Vec<[f64; 2]>>,
}

impl Polygon {
    /// Its area, mm2.
    pub fn area_mm2(&self) -> f64 {
        std::iter::once(&self.outer).chain(&self.holes).map(|border| signed_area_mm2(border)).sum()
    }
}

/// Area inside a closed border, mm2; negative for one that goes clockwise.
pub fn signed_area_mm2(border: &[[f64; 2]]) -> f64 {
    let Some(&[x0, y0]) = border.first() else { return 0.0 };
    // From the first point, so that places far from the origin lose nothing.
    let cross = |pair: &[[f64; 2]]| match pair {
        [[ax, ay], [bx, by]] => (ax - x0) * (by - y0) - (bx - x0) * (ay - y0),
        _ => 0.0,
    };
    border.windows(2).map(cross).sum::<f64>() / 2.0
}
