//! This module holds what the middle of an indexable cutter runs into.

/// Material that stands higher in the middle of an indexable cutter than its inserts clear. The cutter leaves it
/// there itself, as a pillar, or enters it from above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PillarContact {
    /// How high the pillar stands above the tip where it is highest, mm.
    pub height_mm: f64,
    /// How much of that the inserts clear, mm.
    pub clearance_mm: f64,
    /// The top of the pillar in the workpiece frame, mm.
    pub place_mm: [f64; 3],
    /// The volume that the body of the cutter meets on a piece of path, mm3; of several pieces the largest.
    pub volume_mm3: f64,
}

impl PillarContact {
    /// Returns how deep the body of the cutter is pushed into the pillar, mm.
    pub fn depth_mm(&self) -> f64 {
        self.height_mm - self.clearance_mm
    }

    /// Merges what is met in different places of one piece: the deeper contact, with the volume of both. Equally deep ones are
    /// told by the first.
    pub(crate) fn merge_places(one: Option<Self>, other: Option<Self>) -> Option<Self> {
        Self::merge_by(one, other, |one, other| one + other)
    }

    /// Merges what is met on different pieces of path: the deeper contact, with the larger volume. The material stays, so
    /// that pieces may meet the same.
    pub(crate) fn merge_pieces(one: Option<Self>, other: Option<Self>) -> Option<Self> {
        Self::merge_by(one, other, f64::max)
    }

    fn merge_by(one: Option<Self>, other: Option<Self>, volume: fn(f64, f64) -> f64) -> Option<Self> {
        match (one, other) {
            (Some(one), Some(other)) => {
                let volume_mm3 = volume(one.volume_mm3, other.volume_mm3);
                let deeper = if other.depth_mm() > one.depth_mm() { other } else { one };
                Some(Self { volume_mm3, ..deeper })
            }
            (one, other) => one.or(other),
        }
    }
}
