//! This module computes the cutting forces over a revolution from the bins of an engagement, with the
//! mechanistic model.
//!
//! The source is Y. Altintas, Manufacturing Automation, 2nd ed., sec. 2.4-2.5, and sec. 2.8 for corner radii
//! and balls. An element of the edge of length dl along the meridian that cuts a chip of thickness h meets
//! three forces: `dF_t = (k_tc h + k_te) dl` against its motion, `dF_r = (k_rc h + k_re) dl` along the normal
//! into the cutter, and `dF_a = (k_ac h + k_ae) dl` down the meridian, towards the tip. Where there is no chip, there is no
//! edge force. The forces of all teeth are added up at every 3 degrees of rotation, which is the width of a bin.

use std::f64::consts::{PI, TAU};
use std::ops::Range;
use std::sync::Arc;

use crate::cutter::{BeamForces, Meridian, Teeth, ToolBeam};
use crate::engagement::edge_elements::{
    EdgeElement, EngagedEdgePart, ToothPosition, lag_rad_per_mm, list_tooth_positions, split_edge,
};
use crate::engagement::engagement_bins::BINS;
use crate::engagement::{CuttingLaw, Engagement};
use crate::program::record::SpindleDirection;

/// The loads on a cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuttingLoads {
    /// The largest resultant force over a revolution, N.
    pub force_n: f64,
    /// The largest torque about the spindle over a revolution, N m.
    pub torque_nm: f64,
    /// The mean cutting power over a revolution, kW.
    pub power_kw: f64,
}

/// How far a tool bends, and with what stress.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BendingLoads {
    /// The largest deflection of the tip across the axis over a revolution, mm.
    pub deflection_mm: f64,
    /// The largest bending stress over a revolution, MPa.
    pub stress_mpa: f64,
}

/// A cutter in a material, from which loads are computed. It is made once for each cutter and holds
/// everything that does not depend on the engagement, the feed and the spindle speed.
///
/// ```
/// use clsmith::cutter::{CutterModel, Meridian, Teeth};
/// use clsmith::engagement::{CuttingCoefficients, CuttingLoads, LoadModel, PathPiece, Simulation};
/// use clsmith::program::geometry::Pose;
/// use clsmith::program::record::SpindleDirection;
/// use clsmith::stock::{SolidBody, Stock};
/// use nalgebra::{Point3, Vector3};
///
/// let profile = Meridian::new(10.0, 0.0, 0.0, 0.0, 20.0)?;
/// let teeth = Teeth::evenly_spaced(4, 0.5).expect("four teeth");
/// let steel =
///     CuttingCoefficients { k_tc: 1900.0, k_te: 25.0, k_rc: 600.0, k_re: 30.0, k_ac: 0.0, k_ae: 0.0 };
/// let model = LoadModel::new(&profile, &teeth, steel, SpindleDirection::Clockwise);
///
/// let block = SolidBody::Block { from: [0.0, -20.0, -10.0], to: [60.0, 20.0, 0.0] };
/// let stock = Stock::new(vec![block], 0.0)?.to_dexels(0.5, 1_000_000)?;
/// let at = |x: f64| Pose { point: Point3::new(x, 0.0, -2.0), axis: Vector3::z() };
/// let slot = PathPiece { from: at(-6.0), to: at(30.0), cutter: 0 };
/// let mill = CutterModel { profile, collars: Vec::new(), teeth: Some(teeth) };
/// let engagement = Simulation::new(stock, true).sweep_pieces(&[slot], &[mill]).remove(0);
///
/// let loads = model.cutting_loads(&engagement, 1000.0, 5000.0);
/// assert!(loads.force_n > 100.0 && loads.power_kw > 0.1);
/// // The feed at which the torque is half of that.
/// let half = 0.5 * loads.torque_nm;
/// let limits = CuttingLoads { force_n: f64::INFINITY, torque_nm: half, power_kw: f64::INFINITY };
/// assert!(model.feed_for_load_mm_min(&engagement, 5000.0, limits) < 500.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct LoadModel {
    pub(super) teeth: Teeth,
    pub(super) law: CuttingLaw,
    /// The sign of the turn: 1 where the force on a tooth that is straight ahead points to the left
    /// (clockwise), else -1.
    pub(super) left: f64,
    /// By how much the edge lags behind the tip per mm of height, radians.
    pub(super) lag_rad_per_mm: f64,
    elements: Vec<EdgeElement>,
    looks: Vec<ToothPosition>,
    pub(super) beam: Option<Arc<ToolBeam>>,
}

/// An engaged bin, with its values as `f64`.
#[derive(Debug, Clone, Copy, Default)]
struct EngagedBin {
    low: f64,
    high: f64,
    advance_ratio: f64,
    thickness: f64,
}

/// An engagement that is ready for sums over its bins.
pub(super) struct PreparedEngagement {
    bins: Vec<EngagedBin>,
    across: f64,
    along: f64,
    /// The range of edge elements that any bin engages.
    elements: Range<usize>,
}

