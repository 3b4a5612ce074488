//! What makes the thickness of a tooth's chip of how the cutter's surface advances.

use crate::cutter::CutterModel;
use crate::engagement::MotionPiece;
use crate::layered_chips::chip::LayerChip;
use crate::layered_chips::{FlatMill, largest_feed_fraction};

/// Ways of the tip below this, mm, are none.
pub(super) const STANDS: f64 = 1e-7;

/// Length of the tip's way, mm.
pub(super) fn tip_travel_mm(step: &MotionPiece) -> f64 {
    (step.piece.to.point - step.piece.from.point).norm()
}

/// What makes a thickness of an advance.
pub(super) struct ChipThicknessModel<'m> {
    pub cutter: Option<&'m CutterModel>,
    pub mill: Option<FlatMill>,
    /// Feed of a turn, mm.
    pub feed_per_turn_mm: Option<f64>,
    /// Of the borders' chords, mm.
    pub tolerance_mm: f64,
    /// Whether thicknesses are known on the whole motion.
    pub known: bool,
}

impl ChipThicknessModel<'_> {
    /// The thickest chip of a tooth on a layer of a piece, mm; the flank's normal stands square to the axis. Not known of a film that chords
    /// left.
    pub fn max_chip_thickness_mm(&self, step: &MotionPiece, layer: &LayerChip) -> Option<f64> {
        if layer.area_mm2 <= 0.0 {
            return Some(0.0);
        }
        let teeth = self.cutter?.teeth.as_ref()?;
        let way = Some(tip_travel_mm(step)).filter(|way| *way > STANDS)?;
        let on_the_way = largest_feed_fraction(layer, self.mill.as_ref()?, &step.piece, self.tolerance_mm);
        // At the end it is known closer than by samples.
        let at_end = Some(layer.advance_mm / way).filter(|share| *share > 0.0);
        let share = [on_the_way, at_end].into_iter().flatten().reduce(f64::max)?;
        Some(teeth.max_chip_thickness_mm(share * self.feed_per_turn_mm?, 1.0))
    }
}
