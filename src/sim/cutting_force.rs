//! Cutting forces over a revolution, from the bins of an engagement: the mechanistic model.
//!
//! Y. Altintas, Manufacturing Automation, 2nd ed., sec. 2.4-2.5 and (for corners and balls) 2.8: an element of the edge of length dl
//! along the meridian that cuts a chip of thickness h meets `dF_t = (k_tc h + k_te) dl` against its motion,
//! `dF_r = (k_rc h + k_re) dl` along the normal into the cutter and `dF_a = (k_ac h + k_ae) dl` up the meridian. Where there is no
//! chip there is no edge force. The sum over the teeth is taken every 3 degrees of rotation, as wide as a bin.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::edge_elements::{EdgeElement, EngagedEdgePart, ToothPosition, list_tooth_positions, split_edge};
use super::engagement::BINS;
use super::{CuttingCoefficients, Engagement, Meridian, Teeth};
use crate::program::record::SpindleDirection;

/// What a cutter has to bear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuttingLoads {
    /// Largest resultant force over a revolution, N.
    pub force_n: f64,
    /// Largest torque about the spindle over a revolution, N m.
    pub torque_nm: f64,
    /// Mean power at the edges over a revolution, kW.
    pub power_kw: f64,
}

/// A cutter in a material: computes loads. Made once per cutter, it holds all that does not depend on engagement, feed and speed.
#[derive(Debug, Clone)]
pub struct LoadModel {
    teeth: Teeth,
    material: CuttingCoefficients,
    /// 1 where the tooth's force on the cutter points to the left when it is ahead (clockwise), else -1.
    left: f64,
    elements: Vec<EdgeElement>,
    looks: Vec<ToothPosition>,
}

/// An engaged bin in doubles.
#[derive(Debug, Clone, Copy, Default)]
struct EngagedBin {
    low: f64,
    high: f64,
    share: f64,
    thickness: f64,
}

/// An engagement, ready for sums over its bins.
pub(super) struct PreparedEngagement {
    bins: Vec<EngagedBin>,
    across: f64,
    along: f64,
    /// The elements that any bin engages.
    elements: Range<usize>,
}

impl LoadModel {
    /// The model of a cutter with these teeth in a material, turning as `spindle` says.
    ///
    /// The helix has a constant lead, `z tan(helix) / R` with R the largest radius. The edge is cut into elements over which neither
    /// the normal nor the helix turns by more than 3 degrees.
    pub fn new(
        profile: &Meridian,
        teeth: &Teeth,
        material: CuttingCoefficients,
        spindle: SpindleDirection,
    ) -> Self {
        let left = match spindle {
            SpindleDirection::Clockwise => 1.0,
            SpindleDirection::CounterClockwise => -1.0,
        };
        Self {
            teeth: teeth.clone(),
            material,
            left,
            elements: split_edge(profile, teeth.helix, left),
            looks: list_tooth_positions(teeth, left),
        }
    }

    /// Loads at a feed in mm/min and a spindle speed in rev/min (above 0); all 0 in air.
    ///
    /// Tolerance: the mean power is exact for the bins to 3e-4 (elements of 3 degrees, second order; exact on bottoms and flanks);
    /// force and torque are the largest over looks every 3 degrees, so up to 4e-4 below a smooth peak, and as sharp as the
    /// bins (3 degrees) where the teeth enter and leave.
    pub fn cutting_loads(&self, engagement: &Engagement, feed_mm_min: f64, rpm: f64) -> CuttingLoads {
        self.loads_of_prepared(&self.prepare_engagement(engagement), feed_mm_min, rpm)
    }

    /// As [`LoadModel::cutting_loads`], where bins and elements are known.
    pub(super) fn loads_of_prepared(
        &self,
        contact: &PreparedEngagement,
        feed_mm_min: f64,
        rpm: f64,
    ) -> CuttingLoads {
        let per_turn = feed_mm_min / rpm;
        let elements = self.elements.get(contact.elements.clone()).unwrap_or_default();
        let (mut force, mut torque) = (0.0_f64, 0.0_f64);
        for look in self.looks.chunks(self.teeth.count()) {
            let mut sum = ForceSum::default();
            for tooth in look {
                for element in elements {
                    self.add_element_force(contact, per_turn, tooth, element, &mut sum);
                }
            }
            force = force.max(sum.force.iter().map(|part| part * part).sum());
            torque = torque.max(sum.torque);
        }
        let power = self.mean_torque_n_mm(contact, elements, per_turn) * TAU * rpm / 60.0;
        CuttingLoads { force_n: force.sqrt(), torque_nm: torque * 1e-3, power_kw: power * 1e-6 }
    }

