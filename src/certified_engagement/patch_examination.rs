//! This module examines one patch of a search: it drops the patch, or tries a witness in it and halves it.

use super::contour_element::ContourElement;
use super::cover_test::{CoverTask, MATERIAL_TOLERANCE_MM};
use super::patch_hull::PatchHull;
use super::step_search::{EngagementCriterion, StepSearch};
use super::surface_patch::{SurfacePatch, surface_point};
use super::time_union::{find_uncovered, span_of};

/// Patches smaller than this (mm) are not halved.
const SMALLEST_PATCH: f64 = 1e-6;
/// After a zoom into one point so many more patches are examined.
const PATCHES_AFTER_ZOOM: usize = 300;
/// After so many patches those that have hardly left an equal cutter's way are looked at.
const PATCHES_BEFORE_NEARNESS: usize = 160;
/// After so many patches without any material, passes that coincide with earlier ones are looked for.
const PATCHES_BEFORE_COINCIDENCE: usize = 6;
/// The number of steps that are remembered because they covered patches, and that are tried because they are
/// the last.
const HOT_STEPS: usize = 16;
const QUICK_STEPS: usize = 24;
/// What a large patch must promise, as a multiple of the lower bound, before a point of it is tried.
const WORTH_OF_LARGE: f64 = 1.1;
/// The part of the cutter's radius above which a patch is not tested against all steps.
const LARGE_PATCH: f64 = 0.15;

/// The ranges of depths that a patch is tested for: where material may begin, where a chip above the
/// threshold must have material at the same time, and all that matters to its points.
struct DepthRanges {
    first: [f64; 2],
    second: Option<[f64; 2]>,
    whole: [f64; 2],
}

