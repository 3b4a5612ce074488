//! This module holds how far the sweep of a step extends.

use super::cutter_contour::CutterContour;
use super::cutter_pose::PathRef;
use super::swept_step::SweptStep;
use nalgebra::Vector3;

/// The least z of an axis of which a part below a height is looked at.
const FLATTEST_AXIS: f64 = 0.1;

impl SweptStep {
    /// Returns a disc over which the sweep below the height `top` stands, and its lowest height: x, y, radius, z.
    pub(super) fn footprint(&self, contour: &CutterContour, top: f64) -> [f64; 4] {
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
        let [low, high] = self.bounds(contour, top);
        let middle = (low + high) / 2.0;
        [middle.x, middle.y, (high - low).xy().norm() / 2.0, low.z]
    }

    /// Returns the height of the flat bottom, if the step has one height and its bottom reaches over all places within a
    /// distance of a path at some times. Above that height all these places are in the sweep, so that whatever another step
    /// that stays above it removes of them is removed by this one.
    pub(super) fn flat_bottom_over(
        &self,
        contour: &CutterContour,
        (path, spread): (PathRef<'_>, f64),
        need: [f64; 2],
    ) -> Option<f64> {
        let flat = contour.flat_radius_mm();
        if flat <= spread || !self.is_upright() || !self.is_level() || self.path_deviation > 0.0 {
            return None;
        }
        let half = path.speed() * (need[1] - need[0]) / 2.0;
        let apart = self.to_body_vector(&(path.at((need[0] + need[1]) / 2.0) - self.tips[0]));
        if apart.z + spread + half > contour.height_mm() {
            return None;
        }
        let distance = match &self.flat {
            Some(arc) => arc.distance(&apart.xy()),
            None => self.segment.distance(&apart.xy()),
        };
        (distance + half + spread + self.side_deviation <= flat).then(|| self.tips[0].z.max(self.tips[1].z))
    }

    /// Returns how high above the tip the cutter reaches places below the height `top`, mm, at the most.
    fn length_below(&self, contour: &CutterContour, top: f64) -> f64 {
        let [start, end] = self.axes.map(|axis| axis.z);
        let steepness = start.min(end) - self.turn;
        if steepness < FLATTEST_AXIS {
            return contour.height_mm();
        }
        let across = contour.radius_mm() * (1.0 - steepness * steepness).max(0.0).sqrt();
        let deviation = self.line_deviation(contour.radius_mm(), 1.0) + self.side_deviation;
        let lowest = self.tips[0].z.min(self.tips[1].z) - deviation;
        ((top - lowest + across + 1e-3) / steepness).clamp(0.0, contour.height_mm())
    }

    /// Returns the lowest and the highest corner of a box around the part of the sweep that is below the height `top`.
    /// A long cutter that leans stands over much that it cannot touch, since the stock ends below.
    pub(super) fn bounds(&self, contour: &CutterContour, top: f64) -> [Vector3<f64>; 2] {
        let height = self.length_below(contour, top);
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
