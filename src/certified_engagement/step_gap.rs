//! This module holds the gap of a fixed point over a whole step.

use super::convex_times::PointFamily;
use super::cutter_contour::CutterContour;
use super::cutter_pose::PointLine;
use super::swept_step::SweptStep;
use nalgebra::Vector3;

impl SweptStep {
    /// Returns the least gap of a fixed point over the step, mm, from below or above by what is uncertain.
    pub(super) fn gap_of(&self, contour: &CutterContour, point: &Vector3<f64>) -> f64 {
        self.gap_aside_of(contour, point, 0.0)
    }

    /// Returns the least gap of a fixed point that is `aside` mm further from the fixed axis.
    pub(super) fn gap_aside_of(&self, contour: &CutterContour, point: &Vector3<f64>, aside: f64) -> f64 {
        let still = PointLine::still(*point);
        if self.turn > 0.0 {
            let (family, deviation) = self.family_of_turning(&still, [0.0, 1.0], 0.0);
            return family.least_gap(contour, 0.0, 1e-10)
                - deviation
                - self.path_deviation
                - self.side_deviation;
        }
        let base = self.to_body_vector(&(point - self.tips[0]));
        if let Some(flat) = &self.flat {
            let apart = (flat.distance(&base.xy()) + aside).max(0.0);
            return contour.gap(&Vector3::new(apart, 0.0, base.z)).0;
        }
        let aside = aside - self.side_deviation;
        let family = PointFamily { base, travel: Vector3::zeros(), slide: self.slide, aside };
        family.least_gap(contour, 0.0, 1e-10) - self.path_deviation
    }

    /// Returns by how much the gap of a point may be off at the most, mm, for points up to `more` mm away.
    pub(super) fn gap_uncertainty(&self, point: &Vector3<f64>, more: f64) -> f64 {
        let way = (self.tips[1] - self.tips[0]).norm();
        let distance = (point - self.tips[0]).norm() + way + more;
        let bend = (self.turn * self.turn * (distance + way) + 2.0 * self.turn * way) / 8.0;
        bend + self.path_deviation + self.side_deviation
    }
}