impl StepSearch<'_> {
    /// Examines a patch: drops it, or finds a witness in it and halves it.
    pub(super) fn examine(&mut self, mut patch: SurfacePatch) {
        let contour = self.contour;
        let Some(element) = contour.elements().get(patch.element) else { return };
        let threshold = self.threshold();
        let Some(ranges) = self.depth_ranges(&mut patch, threshold) else {
            return self.drop_patch(&patch, threshold);
        };
        if self.patches > PATCHES_BEFORE_COINCIDENCE && self.step.turn == 0.0 && self.lower == 0.0 {
            let Some(need) = self.remove_coincident(patch.need) else {
                return self.drop_patch(&patch, threshold);
            };
            patch.need = need;
        }
        let reach = PatchHull::new(self.step, element, &patch, ranges.whole);
        let mut near = std::mem::take(&mut self.near);
        near.clear();
        let Some(need) = self.test_patch(&mut patch, element, &ranges, &reach, &mut near) else {
            self.near = near;
            return self.drop_patch(&patch, threshold);
        };
        let is_bent = reach.bend > (reach.sag + reach.skew) * 0.3;
        patch.need = need;
        if patch.candidates.is_some() {
            // Those that covered a part of the times come first for the halves, since they leave less for
            // the others.
            for (place, step) in self.buffers.covering.iter().enumerate() {
                if let Some(at) = near.iter().position(|other| other == step).filter(|at| *at > place) {
                    near.swap(at, place);
                }
            }
            patch.candidates = Some(near.as_slice().into());
        }
        self.near = near;
        self.divide(patch, element, is_bent);
    }

    /// Returns the ranges of depths that a patch is tested for, or `None` if no chip of it can exceed the
    /// threshold.
    fn depth_ranges(&self, patch: &mut SurfacePatch, threshold: f64) -> Option<DepthRanges> {
        if self.criterion == EngagementCriterion::Share {
            patch.depths = [0.0, 0.0];
            return Some(DepthRanges { first: [0.0, 0.0], second: None, whole: [0.0, 0.0] });
        }
        patch.depths[1] = patch.depths[1].min(patch.upper - threshold);
        let [from, to] = patch.depths;
        (from <= to).then_some(DepthRanges {
            first: [from, to],
            second: Some([from + threshold, patch.upper]),
            whole: [0.0, patch.upper],
        })
    }

    /// Tests a patch with all means. Returns the span of times at which it may have a chip above the
    /// threshold.
    fn test_patch(
        &mut self,
        patch: &mut SurfacePatch,
        element: &ContourElement,
        ranges: &DepthRanges,
        reach: &PatchHull,
        near: &mut Vec<u32>,
    ) -> Option<[f64; 2]> {
        let first = ranges.second.map(|_| PatchHull::new(self.step, element, patch, ranges.first));
        let need = self.cover_patch(patch, first.as_ref().unwrap_or(reach), reach, near)?;
        if let Some(depths) = ranges.second {
            let hull = PatchHull::new(self.step, element, patch, depths);
            let task = CoverTask {
                hull: &hull,
                axis: self.side_axis(),
                reach: (reach.middle(), reach.radius),
                need,
                candidates: near,
                limit: self.own_sweeps_apart(need[0]),
            };
            self.program.cover_hull(&task, &mut self.buffers, &mut Vec::new())?;
        }
        if self.patches > PATCHES_BEFORE_NEARNESS && self.step.is_straight() {
            let [along, around, _] = patch.sizes(element);
            let is_arc = matches!(element, ContourElement::Arc { .. });
            let size = if is_arc { along.max(around) } else { around };
            self.add_near_coincidence(patch, ranges.whole[1], size, near);
        }
        let slack = self.program.time_slack(reach.middle());
        find_uncovered(&mut self.buffers.times, patch.need, slack, &mut self.buffers.uncovered);
        span_of(&self.buffers.uncovered)
    }

    /// Notes that a patch has nothing above the threshold.
    fn drop_patch(&mut self, patch: &SurfacePatch, threshold: f64) {
        self.keep_patch(patch);
        // A share is none where there is no material; a thin chip may still be there.
        if matches!(self.criterion, EngagementCriterion::Chip { .. }) {
            self.settled = self.settled.max(threshold);
        }
    }

    /// Tests the patch's hull against the steps that may touch it: first those that covered other patches,
    /// and the last ones. A large patch is not tested against all: what they leave of it is halved anyway.
    pub(super) fn cover_patch(
        &mut self,
        patch: &mut SurfacePatch,
        hull: &PatchHull,
        reach: &PatchHull,
        near: &mut Vec<u32>,
    ) -> Option<[f64; 2]> {
        self.buffers.times.clear();
        let mut task = CoverTask {
            hull,
            axis: self.side_axis(),
            reach: (reach.middle(), reach.radius),
            need: patch.need,
            candidates: &[],
            limit: self.own_sweeps_apart(patch.need[0]),
        };
        self.buffers.covering.clear();
        if let Some(candidates) = patch.candidates.clone() {
            task.candidates = &candidates;
            return self.program.cover_hull(&task, &mut self.buffers, near);
        }
        let low = self.near_steps(f64::NEG_INFINITY);
        let known = self.hot.iter().copied();
        let mut quick = std::mem::take(&mut self.quick);
        quick.clear();
        quick.extend(known.filter(|step| self.program.is_earlier(*step, self.before)));
        quick.extend(low.iter().take(QUICK_STEPS));
        let left =
            self.program.cover_hull(&CoverTask { candidates: &quick, ..task }, &mut self.buffers, near);
        self.quick = quick;
        if left.is_none() {
            self.keep_hot();
        }
        if left.is_none() || reach.radius > self.contour.radius_mm() * LARGE_PATCH {
            return left;
        }
        near.clear();
        let all = self.near_steps(reach.bounds(patch.need)[1].z);
        task.candidates = &all;
        let left = self.program.cover_hull(&task, &mut self.buffers, near);
        if left.is_none() {
            self.keep_hot();
        }
        patch.candidates = Some(near.as_slice().into());
        left
    }

    /// Remembers the steps that covered a patch: they are tried first for others, and on the next block.
    fn keep_hot(&mut self) {
        for step in self.buffers.covering.drain(..) {
            if let Some(place) = self.hot.iter().position(|hot| *hot == step) {
                self.hot.remove(place);
            }
            self.hot.insert(0, step);
        }
        self.hot.truncate(HOT_STEPS);
    }

    /// Returns the span of a time without the times at which the cutter is where an equal cutter was.
    fn remove_coincident(&mut self, need: [f64; 2]) -> Option<[f64; 2]> {
        if self.coincident.is_none() {
            let apart = MATERIAL_TOLERANCE_MM / 2.0;
            // Where the tips meet, the other cutter reaches as deep as the own one.
            let all = self.near_steps(self.step.tips[0].z.max(self.step.tips[1].z) + 1e-3);
            let of_step =
                |number: u32| self.program.step_and_contour(number)?.0.times_coincident(self.step, apart);
            let middle = (self.step.tips[0] + self.step.tips[1]) / 2.0;
            let half = (self.step.tips[1] - self.step.tips[0]).norm() / 2.0 + self.step.side_deviation + 1e-2;
            let earlier = all.iter().filter(|number| {
                self.program.is_earlier(**number, self.own_first)
                    && self.program.may_tip_pass(**number, &middle, half)
            });
            let exact = earlier.flat_map(|number| self.program.exact_parts_of(*number));
            self.coincident = Some(exact.filter_map(of_step).collect());
        }
        let times = self.coincident.as_mut()?;
        if times.is_empty() {
            return Some(need);
        }
        let way = (self.step.tips[1] - self.step.tips[0]).norm().max(1e-9);
        find_uncovered(times, need, self.program.guard_mm / way, &mut self.buffers.uncovered);
        span_of(&self.buffers.uncovered)
    }

    /// Tries a witness in a patch and halves it.
    fn divide(&mut self, patch: SurfacePatch, element: &ContourElement, is_bent: bool) {
        self.try_middle(&patch, element);
        if patch.upper <= self.threshold() {
            self.keep_patch(&patch);
            self.settled = self.settled.max(patch.upper);
            return;
        }
        let [mut along, around, deep] = patch.sizes(element);
        // A straight part of the contour has no sag along it.
        if matches!(element, ContourElement::Line { .. }) {
            along *= 0.2;
        }
        // A range of depths counts as a part of the cutter's radius, as it is a part of the chip.
        let deep = deep / patch.upper * self.contour.radius_mm() * 0.3;
        let sizes = [along, around, deep];
        let longest = sizes.iter().copied().fold(0.0, f64::max);
        if longest < SMALLEST_PATCH {
            if self.fans > 0 {
                self.fans -= 1;
                self.search_around(&patch, element);
            }
            self.keep_patch(&patch);
            self.settled = self.settled.max(patch.upper);
            if patch.upper > self.threshold() {
                // Nothing that waits exceeds this patch, so only the lower bound can still change.
                self.rounds = self.rounds.min(PATCHES_AFTER_ZOOM);
            }
            return;
        }
        let halves = if self.divides_times(&patch, element, is_bent) {
            patch.halve_times()
        } else {
            patch.halve(sizes.iter().position(|size| *size >= longest).unwrap_or(0))
        };
        for half in halves {
            self.enqueue(half);
        }
    }

    /// Tries the middle of a patch as a witness, and climbs from it if the material limits its chip.
    fn try_middle(&mut self, patch: &SurfacePatch, element: &ContourElement) {
        let [m, angle, depth] = patch.middle();
        let known = self.lower;
        if patch.candidates.is_none() && patch.upper <= known * WORTH_OF_LARGE {
            return;
        }
        let candidates = patch.candidates.clone().unwrap_or_else(|| {
            let place = surface_point(element, m, angle, 0.0);
            let highest = self.step.tips[0].z.max(self.step.tips[1].z) + place.z + self.criterion.scale();
            let is_upright = self.step.is_exact() && self.step.axes[0] == nalgebra::Vector3::z();
            self.near_steps(if is_upright { highest } else { f64::MAX })
        });
        self.try_point((patch.element, m, angle), depth, patch.need, &candidates);
        let is_short = self.lower > known * 1.02 && self.lower < patch.upper * 0.97;
        if is_short && self.climbs > 0 && self.criterion != EngagementCriterion::Share {
            self.climbs -= 1;
            self.climb();
        }
    }

    /// Returns whether the times of a patch are divided rather than its surface: where its points' ways bend
    /// more than it bulges, or where its shares change more with time than over the patch.
    pub(super) fn divides_times(
        &self,
        patch: &SurfacePatch,
        element: &ContourElement,
        is_bent: bool,
    ) -> bool {
        let [m, angle, _] = patch.middle();
        let scale = self.criterion.scale();
        let change = self.advance.change(patch.need) * scale;
        let of_middle = self.advance.upper(element, [m, m], [angle, angle], patch.need) * scale;
        let varies =
            patch.upper - of_middle <= change && change > patch.upper * self.options.tolerance * 0.25;
        (varies || is_bent) && patch.need[1] - patch.need[0] > 1e-7
    }
}