    /// Adds what one element of one tooth bears.
    fn add_element_force(
        &self,
        contact: &PreparedEngagement,
        per_turn: f64,
        look: &ToothPosition,
        element: &EdgeElement,
        sum: &mut ForceSum,
    ) {
        let index = (look.bins + element.lag_bins) as usize;
        let index = if index >= BINS { index - BINS } else { index };
        let Some(bin) = contact.bins.get(index) else { return };
        let Some(part) = element.engaged_part(bin.low, bin.high) else { return };
        let [sin_tip, cos_tip] = look.angle;
        let [sin_lag, cos_lag] = element.lag;
        let cos = cos_tip * cos_lag - sin_tip * sin_lag;
        let sin = sin_tip * cos_lag + cos_tip * sin_lag;
        let Some((chip, chip_radius)) =
            self.chip_thickness_and_moment(contact, bin, &part, cos, look.tooth, per_turn)
        else {
            return;
        };
        let CuttingCoefficients { k_tc, k_te, k_rc, k_re, k_ac, k_ae } = self.material;
        let tangential = (k_tc * chip + k_te) * part.length;
        let radial = (k_rc * chip + k_re) * part.length;
        let axial = (k_ac * chip + k_ae) * part.length;
        // Outwards: up the meridian goes outwards where the cutter widens; the normal's part presses inwards.
        let outwards = axial * part.cos - radial * part.sin;
        let against = tangential * self.left;
        sum.force[0] += outwards * cos - against * sin;
        sum.force[1] += outwards * sin + against * cos;
        sum.force[2] += axial * part.sin + radial * part.cos;
        sum.torque += (k_tc * chip_radius + k_te * part.r) * part.length;
    }

    /// Chip thickness of a tooth at the middle of a part of its edge, and the mean of thickness times radius over the part; `None`
    /// where there is no chip. `cos` is of the angle from ahead.
    fn chip_thickness_and_moment(
        &self,
        contact: &PreparedEngagement,
        bin: &EngagedBin,
        part: &EngagedEdgePart,
        cos: f64,
        tooth: usize,
        per_turn: f64,
    ) -> Option<(f64, f64)> {
        let share = part.sin * cos * contact.across - part.cos * contact.along;
        let held = share.min(bin.share);
        if held * per_turn <= 0.0 {
            return None;
        }
        let chip = self.teeth.edge_chip_thickness_mm(tooth, held * per_turn, part.sin);
        if chip <= 0.0 {
            return None;
        }
        if chip >= bin.thickness || share > held {
            let chip = chip.min(bin.thickness);
            return Some((chip, chip * part.r));
        }
        // Both grow up a curved meridian: near a ball's tip the product of the means would miss a good part of the torque.
        let rise = (part.cos * cos * contact.across + part.sin * contact.along) * part.curvature;
        let together = part.cos * rise * part.length * part.length / 12.0;
        Some((chip, chip * part.r + chip / share * together))
    }

    /// Mean torque over a revolution, N mm: each bin once per tooth, whatever the helix.
    fn mean_torque_n_mm(&self, contact: &PreparedEngagement, elements: &[EdgeElement], per_turn: f64) -> f64 {
        let width = TAU / BINS as f64;
        // The mean of a cosine over a bin is this much below the cosine of its middle.
        let mean = (width / 2.0).sin() / (width / 2.0);
        // Even teeth all cut the same.
        let (teeth, times) = if self.teeth.is_even() {
            (0..1, self.teeth.count() as f64)
        } else {
            (0..self.teeth.count(), 1.0)
        };
        let mut torque = 0.0;
        for (index, bin) in contact.bins.iter().enumerate().filter(|(_, bin)| bin.high > bin.low) {
            let cos = ((index as f64 + 0.5) * width - PI).cos() * mean;
            for part in elements.iter().filter_map(|element| element.engaged_part(bin.low, bin.high)) {
                for tooth in teeth.clone() {
                    if let Some((_, chip_radius)) =
                        self.chip_thickness_and_moment(contact, bin, &part, cos, tooth, per_turn)
                    {
                        torque +=
                            (self.material.k_tc * chip_radius + self.material.k_te * part.r) * part.length;
                    }
                }
            }
        }
        torque * times / BINS as f64
    }

    /// Bins in doubles, and the elements that they engage.
    pub(super) fn prepare_engagement(&self, engagement: &Engagement) -> PreparedEngagement {
        let mut bins = vec![EngagedBin::default(); BINS];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (to, from) in bins.iter_mut().zip(&engagement.bins).filter(|(_, bin)| bin.is_engaged()) {
            *to = EngagedBin {
                low: f64::from(from.low),
                high: f64::from(from.high),
                share: f64::from(from.share),
                thickness: f64::from(from.thickness),
            };
            low = low.min(to.low);
            high = high.max(to.high);
        }
        let first = self.elements.partition_point(|element| element.to <= low);
        let last = self.elements.partition_point(|element| element.from < high);
        PreparedEngagement {
            bins,
            across: engagement.across,
            along: engagement.along,
            elements: first..last.max(first),
        }
    }
}

/// Forces on the cutter at one look, ahead, left and up (N), and the torque (N mm).
#[derive(Debug, Default)]
struct ForceSum {
    force: [f64; 3],
    torque: f64,
}
