//! This module tells when points on lines are inside the sweep of a step.

use super::convex_times::{FamilyTimes, PointFamily};
use super::cutter_contour::CutterContour;
use super::cutter_pose::{CoverQuery, CoverSide, PointLine};
use super::step_glance::TangentLook;
use super::swept_step::{LEVEL, SweptStep};
use nalgebra::Vector3;

impl SweptStep {
    /// Returns whether the cutter at one end of the step holds all points of some lines at all times of `need`, at a gap of
    /// `bound` mm at the most: the end towards which a look says that the gap falls. The cutter is convex, so that it
    /// holds their hull as well, and there is nothing to add for a turning axis.
    #[inline]
    pub(super) fn holds_at_end(
        &self,
        contour: &CutterContour,
        lines: &[PointLine],
        [from, to]: [f64; 2],
        look: &TangentLook,
        bound: f64,
    ) -> bool {
        let [start, end] = &self.tips;
        let [first, last] = &self.axes;
        let (tip, axis) = if look.slide_growth > 0.0 { (start, first) } else { (end, last) };
        let is_inside = |place: Vector3<f64>| {
            let apart = place - tip;
            let z = apart.dot(axis);
            let r = (apart.norm_squared() - z * z).max(0.0).sqrt();
            contour.gap_in_plane(r, z).0 <= bound
        };
        lines.iter().all(|line| is_inside(line.at(from)) && is_inside(line.at(to)))
    }

    /// Returns whether questions about a line that moves like this have the closed form of a cutter that
    /// moves across its axis.
    #[inline]
    pub(super) fn is_level_for(&self, line: &PointLine) -> bool {
        self.is_level && self.to_body_vector(&line.travel).z.abs() < LEVEL
    }

    /// Returns the times at which all lines' points are in the sweep, for lines in the closed form. Lines at
    /// one height share the radius there.
    pub(super) fn times_level(
        &self,
        contour: &CutterContour,
        lines: &[PointLine],
        query: &CoverQuery,
    ) -> Option<[f64; 2]> {
        let sign = if query.side == CoverSide::Inner { -1.0 } else { 1.0 };
        let is_parallel = self.axes[0] == query.axis;
        let (skew, aside) = if is_parallel { (0.0, query.aside) } else { (query.skew, 0.0) };
        let bound = query.bound + sign * (self.path_deviation + skew);
        let aside = sign * (self.side_deviation + aside);
        let (mut from, mut to) = (query.need[0], query.need[1]);
        let mut known = (f64::NAN, 0.0);
        for line in lines {
            let base = self.to_body_vector(&(line.start - self.tips[0]));
            let travel = self.to_body_vector(&line.travel);
            if base.z != known.0 {
                known = (base.z, contour.radius_at(base.z, bound)? + aside);
            }
            let [first, last] = self.segment.times_within(base.xy(), travel.xy(), known.1)?;
            (from, to) = (from.max(first), to.min(last));
            if from > to {
                return None;
            }
        }
        Some([from, to])
    }

    /// Returns the times at which a line's point is in the sweep.
    #[inline]
    pub(super) fn times_covered(
        &self,
        contour: &CutterContour,
        line: &PointLine,
        query: &CoverQuery,
    ) -> Option<[f64; 2]> {
        let clip = |[from, to]: [f64; 2]| {
            let (from, to) = (from.max(query.need[0]), to.min(query.need[1]));
            (from <= to).then_some([from, to])
        };
        let sign = if query.side == CoverSide::Inner { -1.0 } else { 1.0 };
        let pick = |found: FamilyTimes| if sign < 0.0 { found.inner } else { found.outer };
        let bound = query.bound + sign * self.path_deviation;
        if self.turn > 0.0 {
            let [from, to] = query.need;
            let (family, deviation) = self.family_of_turning(line, query.need, query.diameter);
            let bound = bound + sign * (deviation + query.skew + self.side_deviation);
            let found = pick(family.times_within(contour, [0.0, 1.0], bound, query.precision)?);
            let [first, last] = found.map(|share| from + (to - from) * share);
            let (first, last) =
                (if found[0] <= 0.0 { from } else { first }, if found[1] >= 1.0 { to } else { last });
            return clip([first, last]);
        }
        // What is across the own axis is across this one only if they are parallel.
        let (bound, aside) = if self.axes[0] == query.axis {
            (bound, query.aside + self.side_deviation)
        } else {
            (bound + sign * query.skew, self.side_deviation)
        };
        if self.is_level_for(line) {
            return self.times_level(contour, std::slice::from_ref(line), query);
        }
        let base = self.to_body_vector(&(line.start - self.tips[0]));
        let travel = self.to_body_vector(&line.travel);
        let family = PointFamily { base, travel, slide: self.slide, aside: -sign * aside };
        clip(pick(family.times_within(contour, query.need, bound, query.precision)?))
    }
}
