//! This module holds the way of a tip on a flat arc, seen along the cutter's axis.
//!
//! At one height a cutter that moves on a flat arc about a parallel to its axis sweeps all points whose
//! distance from the arc is at most its radius there. That region is not convex. But in the half-plane on
//! the arc's side of its centre the distance plus R²/(2 low) is convex wherever R, the distance from the
//! centre, is at least `low`: only towards the centre does the distance fall short, by the bend of circles.
//! So a point of a hull is at most spread²/(2 low) further from the arc than the mixture of the corners'
//! distances. Where the cutter reaches over the centre, even that is not needed: what is nearer than the
//! centre is inside anyhow, and beyond that the distance is convex.

use super::plane_path::{Crossings, PlanePath};
use super::time_spans::TimeSpans;
use nalgebra::Vector2;

/// A flat arc of less than half a turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FlatArc {
    center: Vector2<f64>,
    radius: f64,
    /// The unit vector from the centre to the arc's middle.
    middle: Vector2<f64>,
    cos_half: f64,
    ends: [Vector2<f64>; 2],
}

/// The part of the plane that is asked about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ArcPart {
    /// Everything near the arc.
    Whole,
    /// What is on the arc's side of its centre.
    Side,
    /// What is near the first end, or the last one.
    End(usize),
}

