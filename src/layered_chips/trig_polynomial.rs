//! This module holds trigonometric polynomials of second degree, `k0 + k1 cos x + k2 sin x + k3 cos 2x + k4
//! sin 2x`. All functions on a section's ellipse have this form.

use super::interval::IntervalF64;
use super::jet::Scalar;

/// The polynomial, given by its coefficients k0 to k4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TrigPolynomial<S>(pub [S; 5]);

/// The cosine and sine of an angle and of twice that angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AngleSinCos<S> {
    /// The cosine.
    pub cos: S,
    /// The sine.
    pub sin: S,
    /// The cosine of twice the angle.
    pub cos2: S,
    /// The sine of twice the angle.
    pub sin2: S,
}

impl AngleSinCos<f64> {
    /// Computes them for an angle in radians.
    pub(super) fn from_radians(x: f64) -> Self {
        let (sin, cos) = x.sin_cos();
        Self { cos, sin, cos2: cos * cos - sin * sin, sin2: 2.0 * sin * cos }
    }
}

impl AngleSinCos<IntervalF64> {
    /// Encloses them for all angles of an interval, in radians.
    pub(super) fn from_interval(x: IntervalF64) -> Self {
        let [(sin, cos), (sin2, cos2)] = x.sin_cos_with_doubles();
        Self { cos, sin, cos2, sin2 }
    }
}

impl<S: Scalar> TrigPolynomial<S> {
    /// Returns the value at an angle.
    pub(super) fn value_at(&self, x: &AngleSinCos<S>) -> S {
        let [k0, k1, k2, k3, k4] = self.0;
        k0 + k1 * x.cos + k2 * x.sin + k3 * x.cos2 + k4 * x.sin2
    }

    /// Returns the derivative with respect to the angle.
    pub(super) fn derivative_at(&self, x: &AngleSinCos<S>) -> S {
        let [_, k1, k2, k3, k4] = self.0;
        k2 * x.cos - k1 * x.sin + S::from_f64(2.0) * (k4 * x.cos2 - k3 * x.sin2)
    }

    /// Returns the second derivative with respect to the angle.
    pub(super) fn second_derivative_at(&self, x: &AngleSinCos<S>) -> S {
        let [_, k1, k2, k3, k4] = self.0;
        -(k1 * x.cos + k2 * x.sin + S::from_f64(4.0) * (k3 * x.cos2 + k4 * x.sin2))
    }
}

impl TrigPolynomial<IntervalF64> {
    /// Returns an upper bound of the absolute value.
    pub(super) fn max_magnitude(&self) -> f64 {
        self.0.iter().map(|k| k.magnitude()).sum()
    }
}

impl TrigPolynomial<f64> {
    /// Returns the angle in `[lo, hi]` at which the polynomial is zero, given that it rises (or falls) there;
    /// if it has the same sign everywhere, an end of the interval. The result is exact to the last bits
    /// except at a double root. It uses Newton's steps, and bisection where those leave the bracket.
    pub(super) fn find_root(&self, lo: f64, hi: f64, rising: bool) -> f64 {
        let sign = if rising { 1.0 } else { -1.0 };
        let at = |x: f64| {
            let angle = AngleSinCos::from_radians(x);
            (sign * self.value_at(&angle), sign * self.derivative_at(&angle))
        };
        let (mut lo, mut hi) = (lo, hi);
        let mut x = 0.5 * (lo + hi);
        for _ in 0..100 {
            let (value, slope) = at(x);
            if value > 0.0 {
                hi = x;
            } else {
                lo = x;
            }
            let next = x - value / slope;
            let next = if next > lo && next < hi { next } else { 0.5 * (lo + hi) };
            // The error after the next Newton step would be about the square of this one.
            if (next - x).abs() <= 1e-9 || hi - lo <= 1e-15 {
                return next;
            }
            x = next;
        }
        x
    }
}
