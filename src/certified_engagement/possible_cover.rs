//! This module tells where points may have been removed, for proofs that they are material.

use super::certified_program::CertifiedProgram;
use super::cover_test::{CoverBuffers, MATERIAL_TOLERANCE_MM};
use super::cutter_pose::{CoverQuery, CoverSide, PathRef, PointPath};
use nalgebra::Vector3;

impl CertifiedProgram {
    /// Returns whether a run is surely further from a path than a bound, so that its steps need not be asked.
    fn is_run_apart(&self, number: u32, path: PathRef<'_>, need: [f64; 2], bound: f64) -> bool {
        let (true, PathRef::Line(line)) = (self.deviation_of(number) > 0.0, path) else { return false };
        let Some(glance) = self.glance_of(number) else { return false };
        self.is_glance_apart(glance, line, need, bound + glance.deviation)
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
            if self.is_far(candidate, &place) {
                continue;
            }
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
                PathRef::Line(line) if step.flat.is_none() => {
                    if let Some(glance) = self.glance_of(candidate)
                        && self.is_looked_at(candidate, glance, line)
                    {
                        let look = glance.look_from(contour, line, need, 0.0);
                        if look.surely_leaves(line, need, bound + glance.deviation) {
                            continue;
                        }
                        let lines = std::slice::from_ref(line);
                        if step.turn > 0.0 && step.holds_at_end(contour, lines, need, &look, bound) {
                            // Nothing is left to be found.
                            buffers.times.push(need);
                            return;
                        }
                    }
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
