//! This module computes the thickness of a tooth's chip from the advance of the cutter's surface.

use crate::cutter::CutterModel;
use crate::engagement::MotionPiece;
use crate::layered_chips::chip::LayerChip;
use crate::layered_chips::{FlatMill, largest_feed_fraction};

/// A tip that moves less than this, in mm, is at rest.
pub(super) const LEAST_TRAVEL_MM: f64 = 1e-7;

/// Returns the length of the tip's path, mm.
pub(super) fn tip_travel_mm(step: &MotionPiece) -> f64 {
    (step.piece.to.point - step.piece.from.point).norm()
}

/// What is needed to compute a chip thickness from an advance.
pub(super) struct ChipThicknessModel<'m> {
    pub cutter: Option<&'m CutterModel>,
    pub mill: Option<FlatMill>,
    /// The feed per revolution, mm.
    pub feed_per_turn_mm: Option<f64>,
    /// The largest distance between boundaries and their chords, mm.
    pub tolerance_mm: f64,
    /// Whether thicknesses are known on the whole motion.
    pub known: bool,
}

impl ChipThicknessModel<'_> {
    /// Returns the thickest chip of a tooth on a layer of a piece, in mm. It is 0 if the layer has no chip.
    /// Returns `None` if teeth or feed are not known, if the tip is at rest, or if the chip is only a film
    /// that comes from the chords of boundaries.
    pub(super) fn max_chip_thickness_mm(&self, step: &MotionPiece, layer: &LayerChip) -> Option<f64> {
        if layer.area_mm2 <= 0.0 {
            return Some(0.0);
        }
        let teeth = self.cutter?.teeth.as_ref()?;
        let way = Some(tip_travel_mm(step)).filter(|way| *way > LEAST_TRAVEL_MM)?;
        let on_the_way = largest_feed_fraction(layer, self.mill.as_ref()?, &step.piece, self.tolerance_mm);
        // At the end of the piece, the advance is known more exactly than from samples along it.
        let at_end = Some(layer.advance_mm / way).filter(|share| *share > 0.0);
        let share = [on_the_way, at_end].into_iter().flatten().reduce(f64::max)?;
        // The normal of the flank is perpendicular to the axis, so its radial part is 1.
        Some(teeth.max_chip_thickness_mm(share * step.pace * self.feed_per_turn_mm?, 1.0))
    }
}
