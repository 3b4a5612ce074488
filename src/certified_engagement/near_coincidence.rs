//! This module covers patches where a cutter has hardly moved away from an equal cutter's way.
//!
//! Where a block begins, the cutter is where the block before left it, and the front of both is the same
//! surface. A hull of corners with a sag never closes there. But the gap f of the cutter is convex and not
//! positive on its own surface, so after a move by d it is at most the product of d with the gradient at the
//! moved point: f(q + d) <= f(q) + g(q + d) d. The gradients of each element over a patch and its near
//! surroundings are a range of directions, over which the product has a closed form without sag.

use super::advance::{largest_mixture, most_along};
use super::contour_element::ContourElement;
use super::cover_test::MATERIAL_TOLERANCE_MM;
use super::cutter_contour::CutterContour;
use super::step_search::StepSearch;
use super::surface_patch::SurfacePatch;
use super::swept_step::SweptStep;
use nalgebra::Vector3;

/// The gradients of one element near a patch, and its largest gap on the patch.
struct GradientCone {
    gap: f64,
    /// The range of the gradients' angles from straight down.
    steep: [f64; 2],
}

/// What bounds the gap of a patch after a move of at most `reach` mm.
struct MovedGap {
    cones: Vec<GradientCone>,
    angles: [f64; 2],
    top: f64,
    reach: f64,
    /// Some gradients of the own element near the patch. A move along one of them by more than the bound leaves it.
    gradients: [Vector3<f64>; 5],
}

/// How often a position and a time are narrowed.
const SLIDE_THIRDS: usize = 24;
const TIME_HALVES: usize = 12;

impl MovedGap {
    /// Makes the bound for a patch whose points are down to `depth` below the surface; `None` if the patch
    /// is too near the axis.
    fn new(contour: &CutterContour, patch: &SurfacePatch, depth: f64, reach: f64) -> Option<Self> {
        let own = contour.elements().get(patch.element)?;
        let ends = patch.range.map(|m| own.point(m));
        let smallest = ends[0][0].min(ends[1][0]) - depth;
        if reach > smallest * 0.5 {
            return None;
        }
        // asin(x) is at most 1.05 x up to one half.
        let wider = 1.05 * reach / smallest;
        let angles = [patch.angles[0] - wider, patch.angles[1] + wider];
        let along = patch.range[1] - patch.range[0];
        let bulge = match own {
            ContourElement::Arc { radius, .. } => along * along * radius / 8.0,
            ContourElement::Line { .. } => 0.0,
        };
        let cone = |(number, element): (usize, &ContourElement)| {
            let is_own = number == patch.element;
            let gaps = ends.map(|[r, z]| element.gap(r, z).0);
            let gap = if is_own { 0.0 } else { (gaps[0].max(gaps[1]) + bulge + depth).min(0.0) };
            let [low, high] = element.normal_angles();
            let steep = match element {
                ContourElement::Arc { radius, .. } if is_own && reach < (radius - depth) * 0.5 => {
                    let wider = 1.05 * reach / (radius - depth);
                    [(patch.range[0] - wider).max(low), (patch.range[1] + wider).min(high)]
                }
                _ => [low, high],
            };
            GradientCone { gap, steep }
        };
        let cones: Vec<GradientCone> = contour.elements().iter().enumerate().map(cone).collect();
        let top = (ends[0][1].max(ends[1][1]) + depth - contour.height_mm()).min(0.0);
        let steep = cones.get(patch.element)?.steep;
        let middle = [angles, steep].map(|[from, to]| (from + to) / 2.0);
        let ([left, right], [low, high]) = (angles, steep);
        let gradients =
            [middle, [left, low], [left, high], [right, low], [right, high]].map(|[angle, steep]| {
                let (sin, cos) = steep.sin_cos();
                Vector3::new(sin * angle.cos(), sin * angle.sin(), -cos)
            });
        Some(Self { cones, angles, top, reach, gradients })
    }

