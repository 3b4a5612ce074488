//! This module holds how far the sweep of a step extends.

use super::cutter_contour::CutterContour;
use super::swept_step::SweptStep;
use nalgebra::Vector3;

impl SweptStep {
    /// Returns a disc over which the sweep stands, and its lowest height: x, y, radius, z.
    pub(super) fn footprint(&self, contour: &CutterContour) -> [f64; 4] {
        if self.is_upright() {
            let middle = (self.tips[0] + self.tips[1]) / 2.0;
            let half =
                (self.tips[1] - self.tips[0]).xy().norm() / 2.0 + self.path_deviation + self.side_deviation;
            return [
                middle.x,
                middle.y,
                half + contour.radius_mm() + 1e-5,
                self.tips[0].z.min(self.tips[1].z) - self.path_deviation - 1e-5,
            ];
        }
        let [low, high] = self.bounds(contour);
        let middle = (low + high) / 2.0;
        [middle.x, middle.y, (high - low).xy().norm() / 2.0, low.z]
    }

    /// Returns the lowest and the highest corner of a box around the sweep.
    pub(super) fn bounds(&self, contour: &CutterContour) -> [Vector3<f64>; 2] {
        let height = contour.height_mm();
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = Vector3::repeat(f64::NEG_INFINITY);
        let mut add = |tip: &Vector3<f64>, axis: &Vector3<f64>| {
            for center in [*tip, tip + axis * height] {
                let across = axis.map(|part| contour.radius_mm() * (1.0 - part * part).max(0.0).sqrt());
                low = low.inf(&(center - across));
                high = high.sup(&(center + across));
            }
        };
        for (tip, axis) in self.tips.iter().zip(&self.axes) {
            add(tip, axis);
        }
        if let (Some(_), Some(arc)) = (&self.flat, &self.arc) {
            // The arc may bulge beyond the box of its ends.
            let offset = self.tips[0] - arc.center;
            let offset = offset - arc.normal * offset.dot(&arc.normal);
            let second = arc.normal.cross(&offset);
            for (a, b) in offset.iter().zip(second.iter()) {
                for half_turn in -1..=1 {
                    let angle = b.atan2(*a) + f64::from(half_turn) * std::f64::consts::PI;
                    let share = angle / arc.angle;
                    if (0.0..=1.0).contains(&share) {
                        add(&self.tip_at(share), &self.axes[0]);
                    }
                }
            }
        }
        let reach = height.hypot(contour.radius_mm());
        let margin = Vector3::repeat(
            self.line_deviation(reach, 1.0) + self.side_deviation + self.turn * contour.radius_mm() + 1e-3,
        );
        [low - margin, high + margin]
    }
}
