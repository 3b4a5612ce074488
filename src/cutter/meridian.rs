//! This module holds the meridian of a cutter: the line from the tip over the bottom and the corner radius up
//! the flank.
//!
//! The meridian has three parts that meet tangentially or in a sharp edge: a straight bottom (a disc, or the
//! cone of a drill), an arc (a corner radius or a ball) and a straight flank (a cylinder, or a cone that
//! widens upwards). The angle of the normal never falls on the way up, so the solid is convex, which the
//! closed forms of the sweeps need.

use super::dead_middle::DeadMiddle;
use std::f64::consts::FRAC_PI_2;

/// Lengths that differ by less than this (mm) count as equal. It is far below any tool's tolerance and far
/// above rounding.
const SAME: f64 = 1e-6;

/// The meridian of a cutter in mm, with the tip at the origin, r across the axis and z up the axis.
///
/// ```
/// use clsmith::cutter::Meridian;
///
/// // A ball of 10 mm with flutes of 20 mm: diameter, corner radius, taper, tip angle, flute length.
/// let ball = Meridian::new(10.0, 5.0, 0.0, 0.0, 20.0)?;
/// assert!((ball.height_at_radius_mm(3.0) - 1.0).abs() < 1e-12);
/// assert!((ball.radius_at_height_mm(12.0) - 5.0).abs() < 1e-12);
/// assert!(Meridian::new(10.0, 6.0, 0.0, 0.0, 20.0).is_err());
/// # Ok::<(), clsmith::cutter::MeridianError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Meridian {
    /// The radius at which the bottom ends. Its height there is `bottom_radius * tan(bottom_angle)`.
    bottom_radius: f64,
    /// The angle between the bottom and the plane across the axis, radians.
    bottom_angle: f64,
    /// The radius of the corner's arc; 0 for a sharp edge.
    corner_radius: f64,
    /// The centre of the arc: r and z.
    corner_center: [f64; 2],
    /// The angle between the flank and the axis, radians.
    taper: f64,
    /// The point at which the flank begins: r and z.
    flank_start: [f64; 2],
    /// The height of the cutting part above the tip.
    height: f64,
    /// The tangents of `bottom_angle` and `taper`, which the sweeps need at every column.
    bottom_tan: f64,
    taper_tan: f64,
    /// Their sines and cosines.
    bottom_sin_cos: [f64; 2],
    taper_sin_cos: [f64; 2],
    /// The upper side of a cutter that is narrower above its widest place.
    top: Option<Box<CutterTop>>,
    /// The middle of an indexable cutter, which does not cut.
    pub(super) dead_middle: Option<DeadMiddle>,
}

/// The upper side of a cutter that is narrower above its widest place.
#[derive(Debug, Clone, PartialEq)]
pub struct CutterTop {
    /// The meridian of the upper side, upside down: heights count downwards from `height_mm`.
    pub profile: Meridian,
    /// The height of its tip above the cutter's tip, mm.
    pub height_mm: f64,
}

/// A point of the meridian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeridianPoint {
    /// The distance from the axis, mm.
    pub r: f64,
    /// The height above the tip, mm.
    pub z: f64,
    /// The angle of the outward normal from straight down, radians: 0 on a flat bottom, pi/2 on a cylinder.
    pub psi: f64,
}

/// The reason why numbers do not describe a meridian that can be simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeridianError {
    /// The diameter is not positive.
    #[error("the diameter is not positive")]
    Diameter,
    /// The corner radius does not fit into the diameter.
    #[error("the corner radius is larger than half the diameter")]
    Corner,
    /// The taper or the tip's angle is out of range.
    #[error("the taper must be from 0 to below 90 degrees, and the tip's angle as well")]
    Angle,
    /// The flutes end below the upper end of the corner radius.
    #[error("the flutes are shorter than the corner is high")]
    Height,
    /// The flank of a dovetail narrows to a point below the upper end of the flutes.
    #[error("the flank narrows to a point below the upper end of the flutes")]
    Narrow,
}