impl LoadModel {
    /// Makes the model of a cutter with these teeth in a material, for one direction of the spindle.
    ///
    /// The helix has a constant lead: the edge lags by `z tan(helix) / R`, where R is the largest radius. The
    /// edge is cut into elements over which neither the normal nor the helix turns by more than 3 degrees.
    pub fn new(
        profile: &Meridian,
        teeth: &Teeth,
        law: impl Into<CuttingLaw>,
        spindle: SpindleDirection,
    ) -> Self {
        let left = spindle.sense();
        Self {
            teeth: teeth.clone(),
            law: law.into(),
            left,
            lag_rad_per_mm: lag_rad_per_mm(profile, teeth.helix_rad),
            elements: split_edge(profile, teeth.helix_rad, left),
            looks: list_tooth_positions(teeth, left),
            beam: None,
        }
    }

    /// Lets the model tell how the tool bends.
    #[must_use]
    pub fn with_beam(mut self, beam: Option<Arc<ToolBeam>>) -> Self {
        self.beam = beam;
        self
    }

    /// Returns the loads at a feed in mm/min and a spindle speed in rev/min (above 0). All loads are 0 in
    /// air.
    ///
    /// The mean power is exact for the bins to 3e-4: the elements of 3 degrees have a second-order error on
    /// curved parts and none on bottoms and flanks. Force and torque are the largest values at rotations
    /// every 3 degrees. So they are up to 4e-4 below a smooth peak, and as sharp as the bins (3 degrees)
    /// where teeth enter and leave.
    pub fn cutting_loads(&self, engagement: &Engagement, feed_mm_min: f64, rpm: f64) -> CuttingLoads {
        self.loads_of_prepared(&self.prepare_engagement(engagement), feed_mm_min, rpm)
    }

    /// Returns the loads as [`LoadModel::cutting_loads`] does, for an engagement that is already prepared.
    pub(super) fn loads_of_prepared(
        &self,
        contact: &PreparedEngagement,
        feed_mm_min: f64,
        rpm: f64,
    ) -> CuttingLoads {
        let per_turn = feed_mm_min / rpm;
        let elements = self.elements.get(contact.elements.clone());
        debug_assert!(elements.is_some(), "a contact has elements of its own edge");
        let elements = elements.unwrap_or_default();
        let (mut force, mut torque) = (0.0_f64, 0.0_f64);
        for look in self.looks.chunks(self.teeth.count()) {
            let mut sum = ForceSum::default();
            for tooth in look {
                for element in elements {
                    self.add_element_force(contact, per_turn, tooth, element, &mut sum);
                }
            }
            // The square of the resultant is compared; the root is taken once at the end.
            force = force.max(sum.force.iter().map(|part| part * part).sum());
            torque = torque.max(sum.torque);
        }
        // Power is the mean torque times the angular speed: N mm times 1/s is mW, so 1e-6 gives kW.
        let power = self.mean_torque_n_mm(contact, elements, per_turn) * TAU * rpm / 60.0;
        CuttingLoads { force_n: force.sqrt(), torque_nm: torque * 1e-3, power_kw: power * 1e-6 }
    }

    /// Returns how the tool bends at a feed in mm/min and a spindle speed in rev/min; all 0 in air, and for a tool that is
    /// not known as a beam.
    pub fn bending_loads(&self, engagement: &Engagement, feed_mm_min: f64, rpm: f64) -> BendingLoads {
        self.bending_of_prepared(&self.prepare_engagement(engagement), feed_mm_min, rpm)
    }

    /// Returns the bending as [`LoadModel::bending_loads`] does, for an engagement that is already prepared.
    pub(super) fn bending_of_prepared(
        &self,
        contact: &PreparedEngagement,
        feed_mm_min: f64,
        rpm: f64,
    ) -> BendingLoads {
        let mut largest = BendingLoads::default();
        let Some(beam) = &self.beam else { return largest };
        let per_turn = feed_mm_min / rpm;
        let elements = self.elements.get(contact.elements.clone()).unwrap_or_default();
        let highest_mm = elements.last().map_or(0.0, |element| element.z + (element.to - element.from) / 2.0);
        for look in self.looks.chunks(self.teeth.count()) {
            let mut sum = ForceSum::default();
            for tooth in look {
                for element in elements {
                    self.add_element_force(contact, per_turn, tooth, element, &mut sum);
                }
            }
            let [ahead, left] = sum.beam.deflection_mm;
            largest.deflection_mm = largest.deflection_mm.max(ahead.hypot(left));
            largest.stress_mpa = largest.stress_mpa.max(beam.largest_stress_mpa(&sum.beam, highest_mm));
        }
        largest
    }

