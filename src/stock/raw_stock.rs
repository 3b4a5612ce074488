//! This module holds the stock: the material that is on the machine before the program begins.

use crate::stock::axis_box::{AxisBox, FARTHEST, union_boxes};
use crate::stock::{DexelGrid, DexelSpan, Dexels, NoMemory, SolidBody, StockError, dexel_spans, dilate};
use rayon::prelude::*;
use std::sync::Arc;

/// The union of some bodies, all grown by the same allowance.
///
/// ```
/// use clsmith::stock::{SolidBody, Stock};
///
/// let block = SolidBody::Block { from: [0.0, 0.0, -20.0], to: [100.0, 50.0, 0.0] };
/// let boss = SolidBody::Cylinder { diameter: 20.0, from: [50.0, 25.0, 0.0], to: [50.0, 25.0, 10.0] };
/// let stock = Stock::new(vec![block, boss], 0.0)?;
/// let columns = stock.to_dexels(1.0, 100_000)?;
/// assert!(columns.contains([50.0, 25.0, 5.0]) && !columns.contains([10.0, 25.0, 5.0]));
/// assert_eq!(columns.highest_z_mm(), Some(10.0));
/// # Ok::<(), clsmith::stock::StockError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Stock {
    bodies: Vec<SolidBody>,
    allowance: f64,
    bounds: AxisBox,
}

impl Stock {
    /// Makes stock of some bodies, each grown by `allowance_mm`. A block grows at its sides and a cylinder in
    /// radius and at both ends (both keep their sharp edges); a mesh and remains grow by a ball.
    ///
    /// # Errors
    /// Returns an error if there is no body or no material, or if numbers are not finite, out of order or
    /// without volume.
    pub fn new(bodies: Vec<SolidBody>, allowance_mm: f64) -> Result<Self, StockError> {
        if allowance_mm.is_nan() || allowance_mm > FARTHEST {
            return Err(StockError::NotFinite);
        }
        if allowance_mm < 0.0 {
            return Err(StockError::Allowance);
        }
        if bodies.is_empty() {
            return Err(StockError::NoBody);
        }
        bodies.iter().try_for_each(SolidBody::check_volume)?;
        let bounds = bodies.iter().filter_map(|body| body.grown_bounds(allowance_mm));
        let bounds = bounds.reduce(union_boxes).ok_or(StockError::Empty)?;
        Ok(Self { bodies, allowance: allowance_mm, bounds })
    }

    /// Returns the bodies.
    pub fn bodies(&self) -> &[SolidBody] {
        &self.bodies
    }

    /// Returns the allowance by which all bodies are grown, mm.
    pub fn allowance_mm(&self) -> f64 {
        self.allowance
    }

    /// Returns the lower and upper corner of the box around the stock, mm. For remains this is the box of
    /// their grid in x and y.
    pub fn bounds(&self) -> AxisBox {
        self.bounds
    }

    /// Returns the number of columns for a cell in mm, or [`usize::MAX`] if there are more than can be
    /// counted or the cell is not a positive length.
    pub fn count_columns(&self, cell_mm: f64) -> usize {
        if !(cell_mm > 0.0 && cell_mm.is_finite()) {
            return usize::MAX;
        }
        let layout = self.grid_for_cell(cell_mm);
        layout.columns.saturating_mul(layout.rows)
    }

