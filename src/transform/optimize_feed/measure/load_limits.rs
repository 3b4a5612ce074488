//! This module computes the largest feed that keeps every limit from the engagement of a piece of path, and
//! the loads at a feed.

use super::feed_block::FeedLimit;
use super::load_criterion::LoadCriterion;
use crate::cutter::CutterModel;
use crate::engagement::{
    BendingLoads, CuttingLaw, CuttingLoads, Engagement, LoadBound, LoadModel, bound_swept_area_mm2,
    feed_for_chip_of_share_mm_min, thickest_chip_of_share_mm,
};
use crate::program::record::SpindleDirection;
use crate::simulation_run::certified_contacts::ContactGrid;
use crate::simulation_run::{StockResolution, Tooling};

/// A removed volume below this fraction of a cell's cube is rounding, not material.
const SPECK: f64 = 1e-3;

/// The limits of loads, and the data that is needed to check them.
#[derive(Debug)]
pub(in crate::transform::optimize_feed) struct LoadLimits {
    limits: Vec<(LoadCriterion, f64)>,
    models: Vec<Option<[LoadModel; 2]>>,
    resolution: StockResolution,
}

/// The rotation of the spindle while a piece is cut.
#[derive(Debug, Clone, Copy)]
pub(in crate::transform::optimize_feed) struct SpindleRotation {
    /// The spindle speed in rev/min, above 0.
    pub rpm: f64,
    pub direction: SpindleDirection,
}

/// The loads of all that may be engaged on a piece.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::transform::optimize_feed) struct ContactLoads {
    /// The largest feed that keeps all limits but those of chips.
    pub feed_limit_mm_min: f64,
    /// For each limit, what the load is at most at the programmed feed; 0 for a chip.
    pub bounds: Vec<f64>,
}

impl LoadLimits {
    /// Collects the limits (in mm). `material` is needed if a criterion needs it.
    pub(crate) fn new(
        limits: Vec<(LoadCriterion, f64)>,
        tooling: &Tooling,
        material: Option<CuttingLaw>,
        resolution: StockResolution,
    ) -> Self {
        let bends = limits.iter().any(|(criterion, _)| criterion.needs_stiffness());
        let build =
            |law| if bends { tooling.build_bending_models(&law) } else { tooling.build_load_models(&law) };
        let models = material.map(build).unwrap_or_default();
        Self { limits, models, resolution }
    }

    /// Returns the limits.
    pub(crate) fn criterion_limits(&self) -> &[(LoadCriterion, f64)] {
        &self.limits
    }

    /// Returns whether a piece cuts more than rounding leaves.
    pub(crate) fn is_cutting(&self, found: &Engagement) -> bool {
        let speck = match self.resolution {
            StockResolution::Cell(cell) => SPECK * cell.powi(3),
            // Layers have no rounding: films are never part of a chip.
            StockResolution::Layer(_) => 0.0,
        };
        found.removed_mm3 > speck
    }

    /// Returns the largest feed for a piece that a cutter engages.
    pub(crate) fn find_feed_limit(
        &self,
        found: &Engagement,
        cutter: &CutterModel,
        index: usize,
        turning: SpindleRotation,
    ) -> FeedLimit {
        if !self.is_cutting(found) && found.graze <= 0.0 {
            return FeedLimit::Air;
        }
        let feed = |(criterion, limit): &(LoadCriterion, f64)| match criterion {
            LoadCriterion::ChipThickness => {
                let teeth = cutter.teeth.as_ref();
                teeth.map_or(f64::INFINITY, |teeth| found.feed_for_chip_mm_min(teeth, turning.rpm, *limit))
            }
            _ => self.find_feed_for(&self.bound_engagement(found), (*criterion, *limit), index, turning),
        };
        // Each load grows with the feed, so the lowest of these feeds keeps all limits.
        FeedLimit::Limit(self.limits.iter().map(feed).fold(f64::INFINITY, f64::min))
    }

    /// Returns the largest feed in mm/min at which no chip limit is passed, where no point's share is larger.
    pub(crate) fn feed_for_share_mm_min(
        &self,
        share: f64,
        cutter: &CutterModel,
        turning: SpindleRotation,
    ) -> f64 {
        let chips = self.limits.iter().filter(|(criterion, _)| *criterion == LoadCriterion::ChipThickness);
        let Some(teeth) = cutter.teeth.as_ref() else { return f64::INFINITY };
        chips
            .map(|(_, limit)| feed_for_chip_of_share_mm_min(share, teeth, *limit, turning.rpm))
            .fold(f64::INFINITY, f64::min)
    }