    /// Adds the forces on one element of one tooth.
    fn add_element_force(
        &self,
        contact: &PreparedEngagement,
        per_turn: f64,
        look: &ToothPosition,
        element: &EdgeElement,
        sum: &mut ForceSum,
    ) {
        // The element's angle is the tip's angle plus the lag; both are given as bins, so no arctangent is
        // needed.
        let index = (look.bins + element.lag_bins) as usize;
        let index = if index >= BINS { index - BINS } else { index };
        let Some(bin) = contact.bins.get(index) else { return };
        let Some(part) = element.engaged_part(bin.low, bin.high) else { return };
        let [sin_tip, cos_tip] = look.angle;
        let [sin_lag, cos_lag] = element.lag;
        // The cosine and sine of the sum of the two angles.
        let cos = cos_tip * cos_lag - sin_tip * sin_lag;
        let sin = sin_tip * cos_lag + cos_tip * sin_lag;
        let Some((chip, chip_radius)) =
            self.chip_thickness_and_moment(contact, bin, &part, cos, look.tooth, per_turn)
        else {
            return;
        };
        // The law of the module's head, with the length of the engaged part as dl.
        let [tangential, radial, axial] = self.law.edge_forces_n_mm(chip).map(|force| force * part.length);
        // Both the force down the meridian and the one along the normal press inwards where the cutter widens.
        let outwards = -axial * part.cos - radial * part.sin;
        let against = tangential * self.left;
        let across = [outwards * cos - against * sin, outwards * sin + against * cos];
        sum.force[0] += across[0];
        sum.force[1] += across[1];
        if let Some(beam) = &self.beam {
            sum.beam.add_force(across, part.z, beam.deflection_mm_per_n(0.0, part.z));
        }
        sum.force[2] += radial * part.cos - axial * part.sin;
        sum.torque += self.edge_moment(chip, chip_radius, &part);
    }

    /// Returns the moment of a part of the edge in N mm, from its chip and the mean of thickness times radius.
    fn edge_moment(&self, chip: f64, chip_radius: f64, part: &EngagedEdgePart) -> f64 {
        let [tangential, ..] = self.law.edge_forces_n_mm(chip);
        let together = self.law.tangential_slope(chip) * (chip_radius - chip * part.r);
        (tangential * part.r + together) * part.length
    }

    /// Returns the chip thickness of a tooth at the middle of a part of its edge, and the mean of thickness
    /// times radius over that part. Returns `None` where there is no chip. `cos` belongs to the angle from
    /// straight ahead.
    fn chip_thickness_and_moment(
        &self,
        contact: &PreparedEngagement,
        bin: &EngagedBin,
        part: &EngagedEdgePart,
        cos: f64,
        tooth: usize,
        per_turn: f64,
    ) -> Option<(f64, f64)> {
        // The advance ratio v.n / |v| of this point: n has the parts sin psi cos(angle) along the feed and
        // -cos psi along the axis.
        let share = part.sin * cos * contact.across - part.cos * contact.along;
        let held = share.min(bin.advance_ratio);
        if held * per_turn <= 0.0 {
            return None;
        }
        let chip = self.teeth.edge_chip_thickness_mm(tooth, held * per_turn, part.sin);
        if chip <= 0.0 {
            return None;
        }
        // Thickness and radius only vary together where the chip is limited by neither the material nor the
        // bin.
        if chip >= bin.thickness || share > held {
            let chip = chip.min(bin.thickness);
            return Some((chip, chip * part.r));
        }
        // Thickness and radius both grow up a curved meridian. Near a ball's tip the product of their means
        // would miss much of the torque, so the mean of the product gets the term `dh/ds dr/ds l^2 / 12`.
        let rise = (part.cos * cos * contact.across + part.sin * contact.along) * part.curvature;
        let together = part.cos * rise * part.length * part.length / 12.0;
        Some((chip, chip * part.r + chip / share * together))
    }

    /// Returns the mean torque over a revolution in N mm. Every tooth passes every bin once in a revolution,
    /// whatever the helix, so the mean needs no rotation steps.
    fn mean_torque_n_mm(&self, contact: &PreparedEngagement, elements: &[EdgeElement], per_turn: f64) -> f64 {
        let width = TAU / BINS as f64;
        // This is the ratio of the mean of a cosine over a bin to the cosine of the bin's middle.
        let mean = (width / 2.0).sin() / (width / 2.0);
        // Even teeth all cut the same chip, so one of them is computed and multiplied.
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
                    if let Some((chip, chip_radius)) =
                        self.chip_thickness_and_moment(contact, bin, &part, cos, tooth, per_turn)
                    {
                        torque += self.edge_moment(chip, chip_radius, &part);
                    }
                }
            }
        }
        torque * times / BINS as f64
    }

    /// Converts the bins to `f64` and finds the elements that they engage.
    pub(super) fn prepare_engagement(&self, engagement: &Engagement) -> PreparedEngagement {
        let mut bins = vec![EngagedBin::default(); BINS];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (to, from) in bins.iter_mut().zip(&engagement.bins).filter(|(_, bin)| bin.is_engaged()) {
            *to = EngagedBin {
                low: f64::from(from.low),
                high: f64::from(from.high),
                advance_ratio: f64::from(from.advance_ratio),
                thickness: f64::from(from.thickness),
            };
            low = low.min(to.low);
            high = high.max(to.high);
        }
        // Elements are in order of their lengths along the meridian.
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

/// The forces on the cutter at one rotation, ahead, to the left and up (N), and the torque (N mm).
#[derive(Debug, Default)]
struct ForceSum {
    force: [f64; 3],
    torque: f64,
    beam: BeamForces,
}
