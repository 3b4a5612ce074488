//! Stock: what lies on the machine before the program begins.

use super::body::{AxisBox, FARTHEST};
use super::{DexelGrid, DexelSpan, Dexels, SolidBody, dexel_spans, dilate};
use rayon::prelude::*;
use std::sync::Arc;

/// The union of some bodies, all grown by an allowance.
#[derive(Debug, Clone, PartialEq)]
pub struct Stock {
    bodies: Vec<SolidBody>,
    allowance: f64,
    bounds: AxisBox,
}

/// Why there is no stock to simulate.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum StockError {
    /// No body.
    #[error("the stock has no body")]
    NoBody,
    /// Remains from which everything was cut, or bodies far thinner than a cell.
    #[error("there is no material in the stock")]
    Empty,
    /// A number that is not finite, or larger than any workpiece.
    #[error("a number is not finite, or larger than {FARTHEST:e} mm")]
    NotFinite,
    /// A block whose corners are not in order.
    #[error("the block's lower corner must be below its upper one in x, y and z")]
    Block,
    /// A cylinder without volume.
    #[error("the cylinder needs a positive diameter and two different ends")]
    Cylinder,
    /// A negative allowance.
    #[error("the allowance must not be negative")]
    Allowance,
    /// A cell that is no length.
    #[error("the cell must be a positive length")]
    Cell,
    /// A finer grid than there is memory for.
    #[error("a cell of {cell} mm makes {columns} columns, more than the {most} that are allowed")]
    TooMany {
        /// The cell asked for, mm.
        cell: f64,
        /// Columns that it makes.
        columns: usize,
        /// Columns allowed.
        most: usize,
    },
}

impl Stock {
    /// Stock of some bodies, each grown by `allowance` mm: a block by its sides, a cylinder by its radius and ends (both keep
    /// their edges), a mesh and remains by a ball.
    ///
    /// # Errors
    /// Without a body or material, and for numbers that are not finite, out of order or without volume.
    pub fn new(bodies: Vec<SolidBody>, allowance: f64) -> Result<Self, StockError> {
        if allowance.is_nan() || allowance > FARTHEST {
            return Err(StockError::NotFinite);
        }
        if allowance < 0.0 {
            return Err(StockError::Allowance);
        }
        if bodies.is_empty() {
            return Err(StockError::NoBody);
        }
        bodies.iter().try_for_each(SolidBody::check_volume)?;
        let bounds = bodies.iter().filter_map(|body| body.grown_bounds(allowance));
        let bounds = bounds.reduce(union_boxes).ok_or(StockError::Empty)?;
        Ok(Self { bodies, allowance, bounds })
    }

    /// The bodies.
    pub fn bodies(&self) -> &[SolidBody] {
        &self.bodies
    }

    /// By how much all bodies are grown, mm.
    pub fn allowance_mm(&self) -> f64 {
        self.allowance
    }