    /// Returns the largest chip in mm where the largest share is known; 0 for a cutter without known teeth.
    pub(crate) fn chip_of_share_mm(
        &self,
        share: f64,
        cutter: &CutterModel,
        feed_mm_min: f64,
        turning: SpindleRotation,
    ) -> f64 {
        let teeth = cutter.teeth.as_ref();
        teeth.map_or(0.0, |teeth| thickest_chip_of_share_mm(share, teeth, feed_mm_min, turning.rpm))
    }

    /// Returns the largest feed that keeps all limits but those of chips. Returns `None` if there are no others.
    pub(crate) fn find_other_limit(
        &self,
        found: &Engagement,
        index: usize,
        turning: SpindleRotation,
    ) -> Option<f64> {
        let mut others =
            self.limits.iter().filter(|(criterion, _)| *criterion != LoadCriterion::ChipThickness).peekable();
        others.peek()?;
        if !self.is_cutting(found) {
            return Some(f64::INFINITY);
        }
        let bounded = self.bound_engagement(found);
        let feed = |limit: &(LoadCriterion, f64)| self.find_feed_for(&bounded, *limit, index, turning);
        Some(others.map(feed).fold(f64::INFINITY, f64::min))
    }

    /// Returns the largest feed that keeps a limit other than that of a chip; infinite where nothing is known of the tool.
    fn find_feed_for(
        &self,
        bounded: &Engagement,
        (criterion, limit): (LoadCriterion, f64),
        index: usize,
        turning: SpindleRotation,
    ) -> f64 {
        if criterion == LoadCriterion::RemovalRate {
            return bounded.feed_for_removal_rate_mm_min(limit);
        }
        let Some(model) = self.load_model(index, turning) else { return f64::INFINITY };
        if criterion.needs_stiffness() {
            model.feed_for_bending_mm_min(bounded, turning.rpm, limit_one_bending(criterion, limit))
        } else {
            model.feed_for_load_mm_min(bounded, turning.rpm, limit_one_load(criterion, limit))
        }
    }

    /// Returns the load of a piece at a feed: the best estimate, and an upper bound that includes what the
    /// grid may hide.
    pub(crate) fn measure_criterion(
        &self,
        criterion: LoadCriterion,
        found: &Engagement,
        (cutter, index): (&CutterModel, usize),
        feed: f64,
        turning: SpindleRotation,
    ) -> [f64; 2] {
        match criterion {
            LoadCriterion::ChipThickness => cutter.teeth.as_ref().map_or([0.0; 2], |teeth| {
                [
                    found.chip_thickness_mm(teeth, feed, turning.rpm),
                    found.chip_thickness_bound_mm(teeth, feed, turning.rpm),
                ]
            }),
            LoadCriterion::RemovalRate => {
                [found, &self.bound_engagement(found)].map(|found| found.removal_rate_mm3_min(feed))
            }
            LoadCriterion::Force | LoadCriterion::Torque | LoadCriterion::Power => {
                let Some(model) = self.load_model(index, turning) else { return [0.0; 2] };
                [found, &self.bound_engagement(found)]
                    .map(|found| pick_load(criterion, model.cutting_loads(found, feed, turning.rpm)))
            }
            LoadCriterion::Deflection | LoadCriterion::BendingStress => {
                let Some(model) = self.load_model(index, turning) else { return [0.0; 2] };
                [found, &self.bound_engagement(found)]
                    .map(|found| pick_bending(criterion, model.bending_loads(found, feed, turning.rpm)))
            }
        }
    }

