//! This module finds the times at which a point is inside a moving cutter, when there is no closed form.
//!
//! In the cutter's frame the point is `base + t travel + s slide`, with the time t of the own motion and the
//! position s in [0, 1] on the other one. The cutter's gap is convex, so it is convex in (t, s), its least
//! over s is convex in t, and the times at which that is at most a bound are one interval. The interval's
//! ends are found from tangents. An end that is returned as inside is inside: a position s was found there.
//! Times outside are proved by tangents, too.

use super::cutter_contour::CutterContour;
use nalgebra::Vector3;

/// A family of points in the frame of a cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PointFamily {
    /// The point at t = 0 and s = 0, mm.
    pub base: Vector3<f64>,
    /// How far the point moves while t goes from 0 to 1.
    pub travel: Vector3<f64>,
    /// How far the point moves while s goes from 0 to 1.
    pub slide: Vector3<f64>,
    /// How much further from the axis the point counts as, mm. The gap stays convex, as it never falls away
    /// from the axis.
    pub aside: f64,
}

/// The times at which a family is inside: those that were proved, and those that were not disproved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FamilyTimes {
    /// The proved interval.
    pub inner: [f64; 2],
    /// The interval outside of which the point is outside the cutter.
    pub outer: [f64; 2],
}

/// The least gap over s, its slope in t, and whether it is final (a gap below the bound needs not be the
/// least).
#[derive(Clone, Copy)]
struct LeastGap {
    gap: f64,
    slope: f64,
    lowest: f64,
}

/// The number of tangents in s and in t after which a search ends with what it has.
const MOST_ROUNDS: usize = 48;

impl PointFamily {
    fn at(&self, contour: &CutterContour, t: f64, s: f64) -> (f64, f64, f64) {
        let (gap, gradient) = contour.gap_aside(&(self.base + self.travel * t + self.slide * s), self.aside);
        (gap, gradient.dot(&self.travel), gradient.dot(&self.slide))
    }

    /// Returns the least gap over s at a time, mm, as close below the truth as `precision` mm.
    pub(super) fn least_gap(&self, contour: &CutterContour, t: f64, precision: f64) -> f64 {
        self.least_over_s(contour, t, f64::NEG_INFINITY, precision).lowest
    }

    /// Finds the least gap over s. A gap of at most `enough` ends the search.
    fn least_over_s(&self, contour: &CutterContour, t: f64, enough: f64, precision: f64) -> LeastGap {
        let exact = |(gap, slope, _): (f64, f64, f64)| LeastGap { gap, slope, lowest: gap };
        let (mut a, mut low) = (0.0, self.at(contour, t, 0.0));
        if low.0 <= enough || low.2 >= 0.0 {
            return exact(low);
        }
        let (mut b, mut high) = (1.0, self.at(contour, t, 1.0));
        if high.0 <= enough || high.2 <= 0.0 {
            return exact(high);
        }
        for round in 0..MOST_ROUNDS {
            let steepness = high.2 - low.2;
            let cross = a + ((high.0 - low.0) - high.2 * (b - a)) / (low.2 - high.2);
            let lowest = low.0 + low.2 * (cross - a);
            let best = if low.0 <= high.0 { low } else { high };
            if best.0 - lowest <= precision || steepness <= 0.0 {
                return LeastGap {
                    gap: best.0,
                    slope: Self::joint_slope(low, high),
                    lowest: lowest.min(best.0),
                };
            }
            // The zero of the slope by secant, and every third time where the tangents meet, which always
            // makes progress.
            let secant = a - low.2 * (b - a) / steepness;
            let next = if round % 3 == 2 { cross } else { secant };
            let margin = (b - a) * 1e-3;
            let next = next.clamp(a + margin, b - margin);
            let found = self.at(contour, t, next);
            if found.0 <= enough {
                return exact(found);
            }
            if found.2 <= 0.0 {
                (a, low) = (next, found);
            } else {
                (b, high) = (next, found);
            }
            if found.2 == 0.0 {
                return exact(found);
            }
        }
        let best = if low.0 <= high.0 { low } else { high };
        let lowest = best.0 - (b - a) * self.slide.norm();
        LeastGap { gap: best.0, slope: Self::joint_slope(low, high), lowest }
    }

