//! This module finds the times at which a moving point is within a distance of a segment, in closed form.
//!
//! In a plane this is a line against a stadium, which is what a cutter that moves across its axis covers at
//! one height. In space it is a line against a capsule. Both are convex, so the times are one interval: the
//! hull of the intervals of their parts.

use nalgebra::{Vector2, Vector3};

/// Squared speeds below this (mm² over the whole time) count as standing still.
const STILL_SQUARED: f64 = 1e-24;

/// A segment from the origin in a plane, prepared for many lines.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PlaneSegment {
    to: Vector2<f64>,
    direction: Vector2<f64>,
    length: f64,
}

impl PlaneSegment {
    /// Makes the segment from the origin to a point.
    pub(super) fn new(to: Vector2<f64>) -> Self {
        let length = to.norm();
        let direction = if length > 0.0 { to / length } else { Vector2::new(1.0, 0.0) };
        Self { to, direction, length }
    }

    /// Returns the end that is not the origin.
    pub(super) fn to(&self) -> Vector2<f64> {
        self.to
    }

    /// Returns the distance of a place from the segment.
    pub(super) fn distance(&self, place: &Vector2<f64>) -> f64 {
        (place - self.direction * place.dot(&self.direction).clamp(0.0, self.length)).norm()
    }

    /// Returns the times at which the point `start + t travel` is at most `radius` from the segment.
    #[inline]
    pub(super) fn times_within(
        &self,
        start: Vector2<f64>,
        travel: Vector2<f64>,
        radius: f64,
    ) -> Option<[f64; 2]> {
        let squared = travel.norm_squared();
        let along = start.dot(&self.direction);
        let across = start.x * self.direction.y - start.y * self.direction.x;
        if squared < STILL_SQUARED {
            let beyond = (-along).max(along - self.length).max(0.0);
            let inside = beyond * beyond + across * across <= radius * radius && radius >= 0.0;
            return inside.then_some([f64::NEG_INFINITY, f64::INFINITY]);
        }
        if radius < 0.0 {
            return None;
        }
        let along_rate = travel.dot(&self.direction);
        let across_rate = travel.x * self.direction.y - travel.y * self.direction.x;
        let mut hull: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
        let mut add = |from: f64, to: f64| hull = [hull[0].min(from), hull[1].max(to)];
        for offset in [start, start - self.to] {
            let cross = offset.x * travel.y - offset.y * travel.x;
            let root = radius * radius * squared - cross * cross;
            if root >= 0.0 {
                let (middle, half) = (-offset.dot(&travel) / squared, root.sqrt() / squared);
                add(middle - half, middle + half);
            }
        }
        if self.length > 0.0 {
            let band = times_between(across, across_rate, -radius, radius);
            let length = times_between(along, along_rate, 0.0, self.length);
            if let (Some([a, b]), Some([c, d])) = (band, length)
                && a.max(c) <= b.min(d)
            {
                add(a.max(c), b.min(d));
            }
        }
        (hull[0] <= hull[1]).then_some(hull)
    }
}

/// Returns the times at which `start + t rate` is between two values.
fn times_between(start: f64, rate: f64, low: f64, high: f64) -> Option<[f64; 2]> {
    if rate == 0.0 {
        return (low..=high).contains(&start).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let (a, b) = ((low - start) / rate, (high - start) / rate);
    Some([a.min(b), a.max(b)])
}

/// Returns the times at which the point `start + t travel` is at most `radius` from the segment from the
/// origin to `to`.
pub(super) fn times_within_capsule(
    start: Vector3<f64>,
    travel: Vector3<f64>,
    to: Vector3<f64>,
    radius: f64,
) -> Option<[f64; 2]> {
    let squared = travel.norm_squared();
    let length = to.norm();
    let direction = if length > 0.0 { to / length } else { Vector3::x() };
    let (along, along_rate) = (start.dot(&direction), travel.dot(&direction));
    let (across, across_rate) = (start - direction * along, travel - direction * along_rate);
    if squared < STILL_SQUARED {
        let beyond = (-along).max(along - length).max(0.0);
        let inside = beyond * beyond + across.norm_squared() <= radius * radius;
        return inside.then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let mut hull: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];
    let mut add = |from: f64, to: f64| hull = [hull[0].min(from), hull[1].max(to)];
    for offset in [start, start - to] {
        let middle = -offset.dot(&travel) / squared;
        let root = radius * radius - (offset + travel * middle).norm_squared();
        if root >= 0.0 {
            let half = (root / squared).sqrt();
            add(middle - half, middle + half);
        }
    }
    let drift = across_rate.norm_squared();
    let tube = if drift < STILL_SQUARED.max(squared * 1e-24) {
        (across.norm_squared() <= radius * radius).then_some([f64::NEG_INFINITY, f64::INFINITY])
    } else {
        let middle = -across.dot(&across_rate) / drift;
        let root = radius * radius - (across + across_rate * middle).norm_squared();
        (root >= 0.0).then(|| [middle - (root / drift).sqrt(), middle + (root / drift).sqrt()])
    };
    if let (Some([a, b]), Some([c, d])) = (tube, times_between(along, along_rate, 0.0, length))
        && a.max(c) <= b.min(d)
    {
        add(a.max(c), b.min(d));
    }
    (hull[0] <= hull[1]).then_some(hull)
}
