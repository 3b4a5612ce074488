//! This module computes the path of a cutter that follows a mesh along lines given in the view from above.
//!
//! Heights are sampled along the path. Let a straight chord connect two positions at which no point of the
//! mesh is inside the cutter. Then a point is inside the cutter on the chord only if it is between the
//! samples. A point that is outside at both ends of a chord of length `L` is at most this deep inside on the
//! way:
//!
//! - with a corner radius `c >= L/2`: `c - sqrt(c^2 - L^2/4)`, since relative to the point the part of the
//!   cutter that can reach it contains a ball of radius `c`;
//! - with a smaller corner radius: `L/2`, since a move of `L/2` leaves the cutter;
//! - with a flat end and a chord that goes `a` across and `h` up: the larger of `R - sqrt(R^2 - a^2/4)` (the
//!   side grazes the point) and `a h / (a + h)` (the edge passes below it at one end and beside it at the
//!   other).
//!
//! Chords are bisected until this depth is at most a quarter of the tolerance, and until the heights at the
//! middle and at the quarters are within a quarter of the tolerance of them. So even a needle between two
//! samples is not cut into, however thin it is. Valleys between two samples may be missed if they are
//! narrower than the largest step; the cutter then stays above them.

use super::{DropCutter, DropPosition, simplify};
use crate::stock::AirClip;

/// The finest tolerance, mm; a smaller one is replaced by it.
const FINEST: f64 = 1e-6;

/// A sample of the path: the length along its leg, and the height of the tip there.
#[derive(Debug, Clone, Copy)]
struct DropSample {
    along: f64,
    tip: Option<f64>,
}

/// A straight leg of the path, and the way in which it is sampled.
struct DropLeg<'a> {
    cutter: &'a DropCutter,
    from: [f64; 2],
    to: [f64; 2],
    length: f64,
    tolerance: f64,
    /// Chords that are at most this long are not bisected, mm.
    shortest: f64,
}

impl DropCutter {
    /// Returns the tip's path over the mesh along a line of (x, y), as chords: lists of points (x, y, tip z)
    /// in mm, one list for each part with triangles under the cutter.
    ///
    /// Chords are as long as `tolerance_mm` (at least 1e-6) allows. The heights at samples, which are at
    /// most [`DropCutter::largest_step_mm`] apart, are met to half of it. Material between samples is cut
    /// into by at most a quarter of it, measured along its normal. Where the height jumps, at vertical walls,
    /// the path goes straight up or down beside the wall, with an error of at most the tolerance. The ends at
    /// the mesh's boundary are found with the same error. Points of the line stay points of the path. Legs
    /// without length or with infinite length are left out. Parts with material may be missed if they are
    /// shorter than two of the largest steps.
    pub fn follow_line(&self, line: &[[f64; 2]], tolerance_mm: f64) -> Vec<Vec<[f64; 3]>> {
        let tolerance = tolerance_mm.max(FINEST);
        let mut runs: Vec<Vec<[f64; 3]>> = Vec::new();
        let mut open: Vec<[f64; 3]> = Vec::new();
        let legs = line.windows(2).filter_map(|pair| match pair {
            [from, to] => DropLeg::new(self, *from, *to, tolerance),
            _ => None,
        });
        for leg in legs {
            let samples = leg.sample_leg(self.largest_step_mm(tolerance));
            for (index, run) in leg.simplify_runs(&samples).into_iter().enumerate() {
                // Only the first part of a leg can continue the leg before.
                let goes_on = index == 0 && open.last().zip(run.first()).is_some_and(|(a, b)| a == b);
                if !goes_on {
                    runs.push(std::mem::take(&mut open));
                }
                open.extend(run.into_iter().skip(usize::from(goes_on)));
            }
        }
        runs.push(open);
        runs.retain(|run| !run.is_empty());
        runs
    }

    /// Returns the largest distance between samples in the view from above, mm, for a tolerance. It is a
    /// quarter of the radius, or less if a ball with the corner radius (with a flat end, the cutter's radius)
    /// would otherwise be off by more than a quarter of the tolerance.
    pub fn largest_step_mm(&self, tolerance_mm: f64) -> f64 {
        let corner = self.cutter().corner_radius_mm();
        let round = if corner > 0.0 { corner } else { self.cutter().radius_mm() };
        // The sagitta of a chord s on radius R is about s^2 / (8 R); it equals tolerance / 4 at s = sqrt(2 R
        // tolerance).
        let step = (2.0 * round * tolerance_mm.max(FINEST)).sqrt();
        step.min(self.cutter().radius_mm() / 4.0)
    }

    /// Returns how deep a point that is outside the cutter at both ends of a chord can be inside it between
    /// them, mm. `across` and `up` are the chord's lengths.
    fn max_depth_between(&self, across: f64, up: f64) -> f64 {
        let cutter = self.cutter();
        let sagitta = |radius: f64, chord: f64| {
            let half = chord / 2.0;
            // R - sqrt(R^2 - h^2), written so that nothing cancels.
            if half < radius { half * half / (radius + (radius * radius - half * half).sqrt()) } else { half }
        };
        let corner = cutter.corner_radius_mm();
        if corner > 0.0 {
            return sagitta(corner, across.hypot(up));
        }
        let beside = if across > 0.0 { across * up.abs() / (across + up.abs()) } else { 0.0 };
        sagitta(cutter.radius_mm(), across).max(beside)
    }
}

