//! This module finds the part of a long way that is near a body, so that no time and memory is spent on air.
//!
//! One lost decimal point makes a motion of 100 km. Who samples a motion in steps would take a hundred million of
//! them, and all but a few are in the air.

use super::AxisBox;

/// A way that is longer than this many diagonals of the box is cut where it enters and leaves the box. Shorter ways
/// are left whole, so the numbers of ordinary programs do not depend on how their stock is described.
const FAR_DIAGONALS: f64 = 4.0;

/// The box around a body and all places from which a tool reaches it.
///
/// ```
/// use clsmith::stock::AirClip;
///
/// let air = AirClip::around(([0.0, 0.0, 0.0], [100.0, 100.0, 10.0]), 10.0);
/// // A motion along the whole body is not cut.
/// assert_eq!(air.cut_far_way([-50.0, 5.0, 0.0], [150.0, 5.0, 0.0]), None);
/// // One that goes away for a kilometre is cut where it leaves the box.
/// assert_eq!(air.cut_far_way([0.0, 5.0, 0.0], [1e6, 5.0, 0.0]), Some([0.0, 110.0 / 1e6]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AirClip {
    low: [f64; 3],
    high: [f64; 3],
    far_mm: f64,
}

impl AirClip {
    /// Makes the box around `bounds` and all places that are at most `reach_mm` from it.
    pub fn around((low, high): AxisBox, reach_mm: f64) -> Self {
        let (low, high) = (low.map(|at| at - reach_mm), high.map(|at| at + reach_mm));
        let sides = low.iter().zip(&high).map(|(low, high)| high - low).filter(|side| side.is_finite());
        let diagonal = sides.map(|side| side * side).sum::<f64>().sqrt();
        Self { low, high, far_mm: FAR_DIAGONALS * diagonal }
    }

    /// Makes the box for a tool that is lowered onto a body from above: heights do not count.
    pub fn around_from_above((low, high): AxisBox, reach_mm: f64) -> Self {
        let ([x0, y0, _], [x1, y1, _]) = (low, high);
        Self::around(([x0, y0, f64::NEG_INFINITY], [x1, y1, f64::INFINITY]), reach_mm)
    }

    /// Returns the length in mm above which a way is cut.
    pub fn far_mm(&self) -> f64 {
        self.far_mm
    }

    /// Returns the shares of a straight way at which it enters and leaves the box, or `None` for a way of ordinary
    /// length. A far way that misses the box enters it at its end.
    pub fn cut_far_way(&self, from: [f64; 3], to: [f64; 3]) -> Option<[f64; 2]> {
        let way = [0, 1, 2].map(|axis: usize| component(to, axis) - component(from, axis));
        let length = way.iter().map(|side| side * side).sum::<f64>().sqrt();
        if !(length > self.far_mm && length.is_finite()) {
            return None;
        }
        let [mut enters, mut leaves] = [0.0_f64, 1.0_f64];
        for axis in 0..3 {
            let (at, along) = (component(from, axis), component(way, axis));
            let (low, high) = (component(self.low, axis), component(self.high, axis));
            if along == 0.0 {
                if at < low || at > high {
                    return Some([1.0, 1.0]);
                }
                continue;
            }
            let (one, other) = ((low - at) / along, (high - at) / along);
            (enters, leaves) = (enters.max(one.min(other)), leaves.min(one.max(other)));
        }
        Some(if enters < leaves { [enters, leaves] } else { [1.0, 1.0] })
    }

    /// Returns whether a far way, or a part that [`AirClip::cut_far_way`] has cut from one, is in the air.
    pub fn is_far_air(&self, from: [f64; 3], to: [f64; 3]) -> bool {
        // The ends of a part lie on the box, up to rounding.
        self.cut_far_way(from, to).is_some_and(|[enters, leaves]| leaves - enters < 1e-6)
    }

    /// Returns the numbers of the first and the last of `count` even steps of a way that are near the body; all steps,
    /// from 1 to `count`, for a way of ordinary length. Steps between 0 and the first one, and between the last one and
    /// `count`, are in the air.
    pub fn near_steps(&self, from: [f64; 3], to: [f64; 3], count: f64) -> [f64; 2] {
        match self.cut_far_way(from, to) {
            None => [1.0, count],
            Some([enters, leaves]) => {
                [(enters * count).floor().clamp(1.0, count), (leaves * count).ceil().clamp(1.0, count)]
            }
        }
    }

    /// Returns the number of the step behind `step` of those that [`AirClip::near_steps`] tells: the steps in the air
    /// behind the last near one are taken in one.
    pub fn step_behind(step: f64, [_, last]: [f64; 2], count: f64) -> f64 {
        if step >= last && step < count { count } else { step + 1.0 }
    }
}

fn component(of: [f64; 3], axis: usize) -> f64 {
    of.get(axis).copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block() -> AirClip {
        AirClip::around(([0.0; 3], [100.0, 100.0, 20.0]), 5.0)
    }

    #[test]
    fn a_far_way_past_the_box_is_all_air() {
        let air = block();
        assert_eq!(air.cut_far_way([0.0, 200.0, 0.0], [1e8, 200.0, 0.0]), Some([1.0, 1.0]));
        assert_eq!(air.cut_far_way([200.0, 0.0, 0.0], [1e8, 50.0, 0.0]), Some([1.0, 1.0]));
        assert!(air.is_far_air([105.0, 50.0, 0.0], [1e8, 50.0, 0.0]));
        assert!(!air.is_far_air([105.0, 50.0, 0.0], [200.0, 50.0, 0.0]));
    }

    #[test]
    fn a_far_way_through_the_box_is_cut_twice() {
        let [enters, leaves] = block().cut_far_way([-1e6, 50.0, 0.0], [1e6, 50.0, 0.0]).unwrap();
        assert!((enters * 2e6 - 1e6 + 5.0).abs() < 1e-6 && (leaves * 2e6 - 1e6 - 105.0).abs() < 1e-6);
    }

    #[test]
    fn few_steps_of_a_far_way_are_near() {
        let (from, to, count) = ([50.0, 50.0, 0.0], [50.0, 1e8, 0.0], 1e8);
        let near = block().near_steps(from, to, count);
        let (mut step, mut taken) = (near[0], 0);
        while step <= count {
            taken += 1;
            step = AirClip::step_behind(step, near, count);
        }
        assert!((50..70).contains(&taken), "{taken}");
        assert_eq!(block().near_steps([0.0; 3], [50.0, 0.0, 0.0], 10.0), [1.0, 10.0]);
        assert_eq!(AirClip::step_behind(10.0, [1.0, 10.0], 10.0), 11.0);
    }

    #[test]
    fn numbers_that_are_not_finite_cut_nothing() {
        assert_eq!(block().cut_far_way([0.0; 3], [f64::INFINITY, 0.0, 0.0]), None);
        assert_eq!(block().cut_far_way([f64::NAN; 3], [0.0; 3]), None);
    }
}
