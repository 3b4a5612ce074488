//! This module tests a hull of lines against the sweep of one step: whether the step may touch what the hull is about,
//! and when it covers the hull.

use super::certified_program::CertifiedProgram;
use super::cover_test::{CoverBuffers, HullTest};
use super::cutter_contour::CutterContour;
use super::cutter_pose::{CoverQuery, CoverSide, PathRef, PathSlice, PointLine};
use super::step_glance::{StepGlance, TangentLook};
use super::swept_step::SweptStep;
use super::time_union::{find_uncovered, span_of};

/// A step that may touch a reach: the times at which it may, and the look at it if there was one.
pub(super) struct NearStep {
    times: [f64; 2],
    look: Option<TangentLook>,
}

impl CertifiedProgram {
    /// Returns the times at which a step may touch the reach of a test.
    #[inline]
    pub(super) fn times_near(
        &self,
        test: &HullTest<'_>,
        candidate: u32,
        need: [f64; 2],
        buffers: &mut CoverBuffers,
    ) -> Option<NearStep> {
        if self.is_far(candidate, &test.place) {
            return None;
        }
        let glance = self.glance_of(candidate)?;
        if buffers.floor.is_some_and(|(floor, _)| glance.bottom >= floor) {
            return None;
        }
        buffers.tests += 1;
        if let PathRef::Line(line) = test.task.reach.0
            && self.is_looked_at(candidate, glance, line)
        {
            // One look is enough: the exact times would cost more than they spare.
            let contour = self.cutters.get(glance.cutter)?;
            let look = glance.look_from(contour, line, need, 0.0);
            let is_near = !look.surely_leaves(line, need, test.outer + glance.deviation);
            return is_near.then_some(NearStep { times: need, look: Some(look) });
        }
        let (step, contour) = self.step_and_contour(candidate)?;
        let query = CoverQuery {
            side: CoverSide::Outer,
            need,
            bound: test.outer,
            precision: test.precision,
            diameter: 0.0,
            spread: 0.0,
            aside: 0.0,
            skew: 0.0,
            axis: test.task.axis,
        };
        let times = step.hull_of_point(contour, test.task.reach.0, &query)?;
        Some(NearStep { times, look: None })
    }

    /// Returns whether a corner of a hull is surely outside a step's sweep at all times, as far as a look tells.
    #[inline]
    fn is_corner_outside(step: &SweptStep, look: &TangentLook, test: &HullTest<'_>, need: [f64; 2]) -> bool {
        let (PathRef::Line(seen), PathSlice::Lines(corners)) = (test.task.reach.0, test.task.hull.corners())
        else {
            return false;
        };
        // The hull must be that deep in the sweep. What is across the own axis needs no depth if the axes are parallel.
        let is_parallel = step.turn == 0.0 && step.axes[0] == test.task.axis;
        let skew = if is_parallel { 0.0 } else { test.task.hull.skew };
        let most = test.bound - step.path_deviation - skew + step.side_deviation;
        let (middle, half) = ((need[0] + need[1]) / 2.0, (need[1] - need[0]) / 2.0);
        let at = seen.at(middle);
        corners.iter().any(|corner| look.least_gap(&(corner.at(middle) - at), &(corner.travel * half)) > most)
    }

    /// Adds the times at which a step that is near covers the hull of a test, and returns the span that is left.
    #[inline]
    pub(super) fn cover_near(
        &self,
        test: &HullTest<'_>,
        candidate: u32,
        near: &NearStep,
        need: [f64; 2],
        buffers: &mut CoverBuffers,
        relevant: &mut Vec<u32>,
    ) -> Option<[f64; 2]> {
        relevant.push(candidate);
        let Some((step, contour)) = self.step_and_contour(candidate) else { return Some(need) };
        if !self.is_earlier(candidate, test.task.limit) {
            return Some(need);
        }
        if let Some(floor) = step.flat_bottom_over(contour, test.task.reach, test.task.need)
            && buffers.floor.is_none_or(|(known, _)| floor < known)
        {
            buffers.floor = Some((floor, candidate));
        }
        let hull = test.task.hull;
        if near.look.is_some_and(|look| Self::is_corner_outside(step, &look, test, near.times)) {
            return Some(need);
        }
        if let (Some(look), PathSlice::Lines(corners)) = (&near.look, hull.corners())
            && step.turn > 0.0
        {
            let deep = test.bound - step.path_deviation - step.side_deviation - hull.skew;
            if step.holds_at_end(contour, corners, near.times, look, deep) {
                buffers.tests += 1;
                buffers.times.push(near.times);
                buffers.covering.push(candidate);
                find_uncovered(&mut buffers.times, need, test.slack, &mut buffers.uncovered);
                return span_of(&buffers.uncovered);
            }
        }
        let query = CoverQuery {
            side: CoverSide::Inner,
            need: near.times,
            bound: test.bound,
            precision: test.precision,
            diameter: 2.0 * test.task.reach.1,
            spread: hull.spread,
            aside: hull.aside,
            skew: hull.skew,
            axis: test.task.axis,
        };
        let Some(covered) = self.cover_by_step(step, contour, hull.corners(), query, buffers) else {
            return Some(need);
        };
        buffers.covering.push(candidate);
        if covered[0] <= need[0] || covered[1] >= need[1] || relevant.len() % 8 == 7 {
            find_uncovered(&mut buffers.times, need, test.slack, &mut buffers.uncovered);
            return span_of(&buffers.uncovered);
        }
        Some(need)
    }

    /// Returns whether a look is the best first question about a line: there is no closed form.
    #[inline]
    pub(super) fn is_looked_at(&self, number: u32, glance: &StepGlance, line: &PointLine) -> bool {
        glance.is_looked_at
            || self
                .step_and_contour(number)
                .is_some_and(|(step, _)| step.flat.is_none() && !step.is_level_for(line))
    }

    /// Returns whether all points of a line are surely further from a step than a bound, by one look.
    #[inline]
    pub(super) fn is_glance_apart(
        &self,
        glance: &StepGlance,
        line: &PointLine,
        need: [f64; 2],
        bound: f64,
    ) -> bool {
        let Some(contour) = self.cutters.get(glance.cutter) else { return false };
        glance.look_from(contour, line, need, 0.0).surely_leaves(line, need, bound)
    }

    /// Adds the times at which all corners are in one sweep, and returns the span from the first to the last.
    fn cover_by_step(
        &self,
        step: &SweptStep,
        contour: &CutterContour,
        corners: PathSlice<'_>,
        mut query: CoverQuery,
        buffers: &mut CoverBuffers,
    ) -> Option<[f64; 2]> {
        let lines = match corners {
            PathSlice::Lines(lines) if step.flat.is_none() => lines,
            _ => {
                let found = step.spans_of_hull(contour, corners, &query, &mut buffers.tests);
                buffers.times.extend_from_slice(found.spans());
                return found.hull();
            }
        };
        if lines.first().is_some_and(|line| step.turn == 0.0 && step.is_level_for(line)) {
            buffers.tests += lines.len() as u64;
            let found = step.times_level(contour, lines, &query)?;
            buffers.times.push(found);
            return Some(found);
        }
        for line in lines {
            buffers.tests += 1;
            query.need = step.times_covered(contour, line, &query)?;
        }
        buffers.times.push(query.need);
        Some(query.need)
    }
}
