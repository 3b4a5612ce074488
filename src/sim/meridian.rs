//! The meridian of a cutter: bottom, corner, flank.
//!
//! Reduced to three pieces that meet tangentially or in an edge: a straight bottom (a disc, or a drill's cone), an arc (corner
//! radius or ball) and a straight flank (a cylinder, or a cone that widens upwards). The normal's angle never falls on the
//! way up, so the solid is convex: what the closed-form sweeps need.

use std::f64::consts::FRAC_PI_2;

/// Lengths closer than this (mm) are equal: far below any tool's tolerance, far above rounding.
const SAME: f64 = 1e-6;

/// A cutter's meridian, tip at the origin, r across and z up the axis, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct Meridian {
    /// Where the bottom ends: its radius; its height is `bottom_radius * tan(bottom_angle)`.
    bottom_radius: f64,
    /// Angle of the bottom against the plane, radians.
    bottom_angle: f64,
    /// Radius of the corner's arc; 0 for an edge.
    corner_radius: f64,
    /// Centre of the arc: r and z.
    corner_center: [f64; 2],
    /// Angle of the flank against the axis, radians.
    taper: f64,
    /// Where the flank begins: r and z.
    flank_start: [f64; 2],
    /// Height of the cutting part above the tip.
    height: f64,
    /// Tangents of `bottom_angle_rad` and `taper`, which sweeps ask for at every column.
    bottom_tan: f64,
    taper_tan: f64,
}

/// A point of the meridian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeridianPoint {
    /// Distance from the axis, mm.
    pub r: f64,
    /// Height above the tip, mm.
    pub z: f64,
    /// Angle of the outward normal from straight down, radians: 0 on a flat bottom, pi/2 on a cylinder.
    pub psi: f64,
}

/// Why numbers make no profile that can be simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum MeridianError {
    /// The diameter is not positive.
    #[error("the diameter is not positive")]
    Diameter,
    /// The corner radius does not fit into the diameter.
    #[error("the corner radius is larger than half the diameter")]
    Corner,
    /// Taper or tip angle out of range.
    #[error("the taper must be from 0 to below 90 degrees, and the tip's angle as well")]
    Angle,
    /// The flutes end below the corner.
    #[error("the flutes are shorter than the corner is high")]
    Height,
}

impl Meridian {
    /// The profile of a milling cutter or drill.
    ///
    /// `diameter` is measured where the lines of bottom and flank meet (APT's `d`); `taper` is the flank's angle against the axis,
    /// `tip` the bottom's angle against the plane (31 degrees for a drill of 118), both in radians, `flute_length` the height of
    /// the cutting part. A corner radius of half the diameter makes a ball, whatever the taper.
    ///
    /// # Errors
    /// [`MeridianError`] when the numbers do not fit together.
    pub fn new(
        diameter: f64,
        corner_radius: f64,
        taper: f64,
        tip: f64,
        flute_length: f64,
    ) -> Result<Self, MeridianError> {
        if !(diameter > 0.0 && diameter.is_finite()) {
            return Err(MeridianError::Diameter);
        }
        let angle = |angle: f64| (0.0..FRAC_PI_2 - 1e-3).contains(&angle);
        if !angle(taper) || !angle(tip) || taper + tip > FRAC_PI_2 - 1e-3 {
            return Err(MeridianError::Angle);
        }
        let (radius, rc) = (diameter / 2.0, corner_radius);
        if !(0.0..=radius + SAME).contains(&rc) {
            return Err(MeridianError::Corner);
        }
        let (tan_tip, cos_tip) = (tip.tan(), tip.cos());
        let (sin_taper, cos_taper) = taper.sin_cos();
        let ball = (radius - rc).abs() <= SAME && tip == 0.0;
        // The arc's centre is a corner radius away from both lines.
        let e = if ball {
            0.0
        } else {
            (radius * cos_taper - radius * tan_tip * sin_taper - rc + rc * sin_taper / cos_tip)
                / (cos_taper - tan_tip * sin_taper)
        };
        if e < -SAME {
            return Err(MeridianError::Corner);
        }
        let e = e.max(0.0);
        let f = e * tan_tip + rc / cos_tip;
        let bottom_radius = (e + rc * tip.sin()).max(0.0);
        let flank_start = [e + rc * cos_taper, f - rc * sin_taper];
        if !(flute_length > flank_start[1] - SAME && flute_length.is_finite()) {
            return Err(MeridianError::Height);
        }
        Ok(Self {
            bottom_radius,
            bottom_angle: tip,
            corner_radius: rc,
            corner_center: [e, f],
            taper,
            flank_start,
            height: flute_length.max(flank_start[1] + SAME),
            bottom_tan: tan_tip,
            taper_tan: taper.tan(),
        })
    }

