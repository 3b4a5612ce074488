//! This module tests when a hull of lines is proved to be without material.

use super::certified_program::CertifiedProgram;
use super::cutter_pose::{CoverQuery, CoverSide, PathRef, PathSlice, PointPath};
use super::patch_hull::PatchHull;
use super::stock_gap::{HullMargin, StockGap};
use super::swept_step::SweptStep;
use super::time_union::{find_uncovered, intersect_times, span_of};
use nalgebra::Vector3;

/// Points at most this far (mm) from an earlier sweep count as removed, and material less deep than this in
/// the stock counts as none: a chip thinner than that is none.
pub const MATERIAL_TOLERANCE_MM: f64 = 1e-6;

/// The part of a hull's sag to which ends of intervals are found.
const PRECISION: f64 = 0.02;

/// The buffers of a test, and how many lines were tested.
#[derive(Debug, Default)]
pub(super) struct CoverBuffers {
    pub times: Vec<[f64; 2]>,
    pub uncovered: Vec<[f64; 2]>,
    /// The steps that covered something in the last test.
    pub covering: Vec<u32>,
    of_body: Vec<[f64; 2]>,
    both: Vec<[f64; 2]>,
    pub tests: u64,
}

/// What a test of a hull begins with.
#[derive(Clone, Copy)]
pub(super) struct CoverTask<'a> {
    pub hull: &'a PatchHull,
    /// The own axis; zero if it turns, since nothing is across a turning axis.
    pub axis: Vector3<f64>,
    /// The middle and the radius of everything that the later tests of the same patch are about.
    pub reach: (PathRef<'a>, f64),
    pub need: [f64; 2],
    pub candidates: &'a [u32],
    /// Candidates from this number on may touch the patch, but are not known to be earlier.
    pub limit: u32,
}

/// What the tests of a hull against single steps share.
struct HullTest<'a> {
    task: &'a CoverTask<'a>,
    /// A disc around the places of the reach, and their greatest height.
    place: [f64; 4],
    bound: f64,
    outer: f64,
    precision: f64,
    slack: f64,
}

/// The part of a hull's sag above which a run of steps is too rough for it.
const COARSE_PART: f64 = 0.2;

impl CertifiedProgram {
    /// Returns the length of time in which nothing moves further than half the guard; the other half is for
    /// rounding.
    pub(super) fn time_slack(&self, path: PathRef<'_>) -> f64 {
        0.5 * self.guard_mm / path.speed().max(self.guard_mm)
    }

    /// Adds the times at which a hull is proved to be without material to `buffers.times`, and finds what is
    /// uncovered. Steps that may touch the reach are added to `relevant`, if the hull is not covered at all
    /// times. Returns the uncovered span.
    pub(super) fn cover_hull(
        &self,
        task: &CoverTask<'_>,
        buffers: &mut CoverBuffers,
        relevant: &mut Vec<u32>,
    ) -> Option<[f64; 2]> {
        let hull = task.hull;
        let slack = self.time_slack(hull.middle());
        let margin = HullMargin { all: hull.sag, aside: hull.aside, skew: hull.skew, axis: task.axis };
        self.add_outside_stock(hull.paths(), task.need, margin, buffers);
        find_uncovered(&mut buffers.times, task.need, slack, &mut buffers.uncovered);
        let mut need = span_of(&buffers.uncovered)?;
        let bound = MATERIAL_TOLERANCE_MM - self.guard_mm - hull.sag;
        let precision = ((hull.sag + hull.skew) * PRECISION).max(1e-9);
        let (middle, radius) = task.reach;
        let outer = MATERIAL_TOLERANCE_MM + self.guard_mm + radius + precision;
        let place = self.footprint_of(middle, need, outer);
        let test = HullTest { task, place, bound, outer, precision, slack };
        let coarse = (hull.sag + hull.skew) * COARSE_PART + 1e-10;
        for candidate in task.candidates {
            let Some(near) = self.times_near(&test, *candidate, need, buffers) else { continue };
            let is_coarse = self.deviation_of(*candidate) > coarse;
            if is_coarse {
                // The run is too rough for this hull, so its members are tested.
                for member in self.members_of(*candidate).rev() {
                    if let Some(near) = self.times_near(&test, member, need, buffers) {
                        need = self.cover_near(&test, member, [near, need], buffers, relevant)?;
                    }
                }
            } else {
                need = self.cover_near(&test, *candidate, [near, need], buffers, relevant)?;
            }
        }
        find_uncovered(&mut buffers.times, need, slack, &mut buffers.uncovered);
        span_of(&buffers.uncovered)
    }

