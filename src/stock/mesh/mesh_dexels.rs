//! This module converts a mesh to columns.
//!
//! Every row of column centres cuts a triangle in a segment between two of the triangle's edges. The point
//! where an edge meets the row is computed from the edge alone, so both triangles of the edge get the same
//! point to the last bit. A segment includes its lower end and excludes its upper one. So the segments of a
//! closed surface follow each other without gap or overlap, and a column through an edge or a vertex counts
//! each crossing once. The result is the same as if all columns were moved by an infinitesimal step.

use super::Mesh;
use crate::stock::dexel::BAND_ROWS;
use crate::stock::{DexelBand, DexelGrid, DexelSpan, Dexels, NoMemory, dexel_spans};
use rayon::prelude::*;

/// A crossing of a column and the surface: the column's index in the band, the height above the base in mm,
/// and +1 where the surface faces up or -1 where it faces down.
type SurfaceCrossing = (u32, f32, i32);

impl Mesh {
    /// Converts the solid to columns. Each column is the line through its centre as it meets the mesh, so the
    /// result is exact in z (to the resolution of `f32`) and sampled in x and y. Parts of the solid beside
    /// the grid are left out. The time grows with the number of triangles and with the number of columns
    /// below each.
    ///
    /// # Errors
    /// Returns an error if there is no memory for the columns.
    pub fn to_dexels(&self, layout: DexelGrid) -> Result<Dexels, NoMemory> {
        let mut dexels = Dexels::try_with_empty_columns(layout)?;
        if layout.columns == 0 {
            return Ok(dexels);
        }
        let mut per_band: Vec<Vec<u32>> = vec![Vec::new(); dexels.bands().len()];
        for (index, triangle) in self.triangle_vertices().enumerate() {
            let ys = triangle.map(|[_, y, _]| y);
            let Some((first, last)) = index_range(ys, layout.origin_mm[1], layout.cell_mm, layout.rows)
            else {
                continue;
            };
            for band in per_band.iter_mut().take(last / BAND_ROWS + 1).skip(first / BAND_ROWS) {
                band.push(index as u32);
            }
        }
        dexels.bands_mut().par_iter_mut().zip(per_band).for_each(|(band, triangles)| {
            let mut crossings = Vec::new();
            for index in triangles {
                let Some(triangle) = self.triangles.get(index as usize) else { continue };
                collect_crossings(self.vertices_of(*triangle), &layout, band, &mut crossings);
            }
            fill_band(band, crossings);
        });
        Ok(dexels)
    }
}

/// Returns the range of indices whose centres can lie within some values, one index wider on both sides
/// because the exact test follows.
fn index_range(values: [f64; 3], origin: f64, cell: f64, count: usize) -> Option<(usize, usize)> {
    let low = values.into_iter().fold(f64::INFINITY, f64::min);
    let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let first = ((low - origin) / cell).floor() - 1.0;
    let last = ((high - origin) / cell).ceil() + 1.0;
    let end = count.checked_sub(1)?;
    (last >= 0.0 && first <= end as f64).then(|| (first.max(0.0) as usize, (last as usize).min(end)))
}

/// Adds the crossings of one triangle with all columns of a band.
fn collect_crossings(
    corners: [[f64; 3]; 3],
    layout: &DexelGrid,
    band: &DexelBand,
    crossings: &mut Vec<SurfaceCrossing>,
) {
    let [a, b, c] = corners;
    let Some((first, last)) =
        index_range(corners.map(|[_, y, _]| y), layout.origin_mm[1], layout.cell_mm, layout.rows)
    else {
        return;
    };
    for row in first.max(band.first_row)..=last.min(band.first_row + band.row_count() - 1) {
        let [_, y] = layout.column_center(0, row);
        let (mut up, mut down) = (None, None);
        // Of three edges, a row crosses none or two: one upwards in y and one downwards.
        for [from, to] in [[a, b], [b, c], [c, a]] {
            if from[1] <= y && y < to[1] {
                up = Some(intersect_row(from, to, y));
            } else if to[1] <= y && y < from[1] {
                down = Some(intersect_row(to, from, y));
            }
        }
        let (Some(up), Some(down)) = (up, down) else { continue };
        // Counter-clockwise from above, the inside is to the left of an edge that goes up in y.
        let ([x0, z0], [x1, z1], sense) = if down[0] < up[0] { (down, up, 1) } else { (up, down, -1) };
        let Some((first, last)) =
            index_range([x0, x1, x1], layout.origin_mm[0], layout.cell_mm, layout.columns)
        else {
            continue;
        };
        for column in first..=last {
            let [x, _] = layout.column_center(column, row);
            if x0 <= x && x < x1 {
                // Linear interpolation within the triangle's plane, along the row.
                let z = z0 + (z1 - z0) * ((x - x0) / (x1 - x0));
                let index = (row - band.first_row) * band.columns + column;
                crossings.push((index as u32, (z - layout.base_mm) as f32, sense));
            }
        }
    }
}

/// Returns x and z of the point where an edge meets a row. The edge is given from its lower end in y to its
/// upper one, so that both of its triangles compute the same point.
fn intersect_row([x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3], y: f64) -> [f64; 2] {
    let share = (y - y0) / (y1 - y0);
    [x0 + (x1 - x0) * share, z0 + (z1 - z0) * share]
}

/// Fills the columns of a band with the intervals between their crossings.
fn fill_band(band: &mut DexelBand, mut crossings: Vec<SurfaceCrossing>) {
    crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)).then(b.2.cmp(&a.2)));
    let mut intervals: Vec<DexelSpan> = Vec::new();
    for column in crossings.chunk_by(|a, b| a.0 == b.0) {
        intervals.clear();
        // Going down, the winding number counts the surfaces above; there is material where it is not zero.
        let mut winding = 0;
        for pair in column.windows(2) {
            let [(_, top, sense), (_, low, _)] = pair else { continue };
            winding += sense;
            if winding != 0 {
                intervals.push([*low, *top]);
            }
        }
        dexel_spans::join_spans(&mut intervals);
        if let Some((index, ..)) = column.first() {
            band.set_column(*index as usize, &intervals);
        }
    }
}
