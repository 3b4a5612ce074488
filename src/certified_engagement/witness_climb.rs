//! This module looks for better witnesses than those that a search comes across.

use super::contour_element::ContourElement;
use super::cover_test::MATERIAL_TOLERANCE_MM;
use super::step_search::{EngagementCriterion, StepSearch};
use super::surface_patch::SurfacePatch;

/// The directions of a climb.
const COMPASS: [[f64; 2]; 8] =
    [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.7, 0.7], [-0.7, 0.7], [0.7, -0.7], [-0.7, -0.7]];
/// How far a climb may go up, as a part of the cutter's radius.
const CLIMBING_ROOM: f64 = 0.3;
/// The most places of one climb.
const MOST_CLIMBING: usize = 320;
/// The number of directions in which points are tried all over the surface.
const SEED_DIRECTIONS: i32 = 24;

impl StepSearch<'_> {
    /// Tries points all over the surface. The search looks first where shares are largest; where nothing is
    /// engaged there, it would go on without a lower bound for long.
    pub(super) fn sow_seeds(&mut self) {
        let candidates = self.all_near_steps();
        let reach = self.program.farthest_from(&self.step.tips);
        for (number, shape) in self.contour.elements().iter().enumerate() {
            let [from, to] = shape.range();
            let length = ((to - from) * shape.length_per_unit()).max(1e-9);
            let most = (reach / length).min(1.0);
            for part in [0.002, 0.02, 0.1, 0.3, 0.6, 0.9, 0.999] {
                let part = if matches!(shape, ContourElement::Line { .. }) && number > 0 {
                    part * most
                } else {
                    part
                };
                for direction in 0..SEED_DIRECTIONS {
                    let turn = f64::from(direction) / f64::from(SEED_DIRECTIONS) * std::f64::consts::TAU;
                    let place = (number, from + (to - from) * part, self.heading + turn);
                    self.try_point(place, 0.0, [0.0, 1.0], &candidates);
                }
            }
        }
        if matches!(self.criterion, EngagementCriterion::Chip { .. }) {
            self.climb();
        }
    }

    /// Climbs from the witness to places with longer runs of material. Where chips are as long as the
    /// material lets them, the longest is between places that the search looks at early.
    pub(super) fn climb(&mut self) {
        let Some(start) = self.witness else { return };
        let Some(shape) = self.contour.elements().get(start.element) else { return };
        let range = shape.range();
        let radius = shape.point(start.parameter)[0].max(self.contour.radius_mm() * 0.01);
        // An upright cutter needs only the steps below the climb, and the climb stays below them.
        let is_upright = self.step.is_exact() && self.step.axes[0] == nalgebra::Vector3::z();
        let tip = self.step.tips[0].z.max(self.step.tips[1].z) + self.criterion.scale();
        let radius_part = self.contour.radius_mm() * CLIMBING_ROOM;
        let highest = if is_upright { tip + shape.point(start.parameter)[1] + radius_part } else { f64::MAX };
        let candidates = self.near_steps(highest);
        let mut length = self.contour.radius_mm() * 0.1;
        let mut tries = 0;
        while length > self.criterion.scale() * 1e-3 && tries < MOST_CLIMBING {
            let before = self.lower;
            for [along, around] in COMPASS {
                let Some(place) = self.witness else { return };
                let m = place.parameter + along * length / shape.length_per_unit();
                let angle = self.heading + place.from_heading + around * length / radius;
                let m = m.clamp(range[0], range[1]);
                tries += 1;
                if is_upright && tip + shape.point(m)[1] > highest {
                    continue;
                }
                self.try_point(
                    (place.element, m.clamp(range[0], range[1]), angle),
                    0.0,
                    [0.0, 1.0],
                    &candidates,
                );
            }
            if self.lower <= before * 1.0005 {
                length *= 0.4;
            }
        }
    }

    /// Looks for a witness in a fan of directions and distances around a patch into which the search has
    /// zoomed.
    pub(super) fn search_around(&mut self, patch: &SurfacePatch, element: &ContourElement) {
        let [m, angle, depth] = patch.middle();
        let radius = element.point(m)[0].max(1e-3);
        let candidates = self.all_near_steps();
        let range = element.range();
        for direction in 0..16 {
            let (sin, cos) = (f64::from(direction) * std::f64::consts::FRAC_PI_8).sin_cos();
            let mut distance = MATERIAL_TOLERANCE_MM;
            while distance < 0.02 {
                let along = (m + sin * distance / element.length_per_unit()).clamp(range[0], range[1]);
                let place = (patch.element, along, angle + cos * distance / radius);
                self.try_point(place, depth, [0.0, 1.0], &candidates);
                distance *= 3.0;
            }
        }
    }
}