impl<'a> DropLeg<'a> {
    fn new(cutter: &'a DropCutter, from: [f64; 2], to: [f64; 2], tolerance: f64) -> Option<Self> {
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        (length > 0.0 && length.is_finite()).then_some(Self {
            cutter,
            from,
            to,
            length,
            tolerance,
            shortest: tolerance / 2.0,
        })
    }

    fn point_at(&self, along: f64) -> [f64; 2] {
        // The end is met to the last bit, so that legs join.
        if along >= self.length {
            return self.to;
        }
        let share = along / self.length;
        [0, 1].map(|axis: usize| {
            let [from, to] = [self.from, self.to].map(|point| point.get(axis).copied().unwrap_or_default());
            from + (to - from) * share
        })
    }

    fn sample_at(&self, along: f64) -> DropSample {
        let [x, y] = self.point_at(along);
        DropSample { along, tip: self.cutter.drop_at(x, y).map(|DropPosition { tip_z_mm: tip_z, .. }| tip_z) }
    }

    fn sample_leg(&self, step: f64) -> Vec<DropSample> {
        // A part is refined into four samples at least, so the parts may be four steps long.
        let count = (self.length / (4.0 * step)).ceil().max(1.0);
        let mut last = self.sample_at(0.0);
        let mut samples = vec![last];
        let [from, to] = [self.from, self.to].map(|[x, y]| [x, y, 0.0]);
        let near = self.cutter.air.near_steps(from, to, count);
        let mut index = near[0];
        while index <= count {
            let along = if index == count { self.length } else { self.length * (index / count) };
            let next = self.sample_at(along);
            self.refine_samples(last, next, &mut samples);
            last = next;
            index = AirClip::step_behind(index, near, count);
        }
        samples
    }

    /// Adds the samples after `from` up to `to`, so that all chords between neighbours are good enough.
    fn refine_samples(&self, from: DropSample, to: DropSample, samples: &mut Vec<DropSample>) {
        let across = to.along - from.along;
        let middle = f64::midpoint(from.along, to.along);
        if across <= self.shortest || !(from.along < middle && middle < to.along) {
            samples.push(to);
            return;
        }
        let half = self.sample_at(middle);
        if from.tip.is_none() && half.tip.is_none() && to.tip.is_none() {
            samples.push(to);
            return;
        }
        if self.is_straight(from, half, to) {
            let [first, third] =
                [(from, half), (half, to)].map(|(a, b)| self.sample_at(f64::midpoint(a.along, b.along)));
            let parts = [(from, first), (first, half), (half, third), (third, to)];
            if self.is_straight(from, first, half)
                && self.is_straight(half, third, to)
                && parts.iter().all(|(a, b)| self.is_gouge_free(*a, *b))
            {
                samples.extend(parts.map(|(_, end)| end));
                return;
            }
        }
        self.refine_samples(from, half, samples);
        self.refine_samples(half, to, samples);
    }

    /// Returns whether the height at the middle is within a quarter of the tolerance of the chord.
    fn is_straight(&self, from: DropSample, half: DropSample, to: DropSample) -> bool {
        match (from.tip, half.tip, to.tip) {
            (Some(a), Some(z), Some(b)) => (z - f64::midpoint(a, b)).abs() <= self.tolerance / 4.0,
            _ => false,
        }
    }

    /// Returns whether material between two samples cannot be cut into by more than a quarter of the
    /// tolerance.
    fn is_gouge_free(&self, from: DropSample, to: DropSample) -> bool {
        match (from.tip, to.tip) {
            (Some(a), Some(b)) => {
                self.cutter.max_depth_between(to.along - from.along, b - a) <= self.tolerance / 4.0
            }
            _ => false,
        }
    }

    /// Returns the parts with heights, reduced to few points.
    fn simplify_runs(&self, samples: &[DropSample]) -> Vec<Vec<[f64; 3]>> {
        let mut runs = Vec::new();
        for stretch in samples.chunk_by(|a, b| a.tip.is_some() == b.tip.is_some()) {
            let heights: Vec<[f64; 2]> =
                stretch.iter().filter_map(|sample| Some([sample.along, sample.tip?])).collect();
            if heights.is_empty() {
                continue;
            }
            let stepped = self.insert_steps(&heights);
            let kept = simplify::simplify_polyline(&stepped, self.tolerance / 2.0);
            let point = |[along, z]: [f64; 2]| {
                let [x, y] = self.point_at(along);
                [x, y, z]
            };
            runs.push(kept.into_iter().map(point).collect());
        }
        runs
    }

    /// Replaces jumps by vertical steps beside the wall: a step up is at the position before the wall, a step
    /// down at the position behind it.
    fn insert_steps(&self, heights: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut stepped: Vec<[f64; 2]> = Vec::with_capacity(heights.len());
        for next in heights {
            if let Some(last) = stepped.last().copied() {
                let up = next[1] - last[1];
                // Only chords of the shortest length may still be too deep, and these are jumps.
                if self.cutter.max_depth_between(next[0] - last[0], up) > self.tolerance / 4.0 {
                    stepped.push(if up > 0.0 { [last[0], next[1]] } else { [next[0], last[1]] });
                }
            }
            stepped.push(*next);
        }
        stepped
    }
}
