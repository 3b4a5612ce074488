//! This module grows columns by a ball. It applies an allowance to a body that has no closed form.

use crate::stock::dexel::BAND_ROWS;
use crate::stock::{DexelSpan, Dexels, NoMemory, dexel_spans};
use rayon::prelude::*;

/// Grows every interval: over a column at lateral distance d, both ends move outwards by `sqrt(radius^2 -
/// d^2)` mm. The grid stays the same, so material that grows past its boundary is lost. The result is exact
/// for lines of material through the centres: a wall moves by whole cells, and its rounded edge begins at the
/// last centre, up to half a cell inside the wall.
///
/// # Errors
/// Returns an error if there is no memory for the grown columns.
pub(super) fn dilate_by_ball(dexels: &Dexels, radius: f64) -> Result<Dexels, NoMemory> {
    let layout = *dexels.grid();
    // The offsets are sorted from the middle outwards, since the column itself covers most of what its
    // neighbours add.
    let reach = (radius / layout.cell_mm).ceil().min(layout.columns.max(layout.rows) as f64) as i64;
    let mut steps: Vec<(i64, i64, i64, f32)> = Vec::new();
    for up in -reach..=reach {
        for right in -reach..=reach {
            let squared = right * right + up * up;
            // On the sphere at the lateral distance d, the height is sqrt(radius^2 - d^2).
            let rest = radius * radius - squared as f64 * layout.cell_mm * layout.cell_mm;
            // A radius of a whole number of cells reaches its last column, even if its square is rounded
            // down.
            if rest >= -1e-9 * radius * radius {
                steps.push((squared, up, right, rest.max(0.0).sqrt() as f32));
            }
        }
    }
    steps.sort_unstable_by_key(|(squared, up, right, _)| (*squared, *up, *right));
    let mut grown = Dexels::try_with_empty_columns(layout)?;
    grown.bands_mut().par_iter_mut().for_each(|band| {
        let mut intervals: Vec<DexelSpan> = Vec::new();
        for index in 0..band.row_count() * band.columns {
            intervals.clear();
            let (column, row) = (index % band.columns, band.first_row + index / band.columns);
            for (_, up, right, growth) in &steps {
                let place =
                    column.checked_add_signed(*right as isize).zip(row.checked_add_signed(*up as isize));
                let Some((column, row)) = place.filter(|(column, _)| *column < layout.columns) else {
                    continue;
                };
                let Some(from) = dexels.bands().get(row / BAND_ROWS) else { continue };
                for [low, top] in from.column_spans((row - from.first_row) * layout.columns + column) {
                    let grown = [low - growth, top + growth];
                    // Most intervals lie within one that is already there, which costs less to see than to merge.
                    if !intervals.iter().any(|[low, top]| *low <= grown[0] && grown[1] <= *top) {
                        dexel_spans::merge_span(&mut intervals, grown);
                    }
                }
            }
            dexel_spans::join_spans(&mut intervals);
            if !intervals.is_empty() {
                band.set_column(index, &intervals);
            }
        }
    });
    Ok(grown)
}
