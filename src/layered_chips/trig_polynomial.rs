//! Trigonometric polynomials of second degree, `k0 + k1 cos + k2 sin + k3 cos 2x + k4 sin 2x`: what everything on an ellipse is.

use super::interval::IntervalF64;
use super::jet::Scalar;

/// The coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrigPolynomial<S>(pub [S; 5]);

/// Cosine and sine of an angle and of its double.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AngleSinCos<S> {
    /// Cosine.
    pub cos: S,
    /// Sine.
    pub sin: S,
    /// Cosine of the double.
    pub cos2: S,
    /// Sine of the double.
    pub sin2: S,
}

impl AngleSinCos<f64> {
    /// Of an angle in radians.
    pub fn from_radians(x: f64) -> Self {
        let (sin, cos) = x.sin_cos();
        Self { cos, sin, cos2: cos * cos - sin * sin, sin2: 2.0 * sin * cos }
    }
}

impl AngleSinCos<IntervalF64> {
    /// Of all angles of an interval, radians.
    pub fn from_interval(x: IntervalF64) -> Self {
        let [(sin, cos), (sin2, cos2)] = x.sin_cos_with_doubles();
        Self { cos, sin, cos2, sin2 }
    }
}

impl<S: Scalar> TrigPolynomial<S> {
    /// The value.
    pub fn value_at(&self, x: &AngleSinCos<S>) -> S {
        let [k0, k1, k2, k3, k4] = self.0;
        k0 + k1 * x.cos + k2 * x.sin + k3 * x.cos2 + k4 * x.sin2
    }

    /// The derivative by the angle.
    pub fn derivative_at(&self, x: &AngleSinCos<S>) -> S {
        let [_, k1, k2, k3, k4] = self.0;
        k2 * x.cos - k1 * x.sin + S::from_f64(2.0) * (k4 * x.cos2 - k3 * x.sin2)
    }

    /// The second derivative by the angle.
    pub fn second_derivative_at(&self, x: &AngleSinCos<S>) -> S {
        let [_, k1, k2, k3, k4] = self.0;
        -(k1 * x.cos + k2 * x.sin + S::from_f64(4.0) * (k3 * x.cos2 + k4 * x.sin2))
    }
}

impl TrigPolynomial<IntervalF64> {
    /// A bound on its absolute value.
    pub fn max_magnitude(&self) -> f64 {
        self.0.iter().map(|k| k.magnitude()).sum()
    }
}

impl TrigPolynomial<f64> {
    /// The angle in `[lo, hi]` at which it is zero, given that it rises (or falls) there; an end where it has the same sign all over.
    /// To some last bits, but for a double root: Newton's steps, and halves where those leave the bracket.
    pub fn find_root(&self, lo: f64, hi: f64, rising: bool) -> f64 {
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
            // Newton's next step would be the square of this one.
            if (next - x).abs() <= 1e-9 || hi - lo <= 1e-15 {
                return next;
            }
            x = next;
        }
        x
    }
}
