//! This module sorts triangles into square columns in the view from above.

use crate::stock::Mesh;

/// The most columns along a side.
const MOST_COLUMNS: f64 = 1000.0;

/// A mesh's triangles in columns whose side is half a cutter's radius.
#[derive(Debug, Clone)]
pub(super) struct TriangleColumns {
    origin: [f64; 2],
    cell: f64,
    size: [usize; 2],
    columns: Vec<Vec<u32>>,
}

impl TriangleColumns {
    /// Sorts a mesh's triangles for a cutter of `radius_mm`.
    pub(super) fn new(mesh: &Mesh, radius_mm: f64) -> Self {
        let ([x0, y0, _], [x1, y1, _]) = mesh.bounds();
        let cell = (radius_mm / 2.0).max((x1 - x0).max(y1 - y0) / MOST_COLUMNS);
        let size = [x1 - x0, y1 - y0].map(|width| (width / cell) as usize + 1);
        let [across, deep] = size;
        let mut all = Self { origin: [x0, y0], cell, size, columns: vec![Vec::new(); across * deep] };
        for (index, [a, b, c]) in mesh.triangle_vertices().enumerate() {
            let [low, high] = [f64::min, f64::max]
                .map(|of: fn(f64, f64) -> f64| [of(a[0], of(b[0], c[0])), of(a[1], of(b[1], c[1]))]);
            for column in all.covered_columns(low, high) {
                if let Some(column) = all.columns.get_mut(column) {
                    column.push(index as u32);
                }
            }
        }
        all
    }

    /// Returns the triangles of each column that a rectangle touches. A triangle in several columns is
    /// returned several times.
    pub(super) fn columns_within(&self, low: [f64; 2], high: [f64; 2]) -> impl Iterator<Item = &[u32]> {
        self.covered_columns(low, high).filter_map(|column| self.columns.get(column)).map(Vec::as_slice)
    }

    /// Returns the indices of the columns that a rectangle touches.
    fn covered_columns(&self, low: [f64; 2], high: [f64; 2]) -> impl Iterator<Item = usize> + use<> {
        let range = |low: f64, high: f64, origin: f64, size: usize| {
            let [first, last] = [low, high].map(|value| ((value - origin) / self.cell).floor());
            // The range is empty if the rectangle is beside the grid.
            if last < 0.0 {
                0..0
            } else {
                (first.max(0.0) as usize).min(size)..(last as usize).saturating_add(1).min(size)
            }
        };
        let [across, deep] = self.size;
        let [x, y] = self.origin;
        let columns = range(low[0], high[0], x, across);
        range(low[1], high[1], y, deep)
            .flat_map(move |row| columns.clone().map(move |column| row * across + column))
    }
}
