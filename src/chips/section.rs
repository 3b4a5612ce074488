//! The section of a flat end mill with a layer.

/// A flat end mill. Lengths in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatMill {
    /// Radius.
    pub radius: f64,
    /// Length of the flutes above the tip; infinite where it does not matter.
    pub flutes: f64,
}

/// Why a piece of path cannot be modelled.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// No radius or no flutes, or numbers that are not finite.
    #[error("the tool has no diameter or no flutes")]
    NoCutter,
    /// Both places are the same.
    #[error("the piece has no length and the axis does not turn")]
    Still,
    /// The axis is, or becomes on the way, too nearly parallel to the layers.
    #[error("the axis is {tilt_deg:.1} degrees from upright; beyond {most:.0} degrees a layer's section is no ellipse of use", most = MOST_TILT_DEG)]
    Tilt {
        /// Largest angle between axis and z on the way, degrees.
        tilt_deg: f64,
    },
    /// The axis turns by so much that the way it turns is not determined.
    #[error("the axis turns by {turn_deg:.1} degrees in one piece, so which way it turns is not known")]
    Turn {
        /// How far, degrees.
        turn_deg: f64,
    },
    /// A place that is no place.
    #[error("a coordinate is not finite")]
    NotFinite,
}

/// Largest angle between axis and z, degrees: a section is then nearly six times as long as the cutter is wide.
pub const MOST_TILT_DEG: f64 = 80.0;
