//! This module computes the chip thickness of each tooth from the advance of the surface that it cuts.
//!
//! Between the pass of one tooth and the next, the cutter's surface advances, and the material in between is
//! the chip. Teeth with uneven spacing or different radii divide it unevenly, and a tooth that runs far
//! inside may leave all of it to the next one. The source is W. A. Kline, R. E. DeVor, The effect of runout
//! on cutting geometry and forces in end milling, Int. J. Machine Tool Design and Research 23 (1983),
//! 123-140, eq. 5, extended by the radial part of the normal for corner radii and balls.

use std::f64::consts::TAU;

use crate::cutter::Teeth;
use crate::cutter::teeth::ToothRegularity;

impl Teeth {
    /// Returns the largest chip thickness over all edges, mm.
    ///
    /// `advance_mm` is the distance by which the surface advances along its normal in one turn, mm (`v.n / n`);
    /// a surface that retreats cuts no chip. `radial` is the part of the normal across the axis, from 0 to 1,
    /// by which radial offsets count. The thickness of the material is not known here and limits the chip in
    /// addition. Even teeth without runout cut exactly `advance_mm / count`.
    ///
    /// ```
    /// use clsmith::cutter::Teeth;
    ///
    /// let even = Teeth::evenly_spaced(4, 0.0).expect("four teeth");
    /// assert_eq!(even.max_chip_thickness_mm(0.4, 1.0), 0.1);
    /// // Two teeth, one 0.02 mm further out: it takes that much more, and the other that much less.
    /// let runout = Teeth::unevenly_spaced(vec![1.0, 1.0], vec![0.01, -0.01], 0.0).expect("two teeth");
    /// assert!((runout.edge_chip_thickness_mm(0, 0.1, 1.0) - 0.07).abs() < 1e-12);
    /// assert!((runout.edge_chip_thickness_mm(1, 0.1, 1.0) - 0.03).abs() < 1e-12);
    /// ```
    pub fn max_chip_thickness_mm(&self, advance_mm: f64, radial: f64) -> f64 {
        match self.regularity() {
            ToothRegularity::Even => advance_mm.max(0.0) / self.count() as f64,
            ToothRegularity::Pitch => advance_mm.max(0.0) * self.widest_pitch_fraction(),
            ToothRegularity::Runout(_) => (0..self.count())
                .map(|edge| self.edge_chip_thickness_mm(edge, advance_mm, radial))
                .fold(0.0, f64::max),
        }
    }

    /// Returns the chip thickness of one edge, mm, or 0 for an edge that does not exist. The arguments are
    /// those of [`Teeth::max_chip_thickness_mm`].
    ///
    /// The equation is `h_i = max(0, min over m of advance (p_i + .. m angles) / 2 pi + (rho_i - rho_(i-m))
    /// radial)`, with m from 1 to the number of teeth. With the last m the tooth meets its own cut of the
    /// turn before.
    pub fn edge_chip_thickness_mm(&self, edge: usize, advance_mm: f64, radial: f64) -> f64 {
        let Some(pitch) = self.pitch_angles_rad().get(edge) else { return 0.0 };
        let advance = advance_mm.max(0.0);
        let highest = match self.regularity() {
            ToothRegularity::Even => return advance / self.count() as f64,
            ToothRegularity::Pitch => return advance * pitch / TAU,
            ToothRegularity::Runout(highest) => highest,
        };
        // No tooth is further out than the highest one. Once even that one would leave a thicker chip, no
        // earlier pass gives a thinner one.
        let least = (self.runout_offsets_mm().get(edge).copied().unwrap_or(0.0) - highest) * radial;
        let mut thinnest = f64::INFINITY;
        for [turns, further] in self.passes_before(edge) {
            if advance * turns + least >= thinnest {
                break;
            }
            thinnest = thinnest.min(advance * turns + further * radial);
        }
        thinnest.max(0.0)
    }

    /// Returns two numbers a and b so that no chip of an edge is thicker than `a advance + b`, for any part of the
    /// normal that is radial: the tooth before it has passed, and what it left bounds the chip.
    pub(crate) fn chip_bound_parts(&self, edge: usize) -> [f64; 2] {
        let pitch = self.pitch_angles_rad().get(edge).copied().unwrap_or(TAU) / TAU;
        match self.regularity() {
            ToothRegularity::Even | ToothRegularity::Pitch => [pitch, 0.0],
            ToothRegularity::Runout(_) => {
                let [part, further] = self.passes_before(edge).first().copied().unwrap_or([1.0, 0.0]);
                [part, further.max(0.0)]
            }
        }
    }

    /// Returns the largest advance per turn (mm) at which no chip is thicker than `thickness_mm`. This is
    /// the inverse of [`Teeth::max_chip_thickness_mm`], in closed form.
    ///
    /// An edge's chip is the minimum of linear functions of the advance, so it stays within the target as
    /// long as one of them does. Runout alone never exceeds a target, since every tooth follows its own cut
    /// of the turn before. So the result is between `thickness_mm` and `thickness_mm` times the number of teeth. It
    /// is 0 for a target of 0 or less.
    ///
    /// ```
    /// use clsmith::cutter::Teeth;
    ///
    /// let teeth = Teeth::with_eccentricity(vec![1.0; 3], 0.01, 0.0, 0.0).expect("three teeth");
    /// let advance = teeth.max_advance_for_chip_mm(0.08, 1.0);
    /// assert!((teeth.max_chip_thickness_mm(advance, 1.0) - 0.08).abs() < 1e-12);
    /// ```
    pub fn max_advance_for_chip_mm(&self, thickness_mm: f64, radial: f64) -> f64 {
        let thickness = thickness_mm.max(0.0);
        match self.regularity() {
            ToothRegularity::Even => thickness * self.count() as f64,
            ToothRegularity::Pitch => thickness / self.widest_pitch_fraction(),
            ToothRegularity::Runout(_) => (0..self.count())
                .map(|edge| {
                    // Each function reaches the target at (thickness - offset) / turns: the best of an edge's
                    // functions, and the worst edge.
                    self.passes_before(edge)
                        .iter()
                        .map(|[turns, further]| (thickness - further * radial) / turns)
                        .fold(f64::NEG_INFINITY, f64::max)
                })
                .fold(f64::INFINITY, f64::min)
                .max(0.0),
        }
    }

    /// Returns the largest pitch angle as a fraction of a turn.
    fn widest_pitch_fraction(&self) -> f64 {
        self.pitch_angles_rad().iter().copied().fold(0.0, f64::max) / TAU
    }
}
