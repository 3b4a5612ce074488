//! This module tells which kind of approach a ramp is.

use super::ramp::{NOTHING, Ramp, RampArc, wrap_angle};
use nalgebra::{Matrix3, Point2, Vector2, Vector3};
use std::f64::consts::TAU;

/// The points of a helix lie this close to its circle (mm), or within a thousandth of its radius.
const ROUND: f64 = 0.01;

/// A chord of a helix sweeps at most this angle (degrees). An octagon is the coarsest polygon that counts as
/// a circle.
const WIDEST_CHORD: f64 = 46.0;

/// The least sweep of a helix, in degrees. Less is a curved leg.
const LEAST_SWEEP: f64 = 270.0;

/// The kinds of approach.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum RampKind {
    /// Straight legs, to and fro or around.
    Zigzag,
    /// Turns of a circle, as arcs or chords.
    Helix(Helix),
    /// Legs with curves, along the shape that is cut.
    AlongShape,
    /// Straight down.
    Plunge,
}

/// The circle of a helix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Helix {
    /// Its axis.
    pub centre: Point2<f64>,
    /// Its radius, mm.
    pub radius: f64,
    /// The sweep from start to end in radians, positive counter-clockwise.
    pub sweep: f64,
    /// The largest sweep of one of its steps, in radians.
    pub widest_step: f64,
    /// Whether its steps are arcs, not chords.
    pub arcs: bool,
}

impl RampKind {
    /// Classifies a ramp.
    pub fn classify_ramp(ramp: &Ramp) -> Self {
        if ramp.steps_with_starts().all(|(from, step)| step.length_across_mm(from) <= NOTHING) {
            return Self::Plunge;
        }
        if let Some(helix) = fit_helix(ramp) {
            return Self::Helix(helix);
        }
        if ramp.descending_legs().iter().all(|leg| leg.straight) { Self::Zigzag } else { Self::AlongShape }
    }

    /// Returns the name for people.
    pub fn display_name(self) -> &'static str {
        match self {
            Self::Zigzag => "zigzag",
            Self::Helix(_) => "helix",
            Self::AlongShape => "along the shape",
            Self::Plunge => "plunge",
        }
    }
}

/// Fits a helix to the descending part of the ramp. Level steps before and after it are links to a widened
/// helix. Level steps inside it belong to the circle.
fn fit_helix(ramp: &Ramp) -> Option<Helix> {
    let descent = ramp.descending_steps();
    let inside = ramp.steps_with_starts().skip(descent.start).take(descent.len());
    let steps: Vec<_> =
        inside.filter(|(from, step)| from.z > step.to.z || step.length_across_mm(*from) > NOTHING).collect();
    let first = steps.first()?;
    let bends: Vec<Option<RampArc>> = steps.iter().map(|(_, step)| step.bend).collect();
    let arcs = bends.first()?.is_some();
    let centre = match bends.first()? {
        Some(bend) => bend.centre,
        None => {
            let mut points: Vec<Point2<f64>> = vec![first.0.xy()];
            points.extend(steps.iter().map(|(_, step)| step.to.xy()));
            fit_circle_centre(&points)?
        }
    };
    let radius = (first.0.xy() - centre).norm();
    // Printed points and chords of large circles deviate in proportion to the radius.
    let round = ROUND.max(radius * 1e-3);
    let (mut sweep, mut widest_step) = (0.0f64, 0.0f64);
    for (from, step) in &steps {
        let turn = match step.bend {
            Some(bend) if arcs && (bend.centre - centre).norm() <= ROUND => bend.sweep,
            None if !arcs => signed_turn(from.xy() - centre, step.to.xy() - centre),
            _ => return None,
        };
        let off = ((step.to.xy() - centre).norm() - radius).abs();
        // A helix never turns back, and a step that does not turn at all is radial.
        if off > round || turn * sweep < 0.0 || turn == 0.0 {
            return None;
        }
        if !arcs && turn.abs() > WIDEST_CHORD.to_radians() {
            return None;
        }
        sweep += turn;
        widest_step = widest_step.max(turn.abs());
    }
    (sweep.abs() >= LEAST_SWEEP.to_radians()).then_some(Helix { centre, radius, sweep, widest_step, arcs })
}

/// Returns the angle from one spoke to the next, in `(-pi, pi]`.
fn signed_turn(from: Vector2<f64>, to: Vector2<f64>) -> f64 {
    let angle = wrap_angle(to.y.atan2(to.x) - from.y.atan2(from.x));
    if angle > TAU / 2.0 { angle - TAU } else { angle }
}

/// Returns the centre of the circle that fits the points best (algebraic least squares, Kasa 1976). Returns
/// `None` for fewer than four points, or if they lie on a line.
fn fit_circle_centre(points: &[Point2<f64>]) -> Option<Point2<f64>> {
    // Any three points that are not in line lie on a circle, so they prove nothing.
    if points.len() < 4 {
        return None;
    }
    // Kasa's equation x^2 + y^2 = 2 a x + 2 b y + c is linear in a, b and c. About the mean of the points its
    // normal equations are well conditioned, however far the circle is from the origin.
    let mean = points.iter().map(|point| point.coords).sum::<Vector2<f64>>() / points.len() as f64;
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for point in points {
        let at = point.coords - mean;
        let row = Vector3::new(at.x, at.y, 1.0);
        normal += row * row.transpose();
        right += row * at.norm_squared();
    }
    let found = normal.lu().solve(&right)?;
    // The unknowns of the equation are 2 a and 2 b, so the centre is half of them.
    let centre = mean + found.xy() / 2.0;
    centre.iter().all(|value| value.is_finite()).then(|| centre.into())
}
