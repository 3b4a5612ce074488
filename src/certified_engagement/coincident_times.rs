//! This module finds when a cutter is where an equal cutter was.

use super::cutter_pose::TipArc;
use super::level_times::times_within_capsule;
use super::swept_step::SweptStep;
use nalgebra::Vector3;

impl SweptStep {
    /// Returns the times at which the whole cutter of `own` is where this step's equal cutter was, to
    /// `apart` mm.
    pub(super) fn times_coincident(&self, own: &Self, apart: f64) -> Option<[f64; 2]> {
        let is_fixed = self.turn == 0.0 && own.turn == 0.0 && self.axes[0] == own.axes[0];
        if self.cutter != own.cutter || !is_fixed {
            return None;
        }
        if let (Some(arc), Some(own_arc)) = (&self.arc, &own.arc) {
            return self.times_on_arc(arc, own, own_arc, apart);
        }
        if self.arc.is_some() || own.arc.is_some() {
            return None;
        }
        let start = own.tips[0] - self.tips[0];
        let (travel, way) = (own.tips[1] - own.tips[0], self.tips[1] - self.tips[0]);
        times_within_capsule(start, travel, way, apart)
    }

    /// Returns the times at which the own tip is on this step's arc. The arcs must lie on one circle,
    /// without a rise.
    fn times_on_arc(&self, arc: &TipArc, own: &Self, own_arc: &TipArc, apart: f64) -> Option<[f64; 2]> {
        let normal = own_arc.normal;
        let sense = normal.dot(&arc.normal);
        let rises = [self, own].map(|step| (step.tips[1] - step.tips[0]).dot(&normal).abs());
        let across = |vector: Vector3<f64>| vector - normal * vector.dot(&normal);
        let (offset, own_offset) = (across(self.tips[0] - arc.center), across(own.tips[0] - own_arc.center));
        let error = across(arc.center - own_arc.center).norm()
            + (offset.norm() - own_offset.norm()).abs()
            + (self.tips[0] - own.tips[0]).dot(&normal).abs()
            + self.slip.norm()
            + own.slip.norm()
            + rises[0]
            + rises[1]
            + arc.normal.cross(&normal).norm() * offset.norm();
        if error > apart || own_arc.angle == 0.0 {
            return None;
        }
        let first = normal.dot(&own_offset.cross(&offset)).atan2(own_offset.dot(&offset));
        let last = first + arc.angle * sense.signum();
        let turns = [0.0, std::f64::consts::TAU, -std::f64::consts::TAU];
        turns.into_iter().find_map(|turn| {
            let times = [(first + turn) / own_arc.angle, (last + turn) / own_arc.angle];
            // What the error leaves of the distance may be used along the arc, so that neighbours overlap.
            let more = (apart - error) / (own_arc.angle.abs() * own_offset.norm()).max(apart);
            let times = [times[0].min(times[1]) - more, times[0].max(times[1]) + more];
            (times[1] >= 0.0 && times[0] <= 1.0).then_some(times)
        })
    }
}
