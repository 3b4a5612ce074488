//! This module holds how fast the points of a cutter's surface advance along their normals.
//!
//! The share of a point is the speed of the point along its outward normal, divided by the speed that feeds
//! refer to. In the cutter's frame, with the normal's angle k from straight down and the direction phi
//! around the axis, a fixed axis gives sin k cos(phi) times the way across the axis minus cos k times the
//! way along it. A turn adds rotation x arm; along the normal of a surface of revolution that is (r cos k +
//! z sin k) times the turn's part in the direction of phi.

use super::contour_element::ContourElement;
use super::swept_step::SweptStep;
use nalgebra::{Rotation3, Unit, Vector2, Vector3};

/// The velocities of a step in the cutter's frame, as multiples of the reference speed.
#[derive(Debug, Clone, Copy)]
pub(super) struct AdvanceField {
    /// The tip's velocity at the start and at the end.
    ends: [Vector3<f64>; 2],
    /// The direction in which a turn lets points at the height of 1 mm advance, times the turn.
    spin: Vector2<f64>,
    /// How much larger a share may be between the ends.
    slack: f64,
    /// 1 where the slack is proportional to the time, 0 where to its square.
    least_part: f64,
    /// The axis in the cutter's frame and the angle by which the tip's velocity turns.
    bend: (Vector3<f64>, f64),
    is_constant: bool,
}

impl AdvanceField {
    /// Makes the field of a step whose feed refers to `reference` mm of path.
    pub(super) fn new(step: &SweptStep, reference: f64) -> Self {
        let chord = step.tips[1] - step.tips[0];
        let axis = step.to_body_vector(&step.turn_axis);
        let (tip, bend) = match step.arc {
            // Points that are followed around the arc's axis see the same velocity at all times.
            Some(arc) if step.flat.is_some() => {
                (arc.normal.cross(&(step.tips[0] - arc.center)) * arc.angle, (axis, 0.0))
            }
            Some(arc) => {
                let rise = arc.normal * chord.dot(&arc.normal);
                let tangent = arc.normal.cross(&(step.tips[0] - arc.center)) * arc.angle + rise + step.slip;
                (tangent, (step.to_body_vector(&arc.normal), arc.angle))
            }
            // Seen from the turning cutter, the constant velocity turns the other way.
            None => (chord, (axis, -step.turn)),
        };
        let first = step.to_body_vector(&tip) / reference;
        let last = turn_about(&bend, 1.0) * first;
        let spin = axis.cross(&Vector3::z()).xy() * (step.turn / reference);
        let is_constant = bend.1 == 0.0;
        let angle = bend.1.abs() + if step.arc.is_some() { step.turn } else { 0.0 };
        // Between the ends a turning vector is at most |v| angle²/8 beyond its chord. An arc with a turning
        // axis turns about two axes; then the whole angle is the slack.
        let both = step.arc.is_some() && step.turn > 0.0;
        let slack = if both { angle * first.norm() } else { angle * angle / 8.0 * first.norm() };
        let slack = slack + step.slip.norm() / reference * bend.1.abs();
        let least_part = if both || step.slip != Vector3::zeros() { 1.0 } else { 0.0 };
        Self { ends: [first, last], spin, slack, least_part, bend, is_constant }
    }

    /// Returns a share that no point of a patch exceeds at some times. `angles` are the directions around
    /// the axis.
    pub(super) fn upper(
        &self,
        element: &ContourElement,
        range: [f64; 2],
        angles: [f64; 2],
        times: [f64; 2],
    ) -> f64 {
        let [first, _] = &self.ends;
        if self.is_constant {
            let most = self.upper_at(element, range, angles, first);
            return most + most.abs() * 1e-12;
        }
        let at = |time: f64| self.upper_at(element, range, angles, &(turn_about(&self.bend, time) * first));
        let most = at(times[0]).max(at(times[1]));
        let part = times[1] - times[0];
        most + self.slack * part * part.max(self.least_part) + most.abs() * 1e-12
    }

    /// Returns a share that is at least the mean over a range of angles, at any place of a range and any of some times.
    pub(super) fn mean_upper(
        &self,
        element: &ContourElement,
        range: [f64; 2],
        angles: [f64; 2],
        times: [f64; 2],
    ) -> f64 {
        let [first, _] = &self.ends;
        let middle = (angles[0] + angles[1]) / 2.0;
        // A share is a constant plus a multiple of the cosine of the angle from the heading. Where that cosine is positive
        // the share is concave, so that its mean is at most the share in the middle.
        let is_concave = angles.iter().all(|angle| first.x * angle.cos() + first.y * angle.sin() >= 0.0);
        if self.is_constant && self.spin == Vector2::zeros() && is_concave {
            return self.upper(element, range, [middle, middle], times);
        }
        self.upper(element, range, angles, times)
    }