    /// Converts the stock to columns that are `cell_mm` apart, at most `most` of them.
    ///
    /// The first cell begins at the lower corner of the box, so a block whose sides are multiples of the cell
    /// is exact. Other bodies are sampled at the centres of cells in x and y and exact in z (to the
    /// resolution of `f32`). If the stock is one set of remains with the same cell, the remains' own grid is
    /// kept; otherwise each column takes the nearest column of the remains.
    ///
    /// # Errors
    /// Returns an error if the cell is not a positive length or makes no columns or too many, and
    /// [`StockError::NoMemory`] if there is no memory for them.
    pub fn to_dexels(&self, cell_mm: f64, most: usize) -> Result<Dexels, StockError> {
        if !(cell_mm > 0.0 && cell_mm.is_finite()) {
            return Err(StockError::Cell);
        }
        let columns = self.count_columns(cell_mm);
        if columns > most {
            return Err(StockError::TooMany { cell: cell_mm, columns, most });
        }
        if columns == 0 {
            return Err(StockError::Empty);
        }
        let layout = self.grid_for_cell(cell_mm);
        let sampled = self.bodies.iter().filter_map(|body| self.sample_body(body, layout).transpose());
        let given: Vec<Dexels> = sampled.collect::<Result<_, NoMemory>>()?;
        // A single sampled body is the result; otherwise the union is made column by column.
        let given = match <[Dexels; 1]>::try_from(given) {
            Ok([only]) if self.bodies.len() == 1 => return Ok(only),
            Ok([only]) => vec![only],
            Err(given) => given,
        };
        let mut dexels = Dexels::try_with_empty_columns(layout)?;
        dexels.bands_mut().par_iter_mut().enumerate().for_each(|(number, band)| {
            let mut intervals: Vec<DexelSpan> = Vec::new();
            for index in 0..band.row_count() * band.columns {
                intervals.clear();
                let center =
                    layout.column_center(index % band.columns, band.first_row + index / band.columns);
                let closed =
                    // Blocks and cylinders have a closed form over each column.
                    self.bodies.iter().filter_map(|body| body.vertical_extent_at(center, self.allowance));
                intervals.extend(closed.map(|ends| ends.map(|z| (z - layout.base_mm) as f32)));
                for band in given.iter().filter_map(|dexels| dexels.bands().get(number)) {
                    intervals.extend(band.column_spans(index));
                }
                dexel_spans::join_spans(&mut intervals);
                if !intervals.is_empty() {
                    band.set_column(index, &intervals);
                }
            }
        });
        Ok(dexels)
    }

    /// Samples a body that has no closed form on a grid and grows it; returns `None` for blocks and
    /// cylinders.
    fn sample_body(&self, body: &SolidBody, layout: DexelGrid) -> Result<Option<Dexels>, NoMemory> {
        let sampled = match body {
            SolidBody::Block { .. } | SolidBody::Cylinder { .. } => return Ok(None),
            SolidBody::Mesh(mesh) => mesh.to_dexels(layout)?,
            SolidBody::Remains(remains) if *remains.grid() == layout => remains.try_clone()?,
            SolidBody::Remains(remains) => resample_nearest(remains, layout)?,
        };
        let grows = self.allowance > 0.0;
        Ok(Some(if grows { dilate::dilate_by_ball(&sampled, self.allowance)? } else { sampled }))
    }

    /// Returns the grid for a cell: the remains' own grid, widened by the allowance, if it has this cell;
    /// else a grid over the box.
    fn grid_for_cell(&self, cell: f64) -> DexelGrid {
        match self.only_remains() {
            Some(remains) if (remains.grid().cell_mm - cell).abs() <= cell * 1e-9 => {
                let kept = *remains.grid();
                let more = (self.allowance / cell - 1e-9).ceil().max(0.0);
                let count = |columns: usize| columns.saturating_add((2.0 * more) as usize);
                DexelGrid {
                    origin_mm: kept.origin_mm.map(|at| at - more * kept.cell_mm),
                    base_mm: kept.base_mm - self.allowance,
                    cell_mm: kept.cell_mm,
                    columns: count(kept.columns),
                    rows: count(kept.rows),
                }
            }
            _ => DexelGrid::covering_box(self.bounds.0, self.bounds.1, cell),
        }
    }

    /// Returns the remains if they are the only body.
    fn only_remains(&self) -> Option<&Arc<Dexels>> {
        match self.bodies.as_slice() {
            [SolidBody::Remains(remains)] => Some(remains),
            _ => None,
        }
    }
}

/// Resamples columns on another grid. Each new column takes the old column whose centre is nearest; of two
/// equally near ones it takes the one with the larger index.
fn resample_nearest(from: &Dexels, layout: DexelGrid) -> Result<Dexels, NoMemory> {
    let mut dexels = Dexels::try_with_empty_columns(layout)?;
    let old = *from.grid();
    let rise = (old.base_mm - layout.base_mm) as f32;
    let index = |at: f64, origin: f64, count: usize| {
        let index = ((at - origin) / old.cell_mm + 0.5).floor();
        (index >= 0.0 && index < count as f64).then_some(index as usize)
    };
    dexels.bands_mut().par_iter_mut().for_each(|band| {
        for at in 0..band.row_count() * band.columns {
            let [x, y] = layout.column_center(at % band.columns, band.first_row + at / band.columns);
            let [x0, y0] = old.origin_mm;
            let place = index(x, x0, old.columns).zip(index(y, y0, old.rows));
            let Some((column, row)) = place else { continue };
            let moved = |interval: DexelSpan| interval.map(|height| height + rise);
            let mut intervals: Vec<DexelSpan> =
                from.column_spans(column, row).into_iter().map(moved).collect();
            dexel_spans::join_spans(&mut intervals);
            band.set_column(at, &intervals);
        }
    });
    Ok(dexels)
}
