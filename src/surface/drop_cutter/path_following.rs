//! Paths of a cutter that goes over the mesh along lines given from above.
//!
//! Heights are sampled along the path. A straight chord between two places where the cutter stands free leaves every point of the mesh
//! free but for what lies between the samples. A point that is outside the cutter at both ends, a distance `L` apart, is no deeper
//! in it on the way than
//!
//! - `c - sqrt(c^2 - L^2/4)` with a corner radius `c >= L/2`: what touches the cutter is a ball of radius `c`, seen from the point,
//! - `L/2` with a smaller one, for a move of `L/2` gets out of it,
//! - with a flat end, going `a` across and `h` up, the greater of `R - sqrt(R^2 - a^2/4)` (it grazes the side) and
//!   `a h / (a + h)` (it passes below the one end and beside the other).
//!
//! Chords are halved until this is a quarter of the tolerance and heights half-way and at the quarters are as near to them. So no
//! needle between samples is cut into, however thin. Valleys between two samples may be passed over when they are narrower
//! than the largest step; the cutter then stays above.

use super::{DropCutter, DropPosition, simplify};

/// The finest tolerance, mm: what is asked for below it is taken as this.
const FINEST: f64 = 1e-6;

/// A place of the path, the length along its leg, and the tip's height there.
#[derive(Debug, Clone, Copy)]
struct DropSample {
    along: f64,
    tip: Option<f64>,
}

/// A straight leg of the path and how it is sampled.
struct DropLeg<'a> {
    cutter: &'a DropCutter,
    from: [f64; 2],
    to: [f64; 2],
    length: f64,
    tolerance: f64,
    /// Chords this short are not halved, mm.
    shortest: f64,
}

impl DropCutter {
    /// The tip's path over the mesh along a line of (x, y), as chords: points (x, y, tip z), mm, a list for each stretch that has
    /// triangles under the cutter.
    ///
    /// Chords are as long as `tolerance` (mm, at least 1e-6) lets them be: heights at samples, which are no farther apart than
    /// [`DropCutter::largest_step_mm`], are met to half of it, and what lies between samples is not cut into deeper than a quarter of it,
    /// measured along its normal. Where the height jumps, at upright walls, the path goes straight up or down beside the wall, off
    /// by no more than the tolerance. Ends at the mesh's border are found to that as well. Points of the line stay points of the path.
    /// Legs of no or endless length are left out, and stretches with material may be when they are shorter than two largest steps.
    pub fn follow_line(&self, line: &[[f64; 2]], tolerance: f64) -> Vec<Vec<[f64; 3]>> {
        let tolerance = tolerance.max(FINEST);
        let mut runs: Vec<Vec<[f64; 3]>> = Vec::new();
        let mut open: Vec<[f64; 3]> = Vec::new();
        let legs = line.windows(2).filter_map(|pair| match pair {
            [from, to] => DropLeg::new(self, *from, *to, tolerance),
            _ => None,
        });
        for leg in legs {
            let samples = leg.sample_leg(self.largest_step_mm(tolerance));
            for (index, run) in leg.simplify_runs(&samples).into_iter().enumerate() {
                // Only a leg's first stretch can go on from the leg before.
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

    /// The largest distance between samples from above, mm, for a tolerance: a quarter of the radius, or so little that a ball of the
    /// corner's radius (of the cutter's, with a flat end) is passed with a quarter of the tolerance.
    pub fn largest_step_mm(&self, tolerance: f64) -> f64 {
        let corner = self.cutter().corner_radius_mm();
        let round = if corner > 0.0 { corner } else { self.cutter().radius_mm() };
        let step = (2.0 * round * tolerance.max(FINEST)).sqrt();
        step.min(self.cutter().radius_mm() / 4.0)
    }

    /// How deep a point that is free at both ends of a chord can be in the cutter on the way; `across` and `up` are the chord's.
    fn max_depth_between(&self, across: f64, up: f64) -> f64 {
        let cutter = self.cutter();
        let sagitta = |radius: f64, chord: f64| {
            let half = chord / 2.0;
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
        DropSample { along, tip: self.cutter.drop_at(x, y).map(|DropPosition { tip_z, .. }| tip_z) }
    }

    fn sample_leg(&self, step: f64) -> Vec<DropSample> {
        // Four parts each, if nothing asks for more.
        let count = (self.length / (4.0 * step)).ceil().max(1.0);
        let mut last = self.sample_at(0.0);
        let mut samples = vec![last];
        let mut index = 1.0;
        while index <= count {
            let along = if index == count { self.length } else { self.length * (index / count) };
            let next = self.sample_at(along);
            self.refine_samples(last, next, &mut samples);
            last = next;
            index += 1.0;
        }
        samples
    }

    /// Adds samples behind `from` up to `to`, so that chords between neighbours are good.
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

    /// Whether the height half-way is a quarter of the tolerance from the chord's.
    fn is_straight(&self, from: DropSample, half: DropSample, to: DropSample) -> bool {
        match (from.tip, half.tip, to.tip) {
            (Some(a), Some(z), Some(b)) => (z - f64::midpoint(a, b)).abs() <= self.tolerance / 4.0,
            _ => false,
        }
    }

    /// Whether what lies between two samples cannot be cut into deeper than a quarter of the tolerance.
    fn is_gouge_free(&self, from: DropSample, to: DropSample) -> bool {
        match (from.tip, to.tip) {
            (Some(a), Some(b)) => {
                self.cutter.max_depth_between(to.along - from.along, b - a) <= self.tolerance / 4.0
            }
            _ => false,
        }
    }

    /// Stretches with heights, with few points.
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

    /// Jumps as steps: beside the wall on its lower side, and over at the upper height.
    fn insert_steps(&self, heights: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut stepped: Vec<[f64; 2]> = Vec::with_capacity(heights.len());
        for next in heights {
            if let Some(last) = stepped.last().copied() {
                let up = next[1] - last[1];
                // Only chords at the shortest length were left as they are.
                if self.cutter.max_depth_between(next[0] - last[0], up) > self.tolerance / 4.0 {
                    stepped.push(if up > 0.0 { [last[0], next[1]] } else { [next[0], last[1]] });
                }
            }
            stepped.push(*next);
        }
        stepped
    }
}
