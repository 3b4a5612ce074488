//! Chip thickness of each tooth from the advance of the surface that it cuts.
//!
//! In the time from one tooth's pass to the next the surface of the cutter advances; what lies between is the chip. Teeth that
//! are unevenly spaced or run at different radii share it unevenly, and one that runs far in may leave all of it to the next:
//! W. A. Kline, R. E. DeVor, The effect of runout on cutting geometry and forces in end milling, Int. J. Machine Tool Design and
//! Research 23 (1983), 123-140, eq. 5, here with the normal's radial part for corners and balls.

use std::f64::consts::TAU;

use super::Teeth;
use super::teeth::ToothRegularity;

impl Teeth {
    /// Largest chip thickness over the edges, mm.
    ///
    /// `advance` is how far the surface advances along its normal in one turn, mm (`v.n / n`); where it retreats there is no
    /// chip. `radial` is the normal's part across the axis, 0..=1, with which radial offsets count. The material's own
    /// thickness is not known here and bounds the chip besides. Even teeth that run true cut `advance / count` exactly.
    pub fn max_chip_thickness_mm(&self, advance: f64, radial: f64) -> f64 {
        match self.regularity() {
            ToothRegularity::Even => advance.max(0.0) / self.count() as f64,
            ToothRegularity::Pitch => advance.max(0.0) * self.widest_pitch_fraction(),
            ToothRegularity::Runout(_) => (0..self.count())
                .map(|edge| self.edge_chip_thickness_mm(edge, advance, radial))
                .fold(0.0, f64::max),
        }
    }

    /// Chip thickness of one edge, mm; arguments as for [`Teeth::max_chip_thickness_mm`]. 0 for an edge that does not exist.
    ///
    /// `h_i = max(0, min over m of advance (p_i + .. m angles) / 2 pi + (rho_i - rho_(i-m)) radial)`, m from 1 to the number of
    /// teeth: with the last the tooth meets its own cut of the turn before.
    pub fn edge_chip_thickness_mm(&self, edge: usize, advance: f64, radial: f64) -> f64 {
        let Some(pitch) = self.pitch_angles_rad().get(edge) else { return 0.0 };
        let advance = advance.max(0.0);
        let highest = match self.regularity() {
            ToothRegularity::Even => return advance / self.count() as f64,
            ToothRegularity::Pitch => return advance * pitch / TAU,
            ToothRegularity::Runout(highest) => highest,
        };
        // No earlier tooth stands further out than the highest: once even that one would have left more, none leaves less.
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

    /// The largest advance per turn (mm) at which no chip is thicker than `thickness` (mm): the inverse of
    /// [`Teeth::max_chip_thickness_mm`], in closed form.
    ///
    /// An edge's chip is the least of affine functions of the advance, so it stays within the target as long as one of them
    /// does. Runout alone never exceeds a target, since every tooth follows its own cut of the turn before: the result is at
    /// least `thickness`, and at most `thickness` times the number of teeth. 0 for a target of 0 or less.
    pub fn max_advance_for_chip_mm(&self, thickness: f64, radial: f64) -> f64 {
        let thickness = thickness.max(0.0);
        match self.regularity() {
            ToothRegularity::Even => thickness * self.count() as f64,
            ToothRegularity::Pitch => thickness / self.widest_pitch_fraction(),
            ToothRegularity::Runout(_) => (0..self.count())
                .map(|edge| {
                    self.passes_before(edge)
                        .iter()
                        .map(|[turns, further]| (thickness - further * radial) / turns)
                        .fold(f64::NEG_INFINITY, f64::max)
                })
                .fold(f64::INFINITY, f64::min)
                .max(0.0),
        }
    }

    /// Largest pitch angle as part of a turn.
    fn widest_pitch_fraction(&self) -> f64 {
        self.pitch_angles_rad().iter().copied().fold(0.0, f64::max) / TAU
    }
}
