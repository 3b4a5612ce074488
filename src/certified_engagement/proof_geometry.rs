//! This module holds cutters and motions for the proof by points. It is written anew on purpose: it shares no
//! code with what bounds engagement, only the description of motions.

use super::block_motion::BlockMotion;
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// A cutter as its radius over its height, which must not be narrower above than below.
pub struct ProofCutter {
    radius: Box<dyn Fn(f64) -> f64 + Send + Sync>,
    height: f64,
}

impl ProofCutter {
    /// Makes a cutter from its radius in mm at a height above the tip in mm, which must not fall with the
    /// height, and the height of its cutting part.
    pub fn from_radius(radius: Box<dyn Fn(f64) -> f64 + Send + Sync>, height_mm: f64) -> Self {
        Self { radius, height: height_mm }
    }

    /// Returns the height of the cutting part, mm.
    pub fn height_mm(&self) -> f64 {
        self.height
    }

    /// Returns the largest radius, mm.
    pub fn largest_radius_mm(&self) -> f64 {
        (self.radius)(self.height)
    }

    /// Returns the radius at a height.
    pub(super) fn radius_at(&self, z: f64) -> f64 {
        (self.radius)(z.clamp(0.0, self.height))
    }

    /// Returns whether a place at (r, z) is at most so far outside, as far as a box around it tells.
    pub(super) fn may_hold(&self, r: f64, z: f64, more: f64) -> bool {
        let top = (z + more).min(self.height);
        z + more >= 0.0 && z - more <= self.height && r - more <= (self.radius)(top.max(0.0))
    }

    /// Returns whether a place at (r, z) is inside.
    pub(super) fn holds(&self, r: f64, z: f64) -> bool {
        (0.0..=self.height).contains(&z) && r <= (self.radius)(z)
    }
}

/// A motion whose places can be asked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct ProofMotion {
    from: Vector3<f64>,
    to: Vector3<f64>,
    axis: Vector3<f64>,
    turn_axis: Vector3<f64>,
    turn: f64,
    arc: Option<ProofArc>,
    pub cutter: usize,
    pub length: f64,
}

/// An arc or a helix of the tip.
#[derive(Debug, Clone, Copy)]
struct ProofArc {
    center: Vector3<f64>,
    normal: Vector3<f64>,
    swept: f64,
    rise: f64,
    /// The start as seen from the centre: along the normal, across it, and a quarter turn further.
    along: Vector3<f64>,
    across: Vector3<f64>,
    beside: Vector3<f64>,
    /// What is left between the arc's end and the motion's; it is spread evenly over the motion.
    missed: Vector3<f64>,
}

impl ProofArc {
    fn new(
        [center, normal]: [Vector3<f64>; 2],
        [swept, rise]: [f64; 2],
        [from, to]: [Vector3<f64>; 2],
    ) -> Self {
        let offset = from - center;
        let along = normal * offset.dot(&normal);
        let across = offset - along;
        let beside = normal.cross(&across);
        let arc = Self { center, normal, swept, rise, along, across, beside, missed: Vector3::zeros() };
        Self { missed: to - arc.tip(1.0), ..arc }
    }

    fn tip(&self, time: f64) -> Vector3<f64> {
        let (sin, cos) = (self.swept * time).sin_cos();
        let drift = self.normal * self.rise + self.missed;
        self.center + self.along + self.across * cos + self.beside * sin + drift * time
    }
}

/// Turns a vector about a unit axis (Rodrigues).
fn turn(vector: &Vector3<f64>, axis: &Vector3<f64>, angle: f64) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    vector * cos + axis.cross(vector) * sin + axis * axis.dot(vector) * (1.0 - cos)
}

