//! This module tells when points on lines are inside the sweep of a step.

use super::convex_times::{FamilyTimes, PointFamily};
use super::cutter_contour::CutterContour;
use super::cutter_pose::{CoverQuery, CoverSide, PointLine};
use super::swept_step::{LEVEL, SweptStep};

impl SweptStep {
    /// Returns whether a line's points are surely further than `bound` mm from the sweep at all times of `need`. It
    /// looks at one point: half the times at half the step.
    ///
    /// In the cutter's frame the point moves with the time and with the step. The gap is convex, so that it stays
    /// above its tangent plane, and what the point's way bends is told by its second derivatives: the turn squared
    /// times the distance plus twice the turn times the tip's way, and for both together the turn times the line's way.
    #[inline]
    pub(super) fn is_surely_apart(
        &self,
        contour: &CutterContour,
        line: &PointLine,
        [from, to]: [f64; 2],
        [bound, aside]: [f64; 2],
    ) -> bool {
        let apart = line.at((from + to) / 2.0) - (self.tips[0] + self.tips[1]) / 2.0;
        let z = apart.dot(&self.middle_axis);
        let across = apart - self.middle_axis * z;
        let distance = across.norm();
        let r = (distance + aside).max(0.0);
        let (gap, slopes) = contour.gap_in_plane(r, z);
        if gap <= bound {
            return false;
        }
        let outwards = if r > 0.0 && distance > 0.0 { slopes[0] / distance } else { 0.0 };
        let gradient = across * outwards + self.middle_axis * slopes[1];
        let [travel, way] = [line.travel * ((to - from) / 2.0), (self.tips[1] - self.tips[0]) / 2.0];
        if self.turn == 0.0 {
            return gap - gradient.dot(&travel).abs() - gradient.dot(&way).abs() > bound;
        }
        let slide = way + self.turn_axis.cross(&apart) * (self.turn / 2.0);
        let (travelled, length) = (travel.norm(), 2.0 * way.norm());
        let farthest = apart.norm() + travelled + length;
        let bend =
            (self.turn * self.turn * farthest + 2.0 * self.turn * length) / 8.0 + self.turn * travelled / 2.0;
        gap - gradient.dot(&travel).abs() - gradient.dot(&slide).abs() - bend > bound
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
            let most = bound + sign * query.skew + self.side_deviation;
            if self.is_surely_apart(contour, line, query.need, [most, 0.0]) {
                return None;
            }
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
        if self.is_surely_apart(contour, line, query.need, [bound, -sign * aside]) {
            return None;
        }
        let base = self.to_body_vector(&(line.start - self.tips[0]));
        let travel = self.to_body_vector(&line.travel);
        let family = PointFamily { base, travel, slide: self.slide, aside: -sign * aside };
        clip(pick(family.times_within(contour, query.need, bound, query.precision)?))
    }
}
