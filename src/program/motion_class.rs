//! This module holds the classes of motions.

use std::fmt;

/// Class of a motion: told by the file where it marks its motions, else found from rapid, axis and direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(
    feature = "simulation",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum MotionClass {
    /// A rapid through the air.
    Rapid,
    /// A move to where the engage starts.
    Approach,
    /// Into the material: lead, ramp, plunge.
    Engage,
    /// Cutting.
    Cut,
    /// From one pass to the next.
    StepOver,
    /// Out of the material.
    Retract,
    /// A move of a drilling cycle.
    Drill,
}

impl MotionClass {
    /// Every class, in the order of a motion's life.
    pub const ALL: [Self; 7] =
        [Self::Rapid, Self::Approach, Self::Engage, Self::Cut, Self::StepOver, Self::Retract, Self::Drill];
}

impl fmt::Display for MotionClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Rapid => "rapid",
            Self::Approach => "approach",
            Self::Engage => "engage",
            Self::Cut => "cut",
            Self::StepOver => "step_over",
            Self::Retract => "retract",
            Self::Drill => "drill",
        })
    }
}
