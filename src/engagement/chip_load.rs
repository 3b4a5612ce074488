//! This module computes, from an engagement and a feed, the thickest chip and the removal rate, and the feeds
//! that keep them at a target.
//!
//! These are equations (1) and (2) of I. Kiselev, N. Jukov, K. Deev, Automated block-by-block correction of
//! milling parameters by means of numerical simulation, for one piece of the path: C_k is
//! [`Engagement::chip_thickness_mm`] and F_k is [`Engagement::feed_for_chip_mm_min`].
//!
//! A chip counts as thin as its material only on pieces that are longer than the advance per revolution. On
//! shorter pieces the tooth before has already thinned the material, which a single piece cannot know.

use crate::cutter::Teeth;
use crate::engagement::Engagement;

/// How much of a runout reaches the chip at a point depends on its normal, which a share does not tell; a chip is largest
/// at one of these parts.
const RADIAL_PARTS: [f64; 2] = [0.0, 1.0];

/// Returns the thickest chip in mm of points whose share (the speed along their normal divided by the speed of the tip)
/// is at most `share`, at a feed in mm/min and a spindle speed in rev/min.
pub(crate) fn thickest_chip_of_share_mm(share: f64, teeth: &Teeth, feed_mm_min: f64, rpm: f64) -> f64 {
    let advance = share * feed_mm_min / rpm;
    RADIAL_PARTS.map(|radial| teeth.max_chip_thickness_mm(advance, radial)).into_iter().fold(0.0, f64::max)
}

/// Returns the largest feed in mm/min at which no point whose share is at most `share` has a chip above `target_mm`.
pub(crate) fn feed_for_chip_of_share_mm_min(share: f64, teeth: &Teeth, target_mm: f64, rpm: f64) -> f64 {
    let advances = RADIAL_PARTS.map(|radial| teeth.max_advance_for_chip_mm(target_mm, radial));
    advances.into_iter().fold(f64::INFINITY, f64::min) * rpm / share
}

impl Engagement {
    /// Returns the thickest chip in mm at a feed (mm/min) and a spindle speed (rev/min, above 0). This is the
    /// largest over the bins of the chip that the teeth make of the surface's advance, and nowhere more than
    /// the thickness of the material. It is 0 in air.
    ///
    /// The value is the classic thickness, which is f_z sin(phi) on a flank. Measured along the edge's normal
    /// to the surface that the tooth before left, the chip is 4 to 9 % thinner where that surface meets the
    /// free one.
    pub fn chip_thickness_mm(&self, teeth: &Teeth, feed_mm_min: f64, rpm: f64) -> f64 {
        let per_turn = feed_mm_min / rpm;
        let of = |bin: &crate::engagement::EngagementBin| {
            let chip =
                teeth.max_chip_thickness_mm(per_turn * f64::from(bin.advance_ratio), f64::from(bin.radial));
            chip.min(self.material_thickness_mm(bin, per_turn))
        };
        self.engaged_bins().map(of).fold(0.0, f64::max)
    }

    /// Returns an upper bound of [`Engagement::chip_thickness_mm`] with everything that the grid may have
    /// missed: the bounds of the advance ratios, and slivers beside the flank whose thickness is unknown. It
    /// is never below the classic thickness of the true engagement.
    pub fn chip_thickness_bound_mm(&self, teeth: &Teeth, feed_mm_min: f64, rpm: f64) -> f64 {
        let per_turn = feed_mm_min / rpm;
        let of = |bin: &crate::engagement::EngagementBin| {
            let chip = teeth
                .max_chip_thickness_mm(per_turn * f64::from(bin.advance_ratio_bound), f64::from(bin.radial));
            chip.min(self.material_thickness_mm(bin, per_turn))
        };
        // A sliver beside the flank touches the cylinder, so its normal is radial.
        let graze =
            if self.graze > 0.0 { teeth.max_chip_thickness_mm(per_turn * self.graze, 1.0) } else { 0.0 };
        self.engaged_bins().map(of).fold(graze, f64::max)
    }

    /// Returns the largest feed in mm/min at which no chip is thicker than `target_mm`, at a spindle speed
    /// in rev/min. This is equation (2) in closed form. It is infinite where nothing limits the feed, as in
    /// air and where all material is thinner than the target; it is 0 for a target of 0 or less.
    ///
    /// It uses the bounds of [`Engagement::chip_thickness_bound_mm`], so the grid's uncertainty lowers the
    /// feed and never raises it.
    pub fn feed_for_chip_mm_min(&self, teeth: &Teeth, rpm: f64, target_mm: f64) -> f64 {
        // The advance per turn of a bin is F / n times its advance ratio.
        let limit = |share: f64, radial: f64| {
            if share > 0.0 {
                teeth.max_advance_for_chip_mm(target_mm, radial) * rpm / share
            } else {
                f64::INFINITY
            }
        };
        let (mut all, mut thick) = (limit(self.graze, 1.0), limit(self.graze, 1.0));
        for bin in self.engaged_bins() {
            let feed = limit(f64::from(bin.advance_ratio_bound), f64::from(bin.radial));
            all = all.min(feed);
            if f64::from(bin.thickness) > target_mm {
                thick = thick.min(feed);
            }
        }
        // Thin material only permits a higher feed as long as its thickness is known: up to one piece's
        // length per revolution.
        all.max(thick.min(self.shortest_mm * rpm))
    }

    /// Returns the thickness of a bin's material for teeth that advance `per_turn` mm in a revolution;
    /// infinite where it is not known.
    fn material_thickness_mm(&self, bin: &crate::engagement::EngagementBin, per_turn: f64) -> f64 {
        if self.shortest_mm >= per_turn { f64::from(bin.thickness) } else { f64::INFINITY }
    }

    /// Returns the removal rate in mm3/min at a feed in mm/min, as the mean over the piece of the path; 0 for
    /// a piece without length.
    pub fn removal_rate_mm3_min(&self, feed_mm_min: f64) -> f64 {
        if self.length_mm > 0.0 { self.removed_mm3 / self.length_mm * feed_mm_min } else { 0.0 }
    }

    /// Returns the feed in mm/min at which the removal rate is `rate_mm3_min`; infinite in air.
    pub fn feed_for_removal_rate_mm_min(&self, rate_mm3_min: f64) -> f64 {
        if self.has_removed_material() && self.length_mm > 0.0 {
            rate_mm3_min.max(0.0) * self.length_mm / self.removed_mm3
        } else {
            f64::INFINITY
        }
    }
}
