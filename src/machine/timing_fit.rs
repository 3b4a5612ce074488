//! This module fits the times of a machine to blocks that were timed on it.

use super::axis_time::rest_to_rest_s;

/// A corner that was timed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimedCorner {
    /// The angle by which the direction changes, in degrees.
    pub angle_deg: f64,
    /// The feed before and after it, in mm/min.
    pub feed: f64,
    /// The time that it costs, in s.
    pub lost_s: f64,
}

/// A straight motion from rest to rest that was timed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimedStroke {
    /// Its length, in mm or degrees.
    pub length: f64,
    /// Its feed per minute; `None` at rapid.
    pub feed: Option<f64>,
    /// Its time, in s.
    pub seconds: f64,
}

/// A value that was fitted, and how well.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedTiming {
    /// The value.
    pub value: f64,
    /// The largest difference between a time and its fit, in s.
    pub largest_error_s: f64,
}

impl TimedCorner {
    /// Returns the root of the change of the velocity, in mm/s.
    fn root_of_change(&self) -> f64 {
        let speed = self.feed / 60.0;
        (2.0 * speed * (self.angle_deg.to_radians() / 2.0).sin().abs()).sqrt()
    }
}

/// Returns the constant `c` of the corner law, `c sqrt(|dv|)` in s by the root of mm/s, by least squares. `None` without
/// a corner.
pub fn fit_corner_constant(corners: &[TimedCorner]) -> Option<FittedTiming> {
    let sum = |value: &dyn Fn(&TimedCorner) -> f64| corners.iter().map(value).sum::<f64>();
    let weight = sum(&|corner| corner.root_of_change().powi(2));
    if weight <= 0.0 {
        return None;
    }
    let value = sum(&|corner| corner.lost_s * corner.root_of_change()) / weight;
    let errors = corners.iter().map(|corner| (corner.lost_s - value * corner.root_of_change()).abs());
    Some(FittedTiming { value, largest_error_s: errors.fold(0.0, f64::max) })
}

/// Returns the acceleration in mm/s2 of motions at feed from rest to rest. `None` without one that loses time.
pub fn fit_path_acceleration(strokes: &[TimedStroke]) -> Option<FittedTiming> {
    let fed: Vec<(&TimedStroke, f64)> =
        strokes.iter().filter_map(|stroke| Some((stroke, stroke.feed? / 60.0))).collect();
    let fastest = fed.iter().map(|(_, speed)| *speed).reduce(f64::max)?;
    if !fed.iter().any(|(stroke, speed)| stroke.seconds > stroke.length / speed) {
        return None;
    }
    let error = |acceleration: f64| {
        let errors = fed.iter().map(|(stroke, speed)| {
            rest_to_rest_s(stroke.length, *speed, Some(acceleration), None) - stroke.seconds
        });
        errors.collect::<Vec<_>>()
    };
    // Speeds between a hundredth of a second and a hundred seconds to the fastest one.
    let value = search_least(fastest * 0.01, fastest * 1000.0, |value| sum_of_squares(&error(value)));
    Some(FittedTiming { value, largest_error_s: largest(&error(value)) })
}

/// Returns speed per minute and acceleration per s2 of an axis at rapid. `None` with fewer than two different lengths.
pub fn fit_axis_rapid(strokes: &[TimedStroke]) -> Option<(f64, FittedTiming)> {
    let lengths = strokes.iter().map(|stroke| stroke.length);
    let [short, long] = [lengths.clone().fold(f64::INFINITY, f64::min), lengths.fold(0.0, f64::max)];
    if long <= short {
        return None;
    }
    let errors = |speed: f64, acceleration: f64| {
        let errors = strokes
            .iter()
            .map(|stroke| rest_to_rest_s(stroke.length, speed, Some(acceleration), None) - stroke.seconds);
        errors.collect::<Vec<_>>()
    };
    let mean = strokes.iter().map(|stroke| stroke.length / stroke.seconds).fold(0.0, f64::max);
    let best_acceleration = |speed: f64| {
        search_least(speed * 0.01, speed * 1000.0, |value| sum_of_squares(&errors(speed, value)))
    };
    // No axis is slower than its fastest mean speed.
    let speed =
        search_least(mean, mean * 100.0, |speed| sum_of_squares(&errors(speed, best_acceleration(speed))));
    let value = best_acceleration(speed);
    Some((speed * 60.0, FittedTiming { value, largest_error_s: largest(&errors(speed, value)) }))
}

fn sum_of_squares(errors: &[f64]) -> f64 {
    errors.iter().map(|error| error * error).sum()
}

fn largest(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |most, error| most.max(error.abs()))
}

/// Returns the place of the least value between two positive bounds: by steps of equal ratio, then between the
/// neighbours of the best one.
fn search_least(low: f64, high: f64, value: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 60;
    let (mut low, mut high) = (low.ln(), high.ln());
    let at = |low: f64, high: f64, step: usize| low + (high - low) * step as f64 / STEPS as f64;
    let best =
        (0..=STEPS).map(|step| (step, value(at(low, high, step).exp()))).min_by(|a, b| a.1.total_cmp(&b.1));
    let best = best.map_or(0, |(step, _)| step);
    (low, high) = (at(low, high, best.saturating_sub(1)), at(low, high, (best + 1).min(STEPS)));
    for _ in 0..60 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if value(left.exp()) <= value(right.exp()) { high = right } else { low = left }
    }
    ((low + high) / 2.0).exp()
}
