//! This module holds stock that is known in columns over a grid, and stock that is known by a function.

use super::stock_gap::StockGap;
use nalgebra::Vector3;

/// A body that is known by a function of its gap: negative inside, at most the distance outside, at least minus
/// the depth inside, and 1-Lipschitz.
pub struct FunctionGap<F> {
    gap: F,
    bounds: [Vector3<f64>; 2],
}

impl<F: Fn(&Vector3<f64>) -> f64 + Send + Sync> FunctionGap<F> {
    /// Makes the body from its function, and from the lowest and the highest corner of a box around it, mm.
    pub fn new(gap: F, bounds: [Vector3<f64>; 2]) -> Self {
        Self { gap, bounds }
    }
}

impl<F: Fn(&Vector3<f64>) -> f64 + Send + Sync> StockGap for FunctionGap<F> {
    fn gap(&self, point: &Vector3<f64>) -> f64 {
        (self.gap)(point)
    }

    fn bounds(&self) -> [Vector3<f64>; 2] {
        self.bounds
    }
}

/// Columns along z over a grid in x and y: every cell has spans of z that are full. The body is the union of
/// the boxes over the cells, which neighbours share without a wall between them.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnGap {
    origin: [f64; 2],
    cell: f64,
    columns: usize,
    rows: usize,
    spans: Vec<Vec<[f64; 2]>>,
    bounds: [Vector3<f64>; 2],
}

impl ColumnGap {
    /// Makes the body from the lowest corner of its grid, the size of a cell in mm, the number of columns along
    /// x, and the full spans of every cell, row by row; `None` if a number is not finite, there is no cell, or
    /// nothing is full.
    pub fn new(origin_mm: [f64; 2], cell_mm: f64, columns: usize, spans: Vec<Vec<[f64; 2]>>) -> Option<Self> {
        let is_known = |number: &f64| number.is_finite();
        if columns == 0 || !(cell_mm > 0.0 && cell_mm.is_finite()) || !origin_mm.iter().all(is_known) {
            return None;
        }
        if !spans.len().is_multiple_of(columns) || !spans.iter().flatten().flatten().all(is_known) {
            return None;
        }
        let rows = spans.len() / columns;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for [from, to] in spans.iter().flatten().filter(|[from, to]| from < to) {
            (low, high) = (low.min(*from), high.max(*to));
        }
        if low > high {
            return None;
        }
        let [x, y] = origin_mm;
        let bounds = [
            Vector3::new(x, y, low),
            Vector3::new(x + cell_mm * columns as f64, y + cell_mm * rows as f64, high),
        ];
        Some(Self { origin: origin_mm, cell: cell_mm, columns, rows, spans, bounds })
    }

    /// Returns the spans of a cell; none off the grid.
    fn spans_at(&self, column: i64, row: i64) -> &[[f64; 2]] {
        let is_on = (0..self.columns as i64).contains(&column) && (0..self.rows as i64).contains(&row);
        if !is_on {
            return &[];
        }
        self.spans.get(row as usize * self.columns + column as usize).map_or(&[], Vec::as_slice)
    }

    /// Returns how far a height is from what is full (or empty) in a cell: 0 within it.
    fn height_to(spans: &[[f64; 2]], z: f64, full: bool) -> f64 {
        if full {
            let beyond = |[from, to]: &[f64; 2]| (from - z).max(z - to).max(0.0);
            return spans.iter().filter(|[from, to]| from < to).map(beyond).fold(f64::INFINITY, f64::min);
        }
        // The span that holds the height, with those that touch it.
        let (mut low, mut high) = (z, z);
        loop {
            let grown = |low: f64, high: f64| {
                let touching = spans.iter().filter(|[from, to]| from < to && *from <= high && *to >= low);
                touching.fold((low, high), |(low, high), [from, to]| (low.min(*from), high.max(*to)))
            };
            let next = grown(low, high);
            if next == (low, high) {
                return (z - low).min(high - z);
            }
            (low, high) = next;
        }
    }

    /// Returns the distance of the nearest full (or empty) place.
    fn distance_to(&self, point: &Vector3<f64>, full: bool) -> f64 {
        let at = |value: f64, origin: f64| ((value - origin) / self.cell).floor();
        let (column, row) = (at(point.x, self.origin[0]), at(point.y, self.origin[1]));
        let (column, row) = (column.clamp(-1e9, 1e9) as i64, row.clamp(-1e9, 1e9) as i64);
        let mut best = f64::INFINITY;
        let farthest = self.columns.max(self.rows) as i64
            + (column - column.clamp(0, self.columns as i64)).abs()
            + (row - row.clamp(0, self.rows as i64)).abs()
            + 1;
        for ring in 0..=farthest {
            if (ring - 1).max(0) as f64 * self.cell > best {
                break;
            }
            for (x, y) in ring_cells(column, row, ring) {
                let corner = [x as f64, y as f64].map(|number| number * self.cell);
                let beyond = |value: f64, low: f64| (low - value).max(value - low - self.cell).max(0.0);
                let across = beyond(point.x, self.origin[0] + corner[0])
                    .hypot(beyond(point.y, self.origin[1] + corner[1]));
                if across < best {
                    best = best.min(across.hypot(Self::height_to(self.spans_at(x, y), point.z, full)));
                }
            }
        }
        best
    }
}

/// Returns the cells at a distance of so many cells, as a square ring.
fn ring_cells(column: i64, row: i64, ring: i64) -> impl Iterator<Item = (i64, i64)> {
    (-ring..=ring).flat_map(move |dy| {
        let step = if dy.abs() == ring || ring == 0 { 1 } else { 2 * ring };
        (-ring..=ring).step_by(step as usize).map(move |dx| (column + dx, row + dy))
    })
}

impl StockGap for ColumnGap {
    fn gap(&self, point: &Vector3<f64>) -> f64 {
        // Far away the box around the body is enough.
        let [low, high] = self.bounds;
        let beyond = (low - point).max().max((point - high).max());
        if beyond > 4.0 * self.cell {
            return beyond;
        }
        let outside = self.distance_to(point, true);
        if outside > 0.0 { outside } else { -self.distance_to(point, false) }
    }

    fn bounds(&self) -> [Vector3<f64>; 2] {
        self.bounds
    }
}
