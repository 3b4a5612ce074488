//! This module reduces the remaining stock to a field of heights that a browser can draw.

use crate::stock::Dexels;

/// The largest number of columns of the drawing along a side.
const MOST_COLUMNS: usize = 240;

/// Heights on a square grid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StockHeightField {
    /// The centre of the first column (x, y), mm.
    pub first_mm: [f64; 2],
    /// The distance between columns, mm.
    pub cell_mm: f64,
    /// Columns in x.
    pub columns: usize,
    /// Columns in y.
    pub rows: usize,
    /// The height of the lowest material, mm.
    pub low_mm: f64,
    /// The height of the highest material of each column above `low_mm`, in mm, row by row. It is NaN if the
    /// column has no material.
    pub heights: Vec<f32>,
    /// The number of columns of the simulation in each direction that make one of the drawing.
    pub coarser: usize,
}

impl StockHeightField {
    /// Computes the highest material of square blocks of columns. Returns `None` if no material remains.
    pub(super) fn from_dexels(dexels: &Dexels) -> Option<Self> {
        let layout = dexels.grid();
        let coarser = layout.columns.max(layout.rows).div_ceil(MOST_COLUMNS).max(1);
        let (columns, rows) = (layout.columns.div_ceil(coarser), layout.rows.div_ceil(coarser));
        let mut heights = vec![f32::NAN; columns * rows];
        let mut low = f32::INFINITY;
        for band in dexels.bands() {
            for index in 0..band.row_count() * band.columns {
                let (row, column) = (band.first_row + index / band.columns, index % band.columns);
                let mut top = None;
                for [bottom, upper] in band.column_spans(index) {
                    low = low.min(bottom);
                    // The intervals are ordered from top to bottom, so the first one has the top of the
                    // column.
                    top.get_or_insert(upper);
                }
                if let (Some(top), Some(height)) =
                    (top, heights.get_mut(row / coarser * columns + column / coarser))
                {
                    // `f32::max` ignores NaN, so an empty cell takes the height of the column.
                    *height = height.max(top);
                }
            }
        }
        if low == f32::INFINITY {
            return None;
        }
        heights.iter_mut().for_each(|height| *height -= low);
        let [x, y] = layout.origin_mm;
        // The grid states the centre of its first column. The centre of a block of n columns is (n - 1) / 2
        // columns farther in.
        let inward = (coarser as f64 - 1.0) / 2.0 * layout.cell_mm;
        Some(Self {
            first_mm: [x + inward, y + inward],
            cell_mm: layout.cell_mm * coarser as f64,
            columns,
            rows,
            low_mm: layout.base_mm + f64::from(low),
            heights,
            coarser,
        })
    }
}
