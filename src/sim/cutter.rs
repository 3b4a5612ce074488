//! A cutter with everything that a simulation asks of it.

use super::{Profile, Teeth};

/// A cutter: its profile, what is above the flutes, and its teeth. Lengths in mm from the tip up the axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Cutter {
    /// The cutting part's meridian, tip at the origin.
    pub profile: Profile,
    /// What stands above the flutes and must not touch material: shank, holder, from below to above.
    pub collars: Vec<Collar>,
    /// Teeth, where they are known.
    pub teeth: Option<Teeth>,
}

/// A cylinder around the axis that does not cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collar {
    /// What it is.
    pub kind: CollarKind,
    /// Radius.
    pub radius: f64,
    /// Height above the tip at which it begins.
    pub from: f64,
    /// Height above the tip at which it ends.
    pub to: f64,
}

/// What a collar is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CollarKind {
    /// The tool above its flutes.
    Shank,
    /// The holder.
    Holder,
}

impl Cutter {
    /// Largest radius of the cutting part.
    pub fn radius(&self) -> f64 {
        self.profile.radius()
    }

    /// Height of the cutting part above the tip.
    pub fn flute_length(&self) -> f64 {
        self.profile.height()
    }
}