    /// Returns the velocity of the tip at a time in the cutter's frame, and the spin, as multiples of the reference speed.
    pub(super) fn velocities_at(&self, time: f64) -> (Vector3<f64>, Vector2<f64>) {
        let [first, _] = &self.ends;
        let tip = if self.is_constant { *first } else { turn_about(&self.bend, time) * first };
        (tip, self.spin)
    }

    /// Returns whether shares do not depend on time.
    pub(super) fn is_constant(&self) -> bool {
        self.is_constant
    }

    /// Returns how much the tip's velocity changes between two times, as a part of the reference speed.
    pub(super) fn change(&self, times: [f64; 2]) -> f64 {
        let both = self.least_part * self.slack * 2.0;
        (self.bend.1.abs() * self.ends[0].norm() + both) * (times[1] - times[0])
    }

    fn upper_at(
        &self,
        element: &ContourElement,
        range: [f64; 2],
        angles: [f64; 2],
        tip: &Vector3<f64>,
    ) -> f64 {
        let across = tip.xy();
        match element {
            ContourElement::Line { normal: [sin, up], .. } => {
                let at = |m: f64| {
                    let [r, z] = element.point(m);
                    most_along(across * *sin + self.spin * (z * sin - r * up), angles)[1] + up * tip.z
                };
                if self.spin == Vector2::zeros() { at(range[0]) } else { at(range[0]).max(at(range[1])) }
            }
            ContourElement::Arc { center: [e, f], .. } => {
                let [_, sine] = most_along(across + self.spin * *f, angles);
                let [low, high] =
                    if self.spin == Vector2::zeros() { [0.0; 2] } else { most_along(self.spin * *e, angles) };
                largest_mixture(sine, high - tip.z, range).max(if range[1] > 1.57 {
                    largest_mixture(sine, low - tip.z, range)
                } else {
                    f64::NEG_INFINITY
                })
            }
        }
    }

    /// Returns the share of one point of a cutter whose shares do not depend on time.
    pub(super) fn constant_share(&self, element: &ContourElement, m: f64, angle: f64) -> f64 {
        let [first, _] = &self.ends;
        let [sin, up] = element.normal(m);
        (first.x * angle.cos() + first.y * angle.sin()) * sin + first.z * up
    }

    /// Returns the direction around the axis in which the cutter advances most.
    pub(super) fn heading(&self) -> f64 {
        let [first, last] = &self.ends;
        let across = first.xy() + last.xy();
        if across.norm() > 1e-9 { across.y.atan2(across.x) } else { self.spin.y.atan2(self.spin.x) }
    }
}

fn turn_about((axis, angle): &(Vector3<f64>, f64), share: f64) -> Rotation3<f64> {
    Rotation3::from_axis_angle(&Unit::new_unchecked(*axis), angle * share)
}

/// Returns the least and the largest product of a vector with the unit vectors of a range of angles.
pub(super) fn most_along(vector: Vector2<f64>, [from, to]: [f64; 2]) -> [f64; 2] {
    let length = vector.norm();
    if length == 0.0 {
        return [0.0, 0.0];
    }
    let ends = [from, to].map(|angle| vector.x * angle.cos() + vector.y * angle.sin());
    let toward = vector.y.atan2(vector.x);
    let holds = |angle: f64| {
        let turns = ((from - angle) / std::f64::consts::TAU).ceil();
        angle + turns * std::f64::consts::TAU <= to
    };
    let high = if holds(toward) { length } else { ends[0].max(ends[1]) };
    let low = if holds(toward + std::f64::consts::PI) { -length } else { ends[0].min(ends[1]) };
    [low, high]
}

/// Returns the largest a sin k + b cos k for k in a range within [0, pi].
pub(super) fn largest_mixture(a: f64, b: f64, [from, to]: [f64; 2]) -> f64 {
    let best = a.atan2(b);
    if best >= from && best <= to {
        return a.hypot(b);
    }
    let at = |angle: f64| a * angle.sin() + b * angle.cos();
    at(from).max(at(to))
}
