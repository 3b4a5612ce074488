//! This module proves that material is there: a point of the surface, a time, and the chip at it.

use super::contour_element::ContourElement;
use super::cover_test::CoverBuffers;
use super::cutter_pose::{PointLine, PointPath};
use super::step_search::{EngagementCriterion, StepSearch};
use super::stock_gap::HullMargin;
use super::surface_patch::surface_point;
use super::time_union::find_uncovered;
use nalgebra::Vector3;
use std::borrow::Cow;

/// A place on a cutter where material was found: the element, its parameter, the direction from the heading
/// and the time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WitnessPlace {
    pub element: usize,
    pub parameter: f64,
    pub from_heading: f64,
}

/// The place at which the lower bound of a block was found, for reports and for independent checks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EngagementWitness {
    /// The point of the cutter's surface in the workpiece frame, mm.
    pub point: Vector3<f64>,
    /// The outward normal there.
    pub normal: Vector3<f64>,
    /// The position along the block, from 0 to 1 of its time.
    pub at: f64,
    /// The share there.
    pub share: f64,
}

/// How often a span of times is narrowed to its better part.
const TIME_THIRDS: usize = 8;
/// The most times of one point that are tried.
const MOST_TIMES: usize = 3;

impl StepSearch<'_> {
    /// Tries to prove material at a point of the surface within some times, and raises the lower bound if
    /// that succeeds. `begins` is the depth at which the material is thought to begin.
    pub(super) fn try_point(
        &mut self,
        (element, m, angle): (usize, f64, f64),
        begins: f64,
        need: [f64; 2],
        candidates: &[u32],
    ) {
        let Some(shape) = self.contour.elements().get(element) else { return };
        // A place that another cutter left may be beyond this one's element, and so off its surface.
        let [first, last] = shape.range();
        let m = m.clamp(first, last);
        let scale = self.criterion.scale();
        let middle = (need[0] + need[1]) / 2.0;
        let best = [need[0], middle, need[1]]
            .map(|time| self.share_at(shape, m, angle, time))
            .into_iter()
            .fold(0.0, f64::max);
        if best * scale <= self.lower * (1.0 + 1e-9) || best <= 0.0 {
            return;
        }
        self.potential = best * scale;
        let depths = match self.criterion {
            EngagementCriterion::Share => [0.0, 0.0],
            EngagementCriterion::Chip { .. } => {
                // A longer run than the one known has material there and as much deeper.
                let h = best * scale;
                [begins.min(h), (begins + self.lower * 1.001).min(h)]
            }
        };
        let mut buffers = std::mem::take(&mut self.buffers);
        buffers.times.clear();
        let mut slack = 0.0;
        for depth in depths {
            let body = surface_point(shape, m, angle, depth);
            let line = self.step.path_of(&body, need);
            slack = self.program.time_slack(line.as_ref());
            self.program.add_outside_stock(line.as_slice(), need, HullMargin::default(), &mut buffers);
            // Most points in air are covered by what covered others.
            let known = self.known_earlier(&self.hot, 0.0);
            self.program.add_possible_cover(&line, need, &known, &mut buffers);
            find_uncovered(&mut buffers.times, need, slack, &mut buffers.uncovered);
            if buffers.uncovered.is_empty() {
                break;
            }
            let known = self.known_earlier(candidates, need[0]);
            self.program.add_possible_cover(&line, need, &known, &mut buffers);
            if depths[0] == depths[1] {
                break;
            }
        }
        find_uncovered(&mut buffers.times, need, slack, &mut buffers.uncovered);
        let mut free = std::mem::take(&mut buffers.uncovered);
        free.sort_unstable_by(|a, b| (b[1] - b[0]).total_cmp(&(a[1] - a[0])));
        for span in free.iter().take(MOST_TIMES) {
            self.prove_within((element, m, angle), *span, candidates, &mut buffers);
        }
        buffers.uncovered = free;
        self.buffers = buffers;
    }

    /// Proves material at a point within a span of times. A chip that the material limits has its longest
    /// run somewhere within the span; in a convex piece of material the run's length is concave in time, so
    /// the best third is kept.
    fn prove_within(
        &mut self,
        place: (usize, f64, f64),
        [mut from, mut to]: [f64; 2],
        candidates: &[u32],
        buffers: &mut CoverBuffers,
    ) {
        let known = self.lower;
        let mut middle = self.prove_at(place, (from + to) / 2.0, candidates, buffers);
        let is_chip = matches!(self.criterion, EngagementCriterion::Chip { .. });
        if !self.advance.is_constant() || is_chip && middle < self.potential * 0.99 {
            for share in [0.999_999, 0.999, 0.001] {
                let found = self.prove_at(place, from + (to - from) * share, candidates, buffers);
                middle = middle.max(found);
            }
        }
        if !is_chip || middle >= self.potential * 0.99 || middle < known * 0.5 {
            return;
        }
        for _ in 0..TIME_THIRDS {
            let (first, second) = (from + (to - from) * 0.3, from + (to - from) * 0.7);
            let runs = [first, second].map(|time| self.prove_at(place, time, candidates, buffers));
            if runs[0] > runs[1] { to = second } else { from = first }
        }
    }

    /// Proves material at a point and a time, and raises the lower bound to the chip there. Returns the
    /// chip, or 0.
    fn prove_at(
        &mut self,
        (element, m, angle): (usize, f64, f64),
        time: f64,
        candidates: &[u32],
        buffers: &mut CoverBuffers,
    ) -> f64 {
        let Some(shape) = self.contour.elements().get(element) else { return 0.0 };
        let share = self.share_at(shape, m, angle, time);
        let least = share * (1.0 - 1e-12);
        let body = surface_point(shape, m, angle, 0.0);
        if least * self.criterion.scale() <= self.lower || self.is_behind_itself(share, &body, time) {
            return 0.0;
        }
        let place = self.step.place_of(&body, time);
        let found = match self.criterion {
            EngagementCriterion::Share => {
                let earlier = self.known_earlier(candidates, time);
                if !self.program.is_proved_material(&place, &earlier) {
                    return 0.0;
                }
                least
            }
            EngagementCriterion::Chip { feed_per_tooth_mm } => {
                let h = least * feed_per_tooth_mm;
                let inner = surface_point(shape, m, angle, h);
                let end = self.step.place_of(&inner, time);
                self.longest_run(PointLine { start: place, travel: end - place }, h, candidates, buffers)
            }
        };
        if found > self.lower {
            self.lower = found;
            let from_heading = angle - self.heading;
            self.witness = Some(WitnessPlace { element, parameter: m, from_heading });
            let deeper = self.step.place_of(&surface_point(shape, m, angle, 1.0), time);
            let at = self.time_part[0] + (self.time_part[1] - self.time_part[0]) * time;
            self.found = Some(EngagementWitness { point: place, normal: place - deeper, at, share: least });
        }
        found
    }

    /// Returns the share of a point at a time.
    pub(super) fn share_at(&self, shape: &ContourElement, m: f64, angle: f64, time: f64) -> f64 {
        if self.advance.is_constant() && self.step.turn == 0.0 {
            return self.advance.constant_share(shape, m, angle);
        }
        let [across, up] = shape.normal(m);
        let normal = Vector3::new(across * angle.cos(), across * angle.sin(), up);
        let normal = self.step.turned(&self.step.to_world(0, &normal), time);
        let body = surface_point(shape, m, angle, 0.0);
        self.step.velocity_of(&body, time).dot(&normal) / self.reference
    }

    /// Returns the candidates that are over at a time: all but the own motion's later parts.
    pub(super) fn known_earlier<'c>(&self, candidates: &'c [u32], time: f64) -> Cow<'c, [u32]> {
        let over = self.own_sweeps_over(time);
        if candidates.iter().all(|candidate| self.program.is_earlier(*candidate, over)) {
            return Cow::Borrowed(candidates);
        }
        let earlier =
            candidates.iter().copied().filter(|candidate| self.program.is_earlier(*candidate, over));
        Cow::Owned(earlier.collect())
    }

    /// Returns whether a point with this share might have been cut by the own sweep before that is not over.
    /// A cutter that turns or moves on an arc leaves the tangent of a point's way by half the second
    /// derivative times the time squared.
    pub(super) fn is_behind_itself(&self, share: f64, body: &Vector3<f64>, time: f64) -> bool {
        if self.step.is_straight() {
            return false;
        }
        if let (Some(_), Some(arc)) = (&self.step.flat, &self.step.arc) {
            // The distance from the tip depends on the angle between both about the arc's axis, so a point
            // ahead was further from all earlier tips, until they were as far ahead of it.
            let tip = self.step.tips[0] - arc.center;
            let place = tip + self.step.to_world(0, body);
            let ahead = arc.normal.dot(&tip.cross(&place)).atan2(across_dot(&arc.normal, &tip, &place));
            let ahead = ahead * arc.angle.signum();
            return ahead <= 0.0 || arc.angle.abs() * time > 2.0 * (std::f64::consts::PI - ahead) - 1e-9;
        }
        let reach = body.norm();
        let turn = self.step.turn;
        let way = (self.step.tips[1] - self.step.tips[0]).norm();
        let bend = turn * turn * (reach + way)
            + 2.0 * turn * way
            + 8.0 * (self.step.path_deviation + self.step.side_deviation);
        share * self.reference <= bend / 2.0 / f64::from(self.own_count.max(1))
    }

    /// Returns the length of the longest proved run of material along a line of length `h`.
    fn longest_run(&self, line: PointLine, h: f64, candidates: &[u32], buffers: &mut CoverBuffers) -> f64 {
        buffers.times.clear();
        let whole = [0.0, 1.0];
        let path = PointPath::Line(line);
        self.program.add_outside_stock(path.as_slice(), whole, HullMargin::default(), buffers);
        self.program.add_possible_cover(&path, whole, candidates, buffers);
        let mut runs = Vec::new();
        find_uncovered(&mut buffers.times, whole, 0.0, &mut runs);
        let margin = super::cover_test::MATERIAL_TOLERANCE_MM + self.program.guard_mm;
        let mut longest = 0.0;
        for [from, to] in runs {
            // The ends are moved inwards until they are deep enough to be proved; at a slanting face that
            // may take more.
            let whole = (to - from) * h;
            for shrink in
                [16.0 * self.program.guard_mm, 1e-7, 1e-6, 1e-5, whole * 0.002, whole * 0.02, whole * 0.2]
            {
                let inset = |at: f64, by: f64| if at <= 0.0 || at >= 1.0 { at } else { at + by / h };
                let (from, to) = (inset(from, shrink), inset(to, -shrink));
                let length = (to - from) * h;
                if length <= longest {
                    continue;
                }
                let (a, b) = (line.at(from), line.at(to));
                let is_inside = self.program.stock.iter().any(|body| body.contains_segment(&a, &b, margin));
                let middle = line.at((from + to) / 2.0);
                if is_inside && self.program.is_proved_material(&middle, candidates) {
                    longest = length;
                    break;
                }
            }
        }
        longest
    }
}

/// Returns the product of the parts of two vectors across a unit vector.
fn across_dot(normal: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    a.dot(b) - a.dot(normal) * b.dot(normal)
}
