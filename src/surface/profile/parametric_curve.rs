//! Curves given by a parameter, and how they become chains.

use super::chain::{Chain, LARGEST};
use super::chain_piece::{ChainPiece, Point};
use super::chords::{ChordError, ChordSide, fit_chords};

/// Curves are first sampled so that they bulge by this share of the tolerance between samples: sixteen samples a chord.
const SHARE: f64 = 1.0 / 256.0;

/// A part between knots is halved no more often than this; what is left then is far below any tolerance.
const DEEPEST: u32 = 20;

/// A curve in the (u, z) plane.
pub trait ParametricCurve {
    /// The point at a parameter.
    fn point_at(&self, parameter: f64) -> Point;

    /// The parameters between which the curve is smooth, ascending; the first is its start, the last its end.
    fn knots(&self) -> Vec<f64>;
}

/// The curve in chords no farther than `tolerance` mm from it, near the least number: long where the curvature is small,
/// `2 sqrt(2 rho tolerance)` at a radius of curvature rho (Dragoi 2009, section 3, fig. 7). Chord ends lie on the curve.
///
/// # Errors
/// [`ChordError`] when the tolerance is below 2e-6 mm or the curve goes beyond [`LARGEST`].
pub fn to_chords(curve: &impl ParametricCurve, tolerance: f64) -> Result<Chain, ChordError> {
    to_chain(curve, tolerance, false)
}

/// The curve in arcs and chords no farther than `tolerance` mm from it, as [`fit_chords`] makes them with arcs.
///
/// # Errors
/// [`ChordError`] when the tolerance is below 2e-6 mm or the curve goes beyond [`LARGEST`].
pub fn to_arcs(curve: &impl ParametricCurve, tolerance: f64) -> Result<Chain, ChordError> {
    to_chain(curve, tolerance, true)
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
            // Four parts at least, so that a part that turns back on itself is not taken for straight.
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

/// Adds the samples after `from` up to `to`, between which the curve bulges by no more than `fine`.
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
            // Without a direction the chord is a point.
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