    /// Largest radius of the cutting part.
    pub fn radius_mm(&self) -> f64 {
        self.flank_start[0] + (self.height - self.flank_start[1]) * self.taper_tan
    }

    /// Height of the cutting part above the tip.
    pub fn height_mm(&self) -> f64 {
        self.height
    }

    /// Radius at which the bottom ends and the corner begins.
    pub fn bottom_radius_mm(&self) -> f64 {
        self.bottom_radius
    }

    /// Angle of the bottom against the plane, radians.
    pub fn bottom_angle_rad(&self) -> f64 {
        self.bottom_angle
    }

    /// Radius of the corner's arc; 0 for an edge.
    pub fn corner_radius_mm(&self) -> f64 {
        self.corner_radius
    }

    /// Centre of the corner's arc: r and z.
    pub fn corner_center(&self) -> [f64; 2] {
        self.corner_center
    }

    /// Angle of the flank against the axis, radians.
    pub fn taper_rad(&self) -> f64 {
        self.taper
    }

    /// Where the flank begins: r and z.
    pub fn flank_start(&self) -> [f64; 2] {
        self.flank_start
    }

    /// Height of the surface at a distance from the axis, for `r` up to [`Meridian::radius_mm`]; a cylinder's flank counts from its
    /// lower end.
    pub fn height_at_radius_mm(&self, r: f64) -> f64 {
        if r <= self.bottom_radius {
            return r * self.bottom_tan;
        }
        if r <= self.flank_start[0] {
            let across = (r - self.corner_center[0]).min(self.corner_radius);
            return self.corner_center[1]
                - (self.corner_radius * self.corner_radius - across * across).max(0.0).sqrt();
        }
        if self.taper <= 0.0 {
            return self.flank_start[1];
        }
        (self.flank_start[1] + (r - self.flank_start[0]) / self.taper_tan).min(self.height)
    }

    /// Radius at a height above the tip; of a flat bottom the outer edge.
    pub fn radius_at_height_mm(&self, z: f64) -> f64 {
        if z >= self.flank_start[1] {
            return self.flank_start[0] + (z.min(self.height) - self.flank_start[1]) * self.taper_tan;
        }
        let bottom_height = self.bottom_radius * self.bottom_tan;
        if z < bottom_height {
            return (z / self.bottom_tan).max(0.0);
        }
        let down = self.corner_center[1] - z;
        self.corner_center[0] + (self.corner_radius * self.corner_radius - down * down).max(0.0).sqrt()
    }

    /// Angle of the normal from straight down at a height above the tip, radians; at a flat bottom's edge the corner's.
    pub fn normal_angle_at_height_rad(&self, z: f64) -> f64 {
        if z >= self.flank_start[1] {
            return FRAC_PI_2 - self.taper;
        }
        if z < self.bottom_radius * self.bottom_tan || self.corner_radius <= 0.0 {
            return self.bottom_angle;
        }
        ((self.corner_center[1] - z) / self.corner_radius).clamp(-1.0, 1.0).acos()
    }