    /// Returns the slope in t of the mixture of two tangent planes that does not depend on s. Together with
    /// the lowest value where they meet it is a tangent of the least gap from below.
    fn joint_slope(low: (f64, f64, f64), high: (f64, f64, f64)) -> f64 {
        let steepness = high.2 - low.2;
        if steepness <= 0.0 {
            return low.1;
        }
        (low.1 * high.2 - high.1 * low.2) / steepness
    }

    /// Returns the times within `need` at which the least gap over s is at most `bound`; `precision` is the
    /// length in mm to which the ends are found.
    pub(super) fn times_within(
        &self,
        contour: &CutterContour,
        need: [f64; 2],
        bound: f64,
        precision: f64,
    ) -> Option<FamilyTimes> {
        // What is between the bound and a little less decides nothing here.
        let fine = (precision * 0.1).max(1e-12);
        let least = |t: f64| self.least_over_s(contour, t, bound, fine);
        let [mut from, mut to] = need;
        let (mut low, mut high) = (least(from), least(to));
        if low.gap <= bound && high.gap <= bound {
            return Some(FamilyTimes { inner: need, outer: need });
        }
        let speed = self.travel.norm();
        if speed * (to - from) <= 1e-12 {
            let inside = low.gap <= bound || high.gap <= bound;
            return inside.then_some(FamilyTimes { inner: need, outer: need });
        }
        let mut inside = None;
        for round in 0..MOST_ROUNDS {
            if low.gap <= bound || high.gap <= bound {
                inside = Some(if low.gap <= bound { from } else { to });
                break;
            }
            if low.slope >= 0.0 || high.slope <= 0.0 || speed * (to - from) < precision * 0.1 {
                return None;
            }
            let cross =
                from + ((high.lowest - low.lowest) - high.slope * (to - from)) / (low.slope - high.slope);
            if low.lowest + low.slope * (cross - from) > bound {
                return None;
            }
            let middle = from + (to - from) * if round % 3 == 2 { 0.5 } else { 0.0 };
            let margin = (to - from) * 1e-3;
            let next = if round % 3 == 2 { middle } else { cross.clamp(from + margin, to - margin) };
            let found = least(next);
            if found.gap <= bound || found.slope > 0.0 {
                (to, high) = (next, found);
            } else {
                (from, low) = (next, found);
            }
        }
        let inside = inside?;
        let step = (precision / speed).min((need[1] - need[0]) * 0.5);
        let left = self.find_end(contour, [need[0], inside], bound, step, fine);
        let right = self.find_end(contour, [need[1], inside], bound, step, fine);
        Some(FamilyTimes { inner: [left[1], right[1]], outer: [left[0], right[0]] })
    }

    /// Finds the end of the times between a time that may be outside and one that is inside. Returns a time
    /// that is outside (or the first one) and one that is inside, at most `step` apart.
    fn find_end(
        &self,
        contour: &CutterContour,
        [outside, inside]: [f64; 2],
        bound: f64,
        step: f64,
        fine: f64,
    ) -> [f64; 2] {
        let first = self.least_over_s(contour, outside, bound, fine);
        if first.gap <= bound {
            return [outside, outside];
        }
        let (mut out, mut within, mut at) = (outside, inside, first);
        let toward = (inside - outside).signum();
        for round in 0..MOST_ROUNDS {
            if (within - out).abs() <= step {
                break;
            }
            // Newton's method from outside never passes the end of a convex function's interval.
            let newton = if at.slope.abs() > 0.0 { out - (at.lowest - bound) / at.slope } else { f64::NAN };
            let next = newton + toward * step * 0.5;
            let between = (next - out) * toward > 0.0 && (within - next) * toward > 0.0;
            let next = if between && round % 4 != 3 { next } else { (out + within) / 2.0 };
            let found = self.least_over_s(contour, next, bound, fine);
            if found.gap <= bound {
                within = next;
            } else {
                (out, at) = (next, found);
            }
        }
        [out, within]
    }
}
