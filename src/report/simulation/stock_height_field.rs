//! This module reduces columns to a field of heights that a browser can draw.

use crate::stock::{DexelGrid, Dexels};

/// The largest number of columns of the drawing along a side.
const MOST_COLUMNS: usize = 240;

/// The layout of heights on a square grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::report) struct HeightFieldLayout {
    /// The centre of the first cell (x, y), mm.
    pub first_mm: [f64; 2],
    /// The distance between cells, mm.
    pub cell_mm: f64,
    /// Cells in x.
    pub columns: usize,
    /// Cells in y.
    pub rows: usize,
    /// The z from which heights count, mm.
    pub base_mm: f64,
    /// The number of columns of the simulation in each direction that make one cell.
    pub coarser: usize,
}

impl HeightFieldLayout {
    /// Makes the layout for a grid: square blocks of columns, so many together that no side has too many.
    pub(in crate::report) fn of_grid(grid: &DexelGrid) -> Self {
        let coarser = grid.columns.max(grid.rows).div_ceil(MOST_COLUMNS).max(1);
        let [x, y] = grid.origin_mm;
        // The grid states the centre of its first column. The centre of a block of n columns is (n - 1) / 2
        // columns farther in.
        let inward = (coarser as f64 - 1.0) / 2.0 * grid.cell_mm;
        Self {
            first_mm: [x + inward, y + inward],
            cell_mm: grid.cell_mm * coarser as f64,
            columns: grid.columns.div_ceil(coarser),
            rows: grid.rows.div_ceil(coarser),
            base_mm: grid.base_mm,
            coarser,
        }
    }

    fn cell_index(&self, column: usize, row: usize) -> usize {
        row / self.coarser * self.columns + column / self.coarser
    }

    /// Returns the highest material of each cell above the base in mm, row by row: NaN if the cell has none.
    pub(in crate::report) fn highest_material(&self, dexels: &Dexels) -> Vec<f32> {
        let mut heights = vec![f32::NAN; self.columns * self.rows];
        for (column, row, top) in column_tops(dexels) {
            if let (Some(top), Some(height)) = (top, heights.get_mut(self.cell_index(column, row))) {
                // `f32::max` ignores NaN, so an empty cell takes the height of the column.
                *height = height.max(top);
            }
        }
        heights
    }

    /// Returns how far the remaining stock is above (positive) or below a target part, mm: of the columns of each cell
    /// the one that is farthest off. NaN if neither has material there. Both must stand on the same grid.
    pub(in crate::report) fn deviation_from_target(&self, left: &Dexels, target: &Dexels) -> Vec<f32> {
        let mut deviations = vec![f32::NAN; self.columns * self.rows];
        for ((column, row, left), (_, _, target)) in column_tops(left).zip(column_tops(target)) {
            if left.is_none() && target.is_none() {
                continue;
            }
            // Where one of them has no material, the whole height of the other is the difference.
            let off = left.unwrap_or(0.0) - target.unwrap_or(0.0);
            if let Some(most) = deviations.get_mut(self.cell_index(column, row))
                && (most.is_nan() || off.abs() > most.abs())
            {
                *most = off;
            }
        }
        deviations
    }
}

/// Returns each column (its place in x and y) with the upper end of its highest material above the base, mm.
fn column_tops(dexels: &Dexels) -> impl Iterator<Item = (usize, usize, Option<f32>)> + '_ {
    dexels.bands().iter().flat_map(|band| {
        (0..band.row_count() * band.columns).map(move |index| {
            let top = band.column_spans(index).next().map(|[_, top]| top);
            (index % band.columns, band.first_row + index / band.columns, top)
        })
    })
}