    /// Bounds the loads other than chips from all that may be engaged.
    pub(crate) fn bound_contacts(
        &self,
        grids: &[ContactGrid],
        index: usize,
        feed_mm_min: f64,
        turning: SpindleRotation,
    ) -> ContactLoads {
        let swept_mm2 = bound_swept_area_mm2(grids);
        let needs_model = self.limits.iter().any(|(criterion, _)| criterion.needs_material());
        let model = self.load_model(index, turning).filter(|_| needs_model);
        let bound = model.map(|model| LoadBound::from_contacts(model, grids)).unwrap_or_default();
        let loads = bound.loads_at(feed_mm_min, turning.rpm);
        let bending = bound.bending_at(feed_mm_min, turning.rpm);
        let limit = |(criterion, limit): &(LoadCriterion, f64)| match criterion {
            LoadCriterion::ChipThickness => f64::INFINITY,
            LoadCriterion::RemovalRate => limit / swept_mm2,
            LoadCriterion::Deflection | LoadCriterion::BendingStress => {
                bound.feed_within_bending_mm_min(turning.rpm, limit_one_bending(*criterion, *limit))
            }
            _ => bound.feed_within_mm_min(turning.rpm, limit_one_load(*criterion, *limit)),
        };
        let load = |(criterion, _): &(LoadCriterion, f64)| match criterion {
            LoadCriterion::ChipThickness => 0.0,
            LoadCriterion::RemovalRate => swept_mm2 * feed_mm_min,
            LoadCriterion::Deflection | LoadCriterion::BendingStress => pick_bending(*criterion, bending),
            _ => pick_load(*criterion, loads),
        };
        ContactLoads {
            feed_limit_mm_min: self.limits.iter().map(limit).fold(f64::INFINITY, f64::min),
            bounds: self.limits.iter().map(load).collect(),
        }
    }

    fn load_model(&self, index: usize, turning: SpindleRotation) -> Option<&LoadModel> {
        let [clockwise, counter] = self.models.get(index)?.as_ref()?;
        Some(if turning.direction == SpindleDirection::Clockwise { clockwise } else { counter })
    }

    /// Returns the engagement with everything that the grid may have missed: fractions at their bounds, and
    /// half a cell more material on either side, or half a layer more above and below.
    fn bound_engagement(&self, found: &Engagement) -> Engagement {
        let mut bounded = found.clone();
        // Loads grow with every fraction and with the volume, so the bounds of both give bounds of the loads.
        bounded.bins.iter_mut().for_each(|bin| bin.advance_ratio = bin.advance_ratio_bound);
        // Half a cell (or layer) on either side makes an extent longer by one, so the volume grows by the
        // fraction resolution / extent.
        let more = |extent: f64, resolution: f64| {
            if extent > 0.0 { resolution / extent.max(resolution) } else { 0.0 }
        };
        match self.resolution {
            StockResolution::Cell(cell) => bounded.removed_mm3 *= 1.0 + more(found.radial_depth_mm(), cell),
            StockResolution::Layer(layer) => {
                bounded.removed_mm3 *= 1.0 + more(found.axial_depth_mm(), layer);
                // The position of the engagement on the flank does not change the load of a tooth, so the
                // layer is added above only.
                let engaged = bounded.bins.iter_mut().filter(|bin| bin.is_engaged() && bin.radial > 0.0);
                engaged.for_each(|bin| bin.high += layer as f32);
            }
        }
        bounded
    }
}

/// Returns loads that are infinite except for one limit.
fn limit_one_load(criterion: LoadCriterion, limit: f64) -> CuttingLoads {
    let mut loads =
        CuttingLoads { force_n: f64::INFINITY, torque_nm: f64::INFINITY, power_kw: f64::INFINITY };
    match criterion {
        LoadCriterion::Force => loads.force_n = limit,
        LoadCriterion::Torque => loads.torque_nm = limit,
        LoadCriterion::Power => loads.power_kw = limit,
        LoadCriterion::ChipThickness
        | LoadCriterion::RemovalRate
        | LoadCriterion::Deflection
        | LoadCriterion::BendingStress => {}
    }
    loads
}

/// Returns a bending that is infinite except for one limit.
fn limit_one_bending(criterion: LoadCriterion, limit: f64) -> BendingLoads {
    let free = BendingLoads { deflection_mm: f64::INFINITY, stress_mpa: f64::INFINITY };
    match criterion {
        LoadCriterion::Deflection => BendingLoads { deflection_mm: limit, ..free },
        LoadCriterion::BendingStress => BendingLoads { stress_mpa: limit, ..free },
        _ => free,
    }
}

fn pick_bending(criterion: LoadCriterion, loads: BendingLoads) -> f64 {
    if criterion == LoadCriterion::Deflection { loads.deflection_mm } else { loads.stress_mpa }
}

fn pick_load(criterion: LoadCriterion, loads: CuttingLoads) -> f64 {
    match criterion {
        LoadCriterion::Force => loads.force_n,
        LoadCriterion::Torque => loads.torque_nm,
        _ => loads.power_kw,
    }
}
