//! This module holds the contour of a cutter for certified engagement: lines and arcs from the tip up to the
//! flank.
//!
//! The contour lives in the half-plane of r (distance from the axis) and z (height above the tip). Each
//! element bounds the cutter: a line by the half-plane on its inner side, an arc by the half-planes of all
//! its tangents. The cutter is what all elements and the plane at its upper end leave, so it is convex, and
//! its gap is the largest gap of an element. That gap is convex and 1-Lipschitz; inside it is at least minus
//! the depth, outside at most the distance.

use super::contour_element::ContourElement;
use crate::cutter::Meridian;
use nalgebra::Vector3;

/// Lengths that differ by less than this (mm) count as equal.
const SAME: f64 = 1e-6;

/// The contour of a cutter with the tip at the origin.
#[derive(Debug, Clone, PartialEq)]
pub struct CutterContour {
    elements: Vec<ContourElement>,
    height: f64,
    radius: f64,
}

/// The reason why numbers do not describe a cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CutterContourError {
    /// There is no element, or the height is not positive or not finite.
    Length,
    /// The cutter is narrower above its widest place.
    Undercut,
    /// The cutter does not cut in its middle, so that what it removes is not what its contour sweeps.
    DeadMiddle,
    /// The elements do not make a convex contour that turns outwards and upwards.
    NotConvex,
}

impl CutterContour {
    /// Makes the contour of a mill. Elements that are no longer than rounding are left out.
    ///
    /// # Errors
    /// Returns an error for a cutter that is narrower above its widest place, or that does not cut in its middle.
    pub fn from_meridian(profile: &Meridian) -> Result<Self, CutterContourError> {
        if profile.top().is_some() {
            return Err(CutterContourError::Undercut);
        }
        if profile.dead_middle().is_some() {
            return Err(CutterContourError::DeadMiddle);
        }
        let (tip, taper) = (profile.bottom_angle_rad(), profile.taper_rad());
        let (bottom, corner) = (profile.bottom_radius_mm(), profile.corner_radius_mm());
        let mut elements = Vec::new();
        if bottom > SAME {
            let to = [bottom, bottom * tip.tan()];
            elements.push(ContourElement::Line { from: [0.0, 0.0], to, normal: [tip.sin(), -tip.cos()] });
        }
        if corner > SAME {
            let angles = [tip, std::f64::consts::FRAC_PI_2 - taper];
            elements.push(ContourElement::arc(profile.corner_center(), corner, angles));
        }
        let (from, height) = (profile.flank_start(), profile.height_mm());
        if height > from[1] + 2.0 * SAME {
            let to = [profile.radius_mm(), height];
            elements.push(ContourElement::Line { from, to, normal: [taper.cos(), -taper.sin()] });
        }
        Self::from_elements(elements, height)
    }

    /// Makes a contour of any elements, from the tip upwards.
    ///
    /// # Errors
    /// Returns an error if a number is not finite, or if the elements do not meet, or turn inwards.
    pub fn from_elements(elements: Vec<ContourElement>, height_mm: f64) -> Result<Self, CutterContourError> {
        let mut last: Option<([f64; 2], f64)> = None;
        for element in &elements {
            let [from, to] = [element.point(element.range()[0]), element.point(element.range()[1])];
            let [lower, upper] = element.normal_angles();
            let finite = [from, to].iter().flatten().all(|number| number.is_finite());
            if !finite || lower < 0.0 || upper > std::f64::consts::PI || lower > upper {
                return Err(CutterContourError::NotConvex);
            }
            if let Some((at, angle)) = last {
                let apart = (from[0] - at[0]).hypot(from[1] - at[1]);
                if apart > SAME || lower < angle - 1e-9 {
                    return Err(CutterContourError::NotConvex);
                }
            }
            last = Some((to, upper));
        }
        if elements.is_empty() || !(height_mm > 0.0 && height_mm.is_finite()) {
            return Err(CutterContourError::Length);
        }
        Ok(Self::from_parts(elements, height_mm))
    }

