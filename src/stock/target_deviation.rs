//! This module compares the remaining stock with the target part.
//!
//! Differences are measured along the columns. On a slope this vertical measure is larger than the distance
//! between the surfaces, and a steep wall that is slightly off shows as a few columns over its full height.

use crate::stock::{DexelSpan, Dexels, NoMemory, dexel_spans, dilate};
use rayon::prelude::*;

/// The rounding of heights, mm.
const ROUNDING: f32 = 1e-4;

/// The difference between remaining stock and a target part.
///
/// ```
/// use clsmith::stock::{SolidBody, Stock, TargetDeviation};
///
/// let block = |top: f64| SolidBody::Block { from: [0.0, 0.0, 0.0], to: [10.0, 10.0, top] };
/// let target = Stock::new(vec![block(5.0)], 0.0)?.to_dexels(1.0, 1000)?;
/// let mut left = target.clone();
/// left.set_column(3, 3, &[[0.0, 4.0]]);
/// let found = TargetDeviation::measure_by_thickness(&left, &target, 0.01)?;
/// assert_eq!((found.columns_gouged, found.columns_in_excess), (1, 0));
/// assert!((found.gouge_mm3 - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct TargetDeviation {
    /// The volume of the target's material that is missing, mm3.
    pub gouge_mm3: f64,
    /// The thickest missing piece along a column: its thickness in mm, and its lower end (x, y, z).
    pub deepest_gouge: Option<(f64, [f64; 3])>,
    /// The number of columns with a missing piece.
    pub columns_gouged: usize,
    /// The volume of the remaining material that does not belong to the target, mm3.
    pub excess_mm3: f64,
    /// The thickest piece of it along a column: its thickness in mm, and its upper end (x, y, z).
    pub highest_excess: Option<(f64, [f64; 3])>,
    /// The number of columns with such a piece.
    pub columns_in_excess: usize,
}

/// The reason why two solids cannot be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum GridMismatch {
    /// Their columns do not stand in the same places.
    #[error("the columns of stock and target do not stand in the same places")]
    Layout,
    /// There is no memory for columns that are grown by the tolerance.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
}

impl TargetDeviation {
    /// Compares remaining stock with a target on the same grid. Pieces that are at most `tolerance_mm` thick
    /// along a column do not count.
    ///
    /// # Errors
    /// Returns an error if the grids differ.
    pub fn measure_by_thickness(
        remains: &Dexels,
        target: &Dexels,
        tolerance_mm: f64,
    ) -> Result<Self, GridMismatch> {
        let thick = |_, _, [low, top]: DexelSpan, _| f64::from(top) - f64::from(low) > tolerance_mm;
        Self::sum_pieces(remains, target, thick)
    }

    /// Adds up the pieces that count. `counts` gets the band, the column's index in it, the piece, and
    /// whether the piece belongs to the remaining stock; it returns whether the piece counts.
    fn sum_pieces(
        remains: &Dexels,
        target: &Dexels,
        counts: impl Fn(usize, usize, DexelSpan, bool) -> bool + Sync,
    ) -> Result<Self, GridMismatch> {
        let layout = remains.grid();
        if layout != target.grid() {
            return Err(GridMismatch::Layout);
        }
        let area = layout.cell_mm * layout.cell_mm;
        let bands = remains.bands().par_iter().zip(target.bands()).enumerate();
        let of_band = bands.map(|(number, (left, wanted))| {
            let mut all = Self::default();
            let (mut a, mut b): (Vec<DexelSpan>, Vec<DexelSpan>) = Default::default();
            for index in 0..left.row_count() * left.columns {
                a.clear();
                a.extend(left.column_spans(index));
                b.clear();
                b.extend(wanted.column_spans(index));
                let [x, y] =
                    layout.column_center(index % left.columns, left.first_row + index / left.columns);
                let (mut gouged, mut in_excess) = (false, false);
                dexel_spans::find_span_differences(&a, &b, |[low, top], is_left| {
                    if !counts(number, index, [low, top], is_left) {
                        return;
                    }
                    let thickness = f64::from(top) - f64::from(low);
                    // Excess is reported at its upper end, a gouge at its lower end: both are on the machined
                    // surface.
                    let end = layout.base_mm + f64::from(if is_left { top } else { low });
                    let piece = Some((thickness, [x, y, end]));
                    if is_left {
                        in_excess = true;
                        all.excess_mm3 += thickness * area;
                        all.highest_excess = thicker_piece(all.highest_excess, piece);
                    } else {
                        gouged = true;
                        all.gouge_mm3 += thickness * area;
                        all.deepest_gouge = thicker_piece(all.deepest_gouge, piece);
                    }
                });
                all.columns_gouged += usize::from(gouged);
                all.columns_in_excess += usize::from(in_excess);
            }
            all
        });
        // The bands are collected before they are added, so that the sum does not depend on the number of
        // threads.
        let of_band: Vec<Self> = of_band.collect();
        Ok(of_band.into_iter().fold(Self::default(), Self::combine_with))
    }

    /// Compares as [`TargetDeviation::measure_by_thickness`] does, but a piece only counts if some of it is
    /// further than `tolerance_mm` from the other solid in every direction. So a wall that is slightly off
    /// does not count over its whole height. Lateral distances count in whole cells, so a tolerance below a
    /// cell only has an effect along z.
    ///
    /// # Errors
    /// Returns an error if the grids differ.
    pub fn measure_by_distance(
        remains: &Dexels,
        target: &Dexels,
        tolerance_mm: f64,
    ) -> Result<Self, GridMismatch> {
        let near_remains = dilate::dilate_by_ball(remains, tolerance_mm)?;
        let near_target = dilate::dilate_by_ball(target, tolerance_mm)?;
        // A piece within the other solid grown by the tolerance is nowhere further away than that.
        Self::sum_pieces(remains, target, |band, index, [low, top], is_left| {
            let near = if is_left { &near_target } else { &near_remains };
            let covers = |[from, to]: DexelSpan| from <= low + ROUNDING && top <= to + ROUNDING;
            !near.bands().get(band).is_some_and(|band| band.column_spans(index).any(covers))
        })
    }

    /// Adds the differences of two bands.
    fn combine_with(self, other: Self) -> Self {
        Self {
            gouge_mm3: self.gouge_mm3 + other.gouge_mm3,
            deepest_gouge: thicker_piece(self.deepest_gouge, other.deepest_gouge),
            columns_gouged: self.columns_gouged + other.columns_gouged,
            excess_mm3: self.excess_mm3 + other.excess_mm3,
            highest_excess: thicker_piece(self.highest_excess, other.highest_excess),
            columns_in_excess: self.columns_in_excess + other.columns_in_excess,
        }
    }
}

/// A piece's thickness in mm and its end point.
type ThickestPiece = Option<(f64, [f64; 3])>;

/// Returns the thicker piece, or the first if both are equally thick.
fn thicker_piece(a: ThickestPiece, b: ThickestPiece) -> ThickestPiece {
    match (a, b) {
        (Some((first, _)), Some((second, _))) if second > first => b,
        (None, _) => b,
        _ => a,
    }
}