impl Meridian {
    /// Makes the meridian of a milling cutter or drill.
    ///
    /// `diameter_mm` is measured where the lines of bottom and flank meet (APT's `d`). `taper_rad` is the angle
    /// between flank and axis and `tip_rad` the angle between bottom and plane (31 degrees for a drill of 118
    /// degrees), both in radians. `flute_length_mm` is the height of the cutting part. A corner radius of half
    /// the diameter makes a ball, whatever the taper.
    ///
    /// # Errors
    /// Returns a [`MeridianError`] if the numbers do not fit together.
    pub fn new(
        diameter_mm: f64,
        corner_radius_mm: f64,
        taper_rad: f64,
        tip_rad: f64,
        flute_length_mm: f64,
    ) -> Result<Self, MeridianError> {
        if !(diameter_mm > 0.0 && diameter_mm.is_finite()) {
            return Err(MeridianError::Diameter);
        }
        let angle = |angle: f64| (0.0..FRAC_PI_2 - 1e-3).contains(&angle);
        if !angle(taper_rad) || !angle(tip_rad) || taper_rad + tip_rad > FRAC_PI_2 - 1e-3 {
            return Err(MeridianError::Angle);
        }
        let (radius, rc) = (diameter_mm / 2.0, corner_radius_mm);
        if !(rc >= 0.0 && rc.is_finite()) {
            return Err(MeridianError::Corner);
        }
        let (tan_tip, cos_tip) = (tip_rad.tan(), tip_rad.cos());
        let (sin_taper, cos_taper) = taper_rad.sin_cos();
        let ball = (radius - rc).abs() <= SAME && tip_rad == 0.0;
        // The centre (e, f) of the arc is one corner radius away from both lines: from the bottom, f cos(tip)
        // - e sin(tip) = rc; from the flank through (radius, radius tan(tip)), the same distance inwards.
        // This is solved for e.
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
        // The tangent points: from the centre by rc along the normal of the bottom and of the flank.
        let f = e * tan_tip + rc / cos_tip;
        let bottom_radius = (e + rc * tip_rad.sin()).max(0.0);
        let flank_start = [e + rc * cos_taper, f - rc * sin_taper];
        if !(flute_length_mm > flank_start[1] - SAME && flute_length_mm.is_finite()) {
            return Err(MeridianError::Height);
        }
        Ok(Self {
            bottom_radius,
            bottom_angle: tip_rad,
            corner_radius: rc,
            corner_center: [e, f],
            taper: taper_rad,
            flank_start,
            height: flute_length_mm.max(flank_start[1] + SAME),
            bottom_tan: tan_tip,
            taper_tan: taper_rad.tan(),
            bottom_sin_cos: tip_rad.sin_cos().into(),
            taper_sin_cos: [sin_taper, cos_taper],
            top: None,
            dead_middle: None,
        })
    }

    /// Returns the upper side of a cutter that is narrower above its widest place; `None` for all others.
    pub fn top(&self) -> Option<&CutterTop> {
        self.top.as_deref()
    }

    /// Returns the radius at the upper end of the cutting part, mm, where the neck or shank begins.
    pub fn upper_radius_mm(&self) -> f64 {
        match self.top() {
            Some(top) => top.profile.radius_at_height_mm(top.height_mm - self.height),
            None => self.radius_mm(),
        }
    }

    /// Gives the cutter an upper side.
    pub(super) fn with_top(self, top: CutterTop) -> Self {
        Self { top: Some(Box::new(top)), ..self }
    }

    /// Returns the largest radius of the cutting part, mm.
    pub fn radius_mm(&self) -> f64 {
        self.flank_start[0] + (self.height - self.flank_start[1]) * self.taper_tan
    }

    /// Returns the height of the cutting part above the tip, mm.
    pub fn height_mm(&self) -> f64 {
        self.height
    }

    /// Returns the radius at which the bottom ends and the corner's arc begins, mm.
    pub fn bottom_radius_mm(&self) -> f64 {
        self.bottom_radius
    }

    /// Returns the angle between the bottom and the plane across the axis, radians.
    pub fn bottom_angle_rad(&self) -> f64 {
        self.bottom_angle
    }

    /// Returns the radius of the corner's arc, mm; 0 for a sharp edge.
    pub fn corner_radius_mm(&self) -> f64 {
        self.corner_radius
    }

    /// Returns the centre of the corner's arc: r and z, mm.
    pub fn corner_center(&self) -> [f64; 2] {
        self.corner_center
    }

    /// Returns the angle between the flank and the axis, radians.
    pub fn taper_rad(&self) -> f64 {
        self.taper
    }

    /// Returns the point at which the flank begins: r and z, mm.
    pub fn flank_start(&self) -> [f64; 2] {
        self.flank_start
    }

    /// Returns the height of the surface at a distance from the axis, for `r` up to [`Meridian::radius_mm`].
    /// On a cylinder this is the lower end of the flank.
    pub fn height_at_radius_mm(&self, r: f64) -> f64 {
        if r <= self.bottom_radius {
            return r * self.bottom_tan;
        }
        if r <= self.flank_start[0] {
            // The lower half of the arc's circle: z = f - sqrt(rc^2 - (r - e)^2).
            let across = (r - self.corner_center[0]).min(self.corner_radius);
            return self.corner_center[1]
                - (self.corner_radius * self.corner_radius - across * across).max(0.0).sqrt();
        }
        if self.taper <= 0.0 {
            return self.flank_start[1];
        }
        (self.flank_start[1] + (r - self.flank_start[0]) / self.taper_tan).min(self.height)
    }

    /// Returns the radius at a height above the tip. At the height of a flat bottom this is the bottom's
    /// outer edge.
    pub fn radius_at_height_mm(&self, z: f64) -> f64 {
        if z >= self.flank_start[1] {
            return self.flank_start[0] + (z.min(self.height) - self.flank_start[1]) * self.taper_tan;
        }
        let bottom_height = self.bottom_radius * self.bottom_tan;
        if z < bottom_height {
            return (z / self.bottom_tan).max(0.0);
        }
        // The outer half of the same circle: r = e + sqrt(rc^2 - (f - z)^2).
        let down = self.corner_center[1] - z;
        self.corner_center[0] + (self.corner_radius * self.corner_radius - down * down).max(0.0).sqrt()
    }

