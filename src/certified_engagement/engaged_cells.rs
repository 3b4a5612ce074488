//! This module finds which parts of a cutter's surface may cut at which times of a step: what is proved to be without
//! material is left out, and everything else counts as engaged. Loads are sums over these cells, so that they are upper
//! bounds.

use super::contour_element::ContourElement;
use super::patch_hull::PatchHull;
use super::step_search::StepSearch;
use super::surface_patch::{SurfacePatch, largest_radius, surface_point};
use super::time_union::find_uncovered;
use std::collections::BinaryHeap;

/// The directions around the axis in which contacts are told; a cell covers whole ones.
pub const CONTACT_DIRECTIONS: usize = 256;

/// A cell that weighs less than this part of all cells is not divided further: a cell of which some points seem not to
/// cut, and one of which all that are tried do.
const LEAST_PART: f64 = 0.001;
const LEAST_FULL_PART: f64 = 0.02;
/// How far inside a patch its corners are looked at: at its very ends it touches what was cut before.
const INWARDS: f64 = 0.02;
/// Cells shorter than this (mm) along the contour are not divided.
const LEAST_LENGTH_MM: f64 = 0.01;
/// By what shares are raised where cells are weighed: an edge needs a force even where its chip is thin.
const EDGE_SHARE: f64 = 0.1;

/// A part of a cutter's surface that may cut.
#[derive(Debug, Clone)]
pub(super) struct EngagedCell {
    /// The number of the contour's element, and the range of its parameter.
    pub element: usize,
    pub range: [f64; 2],
    /// The first direction and the one behind the last, counted from the heading.
    pub directions: [usize; 2],
    /// The times of the step at which it may cut.
    pub times: Vec<[f64; 2]>,
}

/// A patch that waits, with its weight: share and area.
struct WeighedPatch {
    weight: f64,
    patch: SurfacePatch,
}

impl PartialEq for WeighedPatch {
    fn eq(&self, other: &Self) -> bool {
        self.weight == other.weight
    }
}

impl Eq for WeighedPatch {}

impl PartialOrd for WeighedPatch {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for WeighedPatch {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.weight.total_cmp(&other.weight)
    }
}

impl StepSearch<'_> {
    /// Returns the cells of the step that may cut. When the budget of the search is used, the cells are larger than they
    /// would have to be.
    pub(super) fn collect_cells(&mut self) -> Vec<EngagedCell> {
        let mut cells = Vec::new();
        if !self.program.is_near_stock(&self.step.bounds(self.contour, self.program.stock_top())) {
            return cells;
        }
        let mut waiting = BinaryHeap::new();
        let (mut waits, mut is_found) = (0.0, 0.0);
        for root in self.roots() {
            waits += self.weigh_and_push(root, &mut waiting);
        }
        while let Some(WeighedPatch { weight, mut patch }) = waiting.pop() {
            waits -= weight;
            self.patches += 1;
            let Some(element) = self.contour.elements().get(patch.element) else { continue };
            let reach = PatchHull::new(self.step, element, &patch, [0.0, 0.0]);
            let Some(times) = self.find_times_of(&mut patch, &reach) else { continue };
            let is_spent = self.patches >= self.budget || self.buffers.tests >= self.most_line_tests;
            let all = waits + is_found + weight;
            // A wrong guess makes the cells larger than they would have to be, and nothing else.
            let is_light = weight <= LEAST_PART * all
                || weight <= LEAST_FULL_PART * all && self.seems_full(&patch, element);
            let parts = if is_spent || is_light { None } else { self.halve_cell(&patch, element, &reach) };
            match parts {
                Some(halves) => {
                    for half in halves {
                        waits += self.weigh_and_push(half, &mut waiting);
                    }
                }
                None => {
                    is_found += weight;
                    cells.push(EngagedCell {
                        element: patch.element,
                        range: patch.range,
                        directions: patch.angles.map(|angle| self.direction_of(angle)),
                        times,
                    });
                }
            }
        }
        cells
    }

    /// Returns the times at which a patch may cut, and narrows what it needs to them; `None` if it never does.
    fn find_times_of(&mut self, patch: &mut SurfacePatch, reach: &PatchHull) -> Option<Vec<[f64; 2]>> {
        patch.depths = [0.0, 0.0];
        let mut near = Vec::new();
        let need = self.cover_patch(patch, reach, reach, &mut near)?;
        let slack = self.program.time_slack(reach.middle());
        find_uncovered(&mut self.buffers.times, patch.need, slack, &mut self.buffers.uncovered);
        let times = self.buffers.uncovered.clone();
        if times.is_empty() {
            return None;
        }
        patch.need = need;
        if patch.candidates.is_some() {
            patch.candidates = Some(near.into());
        }
        Some(times)
    }

    /// Returns whether the middle and the corners of a patch are material at the first, the middle and the last of its
    /// times.
    fn seems_full(&self, patch: &SurfacePatch, element: &ContourElement) -> bool {
        let Some(candidates) = &patch.candidates else { return false };
        let [m, angle, _] = patch.middle();
        let [low, high] = patch.range.map(|at| at + (m - at) * INWARDS);
        let [right, left] = patch.angles.map(|at| at + (angle - at) * INWARDS);
        let times = patch.need.map(|at| at + ((patch.need[0] + patch.need[1]) / 2.0 - at) * INWARDS);
        let places = [(m, angle), (low, right), (low, left), (high, right), (high, left)];
        times.iter().all(|time| {
            places.iter().all(|(m, angle)| {
                let point = self.step.place_of(&surface_point(element, *m, *angle, 0.0), *time);
                self.program.is_proved_material(&point, candidates)
            })
        })
    }

    /// Halves a patch across its longer side, or its times; `None` if it is small.
    fn halve_cell(
        &self,
        patch: &SurfacePatch,
        element: &ContourElement,
        reach: &PatchHull,
    ) -> Option<[SurfacePatch; 2]> {
        let is_bent = reach.bend > (reach.sag + reach.skew) * 0.3;
        if self.divides_times(patch, element, is_bent) {
            return Some(patch.clone().halve_times());
        }
        let [along, around, _] = patch.sizes(element);
        let [from, to] = patch.angles.map(|angle| self.direction_of(angle));
        let can_turn = to - from > 1;
        if can_turn && (around >= along || along < LEAST_LENGTH_MM) {
            return Some(patch.halve(1));
        }
        (along >= LEAST_LENGTH_MM).then(|| patch.halve(0))
    }

    /// Adds a patch to those that wait, and returns its weight; 0 for a patch that does not advance.
    fn weigh_and_push(&self, patch: SurfacePatch, waiting: &mut BinaryHeap<WeighedPatch>) -> f64 {
        let Some(element) = self.contour.elements().get(patch.element) else { return 0.0 };
        let share = self.advance.upper(element, patch.range, patch.angles, patch.need);
        if share <= self.threshold() {
            return 0.0;
        }
        let along = (patch.range[1] - patch.range[0]) * element.length_per_unit();
        let around = (patch.angles[1] - patch.angles[0]) * largest_radius(element, patch.range);
        let weight = (share + EDGE_SHARE) * along * around;
        waiting.push(WeighedPatch { weight, patch: SurfacePatch { upper: share, ..patch } });
        weight
    }

    /// Returns the number of the direction that begins at an angle around the axis; directions are counted from behind the
    /// heading.
    fn direction_of(&self, angle: f64) -> usize {
        let width = std::f64::consts::TAU / CONTACT_DIRECTIONS as f64;
        ((angle - self.heading + std::f64::consts::PI) / width).round().max(0.0) as usize
    }
}
