//! This module holds a cutter with everything that a simulation needs to know of it.
//!
//! The shank and the holder do not remove material: where they meet it, the collision is reported and the
//! material stays.

use crate::cutter::{Meridian, Teeth};

/// A cutter: its cutting part, the cylinders above the flutes, and its teeth. Lengths are in mm from the tip
/// up the axis.
///
/// ```
/// use clsmith::cutter::{CutterModel, Meridian, NonCuttingCylinder, NonCuttingKind, Teeth};
///
/// let mill = CutterModel {
///     profile: Meridian::new(10.0, 0.5, 0.0, 0.0, 22.0)?,
///     collars: vec![NonCuttingCylinder {
///         kind: NonCuttingKind::Holder,
///         radius_mm: 20.0,
///         from_mm: 40.0,
///         to_mm: 90.0,
///     }],
///     teeth: Teeth::evenly_spaced(4, 0.6),
/// };
/// assert_eq!((mill.radius_mm(), mill.flute_length_mm()), (5.0, 22.0));
/// # Ok::<(), clsmith::cutter::MeridianError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CutterModel {
    /// The meridian of the cutting part, with the tip at the origin.
    pub profile: Meridian,
    /// The cylinders above the flutes (shank, holder), which must not touch material, from below to above.
    pub collars: Vec<NonCuttingCylinder>,
    /// The teeth, if they are known.
    pub teeth: Option<Teeth>,
}

/// A cylinder around the axis that does not cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NonCuttingCylinder {
    /// The part of the tool that the cylinder stands for.
    pub kind: NonCuttingKind,
    /// The radius in mm.
    pub radius_mm: f64,
    /// The height above the tip at which the cylinder begins, mm.
    pub from_mm: f64,
    /// The height above the tip at which it ends, mm.
    pub to_mm: f64,
}

/// The part of a tool that does not cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum NonCuttingKind {
    /// The tool above its flutes.
    Shank,
    /// The tool holder.
    Holder,
}

impl CutterModel {
    /// Returns the largest radius of the cutting part, mm.
    pub fn radius_mm(&self) -> f64 {
        self.profile.radius_mm()
    }

    /// Returns the distance of the furthest point of the tool, its shank and holder included, from the tip, mm.
    pub fn reach_mm(&self) -> f64 {
        let of_collar = |collar: &NonCuttingCylinder| collar.to_mm.hypot(collar.radius_mm);
        let cutting = self.flute_length_mm().hypot(self.radius_mm());
        self.collars.iter().map(of_collar).fold(cutting, f64::max)
    }

    /// Returns the height of the cutting part above the tip, mm.
    pub fn flute_length_mm(&self) -> f64 {
        self.profile.height_mm()
    }
}
