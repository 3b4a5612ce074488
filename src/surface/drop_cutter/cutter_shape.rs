//! Cutters that can be lowered: ball, bull-nose and flat end, as the disc on which the corner's circle is centred.

/// How far inside the side material has to reach to count as under a cutter, mm: numbers in STL files are no better, and a cutter
/// that goes along a wall touches it.
const SIDE: f64 = 1e-6;

/// A ball, bull-nose or flat end mill; its side goes up without end. mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropCutterShape {
    radius: f64,
    corner: f64,
    /// Radius of the flat bottom, and of the circle around which the corner's circle turns.
    flat: f64,
    /// Up to here material is under the cutter, not beside it.
    reach: f64,
}

/// Why numbers make no cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum CutterShapeError {
    /// The diameter is not positive, or not finite.
    #[error("the diameter is not a positive length")]
    Diameter,
    /// The corner radius is negative or does not fit into the diameter.
    #[error("the corner radius is not between 0 and half the diameter")]
    Corner,
}

impl DropCutterShape {
    /// A cutter from its diameter and corner radius: 0 is a flat end, half the diameter a ball.
    ///
    /// # Errors
    /// When the diameter is not positive, or the corner radius negative or more than half of it.
    pub fn new(diameter: f64, corner_radius: f64) -> Result<Self, CutterShapeError> {
        if !(diameter > 0.0 && diameter.is_finite()) {
            return Err(CutterShapeError::Diameter);
        }
        let radius = diameter / 2.0;
        if !(0.0..=radius).contains(&corner_radius) {
            return Err(CutterShapeError::Corner);
        }
        let reach = radius - SIDE.min(radius * 1e-3);
        Ok(Self { radius, corner: corner_radius, flat: radius - corner_radius, reach })
    }

    /// A ball end.
    ///
    /// # Errors
    /// When the diameter is not positive.
    pub fn ball(diameter: f64) -> Result<Self, CutterShapeError> {
        Self::new(diameter, diameter / 2.0)
    }

    /// A flat end with sharp corners.
    ///
    /// # Errors
    /// When the diameter is not positive.
    pub fn flat(diameter: f64) -> Result<Self, CutterShapeError> {
        Self::new(diameter, 0.0)
    }

    /// Half the diameter.
    pub fn radius_mm(&self) -> f64 {
        self.radius
    }

    /// Radius of the corner: 0 of a flat end, [`DropCutterShape::radius_mm`] of a ball.
    pub fn corner_radius_mm(&self) -> f64 {
        self.corner
    }

    /// Radius of the flat part of the bottom: 0 of a ball.
    pub fn flat_radius_mm(&self) -> f64 {
        self.flat
    }

    /// Height of the bottom above the tip at a distance from the axis, for `r` up to the radius.
    pub fn height_at(&self, r: f64) -> f64 {
        let across = r - self.flat;
        if across <= 0.0 {
            return 0.0;
        }
        // Beyond the radius only by rounding.
        self.corner - (self.corner * self.corner - across * across).max(0.0).sqrt()
    }

    /// Largest distance from the axis at which material is under the cutter.
    pub(super) fn reach_mm(&self) -> f64 {
        self.reach
    }

    /// Sine of the angle between the axis and the cutter's normal at a distance from the axis; 0 on a flat end up to its edge.
    pub(super) fn lean_sine(&self, r: f64) -> f64 {
        if r <= self.flat || self.corner <= 0.0 { 0.0 } else { ((r - self.flat) / self.corner).min(1.0) }
    }

    /// Height of the bottom above the tip at a distance from the axis less than the radius, and its rise outwards there, divided by
    /// that distance.
    #[inline]
    pub(super) fn tangent_at(&self, r: f64) -> (f64, f64) {
        let across = r - self.flat;
        if across <= 0.0 {
            return (0.0, 0.0);
        }
        let up = (self.corner * self.corner - across * across).sqrt();
        (self.corner - up, across / (up * r))
    }

    /// Where a plane that rises by `slope` in its steepest direction touches: how far from the axis, uphill.
    pub(super) fn plane_contact_radius(&self, slope: f64) -> f64 {
        if slope <= 0.0 {
            return 0.0;
        }
        // With the slope below the line, so that one without bound gives a sine of 1.
        (self.flat + self.corner / (1.0 + 1.0 / (slope * slope)).sqrt()).min(self.reach)
    }
}