    /// Sine and cosine of the normal's angle from straight down, at a distance from the axis (a cylinder's flank counts only beyond
    /// its own radius).
    pub fn normal_at_radius(&self, r: f64) -> [f64; 2] {
        if r < self.bottom_radius || (self.corner_radius <= 0.0 && r <= self.flank_start[0]) {
            let (sin, cos) = self.bottom_angle.sin_cos();
            return [sin, cos];
        }
        if r <= self.flank_start[0] {
            let sin = ((r - self.corner_center[0]) / self.corner_radius).clamp(0.0, 1.0);
            return [sin, (1.0 - sin * sin).sqrt()];
        }
        let (sin, cos) = self.taper.sin_cos();
        [cos, sin]
    }

    /// Sine and cosine of the normal's angle from straight down, at a height above the tip; of a flat end's edge, the flank's.
    pub fn normal_at_height(&self, z: f64) -> [f64; 2] {
        if z >= self.flank_start[1] {
            let (sin, cos) = self.taper.sin_cos();
            return [cos, sin];
        }
        if z < self.bottom_radius * self.bottom_tan || self.corner_radius <= 0.0 {
            let (sin, cos) = self.bottom_angle.sin_cos();
            return [sin, cos];
        }
        let cos = ((self.corner_center[1] - z) / self.corner_radius).clamp(0.0, 1.0);
        [(1.0 - cos * cos).sqrt(), cos]
    }

    /// Length along the meridian from the tip to the place of a normal, given its height and radius.
    pub(super) fn arc_length_of_contact_mm(&self, r: f64, z: f64, sin: f64) -> f64 {
        if r < self.bottom_radius && z < self.flank_start[1] {
            return r / self.bottom_angle.cos();
        }
        if z >= self.flank_start[1] {
            return self.flank_start_arc_length_mm() + (z - self.flank_start[1]) / self.taper.cos();
        }
        self.bottom_arc_length_mm()
            + self.corner_radius * (f64::from((sin as f32).min(1.0).asin()) - self.bottom_angle).max(0.0)
    }

    /// Length of the whole meridian from the tip.
    pub fn arc_length_mm(&self) -> f64 {
        self.flank_start_arc_length_mm() + (self.height - self.flank_start[1]) / self.taper.cos()
    }

    /// Length along the meridian from the tip to where the corner begins.
    pub fn bottom_arc_length_mm(&self) -> f64 {
        self.bottom_radius / self.bottom_angle.cos()
    }

    /// Length along the meridian from the tip to where the flank begins.
    pub fn flank_start_arc_length_mm(&self) -> f64 {
        let turn = FRAC_PI_2 - self.taper - self.bottom_angle;
        self.bottom_arc_length_mm() + self.corner_radius * turn
    }

    /// Length along the meridian from the tip to a height above it; of a flat bottom, to its outer edge.
    pub fn arc_length_at_height_mm(&self, z: f64) -> f64 {
        if z >= self.flank_start[1] {
            return self.flank_start_arc_length_mm()
                + (z.min(self.height) - self.flank_start[1]) / self.taper.cos();
        }
        let bottom_height = self.bottom_radius * self.bottom_tan;
        if z < bottom_height {
            return z.max(0.0) / self.bottom_angle.sin();
        }
        self.bottom_arc_length_mm()
            + self.corner_radius * (self.normal_angle_at_height_rad(z) - self.bottom_angle).max(0.0)
    }

    /// The point at a length along the meridian from the tip.
    pub fn point_at_arc_length(&self, length: f64) -> MeridianPoint {
        let bottom = self.bottom_arc_length_mm();
        if length < bottom {
            let (sin, cos) = self.bottom_angle.sin_cos();
            return MeridianPoint { r: length * cos, z: length * sin, psi: self.bottom_angle };
        }
        let flank = self.flank_start_arc_length_mm();
        if length < flank {
            let psi = self.bottom_angle + (length - bottom) / self.corner_radius;
            let [e, f] = self.corner_center;
            return MeridianPoint {
                r: e + self.corner_radius * psi.sin(),
                z: f - self.corner_radius * psi.cos(),
                psi,
            };
        }
        let up = length - flank;
        MeridianPoint {
            r: self.flank_start[0] + up * self.taper.sin(),
            z: self.flank_start[1] + up * self.taper.cos(),
            psi: FRAC_PI_2 - self.taper,
        }
    }
}