impl FlatArc {
    /// Makes the arc from a centre, its start and the angle from there.
    pub(super) fn new(center: Vector2<f64>, start: Vector2<f64>, angle: f64) -> Option<Self> {
        let offset = start - center;
        let turned = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            Vector2::new(offset.x * cos - offset.y * sin, offset.x * sin + offset.y * cos)
        };
        let radius = offset.norm();
        let middle = turned(angle / 2.0).try_normalize(1e-9)?;
        let ends = [start, center + turned(angle)];
        Some(Self { center, radius, middle, cos_half: (angle / 2.0).cos(), ends })
    }

    /// Returns the distance of a place from the arc.
    pub(super) fn distance(&self, place: &Vector2<f64>) -> f64 {
        let offset = place - self.center;
        let far = offset.norm();
        if offset.dot(&self.middle) >= far * self.cos_half {
            return (far - self.radius).abs();
        }
        let [first, last] = &self.ends;
        (place - first).norm().min((place - last).norm())
    }

    /// Returns the distance of a place from a part of the arc's surroundings: infinite off that part.
    pub(super) fn distance_in(&self, part: ArcPart, place: &Vector2<f64>) -> f64 {
        match part {
            ArcPart::Whole => self.distance(place),
            ArcPart::Side if (place - self.center).dot(&self.middle) < 0.0 => f64::INFINITY,
            ArcPart::Side => self.distance(place),
            ArcPart::End(number) => self.ends.get(number).map_or(f64::INFINITY, |end| (place - end).norm()),
        }
    }

    /// Returns the distance of a place from what a part is about, also off that part.
    pub(super) fn distance_near(&self, part: ArcPart, place: &Vector2<f64>) -> f64 {
        match part {
            ArcPart::Whole | ArcPart::Side => self.distance(place),
            ArcPart::End(_) => self.distance_in(part, place),
        }
    }

    /// Returns how far a place is on the arc's side of the centre.
    pub(super) fn side_of(&self, place: &Vector2<f64>) -> f64 {
        (place - self.center).dot(&self.middle)
    }

    /// Returns how far the distance of a point that moves on a line between two places is from a convex
    /// function, at the most.
    pub(super) fn bend_of(&self, from: &Vector2<f64>, to: &Vector2<f64>) -> f64 {
        let way = to - from;
        let squared = way.norm_squared();
        let best =
            if squared > 0.0 { ((self.center - from).dot(&way) / squared).clamp(0.0, 1.0) } else { 0.0 };
        let low = (from + way * best - self.center).norm();
        // Two circles around the ends meet opposite the arc, in a kink.
        let is_beside = self.side_of(from).min(self.side_of(to)) >= 0.0;
        if low > 0.0 && is_beside { squared / (8.0 * low) } else { 2.0 * squared.sqrt() }
    }

    /// Returns by how much more than the corners a hull's points may be away from the arc, if all corners
    /// are at most `reach` away (`least_reach` the smallest of their bounds) and at most `spread` from the
    /// hull's middle. `known_low` is a distance from the centre that no point of the hull falls below.
    pub(super) fn excess(&self, reach: [f64; 2], spread: f64, known_low: f64) -> f64 {
        let [least_reach, reach] = reach;
        if least_reach >= self.radius || known_low >= self.radius {
            return 0.0;
        }
        // Corners at most `reach` away are at least that far from the centre. The mixture's squared
        // distance is theirs less at most the squared spread.
        let inner = (self.radius - reach).max(0.0);
        let low = (inner * inner - spread * spread).max(0.0).sqrt().max(known_low);
        if low > spread * 0.25 { spread * spread / (2.0 * low) } else { 2.0 * spread }
    }

    /// Returns a distance from the centre that no point of a hull falls below at some times. `path` is that
    /// of a point of the hull, and `spread` the largest distance of others from it.
    pub(super) fn low_of(&self, path: &PlanePath, need: [f64; 2], spread: f64) -> f64 {
        let middle = (need[0] + need[1]) / 2.0;
        let nearest = match path {
            PlanePath::Line { start, travel } => {
                let squared = travel.norm_squared();
                let best = if squared > 0.0 { (self.center - start).dot(travel) / squared } else { middle };
                (path.at(best.clamp(need[0], need[1])) - self.center).norm()
            }
            PlanePath::Arc { center, first, .. } => {
                let half = path.speed() * (need[1] - need[0]) / 2.0;
                let place = (path.at(middle) - self.center).norm() - half;
                place.max(((center - self.center).norm() - first.norm()).abs())
            }
        };
        nearest - spread
    }

    /// Returns the times at which a point is at most `radius` from a part of the arc.
    pub(super) fn times_within(
        &self,
        part: ArcPart,
        path: &PlanePath,
        need: [f64; 2],
        radius: f64,
        widens: bool,
    ) -> TimeSpans {
        if radius < 0.0 {
            return TimeSpans::none(widens);
        }
        if let PlanePath::Arc { center, first, .. } = path {
            // The whole circle is that far from the arc's centre.
            let (apart, own) = ((center - self.center).norm(), first.norm());
            if (apart - own).abs() > self.radius + radius || apart + own < self.radius - radius {
                return TimeSpans::none(widens);
            }
        }
        let half = path.speed() * (need[1] - need[0]) / 2.0;
        let middle = path.at((need[0] + need[1]) / 2.0);
        if self.distance(&middle) > radius + half {
            return TimeSpans::none(widens);
        }
        let mut crossings = Crossings::new(need);
        match part {
            ArcPart::End(number) => {
                let Some(end) = self.ends.get(number) else { return TimeSpans::none(widens) };
                path.cross_circle(end, radius, &mut crossings);
            }
            ArcPart::Whole | ArcPart::Side => {
                for end in &self.ends {
                    path.cross_circle(end, radius, &mut crossings);
                }
                path.cross_circle(&self.center, self.radius + radius, &mut crossings);
                path.cross_circle(&self.center, self.radius - radius, &mut crossings);
                if part == ArcPart::Side {
                    path.cross_line(&self.middle, self.middle.dot(&self.center), &mut crossings);
                }
            }
        }
        crossings.spans(widens, &|time| self.distance_in(part, &path.at(time)) <= radius)
    }
}

