//! This module tests when a hull of lines is proved to be without material.

use super::certified_program::CertifiedProgram;
use super::cutter_pose::{PathRef, PathSlice};
use super::patch_hull::PatchHull;
use super::stock_gap::{HullMargin, StockGap};
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
    /// The lowest flat bottom over all that the last test was about, and its step: steps that stay above it add nothing.
    pub floor: Option<(f64, u32)>,
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
pub(super) struct HullTest<'a> {
    pub task: &'a CoverTask<'a>,
    /// A disc around the places of the reach, and their greatest height.
    pub place: [f64; 4],
    pub bound: f64,
    pub outer: f64,
    pub precision: f64,
    pub slack: f64,
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
        buffers.floor = None;
        for candidate in task.candidates {
            let Some(near) = self.times_near(&test, *candidate, need, buffers) else { continue };
            let is_coarse = self.deviation_of(*candidate) > coarse;
            if is_coarse {
                // The run is too rough for this hull, so its members are tested.
                for member in self.members_of(*candidate).rev() {
                    if let Some(near) = self.times_near(&test, member, need, buffers) {
                        need = self.cover_near(&test, member, &near, need, buffers, relevant)?;
                    }
                }
            } else {
                need = self.cover_near(&test, *candidate, &near, need, buffers, relevant)?;
            }
        }
        if let Some((floor, step)) = buffers.floor {
            let adds = |number: u32| self.glance_of(number).is_some_and(|glance| glance.bottom < floor);
            relevant.retain(|number| *number == step || adds(*number));
        }
        find_uncovered(&mut buffers.times, need, slack, &mut buffers.uncovered);
        span_of(&buffers.uncovered)
    }

    /// Returns a disc around a path's places and their greatest height: x, y, radius, z.
    pub(super) fn footprint_of(&self, path: PathRef<'_>, need: [f64; 2], spread: f64) -> [f64; 4] {
        let (center, part) = (path.at((need[0] + need[1]) / 2.0), (need[1] - need[0]) / 2.0);
        if let PathRef::Arc(arc) = path
            && arc.first.norm() <= arc.length() * part
        {
            // The whole circle is nearer than the way along it.
            let (center, radius) = (arc.center, arc.first.norm());
            let up = arc.first.z.hypot(arc.second.z);
            return [center.x, center.y, radius + spread, center.z + up + spread];
        }
        let [across, up] = match path {
            PathRef::Line(line) => [line.travel.xy().norm(), line.travel.z.abs()],
            PathRef::Arc(arc) => [arc.length(), (arc.first.z.hypot(arc.second.z)) * arc.angle.abs()],
        };
        [center.x, center.y, across * part + spread, center.z + up * part + spread]
    }

    /// Returns whether a step's tip may come as near to a point as a distance.
    pub(super) fn may_tip_pass(&self, step: u32, point: &Vector3<f64>, distance: f64) -> bool {
        let Some((swept, _)) = self.step_and_contour(step) else { return false };
        let middle = (swept.tips[0] + swept.tips[1]) / 2.0;
        let half = (swept.tips[1] - swept.tips[0]).norm() / 2.0;
        (middle - point).norm() <= half + distance + swept.path_deviation
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
}
