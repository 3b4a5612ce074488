//! What an indexable cutter allows (Zhou 2020, eqs. (1) and (2)).

use super::kind::Kind;
use super::ramp::Ramp;
use std::fmt;

/// An indexable cutter. It does not cut within `diameter - 2 insert_radius` around its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Indexable {
    /// Diameter D, mm.
    pub diameter: f64,
    /// Radius r of the insert's bottom circle, mm.
    pub insert_radius: f64,
    /// Cutting height h_ic of the insert, mm.
    pub insert_height: f64,
}

/// A cutter whose inserts reach to its centre, or beyond: it cuts everywhere, and the method has no limit for it.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "a cutter of {diameter} mm with inserts of radius {insert_radius} mm cuts up to its centre: D - 2r is not above 0"
)]
pub struct CutsToCentre {
    /// Its diameter, mm.
    pub diameter: f64,
    /// Radius of its inserts, mm.
    pub insert_radius: f64,
}

/// Shortest leg and steepest angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// l_min: shortest leg across the axis, and smallest diameter of a helix; mm.
    pub shortest_leg: f64,
    /// tan a_lim: tangent of the steepest angle.
    pub steepest: f64,
}

impl Indexable {
    /// The limits: l_min = D - 2r, a_lim = atan(h_ic / (D - 2r)).
    ///
    /// # Errors
    /// [`CutsToCentre`] when D - 2r is not a positive number.
    pub fn limits(&self) -> Result<Limits, CutsToCentre> {
        let blind = self.diameter - 2.0 * self.insert_radius;
        if blind.is_nan() || blind <= 1e-9 {
            let Self { diameter, insert_radius, .. } = *self;
            return Err(CutsToCentre { diameter, insert_radius });
        }
        Ok(Limits { shortest_leg: blind, steepest: self.insert_height / blind })
    }
}

/// What a ramp measures.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Measured {
    /// How many legs descend.
    pub legs: usize,
    /// Its shortest leg, of a helix its diameter; mm.
    pub shortest_leg_mm: f64,
    /// Its steepest angle, degrees.
    pub steepest_degrees: f64,
    /// How far it descends, mm.
    pub height_mm: f64,
    /// Length of its path, mm.
    pub length_mm: f64,
}

impl Measured {
    /// Measures a ramp.
    pub fn of(ramp: &Ramp) -> Self {
        let legs = ramp.legs();
        let (count, shortest) = match Kind::of(ramp) {
            Kind::Helix(helix) => (1, 2.0 * helix.radius),
            _ => (legs.len(), legs.iter().map(|leg| leg.extent).fold(f64::INFINITY, f64::min)),
        };
        Self {
            legs: count,
            shortest_leg_mm: if shortest.is_finite() { shortest } else { 0.0 },
            steepest_degrees: ramp.steepest().atan().to_degrees(),
            height_mm: ramp.height(),
            length_mm: ramp.length(),
        }
    }
}

/// Whether a ramp keeps the limits. `rounding` (mm) is how far printed coordinates may be off: a leg may be that much shorter, a
/// step that much deeper, since no file can say it better.
pub fn keeps(ramp: &Ramp, limits: &Limits, rounding: f64) -> bool {
    long_enough(ramp, limits, rounding) && shallow_enough(ramp, limits, rounding)
}

/// Whether every leg is long enough.
pub fn long_enough(ramp: &Ramp, limits: &Limits, rounding: f64) -> bool {
    let least = limits.shortest_leg - rounding - 1e-9;
    match Kind::of(ramp) {
        Kind::Helix(helix) => 2.0 * helix.radius >= least,
        _ => ramp.legs().iter().all(|leg| leg.extent >= least),
    }
}

/// Whether no step is too steep.
pub fn shallow_enough(ramp: &Ramp, limits: &Limits, rounding: f64) -> bool {
    ramp.walk().all(|(from, step)| {
        let most = limits.steepest * step.across(from);
        from.z - step.to.z <= most * (1.0 + 1e-9) + rounding + 1e-9
    })
}

impl fmt::Display for Limits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "legs of at least {:.3} mm and at most {:.2} degrees",
            self.shortest_leg,
            self.steepest.atan().to_degrees()
        )
    }
}
