//! Cutting edges in elements, and the angles at which the teeth are looked at: what the force model needs of a cutter, once.

use std::f64::consts::{PI, TAU};

use super::engagement::BINS;
use super::{Meridian, Teeth};

/// Greatest turn of the normal, and of the helix, within an element; and the rotation from one look to the next: a bin.
const STEP: f64 = TAU / BINS as f64;

/// Most elements of one piece of the meridian; only an absurdly long and thin cutter has more.
const MOST: f64 = 4000.0;

/// A piece of the meridian, seen from its middle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EdgeElement {
    /// Length along the meridian at which it begins, mm.
    pub from: f64,
    /// Length at which it ends.
    pub to: f64,
    /// Distance from the axis, mm.
    r: f64,
    /// Sine and cosine of the normal's angle from straight down.
    normal: [f64; 2],
    /// Turn of the normal per length, 1/mm.
    curvature: f64,
    /// Sine and cosine of the angle by which the edge lags behind the tip here, positive to the left.
    pub lag: [f64; 2],
    /// The same angle in bins, 0..BINS.
    pub lag_bins: f64,
}

/// The part of an element that is engaged.
#[derive(Debug, Clone, Copy)]
pub(super) struct EngagedEdgePart {
    /// Its length, mm.
    pub length: f64,
    /// Distance of its middle from the axis, mm.
    pub r: f64,
    /// Sine of the normal's angle there.
    pub sin: f64,
    /// Cosine of the normal's angle.
    pub cos: f64,
    /// Turn of the normal per length, 1/mm.
    pub curvature: f64,
}

impl EdgeElement {
    /// What `low..=high` holds of it; `None` where it holds nothing. Second order in the element's turn.
    pub fn engaged_part(&self, low: f64, high: f64) -> Option<EngagedEdgePart> {
        let (from, to) = (self.from.max(low), self.to.min(high));
        if to <= from {
            return None;
        }
        let shift = (from + to - self.from - self.to) / 2.0;
        let [sin, cos] = self.normal;
        let turn = self.curvature * shift;
        Some(EngagedEdgePart {
            length: to - from,
            r: self.r + cos * shift,
            sin: sin + cos * turn,
            cos: cos - sin * turn,
            curvature: self.curvature,
        })
    }
}

/// The edge in elements from the tip upwards. `left` is 1 where lagging is to the left of the tooth (clockwise spindle), else -1.
///
/// The helix has a constant lead: at height z the edge lags by `z tan(helix) / R`, R the cutter's largest radius, on corners, balls
/// and tapers too.
pub(super) fn split_edge(profile: &Meridian, helix: f64, left: f64) -> Vec<EdgeElement> {
    let ends =
        [0.0, profile.bottom_arc_length_mm(), profile.flank_start_arc_length_mm(), profile.arc_length_mm()];
    let lag_per_height = lag_rad_per_mm(profile, helix);
    let mut elements = Vec::new();
    for (from, to) in ends.iter().zip(ends.iter().skip(1)).map(|(from, to)| (*from, *to)) {
        // A flat bottom and an edge have pieces of no length.
        if to - from <= 0.0 {
            continue;
        }
        let middle = (from + to) / 2.0;
        let turn =
            profile.point_at_arc_length(to - (to - from) * 1e-9).psi - profile.point_at_arc_length(from).psi;
        let rise = profile.point_at_arc_length(to).z - profile.point_at_arc_length(from).z;
        let count = (turn.max(rise * lag_per_height.abs()) / STEP).ceil().clamp(1.0, MOST);
        let curved = middle > profile.bottom_arc_length_mm() && middle < profile.flank_start_arc_length_mm();
        let curvature = if curved { 1.0 / profile.corner_radius_mm() } else { 0.0 };
        let step = (to - from) / count;
        for index in 0..count as usize {
            let from = from + index as f64 * step;
            let point = profile.point_at_arc_length(from + step / 2.0);
            let lag = left * point.z * lag_per_height;
            elements.push(EdgeElement {
                from,
                to: from + step,
                r: point.r,
                normal: point.psi.sin_cos().into(),
                curvature,
                lag: lag.sin_cos().into(),
                lag_bins: angle_in_bins(lag),
            });
        }
    }
    elements
}

/// Lag of the edge in radians per mm of height.
pub(super) fn lag_rad_per_mm(profile: &Meridian, helix: f64) -> f64 {
    helix.tan() / profile.radius_mm()
}

/// A tooth at one look.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ToothPosition {
    /// Which tooth.
    pub tooth: usize,
    /// Sine and cosine of its tip's angle from ahead, to the left.
    pub angle: [f64; 2],
    /// The angle from behind (where bin 0 begins) in bins, 0..BINS.
    pub bins: f64,
}

/// All teeth at each look of a revolution, `count()` of them a look; of one pitch where the teeth are even.
pub(super) fn list_tooth_positions(teeth: &Teeth, left: f64) -> Vec<ToothPosition> {
    let round = if teeth.is_even() { TAU / teeth.count() as f64 } else { TAU };
    let steps = (round / STEP).ceil().max(1.0);
    let trail = teeth.trail_angles_rad();
    let at = |step: usize| {
        // In the middle of a bin for the first tooth, where rounding decides nothing.
        let turned = (step as f64 + 0.5) * round / steps;
        trail.iter().enumerate().map(move |(tooth, trail)| {
            let angle = left * (trail - turned);
            ToothPosition { tooth, angle: angle.sin_cos().into(), bins: angle_in_bins(angle + PI) }
        })
    };
    (0..steps as usize).flat_map(at).collect()
}

/// An angle as a number of bins, 0..BINS.
fn angle_in_bins(angle: f64) -> f64 {
    (angle / TAU).rem_euclid(1.0) * BINS as f64
}
