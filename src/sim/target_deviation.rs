//! What is left against what shall be left.
//!
//! Measured along the columns: on a slope the vertical measure is larger than the distance between the surfaces, and a steep wall
//! that is a little off appears as few columns of its full height.

use super::{DexelSpan, Dexels, dexel_spans, dilate};
use rayon::prelude::*;

/// Rounding of heights, mm.
const ROUNDING: f32 = 1e-4;

/// How remaining stock and a target part differ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TargetDeviation {
    /// Material of the target that is gone, mm3.
    pub gouge_mm3: f64,
    /// The thickest piece of it along a column: mm, and its lower end (x, y, z).
    pub deepest_gouge: Option<(f64, [f64; 3])>,
    /// Columns with such a piece.
    pub columns_gouged: usize,
    /// Material that is left and not in the target, mm3.
    pub excess_mm3: f64,
    /// The thickest piece of it along a column: mm, and its upper end (x, y, z).
    pub highest_excess: Option<(f64, [f64; 3])>,
    /// Columns with such a piece.
    pub columns_in_excess: usize,
}

/// Why two solids cannot be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum GridMismatch {
    /// Their columns do not stand in the same places.
    #[error("the columns of stock and target do not stand in the same places")]
    Layout,
}

impl TargetDeviation {
    /// Compares what is left with a target on the same grid. Pieces up to `tolerance` mm thick along a column do not count.
    ///
    /// # Errors
    /// When the grids differ.
    pub fn measure_by_thickness(
        remains: &Dexels,
        target: &Dexels,
        tolerance: f64,
    ) -> Result<Self, GridMismatch> {
        let thick = |_, _, [low, top]: DexelSpan, _| f64::from(top) - f64::from(low) > tolerance;
        Self::sum_pieces(remains, target, thick)
    }

    /// Adds up the pieces that count; `counts` is told the band, the index of the column in it, the piece, and whether it is of what
    /// is left.
    fn sum_pieces(
        remains: &Dexels,
        target: &Dexels,
        counts: impl Fn(usize, usize, DexelSpan, bool) -> bool + Sync,
    ) -> Result<Self, GridMismatch> {
        let layout = remains.grid();
        if layout != target.grid() {
            return Err(GridMismatch::Layout);
        }
        let area = layout.cell * layout.cell;
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
                    let end = layout.base + f64::from(if is_left { top } else { low });
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
        // Collected first: the sum must not depend on the number of threads.
        let of_band: Vec<Self> = of_band.collect();
        Ok(of_band.into_iter().fold(Self::default(), Self::combine_with))
    }

    /// As [`TargetDeviation::measure_by_thickness`], but a piece counts when some of it is further than `tolerance` mm from the other solid in every
    /// direction: a wall that is a little off is no difference of its whole height. Directions across z count in whole cells, so
    /// that a tolerance below a cell holds along z only.
    ///
    /// # Errors
    /// When the grids differ.
    pub fn measure_by_distance(
        remains: &Dexels,
        target: &Dexels,
        tolerance: f64,
    ) -> Result<Self, GridMismatch> {
        let [near_remains, near_target] =
            [remains, target].map(|solid| dilate::dilate_by_ball(solid, tolerance));
        Self::sum_pieces(remains, target, |band, index, [low, top], is_left| {
            let near = if is_left { &near_target } else { &near_remains };
            let covers = |[from, to]: DexelSpan| from <= low + ROUNDING && top <= to + ROUNDING;
            !near.bands().get(band).is_some_and(|band| band.column_spans(index).any(covers))
        })
    }

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

/// A thickness and where.
type ThickestPiece = Option<(f64, [f64; 3])>;

/// The thicker piece; of equal ones the first.
fn thicker_piece(a: ThickestPiece, b: ThickestPiece) -> ThickestPiece {
    match (a, b) {
        (Some((first, _)), Some((second, _))) if second > first => b,
        (None, _) => b,
        _ => a,
    }
}