/// Returns the times at which a point is at most `radius` from the segment from the origin.
pub(super) fn times_near_segment(
    to: &Vector2<f64>,
    path: &PlanePath,
    need: [f64; 2],
    radius: f64,
    widens: bool,
) -> TimeSpans {
    if radius < 0.0 {
        return TimeSpans::none(widens);
    }
    let squared = to.norm_squared();
    let distance = |place: &Vector2<f64>| {
        let share = if squared > 0.0 { (place.dot(to) / squared).clamp(0.0, 1.0) } else { 0.0 };
        (place - to * share).norm()
    };
    let half = path.speed() * (need[1] - need[0]) / 2.0;
    let at = distance(&path.at((need[0] + need[1]) / 2.0));
    if at > radius + half {
        return TimeSpans::none(widens);
    }
    if at + half <= radius {
        return TimeSpans::one(need, widens);
    }
    let mut crossings = Crossings::new(need);
    path.cross_circle(&Vector2::zeros(), radius, &mut crossings);
    path.cross_circle(to, radius, &mut crossings);
    if let Some(across) = Vector2::new(-to.y, to.x).try_normalize(1e-12) {
        path.cross_line(&across, radius, &mut crossings);
        path.cross_line(&across, -radius, &mut crossings);
    }
    crossings.spans(widens, &|time| distance(&path.at(time)) <= radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(state: &mut u64) -> f64 {
        *state ^= *state << 13;
        *state ^= *state >> 7;
        *state ^= *state << 17;
        (*state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }

    fn random_path(state: &mut u64) -> PlanePath {
        let mut vector = |size: f64| Vector2::new(random(state), random(state)) * size;
        let (start, travel) = (vector(12.0), vector(10.0));
        if start.x > 0.0 {
            return PlanePath::Line { start, travel };
        }
        let second = Vector2::new(-travel.y, travel.x);
        PlanePath::Arc { center: start, first: travel, second, angle: travel.x * 0.15 }
    }

    #[test]
    fn times_agree_with_places() {
        let mut state = 7;
        for _ in 0..2000 {
            let path = random_path(&mut state);
            let (angle, radius) = (random(&mut state) * 1.5, 2.0 + 2.0 * random(&mut state));
            let center = Vector2::new(random(&mut state), random(&mut state)) * 2.0;
            let start = center + Vector2::new(random(&mut state), random(&mut state)) * 6.0;
            let Some(arc) = FlatArc::new(center, start, angle) else { continue };
            let to = start;
            for part in [ArcPart::Whole, ArcPart::Side, ArcPart::End(0), ArcPart::End(1)] {
                let found = arc.times_within(part, &path, [0.0, 1.0], radius, false);
                for step in 0..200 {
                    let time = (f64::from(step) + 0.5) / 200.0;
                    let apart = arc.distance_in(part, &path.at(time)) - radius;
                    let is_in = found.spans().iter().any(|[from, to]| (*from..=*to).contains(&time));
                    assert!(apart.abs() < 1e-9 || is_in == (apart < 0.0), "{part:?} {apart} {found:?}");
                }
            }
            let found = times_near_segment(&to, &path, [0.0, 1.0], radius, false);
            for step in 0..200 {
                let time = (f64::from(step) + 0.5) / 200.0;
                let place = path.at(time);
                let share = (place.dot(&to) / to.norm_squared()).clamp(0.0, 1.0);
                let apart = (place - to * share).norm() - radius;
                let is_in = found.spans().iter().any(|[from, to]| (*from..=*to).contains(&time));
                assert!(apart.abs() < 1e-9 || is_in == (apart < 0.0), "{apart} {found:?}");
            }
        }
    }

    #[test]
    fn hulls_of_covered_corners_are_covered() {
        let mut state = 11;
        let mut tried = 0;
        for _ in 0..60_000 {
            let angle = random(&mut state) * 1.5;
            let Some(arc) = FlatArc::new(Vector2::zeros(), Vector2::new(4.0, 0.0), angle) else { continue };
            let radius = 3.0 + 2.8 * random(&mut state);
            let middle = Vector2::new(random(&mut state), random(&mut state)) * 9.0;
            let size = random(&mut state).abs() * 2.0;
            let corners: Vec<Vector2<f64>> = (0..4)
                .map(|_| middle + Vector2::new(random(&mut state), random(&mut state)) * size)
                .collect();
            let spread = corners.iter().map(|corner| (corner - middle).norm()).fold(0.0, f64::max);
            let bound = radius - arc.excess([radius, radius], spread, 0.0);
            if corners.iter().any(|corner| arc.distance_in(ArcPart::Side, corner) > bound) {
                continue;
            }
            tried += 1;
            for _ in 0..30 {
                let weights: Vec<f64> = corners.iter().map(|_| random(&mut state).abs()).collect();
                let sum: f64 = weights.iter().sum();
                let place: Vector2<f64> =
                    corners.iter().zip(&weights).map(|(corner, weight)| corner * (weight / sum)).sum();
                assert!(arc.distance(&place) <= radius + 1e-12, "{corners:?} {radius} {place:?}");
            }
        }
        assert!(tried > 1000, "{tried}");
    }
}
