//! A mesh as columns.
//!
//! Every row of column centres cuts a triangle in a segment between two of its edges. Where an edge meets the row is computed
//! from the edge alone, so both of its triangles get the same point to the last bit, and segments take their lower end and
//! leave their upper one: the segments of a closed surface follow each other without gap or overlap, and a column through an
//! edge or a vertex counts each crossing once. This is the same as moving all columns by an infinitesimal step.

use super::Mesh;
use crate::sim::dexel::BAND_ROWS;
use crate::sim::{DexelBand, DexelGrid, DexelSpan, Dexels, dexel_spans};
use rayon::prelude::*;

/// Where a column goes through the surface: its index in the band, the height above the base, +1 where the surface faces up.
type SurfaceCrossing = (u32, f32, i32);

impl Mesh {
    /// The solid as columns: each as the line through its centre meets the mesh, so exact in z (to the resolution of `f32`) and
    /// sampled in x and y. What stands beside the grid is left out. Takes time for the triangles, and for each the columns below.
    pub fn to_dexels(&self, layout: DexelGrid) -> Dexels {
        let mut dexels = Dexels::with_empty_columns(layout);
        if layout.columns == 0 {
            return dexels;
        }
        let mut per_band: Vec<Vec<u32>> = vec![Vec::new(); dexels.bands().len()];
        for (index, triangle) in self.triangle_vertices().enumerate() {
            let ys = triangle.map(|[_, y, _]| y);
            let Some((first, last)) = index_range(ys, layout.origin[1], layout.cell, layout.rows) else {
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
        dexels
    }
}

/// Indices that centres within some values can have, a step more on both sides: the exact test follows.
fn index_range(values: [f64; 3], origin: f64, cell: f64, count: usize) -> Option<(usize, usize)> {
    let low = values.into_iter().fold(f64::INFINITY, f64::min);
    let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let first = ((low - origin) / cell).floor() - 1.0;
    let last = ((high - origin) / cell).ceil() + 1.0;
    let end = count.checked_sub(1)?;
    (last >= 0.0 && first <= end as f64).then(|| (first.max(0.0) as usize, (last as usize).min(end)))
}

fn collect_crossings(
    corners: [[f64; 3]; 3],
    layout: &DexelGrid,
    band: &DexelBand,
    crossings: &mut Vec<SurfaceCrossing>,
) {
    let [a, b, c] = corners;
    let Some((first, last)) =
        index_range(corners.map(|[_, y, _]| y), layout.origin[1], layout.cell, layout.rows)
    else {
        return;
    };
    for row in first.max(band.first_row)..=last.min(band.first_row + band.row_count() - 1) {
        let [_, y] = layout.column_center(0, row);
        let (mut up, mut down) = (None, None);
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
        let Some((first, last)) = index_range([x0, x1, x1], layout.origin[0], layout.cell, layout.columns)
        else {
            continue;
        };
        for column in first..=last {
            let [x, _] = layout.column_center(column, row);
            if x0 <= x && x < x1 {
                let z = z0 + (z1 - z0) * ((x - x0) / (x1 - x0));
                let index = (row - band.first_row) * band.columns + column;
                crossings.push((index as u32, (z - layout.base) as f32, sense));
            }
        }
    }
}

/// Where an edge, given from its lower end in y to its upper one, meets a row: x and z.
fn intersect_row([x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3], y: f64) -> [f64; 2] {
    let share = (y - y0) / (y1 - y0);
    [x0 + (x1 - x0) * share, z0 + (z1 - z0) * share]
}

fn fill_band(band: &mut DexelBand, mut crossings: Vec<SurfaceCrossing>) {
    crossings.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)).then(b.2.cmp(&a.2)));
    let mut intervals: Vec<DexelSpan> = Vec::new();
    for column in crossings.chunk_by(|a, b| a.0 == b.0) {
        intervals.clear();
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
