//! The stock that is left, as a field of heights that a browser can draw.

use crate::stock::Dexels;

/// Most columns of the drawing along a side.
const MOST: usize = 240;

/// Heights on a square grid.
#[derive(Debug, Clone, PartialEq)]
pub struct StockHeightField {
    /// Centre of the first column (x, y), mm.
    pub first_mm: [f64; 2],
    /// Distance of columns, mm.
    pub cell_mm: f64,
    /// Columns in x.
    pub columns: usize,
    /// Columns in y.
    pub rows: usize,
    /// Lowest material, mm.
    pub low_mm: f64,
    /// Highest material of each column above `low`, mm, row by row; NaN where there is none.
    pub heights: Vec<f32>,
    /// How many columns of the simulation, each way, make one of the drawing.
    pub coarser: usize,
}

impl StockHeightField {
    /// The highest material of blocks of columns. `None` when nothing is left.
    pub fn from_dexels(dexels: &Dexels) -> Option<Self> {
        let layout = dexels.grid();
        let coarser = layout.columns.max(layout.rows).div_ceil(MOST).max(1);
        let (columns, rows) = (layout.columns.div_ceil(coarser), layout.rows.div_ceil(coarser));
        let mut heights = vec![f32::NAN; columns * rows];
        let mut low = f32::INFINITY;
        for band in dexels.bands() {
            for index in 0..band.row_count() * band.columns {
                let (row, column) = (band.first_row + index / band.columns, index % band.columns);
                let mut top = None;
                for [bottom, upper] in band.column_spans(index) {
                    low = low.min(bottom);
                    top.get_or_insert(upper);
                }
                if let (Some(top), Some(height)) =
                    (top, heights.get_mut(row / coarser * columns + column / coarser))
                {
                    // `max` takes the number where the other is none.
                    *height = height.max(top);
                }
            }
        }
        if low == f32::INFINITY {
            return None;
        }
        heights.iter_mut().for_each(|height| *height -= low);
        let [x, y] = layout.origin_mm;
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
