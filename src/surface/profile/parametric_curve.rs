//! This module holds curves that are given by a parameter, and converts them to chains.

use super::chain::{Chain, LARGEST};
use super::chain_piece::{ChainPiece, Point};
use super::chords::{ChordError, ChordSide, fit_chords};

/// The fraction of the tolerance that the sagitta between samples may have. It makes sixteen samples a chord.
const SHARE: f64 = 1.0 / 256.0;

/// The most bisections of a part between knots. What is left then is far below any tolerance.
const DEEPEST: u32 = 20;

/// A curve in the (u, z) plane.
pub trait ParametricCurve {
    /// Returns the point at a parameter.
    fn point_at(&self, parameter: f64) -> Point;

    /// Returns the parameters between which the curve is smooth, ascending. The first one is the start, the
    /// last one the end.
    fn knots(&self) -> Vec<f64>;
}

/// Converts a curve to chords that are at most `tolerance_mm` from it. Their number is near the least
/// possible: with the radius of curvature rho, a chord is about `2 sqrt(2 rho tolerance_mm)` long (Dragoi 2009,
/// section 3, fig. 7). Chord ends are on the curve.
///
/// # Errors
/// Returns a [`ChordError`] if the tolerance is below 2e-6 mm or the curve exceeds [`LARGEST`].
pub fn to_chords(curve: &impl ParametricCurve, tolerance_mm: f64) -> Result<Chain, ChordError> {
    to_chain(curve, tolerance_mm, false)
}

/// Converts a curve to arcs and chords that are at most `tolerance` mm from it, as [`fit_chords`] makes them
/// with arcs.
///
/// # Errors
/// Returns a [`ChordError`] if the tolerance is below 2e-6 mm or the curve exceeds [`LARGEST`].
pub fn to_arcs(curve: &impl ParametricCurve, tolerance_mm: f64) -> Result<Chain, ChordError> {
    to_chain(curve, tolerance_mm, true)
}

fn to_chain(curve: &impl ParametricCurve, tolerance: f64, arcs: bool) -> Result<Chain, ChordError> {
    if !(2e-6..=LARGEST).contains(&tolerance) {
        return Err(ChordError::Tolerance(tolerance));
    }
    let fine = tolerance * SHARE;
    let knots = curve.knots();
    let mut points: Vec<Point> = knots.first().map(|knot| curve.point_at(*knot)).into_iter().collect();
    for pair in knots.windows(2) {
        if let [from, to] = *pair
            && from < to
        {
            // There are at least four parts, so that a part that turns back on itself does not count as
            // straight.
            for part in 0..4 {
                let at = |share: f64| from + (to - from) * share;
                let (from, to) = (at(f64::from(part) / 4.0), at(f64::from(part + 1) / 4.0));
                sample_curve(
                    curve,
                    (from, curve.point_at(from)),
                    (to, curve.point_at(to)),
                    fine,
                    DEEPEST,
                    &mut points,
                );
            }
        }
    }
    let line = |pair: &[Point]| match pair {
        [from, to] => Some(ChainPiece::line(*from, *to)),
        _ => None,
    };
    let mut pieces: Vec<ChainPiece> = points.windows(2).filter_map(line).collect();
    if pieces.is_empty() {
        let point = points.first().copied().unwrap_or_default();
        pieces.push(ChainPiece::line(point, point));
    }
    fit_chords(&Chain::new(pieces)?, tolerance * (1.0 - SHARE), arcs, ChordSide::Both)
}

/// Adds the samples after `from` up to `to`, between which the sagitta of the curve is at most `fine`.
fn sample_curve(
    curve: &impl ParametricCurve,
    from: (f64, Point),
    to: (f64, Point),
    fine: f64,
    deeper: u32,
    points: &mut Vec<Point>,
) {
    let at = |share: f64| from.0 + (to.0 - from.0) * share;
    let middle = (at(0.5), curve.point_at(at(0.5)));
    let chord = ChainPiece::line(from.1, to.1);
    let off = [curve.point_at(at(0.25)), middle.1, curve.point_at(at(0.75))]
        .into_iter()
        .map(|point| {
            let direction = chord.direction_at(0.0);
            let (du, dz) = (point.u - from.1.u, point.z - from.1.z);
            let across = (direction.u * dz - direction.z * du).abs();
            // A chord without length has no direction, so the distance from its point counts.
            if chord.length_mm() > 0.0 { across } else { du.hypot(dz) }
        })
        .fold(0.0, f64::max);
    if off <= fine || deeper == 0 || !off.is_finite() {
        points.push(to.1);
        return;
    }
    sample_curve(curve, from, middle, fine, deeper - 1, points);
    sample_curve(curve, middle, to, fine, deeper - 1, points);
}