    /// Returns the times at which a step may touch the reach of a test.
    #[inline]
    fn times_near(
        &self,
        test: &HullTest<'_>,
        candidate: u32,
        need: [f64; 2],
        buffers: &mut CoverBuffers,
    ) -> Option<[f64; 2]> {
        if self.is_far(candidate, &test.place) {
            return None;
        }
        let (step, contour) = self.step_and_contour(candidate)?;
        buffers.tests += 1;
        if let (PathRef::Line(line), None) = (test.task.reach.0, &step.flat)
            && (step.turn > 0.0 || !step.is_level_for(line))
        {
            // One look is enough: the exact times would cost more than they spare.
            let bound = test.outer + step.path_deviation + step.side_deviation;
            return (!step.is_surely_apart(contour, line, need, [bound, 0.0])).then_some(need);
        }
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
        step.hull_of_point(contour, test.task.reach.0, &query)
    }

    /// Adds the times at which a step that is near covers the hull of a test, and returns the span that is left.
    #[inline]
    fn cover_near(
        &self,
        test: &HullTest<'_>,
        candidate: u32,
        [near, need]: [[f64; 2]; 2],
        buffers: &mut CoverBuffers,
        relevant: &mut Vec<u32>,
    ) -> Option<[f64; 2]> {
        relevant.push(candidate);
        let Some((step, contour)) = self.step_and_contour(candidate) else { return Some(need) };
        if !self.is_earlier(candidate, test.task.limit) {
            return Some(need);
        }
        let hull = test.task.hull;
        let query = CoverQuery {
            side: CoverSide::Inner,
            need: near,
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

    /// Returns a disc around a path's places and their greatest height: x, y, radius, z.
    fn footprint_of(&self, path: PathRef<'_>, need: [f64; 2], spread: f64) -> [f64; 4] {
        let (center, part) = (path.at((need[0] + need[1]) / 2.0), (need[1] - need[0]) / 2.0);
        let [across, up] = match path {
            PathRef::Line(line) => [line.travel.xy().norm(), line.travel.z.abs()],
            PathRef::Arc(arc) => [arc.length(), (arc.first.z.hypot(arc.second.z)) * arc.angle.abs()],
        };
        [center.x, center.y, across * part + spread, center.z + up * part + spread]
    }

    /// Returns whether a step stands beside or above a place.
    #[inline]
    fn is_far(&self, step: u32, [x, y, radius, highest]: &[f64; 4]) -> bool {
        let Some([a, b, reach, lowest]) = self.footprint_of_step(step) else { return true };
        let (dx, dy, sum) = (x - a, y - b, radius + reach);
        lowest > highest || dx * dx + dy * dy > sum * sum
    }

    /// Returns whether a run is surely further from a path than a bound, so that its steps need not be asked.
    fn is_run_apart(&self, number: u32, path: PathRef<'_>, need: [f64; 2], bound: f64) -> bool {
        let (true, PathRef::Line(line)) = (self.deviation_of(number) > 0.0, path) else { return false };
        let Some((chord, contour)) = self.step_and_contour(number) else { return false };
        chord.is_surely_apart(contour, line, need, [bound + chord.path_deviation, 0.0])
    }

    /// Returns whether a step's tip may come as near to a point as a distance.
    pub(super) fn may_tip_pass(&self, step: u32, point: &Vector3<f64>, distance: f64) -> bool {
        let Some((swept, _)) = self.step_and_contour(step) else { return false };
        let middle = (swept.tips[0] + swept.tips[1]) / 2.0;
        let half = (swept.tips[1] - swept.tips[0]).norm() / 2.0;
        (middle - point).norm() <= half + distance + swept.path_deviation
    }

    /// Adds the times at which all corners are in one sweep, and returns the span from the first to the last.
    fn cover_by_step(
        &self,
        step: &SweptStep,
        contour: &super::CutterContour,
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

    /// Adds the times at which the hull of paths is outside all bodies of the stock.
    pub(super) fn add_outside_stock(
        &self,
        paths: PathSlice<'_>,
        need: [f64; 2],
        margin: HullMargin,
        buffers: &mut CoverBuffers,
    ) {
        let of_body = |body: &dyn StockGap, margin: HullMargin, out: &mut Vec<[f64; 2]>| match paths {
            PathSlice::Lines(lines) => body.add_outside_times(lines, need, margin, out),
            PathSlice::Arcs(arcs) => body.add_outside_arc_times(arcs, need, margin, out),
        };
        let all = margin.all - MATERIAL_TOLERANCE_MM + self.guard_mm;
        let margin = HullMargin { all, ..margin };
        if let [body] = self.stock.as_slice() {
            of_body(body.as_ref(), margin, &mut buffers.times);
            return;
        }
        let mut outside = vec![need];
        for body in &self.stock {
            buffers.of_body.clear();
            of_body(body.as_ref(), margin, &mut buffers.of_body);
            intersect_times(&outside, &buffers.of_body, &mut buffers.both);
            std::mem::swap(&mut outside, &mut buffers.both);
        }
        buffers.times.append(&mut outside);
    }

    /// Adds the times at which a point may be in an earlier sweep, for proofs that it is material.
    pub(super) fn add_possible_cover(
        &self,
        path: &PointPath,
        need: [f64; 2],
        candidates: &[u32],
        buffers: &mut CoverBuffers,
    ) {
        let path = path.as_ref();
        let bound = MATERIAL_TOLERANCE_MM + self.guard_mm;
        let axis = Vector3::zeros();
        let place = self.footprint_of(path, need, bound);
        let near = candidates.iter().copied().filter(|candidate| {
            !self.is_far(*candidate, &place) && !self.is_run_apart(*candidate, path, need, bound)
        });
        // What may be covered is asked of single steps, unless a run is as good.
        let exact = near.flat_map(|candidate| self.exact_parts_of(candidate));
        for candidate in exact {
            let Some((step, contour)) = self.step_and_contour(candidate) else { continue };
            buffers.tests += 1;
            let query = CoverQuery {
                side: CoverSide::Outer,
                need,
                bound,
                precision: 1e-9,
                diameter: 0.0,
                spread: 0.0,
                aside: 0.0,
                skew: 0.0,
                axis,
            };
            match path {
                PathRef::Line(_) if step.flat.is_none() => {
                    buffers.times.extend(step.hull_of_point(contour, path, &query));
                }
                _ => buffers.times.extend_from_slice(step.spans_of_point(contour, path, &query).spans()),
            }
        }
    }

    /// Returns whether a point is proved material: in the stock and in no sweep of the candidates.
    pub(super) fn is_proved_material(&self, point: &Vector3<f64>, candidates: &[u32]) -> bool {
        self.is_proved_around(point, 0.0, candidates)
    }

    /// Returns whether all points within a radius are proved material.
    pub(super) fn is_proved_around(&self, point: &Vector3<f64>, radius: f64, candidates: &[u32]) -> bool {
        let margin = radius + MATERIAL_TOLERANCE_MM + self.guard_mm;
        let place = [point.x, point.y, margin, point.z + margin];
        let is_apart = |number: u32| {
            self.step_and_contour(number).is_none_or(|(step, contour)| step.gap_of(contour, point) > margin)
        };
        self.stock.iter().any(|body| body.gap(point) < -margin)
            && candidates.iter().filter(|candidate| !self.is_far(**candidate, &place)).all(|candidate| {
                let is_rough = self.deviation_of(*candidate) > 1e-10;
                is_apart(*candidate) || is_rough && self.members_of(*candidate).all(is_apart)
            })
    }
}
