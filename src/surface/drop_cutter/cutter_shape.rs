//! This module holds the shapes of cutters that can be lowered: ball, bull-nose and flat end. A shape is a
//! disc whose rim is rounded with the corner radius.

/// Material must be at least this far inside the cutter's side to count as under the cutter, in mm. Numbers
/// in STL files are not more exact, and a cutter that moves along a wall touches it.
const SIDE: f64 = 1e-6;

/// A ball-end, bull-nose or flat-end mill whose side goes up without end; lengths are in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropCutterShape {
    radius: f64,
    corner: f64,
    /// The radius of the flat bottom. It is also the distance of the centre of the corner's circle from the
    /// axis.
    flat: f64,
    /// The distance from the axis up to which material is under the cutter and not beside it.
    reach: f64,
}

/// The reason why numbers do not describe a cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum CutterShapeError {
    /// The diameter is not positive or not finite.
    #[error("the diameter is not a positive length")]
    Diameter,
    /// The corner radius is negative or does not fit into the diameter.
    #[error("the corner radius is not between 0 and half the diameter")]
    Corner,
}

impl DropCutterShape {
    /// Makes a cutter from its diameter and corner radius in mm. A corner radius of 0 is a flat end, half the
    /// diameter a ball.
    ///
    /// # Errors
    /// Returns an error if the diameter is not positive, or if the corner radius is negative or more than
    /// half of it.
    pub fn new(diameter_mm: f64, corner_radius_mm: f64) -> Result<Self, CutterShapeError> {
        if !(diameter_mm > 0.0 && diameter_mm.is_finite()) {
            return Err(CutterShapeError::Diameter);
        }
        let radius = diameter_mm / 2.0;
        if !(0.0..=radius).contains(&corner_radius_mm) {
            return Err(CutterShapeError::Corner);
        }
        let reach = radius - SIDE.min(radius * 1e-3);
        Ok(Self { radius, corner: corner_radius_mm, flat: radius - corner_radius_mm, reach })
    }

    /// Makes a ball-end mill.
    ///
    /// # Errors
    /// Returns an error if the diameter is not positive.
    pub fn ball(diameter_mm: f64) -> Result<Self, CutterShapeError> {
        Self::new(diameter_mm, diameter_mm / 2.0)
    }

    /// Makes a flat-end mill with a sharp edge.
    ///
    /// # Errors
    /// Returns an error if the diameter is not positive.
    pub fn flat(diameter_mm: f64) -> Result<Self, CutterShapeError> {
        Self::new(diameter_mm, 0.0)
    }

    /// Returns half the diameter.
    pub fn radius_mm(&self) -> f64 {
        self.radius
    }

    /// Returns the corner radius: 0 for a flat end, [`DropCutterShape::radius_mm`] for a ball.
    pub fn corner_radius_mm(&self) -> f64 {
        self.corner
    }

    /// Returns the radius of the flat part of the bottom: 0 for a ball.
    pub fn flat_radius_mm(&self) -> f64 {
        self.flat
    }

    /// Returns the height of the bottom above the tip at a distance from the axis, for `r` up to the radius,
    /// mm.
    pub fn height_at(&self, r: f64) -> f64 {
        let across = r - self.flat;
        if across <= 0.0 {
            return 0.0;
        }
        // Only rounding can make this negative.
        self.corner - (self.corner * self.corner - across * across).max(0.0).sqrt()
    }

    /// Returns the largest distance from the axis at which material is under the cutter.
    pub(super) fn reach_mm(&self) -> f64 {
        self.reach
    }

    /// Returns the sine of the angle between the axis and the cutter's normal at a distance from the axis. It
    /// is 0 on a flat end up to its edge.
    pub(super) fn lean_sine(&self, r: f64) -> f64 {
        if r <= self.flat || self.corner <= 0.0 { 0.0 } else { ((r - self.flat) / self.corner).min(1.0) }
    }

    /// Returns the height of the bottom above the tip at a distance from the axis below the radius, and the
    /// outward slope of the bottom there, divided by that distance.
    #[inline]
    pub(super) fn tangent_at(&self, r: f64) -> (f64, f64) {
        let across = r - self.flat;
        if across <= 0.0 {
            return (0.0, 0.0);
        }
        let up = (self.corner * self.corner - across * across).sqrt();
        (self.corner - up, across / (up * r))
    }

    /// Returns the distance from the axis, uphill, at which a plane touches the cutter whose steepest slope
    /// is `slope`.
    pub(super) fn plane_contact_radius(&self, slope: f64) -> f64 {
        if slope <= 0.0 {
            return 0.0;
        }
        // The sine of the slope's angle, written so that an infinite slope gives 1.
        (self.flat + self.corner / (1.0 + 1.0 / (slope * slope)).sqrt()).min(self.reach)
    }
}
