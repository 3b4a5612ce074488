//! This module does interval arithmetic with outward rounding: a result contains every value that the
//! operands allow.

use std::f64::consts::{FRAC_PI_2, PI};
use std::ops::{Add, Mul, Neg, Sub};

/// The largest error of the standard library's sine and cosine: some roundings at 1.
const TRIG_ERROR: f64 = 4.0 * f64::EPSILON;

/// The interval of all numbers from `lo` to `hi`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct IntervalF64 {
    /// The least number.
    pub lo: f64,
    /// The largest number.
    pub hi: f64,
}

impl IntervalF64 {
    /// Makes the interval of a single number.
    pub(super) fn from_point(x: f64) -> Self {
        Self { lo: x, hi: x }
    }

    /// Makes the interval around results that were rounded to these two numbers. An operation has an error of
    /// half a unit in the last place, and a number times epsilon is at least one such unit. This is quicker
    /// than computing the next number.
    fn rounded_outward(lo: f64, hi: f64) -> Self {
        let slack = |x: f64| x.abs() * f64::EPSILON + f64::MIN_POSITIVE;
        Self { lo: lo - slack(lo), hi: hi + slack(hi) }
    }

    /// Returns the middle.
    pub(super) fn middle(self) -> f64 {
        self.lo + (self.hi - self.lo) / 2.0
    }

    /// Returns the sign of every number in the interval, 1 or -1. Returns `None` if the signs differ or a
    /// number is zero.
    pub(super) fn sign(self) -> Option<i8> {
        match (self.lo > 0.0, self.hi < 0.0) {
            (true, _) => Some(1),
            (_, true) => Some(-1),
            _ => None,
        }
    }

    /// Returns the largest absolute value.
    pub(super) fn magnitude(self) -> f64 {
        self.hi.abs().max(self.lo.abs())
    }

    /// Returns the intersection of both intervals, or `self` if rounding left it empty.
    pub(super) fn intersect_or_self(self, other: Self) -> Self {
        let both = Self { lo: self.lo.max(other.lo), hi: self.hi.min(other.hi) };
        if both.lo <= both.hi { both } else { self }
    }

    /// Returns the reciprocal. It is the interval of all numbers if this one contains zero.
    pub(super) fn recip(self) -> Self {
        match self.sign() {
            Some(_) => Self::rounded_outward(1.0 / self.hi, 1.0 / self.lo),
            None => Self { lo: f64::NEG_INFINITY, hi: f64::INFINITY },
        }
    }

    /// Returns the sine and cosine of all angles in the interval, in radians.
    pub(super) fn sin_cos(self) -> (Self, Self) {
        let [single, _] = self.sin_cos_with_doubles();
        single
    }

    /// Returns the sine and cosine of all angles in the interval, and of twice those angles.
    pub(super) fn sin_cos_with_doubles(self) -> [(Self, Self); 2] {
        let ends = EndValues([self.lo.sin_cos(), self.hi.sin_cos()]);
        let slack = 2.0 * TRIG_ERROR * (1.0 + self.magnitude());
        let double = Self { lo: 2.0 * self.lo, hi: 2.0 * self.hi };
        let sin = ends.map(|(sin, _)| sin).cosine_range(self, FRAC_PI_2, slack);
        let cos = ends.map(|(_, cos)| cos).cosine_range(self, 0.0, slack);
        let sin2 = ends.map(|(sin, cos)| 2.0 * sin * cos).cosine_range(double, FRAC_PI_2, slack);
        let cos2 = ends.map(|(sin, cos)| cos * cos - sin * sin).cosine_range(double, 0.0, slack);
        [(sin, cos), (sin2, cos2)]
    }
}

/// The values of a function at the least and at the largest angle of an interval.
#[derive(Clone, Copy)]
struct EndValues<T>([T; 2]);

impl<T> EndValues<T> {
    fn map<U>(self, of: fn(T) -> U) -> EndValues<U> {
        EndValues(self.0.map(of))
    }
}

impl EndValues<f64> {
    /// Returns the range of a cosine over the angles of an interval. `crest` is the angle of a maximum of the
    /// cosine, in radians, and `slack` bounds the rounding of the values at both ends and of the angles.
    fn cosine_range(self, angles: IntervalF64, crest: f64, slack: f64) -> IntervalF64 {
        let Self([a, b]) = self;
        let turn = 2.0 * PI;
        // The distances, in turns, from the least angle to the first maximum and to the first minimum. One
        // that is so close to an end that rounding hides it may count, because the value there is 1 to the
        // last bit.
        let near = 16.0 * slack;
        let from = (angles.lo - near - crest) / turn;
        let wide = (angles.hi - angles.lo + 2.0 * near) / turn;
        let to_crest = ceil_to_whole(from) - from;
        let to_trough = if to_crest >= 0.5 { to_crest - 0.5 } else { to_crest + 0.5 };
        let hi = if to_crest <= wide { 1.0 } else { (a.max(b) + slack).min(1.0) };
        let lo = if to_trough <= wide { -1.0 } else { (a.min(b) - slack).max(-1.0) };
        IntervalF64 { lo, hi }
    }
}

