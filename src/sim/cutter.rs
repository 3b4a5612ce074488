//! A cutter with everything that a simulation asks of it.

use super::{Meridian, Teeth};

/// A cutter: its profile, what is above the flutes, and its teeth. Lengths in mm from the tip up the axis.
#[derive(Debug, Clone, PartialEq)]
pub struct CutterModel {
    /// The cutting part's meridian, tip at the origin.
    pub profile: Meridian,
    /// What stands above the flutes and must not touch material: shank, holder, from below to above.
    pub collars: Vec<NonCuttingCylinder>,
    /// Teeth, where they are known.
    pub teeth: Option<Teeth>,
}

/// A cylinder around the axis that does not cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NonCuttingCylinder {
    /// What it is.
    pub kind: NonCuttingKind,
    /// Radius.
    pub radius: f64,
    /// Height above the tip at which it begins.
    pub from: f64,
    /// Height above the tip at which it ends.
    pub to: f64,
}

/// What a collar is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NonCuttingKind {
    /// The tool above its flutes.
    Shank,
    /// The holder.
    Holder,
}

impl CutterModel {
    /// Largest radius of the cutting part.
    pub fn radius_mm(&self) -> f64 {
        self.profile.radius_mm()
    }

    /// Height of the cutting part above the tip.
    pub fn flute_length_mm(&self) -> f64 {
        self.profile.height_mm()
    }
}
