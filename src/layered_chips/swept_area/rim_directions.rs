//! This module holds the directions around the cutter at which its edge has vertices when it becomes a
//! polygon.

use crate::layered_chips::mill_step::MillStep;
use std::f64::consts::TAU;

/// Directions that are evenly spaced around the tool axis. They are the same for every layer of a step and
/// mostly for steps that follow each other. So the last edge of one step is the first edge of the next, to
/// the bit.
#[derive(Debug, Clone, PartialEq)]
pub struct RimDirections {
    tolerance: f64,
    directions: Vec<[f64; 2]>,
}

/// The fewest directions.
const FEWEST: usize = 16;

/// The most directions, for tolerances far below what a machine can do.
const MOST: usize = 1 << 14;

impl RimDirections {
    /// Makes as many directions as keep chords within a tolerance (mm) for every section of a step.
    pub fn new(step: &MillStep, tolerance_mm: f64) -> Self {
        // The lower of the two axes has the longest ellipse; all axes between them are within their cap.
        let end = step.from * step.turn.cos() + step.across * step.turn.sin();
        let longest = step.mill.radius_mm / step.from.z.min(end.z).max(0.1);
        // A chord of angle d on an ellipse with the long semi-axis a is off by at most a (1 - cos(d / 2)),
        // about a d^2 / 8.
        let angle = (8.0 * tolerance_mm / longest).sqrt().clamp(1e-9, 1.0);
        let count = ((TAU / angle / 8.0).ceil() as usize * 8).clamp(FEWEST, MOST);
        let direction = |index: usize| {
            let (sin, cos) = (TAU * index as f64 / count as f64).sin_cos();
            [cos, sin]
        };
        Self { tolerance: tolerance_mm, directions: (0..count).map(direction).collect() }
    }

    /// Returns the largest distance of a chord from its curve, mm.
    pub fn tolerance_mm(&self) -> f64 {
        self.tolerance
    }

    /// Returns the number of directions.
    pub(crate) fn direction_count(&self) -> usize {
        self.directions.len()
    }

    /// Returns the directions strictly between two angles (radians, the second one larger) with their angles,
    /// in order.
    pub(super) fn directions_between(&self, from: f64, to: f64) -> impl Iterator<Item = (f64, [f64; 2])> {
        let step = TAU / self.directions.len() as f64;
        let first = (from / step).floor() as i64 + 1;
        let last = ((to / step).ceil() as i64 - 1).min(first + self.directions.len() as i64);
        (first..=last).map(move |index| {
            let at = index.rem_euclid(self.directions.len() as i64) as usize;
            let direction = self.directions.get(at).copied().unwrap_or([1.0, 0.0]);
            (index as f64 * step, direction)
        })
    }
}