    /// Returns a gap that no point of the patch exceeds after a move; infinite for a move beyond the reach.
    fn after(&self, moved: &Vector3<f64>) -> f64 {
        if moved.norm() > self.reach {
            return f64::INFINITY;
        }
        let [_, outwards] = most_along(moved.xy(), self.angles);
        let of_cone = |cone: &GradientCone| cone.gap + largest_mixture(outwards, -moved.z, cone.steep);
        self.cones.iter().map(of_cone).fold(self.top + moved.z, f64::max)
    }

    /// Returns whether some place on the other way brings the gap to at most the bound. The gap is convex
    /// along the way.
    fn is_covered(&self, start: &Vector3<f64>, way: &Vector3<f64>, bound: f64) -> bool {
        // The own element's gap grows with a move along any of its gradients.
        if self.gradients.iter().any(|along| along.dot(start).min(along.dot(&(start + way))) > bound) {
            return false;
        }
        let squared = way.norm_squared();
        // Beyond the reach nothing is known, so the search stays near the nearest place.
        let nearest = if squared > 0.0 { (-start.dot(way) / squared).clamp(0.0, 1.0) } else { 0.0 };
        if (start + way * nearest).norm() > self.reach {
            return false;
        }
        let span = if squared > 0.0 { self.reach / squared.sqrt() } else { 0.0 };
        let (mut from, mut to) = ((nearest - span).max(0.0), (nearest + span).min(1.0));
        let at = |share: f64| self.after(&(start + way * share));
        if at(nearest) <= bound {
            return true;
        }
        for _ in 0..SLIDE_THIRDS {
            let (first, second) = (from + (to - from) * 0.382, from + (to - from) * 0.618);
            let (low, high) = (at(first), at(second));
            if low.min(high) <= bound {
                return true;
            }
            // Where both are beyond the reach, the nearer end is kept.
            let keeps_first = if low.is_finite() || high.is_finite() { low < high } else { first > nearest };
            if keeps_first { to = second } else { from = first }
        }
        false
    }
}

impl StepSearch<'_> {
    /// Adds the times at which a patch is covered by steps of the equal cutter that it has hardly left.
    pub(super) fn add_near_coincidence(
        &mut self,
        patch: &SurfacePatch,
        depth: f64,
        size: f64,
        candidates: &[u32],
    ) {
        let Some(moved) = MovedGap::new(self.contour, patch, depth, size * 0.5) else { return };
        let bound = MATERIAL_TOLERANCE_MM - self.program.guard_mm;
        let travel = self.step.to_body_vector(&(self.step.tips[1] - self.step.tips[0]));
        for candidate in candidates.iter().flat_map(|candidate| self.program.exact_parts_of(*candidate)) {
            let Some((other, _)) = self.program.step_and_contour(candidate) else { continue };
            if !self.program.is_earlier(candidate, self.before) || !self.is_alike(other) {
                continue;
            }
            let way = self.step.to_body_vector(&(other.tips[1] - other.tips[0]));
            let start = self.step.to_body_vector(&(self.step.tips[0] - other.tips[1]));
            let covered = |time: f64| moved.is_covered(&(start + travel * time), &way, bound);
            let [from, to] = patch.need;
            let longest = size / travel.norm().max(1e-12);
            // A convex set of times: from an end that is covered as far as halving finds.
            for [end, mut far] in [[from, (from + longest).min(to)], [to, (to - longest).max(from)]] {
                if !covered(end) {
                    continue;
                }
                let mut near = end;
                for _ in 0..TIME_HALVES {
                    if covered(far) {
                        near = far;
                        break;
                    }
                    far = (near + far) / 2.0;
                    if covered(far) {
                        near = far;
                        break;
                    }
                }
                self.buffers.times.push([end.min(near), end.max(near)]);
            }
        }
    }

    /// Returns whether another step is of the same cutter in the same direction, both straight.
    fn is_alike(&self, other: &SweptStep) -> bool {
        other.cutter == self.step.cutter
            && other.is_straight()
            && self.step.is_straight()
            && other.axes[0] == self.step.axes[0]
    }
}