    fn from_parts(elements: Vec<ContourElement>, height: f64) -> Self {
        let radius = elements.iter().map(ContourElement::largest_radius).fold(0.0, f64::max);
        Self { elements, height, radius }
    }

    /// Returns the elements from the tip upwards.
    pub fn elements(&self) -> &[ContourElement] {
        &self.elements
    }

    /// Returns the contour as a polyline from the tip upwards, for drawings: distances from the axis and heights, mm.
    pub fn list_outline_points(&self) -> Vec<[f64; 2]> {
        let of_element = |element: &ContourElement| {
            let [from, to] = element.range();
            let parts = if matches!(element, ContourElement::Arc { .. }) { 24 } else { 1 };
            let at = move |number: i32| from + (to - from) * f64::from(number) / f64::from(parts);
            let points: Vec<[f64; 2]> = (0..=parts).map(|number| element.point(at(number))).collect();
            points
        };
        let mut points: Vec<[f64; 2]> = self.elements.iter().flat_map(of_element).collect();
        points.dedup_by(|next, kept| (next[0] - kept[0]).hypot(next[1] - kept[1]) < SAME);
        points
    }

    /// Returns the height of the cutting part, mm.
    pub fn height_mm(&self) -> f64 {
        self.height
    }

    /// Returns the largest radius, mm.
    pub fn radius_mm(&self) -> f64 {
        self.radius
    }

    /// Returns the radius of the flat bottom of a cutter that is nowhere narrower above it, mm; 0 if there is none.
    pub(super) fn flat_radius_mm(&self) -> f64 {
        let flat = |element: &ContourElement| match element {
            ContourElement::Line { from, to, normal } if *normal == [0.0, -1.0] => from[0].max(to[0]),
            _ => 0.0,
        };
        if self.widens_upwards() { self.elements.iter().map(flat).fold(0.0, f64::max) } else { 0.0 }
    }

    /// Returns whether the cutter is nowhere narrower above than below.
    pub(super) fn widens_upwards(&self) -> bool {
        let most = |element: &ContourElement| element.normal_angles()[1];
        self.elements.iter().map(most).fold(0.0, f64::max) <= std::f64::consts::FRAC_PI_2
    }

    /// Returns the gap of a point of the cutter's frame, mm, and the gap's gradient. The gap is negative
    /// inside.
    pub fn gap(&self, at: &Vector3<f64>) -> (f64, Vector3<f64>) {
        self.gap_aside(at, 0.0)
    }

    /// Returns the gap of a point that is `aside` mm further from the axis, or nearer if that is negative,
    /// and its gradient.
    pub fn gap_aside(&self, at: &Vector3<f64>, aside: f64) -> (f64, Vector3<f64>) {
        let distance = (at.x * at.x + at.y * at.y).sqrt();
        let r = (distance + aside).max(0.0);
        let (gap, slope) = self.gap_in_plane(r, at.z);
        let across = if r > 0.0 && distance > 0.0 { slope[0] / distance } else { 0.0 };
        (gap, Vector3::new(at.x * across, at.y * across, slope[1]))
    }

    /// Returns the gap of a point at a distance from the axis and a height above the tip, and its slopes in both.
    #[inline]
    pub(super) fn gap_in_plane(&self, r: f64, z: f64) -> (f64, [f64; 2]) {
        let (mut most, mut slopes) = (z - self.height, [0.0, 1.0]);
        for element in &self.elements {
            let (gap, normal) = element.gap(r, z);
            if gap > most {
                (most, slopes) = (gap, normal);
            }
        }
        (most, slopes)
    }

    /// Returns the largest radius at a height at which the gap is at most `gap_mm`, or `None` if there is
    /// none.
    pub fn radius_at(&self, z: f64, gap_mm: f64) -> Option<f64> {
        if z - self.height > gap_mm {
            return None;
        }
        let mut least = f64::INFINITY;
        for element in &self.elements {
            least = least.min(element.radius_at(z, gap_mm)?);
        }
        (least >= 0.0).then_some(least)
    }
}
