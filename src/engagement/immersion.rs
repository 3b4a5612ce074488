//! This module gives the depths and angles of an engagement in the terms of machinists.

use crate::cutter::Meridian;
use crate::engagement::Engagement;
use crate::program::record::SpindleDirection;

/// A motion whose part across the tool axis is below this counts as a motion along the axis, since its
/// lateral direction is only noise.
const ALONG_AXIS: f64 = 1e-6;

impl Engagement {
    /// Returns the angles in degrees at which a tooth enters and leaves the material. They count in the
    /// direction of rotation, from the side where a tooth enters in up milling: for a clockwise spindle 0 is
    /// at the left of the feed, 90 straight ahead and 180 at the right (Altintas, Manufacturing Automation,
    /// 2nd ed., sec. 2.3). Up milling starts at 0, down milling ends at 180, and a slot has 0 to 180.
    ///
    /// The angles come from the lateral extent of the removed material at the largest engaged radius, so gaps
    /// within the extent are not seen, and the angles are as exact as the extent. A motion along the axis has
    /// 0 to 360. Returns `None` in air.
    pub fn immersion_deg(&self, profile: &Meridian, spindle: SpindleDirection) -> Option<[f64; 2]> {
        if !self.has_removed_material() {
            return None;
        }
        if self.across < ALONG_AXIS {
            return Some([0.0, 360.0]);
        }
        let [low, high] = self.height_mm;
        let [right, left] = self.lateral_mm;
        if low > high || right > left {
            return None;
        }
        let radius = profile.radius_at_height_mm(high);
        if radius <= 0.0 {
            return None;
        }
        // A point at lateral distance q on radius R has the angle asin(q / R) from straight ahead.
        let from_ahead = |lateral: f64| (lateral / radius).clamp(-1.0, 1.0).asin().to_degrees();
        Some(match spindle {
            SpindleDirection::Clockwise => [90.0 - from_ahead(left), 90.0 - from_ahead(right)],
            SpindleDirection::CounterClockwise => [90.0 + from_ahead(right), 90.0 + from_ahead(left)],
        })
    }

    /// Returns the height of the engaged part of the cutter along its axis, mm; 0 in air.
    pub fn axial_depth_mm(&self) -> f64 {
        interval_length_mm(self.height_mm)
    }

    /// Returns the width of the removed material across the path and the tool axis, mm; 0 in air.
    pub fn radial_depth_mm(&self) -> f64 {
        interval_length_mm(self.lateral_mm)
    }
}

/// Returns the length of an interval, or 0 if it is empty.
fn interval_length_mm([least, greatest]: [f64; 2]) -> f64 {
    if greatest >= least { greatest - least } else { 0.0 }
}
