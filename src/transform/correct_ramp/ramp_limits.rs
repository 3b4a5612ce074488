//! This module holds what an indexable cutter allows (Zhou 2020, eqs. (1) and (2)).

use super::ramp::Ramp;
use super::ramp_kind::RampKind;
use std::fmt;

/// An indexable cutter. It does not cut within `diameter - 2 insert_radius` around its axis.
///
/// ```
/// use clsmith::internals::transform::correct_ramp::ramp_limits::IndexableCutter;
///
/// let face_mill = IndexableCutter { diameter: 50.0, insert_radius: 6.0, insert_height: 5.0 };
/// let limits = face_mill.ramp_limits()?;
/// assert_eq!(limits.shortest_leg, 38.0);
/// assert!((limits.steepest.atan().to_degrees() - 7.5).abs() < 0.01);
/// # Ok::<(), clsmith::internals::transform::correct_ramp::ramp_limits::CutsToCentre>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndexableCutter {
    /// The diameter D, in mm.
    pub diameter: f64,
    /// The radius r of the insert's bottom circle, in mm.
    pub insert_radius: f64,
    /// The cutting height h_ic of the insert, in mm.
    pub insert_height: f64,
}

/// A cutter whose inserts reach its centre or beyond. It cuts everywhere, and the method sets no limit for
/// it.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a cutter of {diameter} mm with inserts of radius {insert_radius} mm cuts up to its centre: D - 2r is not above 0"
)]
pub struct CutsToCentre {
    /// Its diameter, in mm.
    pub diameter: f64,
    /// The radius of its inserts, in mm.
    pub insert_radius: f64,
}

/// The shortest leg and the steepest angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RampLimits {
    /// l_min: the shortest leg across the axis, and the smallest diameter of a helix, in mm.
    pub shortest_leg: f64,
    /// tan a_lim: the tangent of the steepest angle.
    pub steepest: f64,
}

impl IndexableCutter {
    /// Computes the limits l_min = D - 2r and a_lim = atan(h_ic / (D - 2r)).
    ///
    /// # Errors
    /// Returns [`CutsToCentre`] if D - 2r is not a positive number.
    pub fn ramp_limits(&self) -> Result<RampLimits, CutsToCentre> {
        let blind = self.diameter - 2.0 * self.insert_radius;
        if blind.is_nan() || blind <= 1e-9 {
            let Self { diameter, insert_radius, .. } = *self;
            return Err(CutsToCentre { diameter, insert_radius });
        }
        // Eq. (1): a leg has to be so long that the cutting edge passes over what the blind middle has left.
        // Eq. (2): over that length the tool may sink by no more than the height of the insert.
        Ok(RampLimits { shortest_leg: blind, steepest: self.insert_height / blind })
    }
}

impl RampLimits {
    /// Returns the limits within which no pillar under the middle is higher than the inserts clear, wherever the ramp
    /// turns.
    ///
    /// A place is under the middle, a disc as wide as D - 2r, for at most two legs: for the length D - 2r to the turn
    /// and for as much after it. The pillar there is as high as the tool descends on that way, 2 (D - 2r) tan a at most, which
    /// is so where the ramp turns back by 180 degrees.
    pub fn halved_for_turns(self) -> Self {
        Self { steepest: self.steepest / 2.0, ..self }
    }
}

/// The measurements of a ramp.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct RampMeasurement {
    /// The number of legs that descend.
    pub legs: usize,
    /// The shortest leg, or the diameter of a helix, in mm.
    pub shortest_leg_mm: f64,
    /// The steepest angle, in degrees.
    pub steepest_degrees: f64,
    /// How far it descends, in mm.
    pub height_mm: f64,
    /// The length of its path, in mm.
    pub length_mm: f64,
}

impl RampMeasurement {
    /// Measures a ramp.
    pub fn measure_ramp(ramp: &Ramp) -> Self {
        let legs = ramp.descending_legs();
        let (count, shortest) = match RampKind::classify_ramp(ramp) {
            RampKind::Helix(helix) => (1, 2.0 * helix.radius),
            _ => (legs.len(), legs.iter().map(|leg| leg.extent).fold(f64::INFINITY, f64::min)),
        };
        Self {
            legs: count,
            shortest_leg_mm: if shortest.is_finite() { shortest } else { 0.0 },
            steepest_degrees: ramp.steepest_slope().atan().to_degrees(),
            height_mm: ramp.height_mm(),
            length_mm: ramp.length_mm(),
        }
    }
}

/// Returns whether a ramp keeps the limits. `rounding` (mm) is how far printed coordinates may be off. A leg
/// may be shorter by that, and a step deeper, because no file can state it better.
pub fn is_within_limits(ramp: &Ramp, limits: &RampLimits, rounding: f64) -> bool {
    is_long_enough(ramp, limits, rounding) && is_shallow_enough(ramp, limits, rounding)
}

/// Returns whether every leg is long enough.
pub fn is_long_enough(ramp: &Ramp, limits: &RampLimits, rounding: f64) -> bool {
    let least = limits.shortest_leg - rounding - 1e-9;
    match RampKind::classify_ramp(ramp) {
        // A helix has no turning points. Its diameter takes the place of a leg, or every one of its short
        // chords would be too short.
        RampKind::Helix(helix) => 2.0 * helix.radius >= least,
        _ => ramp.descending_legs().iter().all(|leg| leg.extent >= least),
    }
}

/// Returns whether no step is too steep.
pub fn is_shallow_enough(ramp: &Ramp, limits: &RampLimits, rounding: f64) -> bool {
    ramp.steps_with_starts().all(|(from, step)| {
        // Heights are compared, not slopes: on a short chord the rounding of two printed heights alone would
        // look steep.
        let most = limits.steepest * step.length_across_mm(from);
        from.z - step.to.z <= most * (1.0 + 1e-9) + rounding + 1e-9
    })
}

impl fmt::Display for RampLimits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "legs of at least {:.3} mm and at most {:.2} degrees",
            self.shortest_leg,
            self.steepest.atan().to_degrees()
        )
    }
}
