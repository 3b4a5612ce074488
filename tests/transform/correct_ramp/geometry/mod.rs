//! Ramps as geometry: closed forms, worked cases, and what holds for every ramp.

mod cases;
mod circle;
mod layers;
mod limits;
mod odd;
mod pillars;
mod properties;
mod region;
mod shapes;

use clsmith::internals::transform::correct_ramp::ramp::{Ramp, RampArc, RampStep};
use clsmith::internals::transform::correct_ramp::ramp_limits::RampLimits;
use nalgebra::{Point2, Point3, Rotation2};
use std::f64::consts::TAU;

/// Legs of 10 mm or more, descending 1 mm in 10.
const LIMITS: RampLimits = RampLimits { shortest_leg: 10.0, steepest: 0.1 };

#[track_caller]
fn near(actual: f64, expected: f64) {
    assert!((actual - expected).abs() <= 1e-9, "{actual} is not {expected}");
}

#[track_caller]
fn all_near(actual: &[[f64; 3]], expected: &[[f64; 3]]) {
    let close = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-9);
    assert!(
        actual.len() == expected.len() && actual.iter().zip(expected).all(close),
        "{actual:?}\nis not\n{expected:?}"
    );
}

/// Straight steps through points.
fn ramp(points: &[[f64; 3]]) -> Ramp {
    Ramp::from_points(&points.iter().map(|place| Point3::from(*place)).collect::<Vec<_>>()).unwrap()
}

fn points(ramp: &Ramp) -> Vec<[f64; 3]> {
    ramp.points().map(|point| [point.x, point.y, point.z]).collect()
}

/// A helix to height 0 around a centre, from the angle 0 on.
#[derive(Debug, Clone, Copy)]
struct Turns {
    centre: [f64; 2],
    radius: f64,
    /// Counter-clockwise positive.
    turns: f64,
    height: f64,
    steps: usize,
    arcs: bool,
}

impl Turns {
    fn ramp(&self) -> Ramp {
        let centre = Point2::from(self.centre);
        let at = |index: usize| {
            let share = index as f64 / self.steps as f64;
            let place =
                centre + Rotation2::new(TAU * self.turns * share) * nalgebra::Vector2::new(self.radius, 0.0);
            Point3::new(place.x, place.y, self.height * (1.0 - share))
        };
        let bend = self.arcs.then_some(RampArc { centre, sweep: TAU * self.turns / self.steps as f64 });
        Ramp { start: at(0), steps: (1..=self.steps).map(|index| RampStep { to: at(index), bend }).collect() }
    }
}
