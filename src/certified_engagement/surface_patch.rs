//! This module holds patches of a cutter's surface, and the hulls that stand for them.
//!
//! A patch is a range of the contour and a range of directions around the axis. For the thickness of chips
//! it also has a range of depths below the surface. A hull is the lines of a patch's corners: every point of
//! the patch is at most the sag from the corners' convex hull, (dphi² r + dkappa² rho) / 8, because a
//! surface is that near to what interpolates its corners.

use super::contour_element::ContourElement;
use super::cutter_contour::CutterContour;
use nalgebra::Vector3;
use std::rc::Rc;

/// A patch that waits to be examined.
#[derive(Debug, Clone)]
pub(super) struct SurfacePatch {
    /// The number of the contour's element.
    pub element: usize,
    /// The range of the element's parameter.
    pub range: [f64; 2],
    /// The range of directions around the axis, radians in the cutter's frame.
    pub angles: [f64; 2],
    /// The range of depths at which material may begin, mm.
    pub depths: [f64; 2],
    /// The times of the step that the patch is about.
    pub times: [f64; 2],
    /// The part of them at which the patch may meet material.
    pub need: [f64; 2],
    /// What no point of the patch exceeds.
    pub upper: f64,
    /// The earlier steps that may touch the patch; `None` while the patch is too large for them to be
    /// collected.
    pub candidates: Option<Rc<[u32]>>,
}

impl PartialEq for SurfacePatch {
    fn eq(&self, other: &Self) -> bool {
        self.upper == other.upper
    }
}

impl Eq for SurfacePatch {}

impl PartialOrd for SurfacePatch {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for SurfacePatch {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.upper.total_cmp(&other.upper)
    }
}

impl SurfacePatch {
    /// Returns the parameter, the direction and the depth of the middle.
    pub(super) fn middle(&self) -> [f64; 3] {
        [self.range, self.angles, self.depths].map(|[from, to]| (from + to) / 2.0)
    }

    /// Halves the patch across its contour range (0), its directions (1) or its depths (2).
    pub(super) fn halve(&self, across: usize) -> [Self; 2] {
        let [m, angle, depth] = self.middle();
        let (mut first, mut second) = (self.clone(), self.clone());
        match across {
            0 => (first.range[1], second.range[0]) = (m, m),
            1 => (first.angles[1], second.angles[0]) = (angle, angle),
            _ => (first.depths[1], second.depths[0]) = (depth, depth),
        }
        [first, second]
    }

    /// Halves the times of the patch.
    pub(super) fn halve_times(self) -> [Self; 2] {
        let middle = (self.need[0] + self.need[1]) / 2.0;
        let (mut first, mut second) = (self.clone(), self);
        (first.need[1], second.need[0]) = (middle, middle);
        (first.times[1], second.times[0]) = (middle, middle);
        [first, second]
    }

    /// Returns the lengths of the patch along the contour, around the axis and in depth, mm.
    pub(super) fn sizes(&self, element: &ContourElement) -> [f64; 3] {
        let radius = largest_radius(element, self.range);
        let along = (self.range[1] - self.range[0]) * element.length_per_unit();
        [along, (self.angles[1] - self.angles[0]) * radius, self.depths[1] - self.depths[0]]
    }
}

/// Returns the largest distance from the axis of a part of an element.
pub(super) fn largest_radius(element: &ContourElement, [from, to]: [f64; 2]) -> f64 {
    match element {
        ContourElement::Arc { center, radius, .. } if to > 1.57 && from < 1.58 => center[0] + radius,
        _ => element.point(from)[0].max(element.point(to)[0]),
    }
}

/// Returns the patches that a search begins with: every element in eight directions, without what is far
/// above the stock.
pub(super) fn root_patches(contour: &CutterContour, heading: f64, farthest: f64) -> Vec<SurfacePatch> {
    let mut roots = Vec::new();
    let sector = std::f64::consts::FRAC_PI_4;
    for (element, shape) in contour.elements().iter().enumerate() {
        let mut range = shape.range();
        if let ContourElement::Line { from, to, .. } = shape
            && to[1] > farthest
            && to[1] > from[1]
        {
            range[1] = ((farthest - from[1]) / (to[1] - from[1])).clamp(1e-9, 1.0);
        }
        let parts = if matches!(shape, ContourElement::Arc { .. }) { 2 } else { 1 };
        let part = (range[1] - range[0]) / f64::from(parts);
        for number in 0..parts {
            let from = range[0] + part * f64::from(number);
            for turn in -4..4 {
                let angle = heading + f64::from(turn) * sector;
                roots.push(SurfacePatch {
                    element,
                    range: [from, from + part],
                    angles: [angle, angle + sector],
                    depths: [0.0, f64::INFINITY],
                    times: [0.0, 1.0],
                    need: [0.0, 1.0],
                    upper: f64::INFINITY,
                    candidates: None,
                });
            }
        }
    }
    roots
}

/// Returns the point of an element's surface, `depth` below it, in the cutter's frame.
pub(super) fn surface_point(element: &ContourElement, m: f64, angle: f64, depth: f64) -> Vector3<f64> {
    let ([r, z], [across, up]) = (element.point(m), element.normal(m));
    let r = r - depth * across;
    Vector3::new(r * angle.cos(), r * angle.sin(), z - depth * up)
}
