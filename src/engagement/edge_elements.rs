//! This module cuts the cutting edge into elements and lists the angular positions of the teeth. The force
//! model needs both, once for each cutter.

use std::f64::consts::{PI, TAU};

use crate::cutter::{Meridian, Teeth};
use crate::engagement::engagement_bins::BINS;

/// The step in radians, equal to the width of a bin: the normal and the helix turn by at most this much
/// within an element, and the teeth rotate by at most this much from one position to the next.
const STEP: f64 = TAU / BINS as f64;

/// The most elements of one part of the meridian. Only an absurdly long and thin cutter has more.
const MOST: f64 = 4000.0;

/// A short piece of the cutting edge. All its values belong to its middle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct EdgeElement {
    /// The length along the meridian at which the element begins, mm.
    pub from: f64,
    /// The length along the meridian at which it ends, mm.
    pub to: f64,
    /// The distance of its middle from the axis, mm.
    r: f64,
    /// The height of its middle above the tip, mm.
    pub z: f64,
    /// The sine and cosine of the normal's angle from straight down.
    normal: [f64; 2],
    /// The turn of the normal per length along the meridian, 1/mm.
    curvature: f64,
    /// The sine and cosine of the angle by which the edge lags behind the tip here; positive to the left.
    pub lag: [f64; 2],
    /// The same angle in bins, from 0 to below `BINS`.
    pub lag_bins: f64,
}

/// The part of an element that is engaged. Its values belong to the middle of that part.
#[derive(Debug, Clone, Copy)]
pub(super) struct EngagedEdgePart {
    /// The length of the part along the meridian, mm.
    pub length: f64,
    /// The distance of its middle from the axis, mm.
    pub r: f64,
    /// The height of its middle above the tip, mm.
    pub z: f64,
    /// The sine of the normal's angle from straight down.
    pub sin: f64,
    /// The cosine of that angle.
    pub cos: f64,
    /// The turn of the normal per length along the meridian, 1/mm.
    pub curvature: f64,
}

impl EdgeElement {
    /// Returns the part of the element between two lengths along the meridian, or `None` if it has none
    /// there. The error is of second order in the element's turn.
    pub(super) fn engaged_part(&self, low: f64, high: f64) -> Option<EngagedEdgePart> {
        let (from, to) = (self.from.max(low), self.to.min(high));
        if to <= from {
            return None;
        }
        // First-order Taylor series of r and of the normal around the element's middle: dr/ds = cos psi and
        // dpsi/ds = curvature.
        let shift = (from + to - self.from - self.to) / 2.0;
        let [sin, cos] = self.normal;
        let turn = self.curvature * shift;
        Some(EngagedEdgePart {
            length: to - from,
            r: self.r + cos * shift,
            z: self.z + sin * shift,
            sin: sin + cos * turn,
            cos: cos - sin * turn,
            curvature: self.curvature,
        })
    }
}

/// Cuts the edge into elements from the tip upwards. `left` is 1 where a lagging edge is to the left of its
/// tooth (clockwise spindle), else -1.
///
/// The helix has a constant lead: at height z the edge lags by `z tan(helix) / R`, where R is the cutter's
/// largest radius. This also holds on corner radii, balls and tapers.
pub(super) fn split_edge(profile: &Meridian, helix: f64, left: f64) -> Vec<EdgeElement> {
    let ends =
        [0.0, profile.bottom_arc_length_mm(), profile.flank_start_arc_length_mm(), profile.arc_length_mm()];
    let lag_per_height = lag_rad_per_mm(profile, helix);
    let mut elements = Vec::new();
    for (from, to) in ends.iter().zip(ends.iter().skip(1)).map(|(from, to)| (*from, *to)) {
        // The bottom of a ball and the corner of a sharp cutter have no length.
        if to - from <= 0.0 {
            continue;
        }
        let middle = (from + to) / 2.0;
        // The normal jumps where the parts meet at a sharp edge, so its angle is read just before the end.
        let turn =
            profile.point_at_arc_length(to - (to - from) * 1e-9).psi - profile.point_at_arc_length(from).psi;
        let rise = profile.point_at_arc_length(to).z - profile.point_at_arc_length(from).z;
        let count = (turn.max(rise * lag_per_height.abs()) / STEP).ceil().clamp(1.0, MOST);
        let curved = middle > profile.bottom_arc_length_mm() && middle < profile.flank_start_arc_length_mm();
        let curvature = if curved { 1.0 / profile.corner_radius_mm() } else { 0.0 };
        let step = (to - from) / count;
        for index in 0..count as usize {
            // The values of the element's middle make the sum over elements a midpoint rule, of second order.
            let from = from + index as f64 * step;
            let point = profile.point_at_arc_length(from + step / 2.0);
            let lag = left * point.z * lag_per_height;
            elements.push(EdgeElement {
                from,
                to: from + step,
                r: point.r,
                z: point.z,
                normal: point.psi.sin_cos().into(),
                curvature,
                lag: lag.sin_cos().into(),
                lag_bins: angle_in_bins(lag),
            });
        }
    }
    elements
}

/// Returns the lag of the edge in radians per mm of height.
pub(super) fn lag_rad_per_mm(profile: &Meridian, helix: f64) -> f64 {
    helix.tan() / profile.radius_mm()
}

/// The angular position of one tooth at one rotation of the spindle.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ToothPosition {
    /// The index of the tooth.
    pub tooth: usize,
    /// The sine and cosine of its tip's angle, which counts from straight ahead to the left.
    pub angle: [f64; 2],
    /// The angle from straight behind, where bin 0 begins, in bins from 0 to below `BINS`.
    pub bins: f64,
}

/// Lists the positions of all teeth at each rotation step: `count()` entries a step. The steps cover one
/// pitch if the teeth are even, else a whole revolution.
pub(super) fn list_tooth_positions(teeth: &Teeth, left: f64) -> Vec<ToothPosition> {
    let round = if teeth.is_even() { TAU / teeth.count() as f64 } else { TAU };
    let steps = (round / STEP).ceil().max(1.0);
    let trail = teeth.trail_angles_rad();
    let at = |step: usize| {
        // The first tooth is in the middle of a bin, where rounding cannot move it to the next bin.
        let turned = (step as f64 + 0.5) * round / steps;
        trail.iter().enumerate().map(move |(tooth, trail)| {
            let angle = left * (trail - turned);
            ToothPosition { tooth, angle: angle.sin_cos().into(), bins: angle_in_bins(angle + PI) }
        })
    };
    (0..steps as usize).flat_map(at).collect()
}

/// Converts an angle in radians to bins, from 0 to below `BINS`.
fn angle_in_bins(angle: f64) -> f64 {
    (angle / TAU).rem_euclid(1.0) * BINS as f64
}
