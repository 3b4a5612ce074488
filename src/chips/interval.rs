//! Interval arithmetic with outward rounding: a result holds every value that the operands allow.

use std::ops::{Add, Mul, Neg, Sub};

/// How far the sine and cosine of the standard library are from the true ones at most: some roundings at 1.
const TRIG_ERROR: f64 = 4.0 * f64::EPSILON;

/// All numbers from `lo` to `hi`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Least.
    pub lo: f64,
    /// Largest.
    pub hi: f64,
}

impl Interval {
    /// A number alone.
    pub fn point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    fn outward(lo: f64, hi: f64) -> Self {
        Self { lo: lo.next_down(), hi: hi.next_up() }
    }

    /// The number in the middle.
    pub fn middle(self) -> f64 {
        self.lo + (self.hi - self.lo) / 2.0
    }

    /// Sign of every number in it: 1, -1, or `None` where they differ or one is zero.
    pub fn sign(self) -> Option<i8> {
        match (self.lo > 0.0, self.hi < 0.0) {
            (true, _) => Some(1),
            (_, true) => Some(-1),
            _ => None,
        }
    }

    /// Largest absolute value.
    pub fn magnitude(self) -> f64 {
        self.hi.abs().max(self.lo.abs())
    }

    /// What both hold; `self` if rounding left nothing.
    pub fn meet(self, other: Self) -> Self {
        let both = Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) };
        if both.lo <= both.hi { both } else { self }
    }

    /// One by it. All numbers when it holds zero.
    pub fn recip(self) -> Self {
        match self.sign() {
            Some(_) => Self::outward(1.0 / self.hi, 1.0 / self.lo),
            None => Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY },
        }
    }

    /// Sine and cosine of every angle in it, radians.
    pub fn sin_cos(self) -> (Self, Self) {
        let quarter = std::f64::consts::FRAC_PI_2;
        (Self { lo: self.lo - quarter, hi: self.hi - quarter }.cos(quarter), self.cos(0.0))
    }

    /// Cosine of every angle in it; `shift` is what was taken away to make a sine of it, whose rounding counts as well.
    fn cos(self, shift: f64) -> Self {
        let pi = std::f64::consts::PI;
        let slack = TRIG_ERROR * (1.0 + shift + self.magnitude());
        if self.hi - self.lo >= 2.0 * pi {
            return Self { lo: -1.0, hi: 1.0 };
        }
        let (a, b) = (self.lo.cos(), self.hi.cos());
        let holds = |extreme: f64| {
            // Whether extreme + 2 pi n lies inside for some n.
            let turns = ((self.lo - slack - extreme) / (2.0 * pi)).ceil();
            extreme + turns * 2.0 * pi <= self.hi + slack
        };
        let hi = if holds(0.0) { 1.0 } else { (a.max(b) + slack).min(1.0) };
        let lo = if holds(pi) { -1.0 } else { (a.min(b) - slack).max(-1.0) };
        Self { lo, hi }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::outward(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::outward(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.lo * other.lo, self.lo * other.hi);
        let (c, d) = (self.hi * other.lo, self.hi * other.hi);
        Self::outward(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}