/// Returns the smaller of two numbers. This is one instruction, whereas `f64::min` also handles values that
/// are not numbers.
fn smaller_of(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Returns the larger of two numbers, likewise in one instruction.
fn larger_of(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Returns the least whole number that is not less than `x`, for absolute values up to a few thousand. It is
/// quicker than `ceil`, which is a function call on many processors.
fn ceil_to_whole(x: f64) -> f64 {
    let cut = x as i32 as f64;
    if cut < x { cut + 1.0 } else { cut }
}

impl Add for IntervalF64 {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::rounded_outward(self.lo + other.lo, self.hi + other.hi)
    }
}

impl Sub for IntervalF64 {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::rounded_outward(self.lo - other.hi, self.hi - other.lo)
    }
}

impl Mul for IntervalF64 {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let (a, b) = (self.lo * other.lo, self.lo * other.hi);
        let (c, d) = (self.hi * other.lo, self.hi * other.hi);
        Self::rounded_outward(
            smaller_of(smaller_of(a, b), smaller_of(c, d)),
            larger_of(larger_of(a, b), larger_of(c, d)),
        )
    }
}

impl Neg for IntervalF64 {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

#[cfg(test)]
mod tests {
    use super::IntervalF64;
    use proptest::prelude::*;

    fn interval(width: f64) -> impl Strategy<Value = IntervalF64> {
        (-9.0..9.0f64, prop_oneof![Just(0.0), 0.0..1e-9, 0.0..width])
            .prop_map(|(lo, width)| IntervalF64 { lo, hi: lo + width })
    }

    fn holds(interval: IntervalF64, value: f64) -> bool {
        interval.lo <= value && value <= interval.hi
    }

    proptest! {
        #![proptest_config(crate::property::property(256))]

        #[test]
        fn results_hold_what_numbers_of_the_operands_make(
            (a, b) in (interval(3.0), interval(3.0)),
            shares in prop::array::uniform2(0.0..=1.0f64),
        ) {
            let [x, y] = [(a, shares[0]), (b, shares[1])].map(|(i, share)| (i.lo + share * (i.hi - i.lo)).min(i.hi));
            prop_assert!(holds(a + b, x + y) && holds(a - b, x - y) && holds(a * b, x * y) && holds(-a, -x));
            prop_assert!(a.sign().is_none() || holds(a.recip(), 1.0 / x));
        }

        #[test]
        fn sines_and_cosines_are_held_and_no_wider_than_they_are(angles in interval(8.0)) {
            const LOOKS: usize = 2000;
            let [(sin, cos), (sin2, cos2)] = angles.sin_cos_with_doubles();
            let functions = [
                (sin, f64::sin as fn(f64) -> f64, 1.0),
                (cos, f64::cos, 1.0),
                (sin2, f64::sin, 2.0),
                (cos2, f64::cos, 2.0),
            ];
            for (found, function, times) in functions {
                let at = |look: usize| angles.lo + (angles.hi - angles.lo) * look as f64 / LOOKS as f64;
                let values = (0..=LOOKS).map(|look| function(times * at(look).min(angles.hi)));
                let (low, high) = values.fold((2.0f64, -2.0f64), |(low, high), v| (low.min(v), high.max(v)));
                prop_assert!(found.lo <= low && high <= found.hi, "{found:?} {low} {high}");
                // Between two samples a curve deviates by the square of their distance, times an eighth of
                // its second derivative.
                let missed = (times * (angles.hi - angles.lo) / LOOKS as f64).powi(2) + 1e-13;
                prop_assert!(low - found.lo <= missed && found.hi - high <= missed, "{found:?} {low} {high}");
            }
        }
    }

    #[test]
    fn crests_and_troughs_at_the_very_end_count() {
        use std::f64::consts::{FRAC_PI_2, PI};
        for turn in [-2.0 * PI, 0.0, 2.0 * PI] {
            for (angles, is_cos, extreme) in [
                (IntervalF64 { lo: turn - 0.3, hi: turn }, true, 1.0),
                (IntervalF64 { lo: turn + PI, hi: turn + PI + 0.3 }, true, -1.0),
                (IntervalF64 { lo: turn + FRAC_PI_2, hi: turn + 2.0 }, false, 1.0),
                (IntervalF64 { lo: turn - 2.0, hi: turn - FRAC_PI_2 }, false, -1.0),
            ] {
                let (sin, cos) = angles.sin_cos();
                let found = if is_cos { cos } else { sin };
                assert!(holds(found, extreme), "{angles:?} {found:?}");
            }
        }
    }
}