impl ProofMotion {
    /// Makes the motion. An arc goes through both ends; its centre is the nearest one to that which is told.
    pub(super) fn new(motion: &BlockMotion) -> Self {
        let (from, to) = (motion.from.tip, motion.to.tip);
        let axis = motion.from.axis.normalize();
        let end = motion.to.axis.normalize();
        let cross = axis.cross(&end);
        let angle = cross.norm().atan2(axis.dot(&end));
        let (turn_axis, angle) =
            if angle > 1e-10 { (cross / cross.norm(), angle) } else { (Vector3::x(), 0.0) };
        let arc = motion.arc.map(|arc| {
            let flat = |vector: Vector3<f64>| vector - arc.normal * vector.dot(&arc.normal);
            let rise = (to - from).dot(&arc.normal);
            let missed = flat(arc.center + turn(&(from - arc.center), &arc.normal, arc.angle) - to).norm();
            let chord = flat(to - from);
            let (mut center, mut swept) = (arc.center, arc.angle);
            if chord.norm() > 1e-9 {
                let along = chord / chord.norm();
                let shift = along * ((from + to) / 2.0 - center).dot(&along);
                if shift.norm() <= 2.0 * missed {
                    center += shift;
                    let (a, b) = (flat(from - center), flat(to - center));
                    let least = arc.normal.dot(&a.cross(&b)).atan2(a.dot(&b));
                    swept = least + ((arc.angle - least) / TAU).round() * TAU;
                }
            }
            ProofArc::new([center, arc.normal], [swept, rise], [from, to])
        });
        let length = match &arc {
            None => (to - from).norm(),
            Some(arc) => (arc.across.norm() * arc.swept).hypot(arc.rise),
        };
        Self { from, to, axis, turn_axis, turn: angle, arc, cutter: motion.cutter, length }
    }

    /// Returns the tip and the axis at a time.
    pub(super) fn pose(&self, time: f64) -> (Vector3<f64>, Vector3<f64>) {
        let tip = match &self.arc {
            None => self.from + (self.to - self.from) * time,
            Some(arc) => arc.tip(time),
        };
        if self.turn == 0.0 {
            return (tip, self.axis);
        }
        (tip, turn(&self.axis, &self.turn_axis, self.turn * time))
    }

    /// Returns the velocity of a point that moves with the cutter, mm over the whole motion.
    pub(super) fn velocity(&self, point: &Vector3<f64>, time: f64) -> Vector3<f64> {
        let (tip, _) = self.pose(time);
        let of_tip = match &self.arc {
            None => self.to - self.from,
            Some(arc) => arc.normal.cross(&(tip - arc.center)) * arc.swept + arc.normal * arc.rise,
        };
        of_tip + self.turn_axis.cross(&(point - tip)) * self.turn
    }

    /// Returns by how much a fixed point moves as seen from the cutter, at the most, mm over the whole motion.
    pub(super) fn speed_at(&self, point: &Vector3<f64>) -> f64 {
        let way = self.length.max((self.to - self.from).norm());
        way * 1.001 + self.turn * ((point - self.from).norm() + way) + 1e-9
    }

    /// Returns the length that feeds refer to.
    pub(super) fn reference(&self, cutter: &ProofCutter) -> f64 {
        if self.length > 1e-7 {
            return self.length;
        }
        self.turn * cutter.largest_radius_mm().hypot(cutter.height_mm())
    }

    /// Returns the lowest and the highest corner of a box around all that the cutter sweeps.
    pub(super) fn bounds(&self, cutter: &ProofCutter) -> [Vector3<f64>; 2] {
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = Vector3::repeat(f64::NEG_INFINITY);
        let parts = 64;
        let reach = cutter.largest_radius_mm() + self.length / f64::from(parts);
        let reach = reach + self.turn * cutter.height_mm() / f64::from(parts) + 1e-3;
        for part in 0..=parts {
            let (tip, axis) = self.pose(f64::from(part) / f64::from(parts));
            for place in [tip, tip + axis * cutter.height_mm()] {
                low = low.inf(&place.add_scalar(-reach));
                high = high.sup(&place.add_scalar(reach));
            }
        }
        [low, high]
    }

    /// Returns whether a point may have been cut until a time. What is not decided counts as cut.
    pub(super) fn may_cut(&self, cutter: &ProofCutter, point: &Vector3<f64>, until: f64) -> bool {
        match self.nearest_at_level(point, until) {
            Some([r, z]) => cutter.may_hold(r, z, CLOSE_MM),
            None => self.may_cut_by_halving(cutter, point, until),
        }
    }

