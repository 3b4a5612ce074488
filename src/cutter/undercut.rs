//! This module holds cutters that are narrower above their widest place: dovetails, T-slot cutters and
//! lollipops.
//!
//! Such a cutter is the common part of two convex bodies: one that stands on the tip, and one that hangs upside
//! down from the upper end of the cutting part. The upper one is a meridian too, in a frame whose z points down
//! from that end, so the sweeps of undersides serve both.

use super::meridian::{CutterTop, Meridian, MeridianError};

impl Meridian {
    /// Makes a dovetail: a cutter whose flank narrows upwards by an angle against the axis, in radians. The
    /// other parameters are those of [`Meridian::new`].
    ///
    /// ```
    /// use clsmith::cutter::Meridian;
    ///
    /// // 20 mm at the bottom, narrowing by 45 degrees over 6 mm.
    /// let dovetail = Meridian::dovetail(20.0, 0.0, 45_f64.to_radians(), 0.0, 6.0)?;
    /// let top = dovetail.top().expect("it is narrower above");
    /// assert!((top.profile.height_at_radius_mm(7.0) - 3.0).abs() < 1e-9);
    /// // It would end in a point below its upper end.
    /// assert!(Meridian::dovetail(20.0, 0.0, 45_f64.to_radians(), 0.0, 11.0).is_err());
    /// # Ok::<(), clsmith::cutter::MeridianError>(())
    /// ```
    ///
    /// # Errors
    /// Returns a [`MeridianError`] if the numbers do not fit together.
    pub fn dovetail(
        diameter_mm: f64,
        corner_radius_mm: f64,
        narrowing_rad: f64,
        tip_rad: f64,
        flute_length_mm: f64,
    ) -> Result<Self, MeridianError> {
        if !(narrowing_rad > 0.0 && narrowing_rad < std::f64::consts::FRAC_PI_2 - 1e-3) {
            return Err(MeridianError::Angle);
        }
        let (radius, corner) = (diameter_mm / 2.0, corner_radius_mm);
        let narrow = radius - flute_length_mm * narrowing_rad.tan();
        if narrow.is_nan() || narrow <= 0.0 {
            return Err(MeridianError::Narrow);
        }
        // The corner's arc touches the bottom and the flank. Its centre is one corner radius away from both:
        // the formula of `Meridian::new` with a taper below 0.
        let (sin, cos) = (-narrowing_rad).sin_cos();
        let (tan_tip, cos_tip) = (tip_rad.tan(), tip_rad.cos());
        let center =
            (radius * cos - radius * tan_tip * sin - corner + corner * sin / cos_tip) / (cos - tan_tip * sin);
        if center < 0.0 {
            return Err(MeridianError::Corner);
        }
        // Below, the cutter is one with an upright flank that goes through the widest place of the arc.
        let below = Self::new(2.0 * (center + corner), corner, 0.0, tip_rad, flute_length_mm)?;
        let profile = Self::new(2.0 * narrow, 0.0, narrowing_rad, 0.0, flute_length_mm)?;
        Ok(below.with_top(CutterTop { profile, height_mm: flute_length_mm }))
    }

    /// Returns the cutter with a rounded upper edge: a T-slot cutter, or a lollipop if the radius is half the
    /// diameter of a ball, whose neck then begins at the upper end of the flutes.
    ///
    /// # Errors
    /// Returns a [`MeridianError`] if the radius does not fit, or if the cutter has a taper.
    pub fn with_upper_corner(self, upper_radius_mm: f64) -> Result<Self, MeridianError> {
        if self.taper_rad() != 0.0 || self.top().is_some() {
            return Err(MeridianError::Angle);
        }
        let radius = self.radius_mm();
        let ball =
            (radius - upper_radius_mm).abs() <= 1e-6 && (radius - self.corner_radius_mm()).abs() <= 1e-6;
        // The neck of a lollipop cuts off the upper end of its ball.
        let height_mm = if ball { 2.0 * radius } else { self.height_mm() };
        let widest = self.flank_start()[1];
        if self.height_mm() > height_mm + 1e-6 || widest + upper_radius_mm > height_mm + 1e-6 {
            return Err(MeridianError::Height);
        }
        let profile = Self::new(2.0 * radius, upper_radius_mm, 0.0, 0.0, height_mm)?;
        Ok(self.with_top(CutterTop { profile, height_mm }))
    }
}