    /// Returns the angle of the normal from straight down at a height above the tip, radians. At the edge of
    /// a flat bottom this is the normal of the corner's arc.
    pub fn normal_angle_at_height_rad(&self, z: f64) -> f64 {
        if z >= self.flank_start[1] {
            return FRAC_PI_2 - self.taper;
        }
        if z < self.bottom_radius * self.bottom_tan || self.corner_radius <= 0.0 {
            return self.bottom_angle;
        }
        ((self.corner_center[1] - z) / self.corner_radius).clamp(-1.0, 1.0).acos()
    }

    /// Returns the sine and cosine of the normal's angle from straight down at a distance from the axis. A
    /// cylinder's flank only counts beyond its own radius.
    pub fn normal_at_radius(&self, r: f64) -> [f64; 2] {
        if r < self.bottom_radius || (self.corner_radius <= 0.0 && r <= self.flank_start[0]) {
            return self.bottom_sin_cos;
        }
        if r <= self.flank_start[0] {
            let sin = ((r - self.corner_center[0]) / self.corner_radius).clamp(0.0, 1.0);
            return [sin, (1.0 - sin * sin).sqrt()];
        }
        let [sin, cos] = self.taper_sin_cos;
        [cos, sin]
    }

    /// Returns the sine and cosine of the normal's angle from straight down at a height above the tip. At a
    /// sharp edge of a flat end this is the normal of the flank.
    pub fn normal_at_height(&self, z: f64) -> [f64; 2] {
        if z >= self.flank_start[1] {
            let [sin, cos] = self.taper_sin_cos;
            return [cos, sin];
        }
        if z < self.bottom_radius * self.bottom_tan || self.corner_radius <= 0.0 {
            return self.bottom_sin_cos;
        }
        let cos = ((self.corner_center[1] - z) / self.corner_radius).clamp(0.0, 1.0);
        [(1.0 - cos * cos).sqrt(), cos]
    }

    /// Returns the length along the meridian from the tip to a contact, given by its radius, its height and
    /// the sine of its normal's angle.
    pub(crate) fn arc_length_of_contact_mm(&self, r: f64, z: f64, sin: f64) -> f64 {
        if r < self.bottom_radius && z < self.flank_start[1] {
            return r / self.bottom_sin_cos[1];
        }
        if z >= self.flank_start[1] {
            return self.flank_start_arc_length_mm() + (z - self.flank_start[1]) / self.taper_sin_cos[1];
        }
        // On the arc, the length is the corner radius times the turn of the normal.
        self.bottom_arc_length_mm()
            + self.corner_radius * (f64::from((sin as f32).min(1.0).asin()) - self.bottom_angle).max(0.0)
    }

    /// Returns the length of the whole meridian, mm.
    pub fn arc_length_mm(&self) -> f64 {
        self.flank_start_arc_length_mm() + (self.height - self.flank_start[1]) / self.taper_sin_cos[1]
    }

    /// Returns the length along the meridian from the tip to where the corner's arc begins, mm.
    pub fn bottom_arc_length_mm(&self) -> f64 {
        self.bottom_radius / self.bottom_sin_cos[1]
    }

    /// Returns the length along the meridian from the tip to where the flank begins, mm.
    pub fn flank_start_arc_length_mm(&self) -> f64 {
        let turn = FRAC_PI_2 - self.taper - self.bottom_angle;
        self.bottom_arc_length_mm() + self.corner_radius * turn
    }

    /// Returns the length along the meridian from the tip to a height above it, mm. At the height of a flat
    /// bottom this is the length to the bottom's outer edge.
    pub fn arc_length_at_height_mm(&self, z: f64) -> f64 {
        if z >= self.flank_start[1] {
            return self.flank_start_arc_length_mm()
                + (z.min(self.height) - self.flank_start[1]) / self.taper_sin_cos[1];
        }
        let bottom_height = self.bottom_radius * self.bottom_tan;
        if z < bottom_height {
            return z.max(0.0) / self.bottom_sin_cos[0];
        }
        self.bottom_arc_length_mm()
            + self.corner_radius * (self.normal_angle_at_height_rad(z) - self.bottom_angle).max(0.0)
    }

    /// Returns the point at a length along the meridian from the tip.
    pub fn point_at_arc_length(&self, length: f64) -> MeridianPoint {
        let bottom = self.bottom_arc_length_mm();
        if length < bottom {
            let [sin, cos] = self.bottom_sin_cos;
            return MeridianPoint { r: length * cos, z: length * sin, psi: self.bottom_angle };
        }
        let flank = self.flank_start_arc_length_mm();
        if length < flank {
            // On the arc the normal turns by length / corner radius, and the point is centre + rc (sin psi,
            // -cos psi).
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
            r: self.flank_start[0] + up * self.taper_sin_cos[0],
            z: self.flank_start[1] + up * self.taper_sin_cos[1],
            psi: FRAC_PI_2 - self.taper,
        }
    }
}
