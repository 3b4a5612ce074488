//! What is left against what shall be left.
//!
//! Measured along the columns: on a slope the vertical measure is larger than the distance between the surfaces, and a steep wall
//! that is a little off appears as few columns of its full height.

use super::{Dexels, Interval, dilate, interval};
use rayon::prelude::*;

/// Rounding of heights, mm.
const ROUNDING: f32 = 1e-4;

/// How remaining stock and a target part differ.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Difference {
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
pub enum CompareError {
    /// Their columns do not stand in the same places.
    #[error("the columns of stock and target do not stand in the same places")]
    Layout,
}

impl Difference {
    /// Compares what is left with a target on the same grid. Pieces up to `tolerance` mm thick along a column do not count.
    ///
    /// # Errors
    /// When the grids differ.
    pub fn between(remains: &Dexels, target: &Dexels, tolerance: f64) -> Result<Self, CompareError> {
        let thick = |_, _, [low, top]: Interval, _| f64::from(top) - f64::from(low) > tolerance;
        Self::scan(remains, target, thick)
    }

    /// Adds up the pieces that count; `counts` is told the band, the index of the column in it, the piece, and whether it is of what
    /// is left.
    fn scan(
        remains: &Dexels,
        target: &Dexels,
        counts: impl Fn(usize, usize, Interval, bool) -> bool + Sync,
    ) -> Result<Self, CompareError> {
        let layout = remains.layout();
        if layout != target.layout() {
            return Err(CompareError::Layout);
        }
        let area = layout.cell * layout.cell;
        let bands = remains.bands().par_iter().zip(target.bands()).enumerate();
        let of_band = bands.map(|(number, (left, wanted))| {
            let mut all = Self::default();
            let (mut a, mut b): (Vec<Interval>, Vec<Interval>) = Default::default();
            for index in 0..left.rows() * left.columns {
                a.clear();
                a.extend(left.intervals(index));
                b.clear();
                b.extend(wanted.intervals(index));
                let [x, y] = layout.center(index % left.columns, left.first_row + index / left.columns);
                let (mut gouged, mut in_excess) = (false, false);
                interval::differ(&a, &b, |[low, top], is_left| {
                    if !counts(number, index, [low, top], is_left) {
                        return;
                    }
                    let thickness = f64::from(top) - f64::from(low);
                    let end = layout.base + f64::from(if is_left { top } else { low });
                    let piece = Some((thickness, [x, y, end]));
                    if is_left {
                        in_excess = true;
                        all.excess_mm3 += thickness * area;
                        all.highest_excess = thicker(all.highest_excess, piece);
                    } else {
                        gouged = true;
                        all.gouge_mm3 += thickness * area;
                        all.deepest_gouge = thicker(all.deepest_gouge, piece);
                    }
                });
                all.columns_gouged += usize::from(gouged);
                all.columns_in_excess += usize::from(in_excess);
            }
            all
        });
        // Collected first: the sum must not depend on the number of threads.
        let of_band: Vec<Self> = of_band.collect();
        Ok(of_band.into_iter().fold(Self::default(), Self::and))
    }

    /// As [`Difference::between`], but a piece counts when some of it is further than `tolerance` mm from the other solid in every
    /// direction: a wall that is a little off is no difference of its whole height. Directions across z count in whole cells, so
    /// that a tolerance below a cell holds along z only.
    ///
    /// # Errors
    /// When the grids differ.
    pub fn beyond(remains: &Dexels, target: &Dexels, tolerance: f64) -> Result<Self, CompareError> {
        let [near_remains, near_target] = [remains, target].map(|solid| dilate::by_ball(solid, tolerance));
        Self::scan(remains, target, |band, index, [low, top], is_left| {
            let near = if is_left { &near_target } else { &near_remains };
            let covers = |[from, to]: Interval| from <= low + ROUNDING && top <= to + ROUNDING;
            !near.bands().get(band).is_some_and(|band| band.intervals(index).any(covers))
        })
    }

    fn and(self, other: Self) -> Self {
        Self {
            gouge_mm3: self.gouge_mm3 + other.gouge_mm3,
            deepest_gouge: thicker(self.deepest_gouge, other.deepest_gouge),
            columns_gouged: self.columns_gouged + other.columns_gouged,
            excess_mm3: self.excess_mm3 + other.excess_mm3,
            highest_excess: thicker(self.highest_excess, other.highest_excess),
            columns_in_excess: self.columns_in_excess + other.columns_in_excess,
        }
    }
}

/// A thickness and where.
type Piece = Option<(f64, [f64; 3])>;

/// The thicker piece; of equal ones the first.
fn thicker(a: Piece, b: Piece) -> Piece {
    match (a, b) {
        (Some((first, _)), Some((second, _))) if second > first => b,
        (None, _) => b,
        _ => a,
    }
}
