//! This module keeps the heights of the stock around a tool, for a picture.

use crate::simulation_run::EdgeMoment;
use crate::stock::Dexels;

/// The number of cells of the picture along a side.
const CELLS: usize = 72;

/// How far the window reaches from the tip, in radii of the tool.
const REACH: f64 = 1.7;

/// How far it reaches below the tip, in radii of the tool.
const BELOW: f64 = 0.35;

/// The heights of the stock on a square grid around a tool.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StockWindow {
    /// The centre of the first cell (x, y), mm.
    pub first_mm: [f64; 2],
    /// The distance between cells, mm.
    pub cell_mm: f64,
    /// The number of cells in x and in y.
    pub counts: [usize; 2],
    /// The z of the highest material of each cell, row by row, mm; the floor where there is none.
    pub heights_mm: Vec<f64>,
    /// The lowest z of the picture, mm.
    pub floor_mm: f64,
}

impl StockWindow {
    /// Takes the heights around a tool out of the stock. What lies below the floor is not seen.
    pub(super) fn around_tool(stock: &Dexels, moment: &EdgeMoment) -> Self {
        let grid = stock.grid();
        let radius = moment.outline_mm.iter().map(|[radius, _]| *radius).fold(1e-3, f64::max);
        let [x, y, z] = moment.tip_mm;
        let floor_mm = z - BELOW * radius;
        let range = |tip: f64, origin: f64, columns: usize| {
            let column =
                |at: f64| ((at - origin) / grid.cell_mm).round().clamp(0.0, columns.saturating_sub(1) as f64);
            [column(tip - REACH * radius) as usize, column(tip + REACH * radius) as usize]
        };
        let [first_column, last_column] = range(x, grid.origin_mm[0], grid.columns);
        let [first_row, last_row] = range(y, grid.origin_mm[1], grid.rows);
        let step = ((last_column - first_column).max(last_row - first_row) / CELLS).max(1);
        let counts = [(last_column - first_column) / step + 1, (last_row - first_row) / step + 1];
        let mut heights_mm = Vec::with_capacity(counts[0] * counts[1]);
        for row in 0..counts[1] {
            for column in 0..counts[0] {
                let spans = stock.column_spans(first_column + column * step, first_row + row * step);
                let top = spans.first().map(|span| grid.base_mm + f64::from(span[1]));
                heights_mm.push(top.unwrap_or(floor_mm).max(floor_mm));
            }
        }
        Self {
            first_mm: stock.grid().column_center(first_column, first_row),
            cell_mm: grid.cell_mm * step as f64,
            counts,
            heights_mm,
            floor_mm,
        }
    }

    /// Returns the height of a cell, mm.
    pub(super) fn height_mm(&self, column: usize, row: usize) -> f64 {
        self.heights_mm.get(row * self.counts[0] + column).copied().unwrap_or(self.floor_mm)
    }
}