    /// Lower and upper corner of the box around all of it, mm; of remains, the box of their grid in x and y.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
        self.bounds
    }

    /// How many columns a cell (mm) makes; [`usize::MAX`] for more than can be counted or a cell that is no length.
    pub fn count_columns(&self, cell: f64) -> usize {
        if !(cell > 0.0 && cell.is_finite()) {
            return usize::MAX;
        }
        let layout = self.grid_for_cell(cell);
        layout.columns.saturating_mul(layout.rows)
    }

    /// The stock as columns `cell` mm apart, at most `most` of them.
    ///
    /// Cell borders lie on the lower corner of the box, so a block whose sides are multiples of the cell is exact. Else bodies are
    /// sampled at the centres of cells in x and y and exact in z (to the resolution of `f32`). Remains alone keep their grid when
    /// it has the same cell; otherwise each column takes the nearest of theirs.
    ///
    /// # Errors
    /// When the cell is no length or makes too many columns, or none.
    pub fn to_dexels(&self, cell: f64, most: usize) -> Result<Dexels, StockError> {
        if !(cell > 0.0 && cell.is_finite()) {
            return Err(StockError::Cell);
        }
        let columns = self.count_columns(cell);
        if columns > most {
            return Err(StockError::TooMany { cell, columns, most });
        }
        if columns == 0 {
            return Err(StockError::Empty);
        }
        let layout = self.grid_for_cell(cell);
        let given: Vec<Dexels> =
            self.bodies.iter().filter_map(|body| self.sample_body(body, layout)).collect();
        let given = match <[Dexels; 1]>::try_from(given) {
            Ok([only]) if self.bodies.len() == 1 => return Ok(only),
            Ok([only]) => vec![only],
            Err(given) => given,
        };
        let mut dexels = Dexels::with_empty_columns(layout);
        dexels.bands_mut().par_iter_mut().enumerate().for_each(|(number, band)| {
            let mut intervals: Vec<DexelSpan> = Vec::new();
            for index in 0..band.row_count() * band.columns {
                intervals.clear();
                let center =
                    layout.column_center(index % band.columns, band.first_row + index / band.columns);
                let closed =
                    self.bodies.iter().filter_map(|body| body.vertical_extent_at(center, self.allowance));
                intervals.extend(closed.map(|ends| ends.map(|z| (z - layout.base) as f32)));
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

    /// A body without closed form on a grid, grown.
    fn sample_body(&self, body: &SolidBody, layout: DexelGrid) -> Option<Dexels> {
        let sampled = match body {
            SolidBody::Block { .. } | SolidBody::Cylinder { .. } => return None,
            SolidBody::Mesh(mesh) => mesh.to_dexels(layout),
            SolidBody::Remains(remains) if *remains.grid() == layout => Dexels::clone(remains),
            SolidBody::Remains(remains) => resample_nearest(remains, layout),
        };
        Some(if self.allowance > 0.0 { dilate::dilate_by_ball(&sampled, self.allowance) } else { sampled })
    }

    fn grid_for_cell(&self, cell: f64) -> DexelGrid {
        match self.only_remains() {
            Some(remains) if (remains.grid().cell - cell).abs() <= cell * 1e-9 => {
                let kept = *remains.grid();
                let more = (self.allowance / cell - 1e-9).ceil().max(0.0);
                let count = |columns: usize| columns.saturating_add((2.0 * more) as usize);
                DexelGrid {
                    origin: kept.origin.map(|at| at - more * kept.cell),
                    base: kept.base - self.allowance,
                    cell: kept.cell,
                    columns: count(kept.columns),
                    rows: count(kept.rows),
                }
            }
            _ => DexelGrid::covering_box(self.bounds.0, self.bounds.1, cell),
        }
    }

    fn only_remains(&self) -> Option<&Arc<Dexels>> {
        match self.bodies.as_slice() {
            [SolidBody::Remains(remains)] => Some(remains),
            _ => None,
        }
    }
}

fn union_boxes(([a, b, c], [d, e, f]): AxisBox, ([g, h, i], [j, k, l]): AxisBox) -> AxisBox {
    ([a.min(g), b.min(h), c.min(i)], [d.max(j), e.max(k), f.max(l)])
}

/// Columns of another grid: each the one whose centre is nearest, of two as near the one with the larger index.
fn resample_nearest(from: &Dexels, layout: DexelGrid) -> Dexels {
    let mut dexels = Dexels::with_empty_columns(layout);
    let old = *from.grid();
    let rise = (old.base - layout.base) as f32;
    let index = |at: f64, origin: f64, count: usize| {
        let index = ((at - origin) / old.cell + 0.5).floor();
        (index >= 0.0 && index < count as f64).then_some(index as usize)
    };
    dexels.bands_mut().par_iter_mut().for_each(|band| {
        for at in 0..band.row_count() * band.columns {
            let [x, y] = layout.column_center(at % band.columns, band.first_row + at / band.columns);
            let [x0, y0] = old.origin;
            let place = index(x, x0, old.columns).zip(index(y, y0, old.rows));
            let Some((column, row)) = place else { continue };
            let moved = |interval: DexelSpan| interval.map(|height| height + rise);
            let mut intervals: Vec<DexelSpan> =
                from.column_spans(column, row).into_iter().map(moved).collect();
            dexel_spans::join_spans(&mut intervals);
            band.set_column(at, &intervals);
        }
    });
    dexels
}
