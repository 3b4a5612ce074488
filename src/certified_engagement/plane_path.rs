//! This module finds when a point that moves in a plane on a line or a circle is inside a shape that lines
//! and circles bound: the times at which it crosses them are known in closed form, and between two of them
//! one place tells.

use super::time_spans::TimeSpans;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// The way of a point in a plane from time 0 to time 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum PlanePath {
    /// An even motion on a line.
    Line {
        /// The place at time 0.
        start: Vector2<f64>,
        /// The way to time 1.
        travel: Vector2<f64>,
    },
    /// An even motion on a circle.
    Arc {
        /// The circle's centre.
        center: Vector2<f64>,
        /// From the centre to the place at time 0.
        first: Vector2<f64>,
        /// The same a quarter turn later.
        second: Vector2<f64>,
        /// The angle, less than a whole turn.
        angle: f64,
    },
}

/// The most crossings of one question.
const MOST: usize = 26;

/// The times at which a path crosses what bounds a shape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossings {
    times: [f64; MOST],
    count: usize,
    need: [f64; 2],
}

impl Crossings {
    /// Starts with the ends of the times that are asked for.
    pub(super) fn new(need: [f64; 2]) -> Self {
        let mut crossings = Self { times: [0.0; MOST], count: 0, need };
        crossings.insert(need[0]);
        crossings.insert(need[1]);
        crossings
    }

    /// Adds a time, unless it is not asked for.
    fn push(&mut self, time: f64) {
        if time > self.need[0] && time < self.need[1] {
            self.insert(time);
        }
    }

    fn insert(&mut self, time: f64) {
        debug_assert!(self.count < MOST, "too many crossings");
        if let Some(place) = self.times.get_mut(self.count) {
            *place = time;
            self.count += 1;
        }
    }

    /// Returns the spans whose middle is inside.
    pub(super) fn spans(mut self, widens: bool, inside: &dyn Fn(f64) -> bool) -> TimeSpans {
        let mut found = TimeSpans::none(widens);
        let times = self.times.get_mut(..self.count).unwrap_or_default();
        times.sort_unstable_by(f64::total_cmp);
        if self.need[0] >= self.need[1] {
            if inside(self.need[0]) {
                found.push(self.need);
            }
            return found;
        }
        for pair in times.windows(2) {
            let [from, to] = pair else { continue };
            if from < to && inside((from + to) / 2.0) {
                found.push([*from, *to]);
            }
        }
        found
    }
}

impl PlanePath {
    /// Returns the place at a time.
    pub(super) fn at(&self, time: f64) -> Vector2<f64> {
        match self {
            Self::Line { start, travel } => start + travel * time,
            Self::Arc { center, first, second, angle } => {
                let (sin, cos) = (angle * time).sin_cos();
                center + first * cos + second * sin
            }
        }
    }

    /// Returns the length of the way from time 0 to time 1.
    pub(super) fn speed(&self) -> f64 {
        match self {
            Self::Line { travel, .. } => travel.norm(),
            Self::Arc { first, angle, .. } => first.norm() * angle.abs(),
        }
    }

    /// Adds the times at which the point is on a circle.
    pub(super) fn cross_circle(&self, around: &Vector2<f64>, radius: f64, out: &mut Crossings) {
        if radius < 0.0 {
            return;
        }
        match self {
            Self::Line { start, travel } => {
                let (offset, squared) = (start - around, travel.norm_squared());
                let cross = offset.x * travel.y - offset.y * travel.x;
                let root = radius * radius * squared - cross * cross;
                if squared > 0.0 && root >= 0.0 {
                    let (middle, half) = (-offset.dot(travel) / squared, root.sqrt() / squared);
                    out.push(middle - half);
                    out.push(middle + half);
                }
            }
            Self::Arc { center, first, second, angle } => {
                let offset = center - around;
                let (a, b) = (2.0 * offset.dot(first), 2.0 * offset.dot(second));
                let rest = radius * radius - offset.norm_squared() - first.norm_squared();
                cross_wave(a, b, rest, *angle, out);
            }
        }
    }

    /// Adds the times at which the point's product with a normal has a value.
    pub(super) fn cross_line(&self, normal: &Vector2<f64>, value: f64, out: &mut Crossings) {
        match self {
            Self::Line { start, travel } => {
                let rate = normal.dot(travel);
                if rate != 0.0 {
                    out.push((value - normal.dot(start)) / rate);
                }
            }
            Self::Arc { center, first, second, angle } => {
                cross_wave(normal.dot(first), normal.dot(second), value - normal.dot(center), *angle, out);
            }
        }
    }
}

/// Adds the times at which a cos x + b sin x has a value, where x goes from 0 to the angle.
pub(super) fn cross_wave(a: f64, b: f64, value: f64, angle: f64, out: &mut Crossings) {
    let height = a.hypot(b);
    if height == 0.0 || angle == 0.0 || value.abs() > height {
        return;
    }
    let (middle, half) = (b.atan2(a), (value / height).acos());
    for at in [middle - half, middle + half] {
        // The sense of the motion is that of the time.
        let along = at * angle.signum();
        out.push((along - TAU * (along / TAU).floor()) / angle.abs());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_crosses_circles_and_lines_where_it_should() {
        for angle in [1.4, -1.4] {
            let path = PlanePath::Arc {
                center: Vector2::new(1.0, 2.0),
                first: Vector2::new(3.0, 0.0),
                second: Vector2::new(0.0, 3.0),
                angle,
            };
            let around = Vector2::new(4.0, 2.0 + 2.5 * angle.signum());
            let mut crossings = Crossings::new([0.0, 1.0]);
            path.cross_circle(&around, 2.0, &mut crossings);
            path.cross_line(&Vector2::new(0.0, 1.0), 2.0 + angle.signum(), &mut crossings);
            assert!(crossings.count >= 4, "{crossings:?}");
            for time in &crossings.times[2..crossings.count] {
                let at = path.at(*time);
                let is_on =
                    ((at - around).norm() - 2.0).abs() < 1e-12 || (at.y - 2.0 - angle.signum()).abs() < 1e-12;
                assert!(is_on, "{at:?}");
            }
        }
    }
}
