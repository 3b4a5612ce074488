//! Functions of time with their first two derivatives, over numbers or over intervals of time.

use super::interval::IntervalF64;
use std::ops::{Add, Mul, Neg, Sub};

/// What a function of time is computed in: numbers, or intervals that hold all its values.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self>
{
    /// A number.
    fn from_f64(x: f64) -> Self;
    /// One by it.
    fn recip(self) -> Self;
    /// Sine and cosine, radians.
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

/// A value with its first and second derivative by time.
#[derive(Debug, Clone, Copy)]
pub struct Jet<S> {
    /// Value.
    pub v: S,
    /// First derivative.
    pub d: S,
    /// Second derivative.
    pub dd: S,
}

impl<S: Scalar> Jet<S> {
    /// A constant.
    pub fn constant(x: f64) -> Self {
        Self { v: S::from_f64(x), d: S::from_f64(0.0), dd: S::from_f64(0.0) }
    }

    /// One by it.
    pub fn recip(self) -> Self {
        let r = self.v.recip();
        let rr = r * r;
        let d = -(self.d * rr);
        Self { v: r, d, dd: (S::from_f64(2.0) * self.d * self.d * r - self.dd) * rr }
    }

    /// Times a number.
    pub fn scaled_by(self, factor: f64) -> Self {
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
        let twice = self.d * other.d;
        Self {
            v: self.v * other.v,
            d: self.d * other.v + self.v * other.d,
            dd: self.dd * other.v + twice + twice + self.v * other.dd,
        }
    }
}