    /// Returns the least distance of a point from the axis, and its height above the tip, where the tip moves across a
    /// fixed axis: on a line, or on an arc about a parallel to the axis.
    fn nearest_at_level(&self, point: &Vector3<f64>, until: f64) -> Option<[f64; 2]> {
        if self.turn != 0.0 || (self.to - self.from).dot(&self.axis).abs() > LEVEL_MM {
            return None;
        }
        let offset = point - self.from;
        let z = offset.dot(&self.axis);
        let Some(arc) = &self.arc else {
            let way = (self.to - self.from) * until;
            let squared = way.norm_squared();
            let nearest = if squared > 0.0 { (offset.dot(&way) / squared).clamp(0.0, 1.0) } else { 0.0 };
            return Some([(offset - self.axis * z - way * nearest).norm(), z]);
        };
        if arc.normal.cross(&self.axis).norm() > 1e-10 || arc.missed.norm() > LEVEL_MM {
            return None;
        }
        let seen = point - arc.center;
        let seen = seen - arc.normal * seen.dot(&arc.normal);
        let ahead = arc.beside.dot(&seen).atan2(arc.across.dot(&seen)) * arc.swept.signum();
        let ahead = if ahead < 0.0 { ahead + TAU } else { ahead };
        if ahead <= arc.swept.abs() * until {
            return Some([(seen.norm() - arc.across.norm()).abs(), z]);
        }
        let (sin, cos) = (arc.swept * until).sin_cos();
        let from_end = (seen - arc.across * cos - arc.beside * sin).norm();
        Some([(seen - arc.across).norm().min(from_end), z])
    }

    fn may_cut_by_halving(&self, cutter: &ProofCutter, point: &Vector3<f64>, until: f64) -> bool {
        let speed = self.speed_at(point);
        let mut span = Some((0.0, until));
        // Most motions are told by one look, and need no list.
        let mut waiting = Vec::new();
        while let Some((from, to)) = span {
            let middle = (from + to) / 2.0;
            let (tip, axis) = self.pose(middle);
            let offset = point - tip;
            let z = offset.dot(&axis);
            let r = (offset - axis * z).norm();
            let reach = speed * (to - from) / 2.0;
            span = if !cutter.may_hold(r, z, reach + CLOSE_MM) {
                waiting.pop()
            } else if reach < CLOSE_MM / 4.0 || cutter.holds(r, z) {
                return true;
            } else {
                waiting.push((from, middle));
                Some((middle, to))
            };
        }
        false
    }
}

/// Points nearer than this (mm) to a sweep count as cut.
const CLOSE_MM: f64 = 2e-6;
/// Ways along the axis below this (mm), and what an arc misses, are within what counts as near.
const LEVEL_MM: f64 = 1e-7;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certified_engagement::{CutterPose, TipArc};

    /// Points on a lattice around a motion: the closed form and halving tell the same of each.
    #[test]
    fn level_motions_cut_what_halving_says() {
        let cutter = ProofCutter::from_radius(Box::new(|z| 2.0 + z.min(1.0)), 6.0);
        let axis = Vector3::new(0.2, -0.1, 1.0).normalize();
        let side = axis.cross(&Vector3::x()).normalize();
        let (mut cut, mut all) = (0, 0);
        for swept in [0.0, 0.4, -2.5, 5.9] {
            let from = Vector3::new(1.0, 2.0, 3.0);
            let center = from - side * 4.0;
            let to =
                if swept == 0.0 { from + side * 7.0 } else { center + turn(&(from - center), &axis, swept) };
            let arc = (swept != 0.0).then_some(TipArc { center, normal: axis, angle: swept });
            let pose = |tip| CutterPose { tip, axis };
            let motion = ProofMotion::new(&BlockMotion { from: pose(from), to: pose(to), arc, cutter: 0 });
            for number in 0..4000 {
                let part = |step: f64| (f64::from(number) * step).fract() * 15.0 - 7.5;
                let point = center + Vector3::new(part(0.618_034), part(0.754_878), part(0.569_840));
                let until = 0.3 + 0.7 * (f64::from(number) * 0.3247).fract();
                assert!(motion.nearest_at_level(&point, until).is_some());
                let told = motion.may_cut(&cutter, &point, until);
                assert_eq!(told, motion.may_cut_by_halving(&cutter, &point, until), "{swept} {point}");
                (cut, all) = (cut + usize::from(told), all + 1);
            }
        }
        assert!(cut > all / 20 && cut < all / 2, "{cut} of {all} are cut");
    }
}
