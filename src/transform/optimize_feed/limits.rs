//! From what a piece of path engages to the largest feed that keeps every limit there, and to the loads at a feed.

use super::feeds::Load;
use super::parameters::Criterion;
use crate::machining::{Grain, Tooling};
use crate::program::record::SpindleDirection;
use crate::sim::{Cutter, Engagement, LoadModel, Loads, Material};

/// Removed volume below this share of a cell's cube is rounding, not material.
const SPECK: f64 = 1e-3;

/// Limits, and what is needed to see whether they hold.
#[derive(Debug)]
pub(super) struct Limits {
    limits: Vec<(Criterion, f64)>,
    models: Vec<Option<[LoadModel; 2]>>,
    grain: Grain,
}

/// The spindle while a piece is cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turning {
    /// rev/min, above 0.
    pub rpm: f64,
    pub direction: SpindleDirection,
}

impl Limits {
    /// `limits` in millimetres; `material` where a criterion needs it.
    pub fn new(
        limits: Vec<(Criterion, f64)>,
        tooling: &Tooling,
        material: Option<Material>,
        grain: Grain,
    ) -> Self {
        let models = material.map(|material| tooling.load_models(material)).unwrap_or_default();
        Self { limits, models, grain }
    }

    /// The limits.
    pub fn all(&self) -> &[(Criterion, f64)] {
        &self.limits
    }

    /// Whether a piece cuts more than rounding leaves.
    pub fn cuts(&self, found: &Engagement) -> bool {
        let speck = match self.grain {
            Grain::Cell(cell) => SPECK * cell.powi(3),
            // Films are none of a chip's pieces.
            Grain::Layer(_) => 0.0,
        };
        found.removed_mm3 > speck
    }

    /// The load of a piece that a cutter engages.
    pub fn load(&self, found: &Engagement, cutter: &Cutter, index: usize, turning: Turning) -> Load {
        if !self.cuts(found) && found.graze <= 0.0 {
            return Load::Air;
        }
        let feed = |(criterion, limit): &(Criterion, f64)| match criterion {
            Criterion::ChipThickness => {
                let teeth = cutter.teeth.as_ref();
                teeth.map_or(f64::INFINITY, |teeth| found.feed_for_chip(teeth, turning.rpm, *limit))
            }
            Criterion::RemovalRate => self.bounded(found).feed_for_removal_rate(*limit),
            Criterion::Force | Criterion::Torque | Criterion::Power => {
                let Some(model) = self.model(index, turning) else { return f64::INFINITY };
                model.feed_for_load(&self.bounded(found), turning.rpm, only(*criterion, *limit))
            }
        };
        Load::Limit(self.limits.iter().map(feed).fold(f64::INFINITY, f64::min))
    }

    /// How much of a criterion a piece has at a feed: the best estimate, and not below what the grid may hide.
    pub fn measure(
        &self,
        criterion: Criterion,
        found: &Engagement,
        (cutter, index): (&Cutter, usize),
        feed: f64,
        turning: Turning,
    ) -> [f64; 2] {
        match criterion {
            Criterion::ChipThickness => cutter.teeth.as_ref().map_or([0.0; 2], |teeth| {
                [
                    found.chip_thickness(teeth, feed, turning.rpm),
                    found.chip_thickness_bound(teeth, feed, turning.rpm),
                ]
            }),
            Criterion::RemovalRate => {
                [found, &self.bounded(found)].map(|found| found.removal_rate_mm3_min(feed))
            }
            Criterion::Force | Criterion::Torque | Criterion::Power => {
                let Some(model) = self.model(index, turning) else { return [0.0; 2] };
                [found, &self.bounded(found)]
                    .map(|found| of(criterion, model.loads(found, feed, turning.rpm)))
            }
        }
    }

    fn model(&self, index: usize, turning: Turning) -> Option<&LoadModel> {
        let [clockwise, counter] = self.models.get(index)?.as_ref()?;
        Some(if turning.direction == SpindleDirection::Clockwise { clockwise } else { counter })
    }

    /// The engagement with everything that the grid may have missed: shares at their bounds, and half a cell of ground more on
    /// either side, or half a layer more above and below.
    fn bounded(&self, found: &Engagement) -> Engagement {
        let mut bounded = found.clone();
        bounded.bins.iter_mut().for_each(|bin| bin.share = bin.share_bound);
        let more = |extent: f64, grain: f64| if extent > 0.0 { grain / extent.max(grain) } else { 0.0 };
        match self.grain {
            Grain::Cell(cell) => bounded.removed_mm3 *= 1.0 + more(found.radial_depth_mm(), cell),
            Grain::Layer(layer) => {
                bounded.removed_mm3 *= 1.0 + more(found.axial_depth_mm(), layer);
                // A tooth bears the same wherever on the flank it is engaged.
                let engaged = bounded.bins.iter_mut().filter(|bin| bin.is_engaged() && bin.radial > 0.0);
                engaged.for_each(|bin| bin.high += layer as f32);
            }
        }
        bounded
    }
}

/// Loads of which only one has a limit.
fn only(criterion: Criterion, limit: f64) -> Loads {
    let mut loads = Loads { force_n: f64::INFINITY, torque_nm: f64::INFINITY, power_kw: f64::INFINITY };
    match criterion {
        Criterion::Force => loads.force_n = limit,
        Criterion::Torque => loads.torque_nm = limit,
        Criterion::Power => loads.power_kw = limit,
        Criterion::ChipThickness | Criterion::RemovalRate => {}
    }
    loads
}

fn of(criterion: Criterion, loads: Loads) -> f64 {
    match criterion {
        Criterion::Force => loads.force_n,
        Criterion::Torque => loads.torque_nm,
        _ => loads.power_kw,
    }
}
