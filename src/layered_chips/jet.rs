//! This module computes functions of time together with their first two derivatives, for numbers or for
//! intervals of time.

use super::interval::IntervalF64;
use std::ops::{Add, Mul, Neg, Sub};

/// The arithmetic of a function of time: numbers, or intervals that contain all values.
pub(super) trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// Converts a number.
    fn from_f64(x: f64) -> Self;
    /// Returns the reciprocal.
    fn recip(self) -> Self;
    /// Returns the sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
}

impl Scalar for f64 {
    fn from_f64(x: f64) -> Self {
        x
    }
    fn recip(self) -> Self {
        1.0 / self
    }
    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }
}

impl Scalar for IntervalF64 {
    fn from_f64(x: f64) -> Self {
        Self::from_point(x)
    }
    fn recip(self) -> Self {
        IntervalF64::recip(self)
    }
    fn sin_cos(self) -> (Self, Self) {
        IntervalF64::sin_cos(self)
    }
}

/// A value with its first and second derivative with respect to time.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet<S> {
    /// The value.
    pub v: S,
    /// The first derivative.
    pub d: S,
    /// The second derivative.
    pub dd: S,
}

impl<S: Scalar> Jet<S> {
    /// Makes a constant, whose derivatives are zero.
    pub(super) fn constant(x: f64) -> Self {
        Self { v: S::from_f64(x), d: S::from_f64(0.0), dd: S::from_f64(0.0) }
    }

    /// Returns the reciprocal.
    pub(super) fn recip(self) -> Self {
        let r = self.v.recip();
        let rr = r * r;
        let d = -(self.d * rr);
        // (1/v)' = -v' / v^2 and (1/v)'' = (2 v'^2 / v - v'') / v^2.
        Self { v: r, d, dd: (S::from_f64(2.0) * self.d * self.d * r - self.dd) * rr }
    }

    /// Returns the value multiplied by a number.
    pub(super) fn scaled_by(self, factor: f64) -> Self {
        let factor = S::from_f64(factor);
        Self { v: self.v * factor, d: self.d * factor, dd: self.dd * factor }
    }
}

impl<S: Scalar> Add for Jet<S> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { v: self.v + other.v, d: self.d + other.d, dd: self.dd + other.dd }
    }
}

impl<S: Scalar> Sub for Jet<S> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { v: self.v - other.v, d: self.d - other.d, dd: self.dd - other.dd }
    }
}

impl<S: Scalar> Mul for Jet<S> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // Leibniz: (u v)'' = u'' v + 2 u' v' + u v''.
        let twice = self.d * other.d;
        Self {
            v: self.v * other.v,
            d: self.d * other.v + self.v * other.d,
            dd: self.dd * other.v + twice + twice + self.v * other.dd,
        }
    }
}
