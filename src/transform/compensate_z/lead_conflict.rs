//! This module names the reasons why motions around a pass cannot follow it.

/// The reason why motions around a pass cannot follow it, with the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LeadConflict {
    /// The pass begins where a rapid ends.
    Rapid(usize),
    /// The pass continues, or leads into, a cut that the step does not mean.
    Excluded(usize),
    /// The pass begins at a point that its operation must not move.
    Fixed(usize),
}
