//! This module holds the contour of a cutter for certified engagement: lines and arcs from the tip up to the
//! flank.
//!
//! The contour lives in the half-plane of r (distance from the axis) and z (height above the tip). Each
//! element bounds the cutter: a line by the half-plane on its inner side, an arc by the half-planes of all
//! its tangents. The cutter is what all elements and the plane at its upper end leave, so it is convex, and
//! its gap is the largest gap of an element. That gap is convex and 1-Lipschitz; inside it is at least minus
//! the depth, outside at most the distance.

use super::contour_element::ContourElement;
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
    /// A length is not positive or not finite.
    Length,
    /// An angle is out of range.
    Angle,
    /// The corner does not fit into the diameter, or the flutes are shorter than it.
    Corner,
    /// The elements do not make a convex contour that turns outwards and upwards.
    NotConvex,
}

impl CutterContour {
    /// Makes the contour of a flat, ball, bull-nose, taper or cone cutter from APT's numbers: the diameter
    /// where bottom and flank meet, the corner radius, the angle between flank and axis, the angle between
    /// bottom and plane, and the height of the cutting part (mm and radians).
    ///
    /// # Errors
    /// Returns an error if the numbers do not fit together.
    pub fn mill(
        diameter_mm: f64,
        corner_radius_mm: f64,
        taper_rad: f64,
        tip_rad: f64,
        flute_length_mm: f64,
    ) -> Result<Self, CutterContourError> {
        let positive = |length: f64| length > 0.0 && length.is_finite();
        if !positive(diameter_mm) || !positive(flute_length_mm) {
            return Err(CutterContourError::Length);
        }
        let angle = |angle: f64| (0.0..std::f64::consts::FRAC_PI_2 - 1e-3).contains(&angle);
        if !angle(taper_rad) || !angle(tip_rad) || !angle(taper_rad + tip_rad) {
            return Err(CutterContourError::Angle);
        }
        let (radius, rc) = (diameter_mm / 2.0, corner_radius_mm);
        if !(0.0..=radius + SAME).contains(&rc) {
            return Err(CutterContourError::Corner);
        }
        // The arc's centre is one corner radius away from bottom and flank.
        let (tan_tip, cos_tip, sin_tip) = (tip_rad.tan(), tip_rad.cos(), tip_rad.sin());
        let (sin_taper, cos_taper) = taper_rad.sin_cos();
        let ball = (radius - rc).abs() <= SAME && tip_rad == 0.0;
        let e = if ball {
            0.0
        } else {
            (radius * cos_taper - radius * tan_tip * sin_taper - rc + rc * sin_taper / cos_tip)
                / (cos_taper - tan_tip * sin_taper)
        };
        if e < -SAME {
            return Err(CutterContourError::Corner);
        }
        let e = e.max(0.0);
        let f = e * tan_tip + rc / cos_tip;
        let mut elements = Vec::new();
        let bottom = (e + rc * sin_tip).max(0.0);
        if bottom > SAME {
            let to = [bottom, bottom * tan_tip];
            elements.push(ContourElement::Line { from: [0.0, 0.0], to, normal: [sin_tip, -cos_tip] });
        }
        let upper = std::f64::consts::FRAC_PI_2 - taper_rad;
        if rc > SAME {
            elements.push(ContourElement::arc([e, f], rc, [tip_rad, upper]));
        }
        let flank = [e + rc * cos_taper, f - rc * sin_taper];
        let height = flute_length_mm;
        if height < flank[1] - SAME {
            return Err(CutterContourError::Corner);
        }
        if height > flank[1] + SAME {
            let to = [flank[0] + (height - flank[1]) * sin_taper / cos_taper, height];
            elements.push(ContourElement::Line { from: flank, to, normal: [cos_taper, -sin_taper] });
        }
        Ok(Self::from_parts(elements, height))
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

    /// Returns the height of the cutting part, mm.
    pub fn height_mm(&self) -> f64 {
        self.height
    }

    /// Returns the largest radius, mm.
    pub fn radius_mm(&self) -> f64 {
        self.radius
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
        let (mut most, mut slope) = (at.z - self.height, [0.0, 1.0]);
        for element in &self.elements {
            let (gap, normal) = element.gap(r, at.z);
            if gap > most {
                (most, slope) = (gap, normal);
            }
        }
        let across = if r > 0.0 && distance > 0.0 { slope[0] / distance } else { 0.0 };
        (most, Vector3::new(at.x * across, at.y * across, slope[1]))
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
