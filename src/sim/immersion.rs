//! Depths and angles of an engagement, in the terms that machinists use.

use super::{Engagement, Meridian};
use crate::program::record::SpindleDirection;

/// A motion whose part across the tool axis is below this goes along the axis: the angle of travel is noise there.
const ALONG_AXIS: f64 = 1e-6;

impl Engagement {
    /// Angles in degrees at which a tooth enters and leaves the material, counted with the rotation from the side where an up-milling
    /// tooth enters: for a clockwise spindle from the left of the feed, 90 straight ahead, 180 at the right (Altintas,
    /// Manufacturing Automation, 2nd ed., sec. 2.3). Up milling starts at 0, down milling ends at 180, a slot is 0..180.
    ///
    /// Taken from the lateral extent of the removed ground at the largest engaged radius, so what hides behind an island is not
    /// told apart; as exact as the extent. A motion along the axis has 0..360. `None` in air.
    pub fn immersion_deg(&self, profile: &Meridian, spindle: SpindleDirection) -> Option<[f64; 2]> {
        if !self.has_removed_material() {
            return None;
        }
        if self.across < ALONG_AXIS {
            return Some([0.0, 360.0]);
        }
        let [low, high] = self.height;
        let [right, left] = self.lateral;
        if low > high || right > left {
            return None;
        }
        let radius = profile.radius_at_height_mm(high);
        if radius <= 0.0 {
            return None;
        }
        let from_ahead = |lateral: f64| (lateral / radius).clamp(-1.0, 1.0).asin().to_degrees();
        Some(match spindle {
            SpindleDirection::Clockwise => [90.0 - from_ahead(left), 90.0 - from_ahead(right)],
            SpindleDirection::CounterClockwise => [90.0 + from_ahead(right), 90.0 + from_ahead(left)],
        })
    }

    /// Height of the engaged part of the cutter along its axis, mm; 0 in air.
    pub fn axial_depth_mm(&self) -> f64 {
        interval_length_mm(self.height)
    }

    /// Width of the removed ground across the path and the tool axis, mm; 0 in air.
    pub fn radial_depth_mm(&self) -> f64 {
        interval_length_mm(self.lateral)
    }
}

/// Length of an interval; 0 for none.
fn interval_length_mm([least, greatest]: [f64; 2]) -> f64 {
    if greatest >= least { greatest - least } else { 0.0 }
}
