//! The reasons why what is around a pass cannot go with it.

/// Why what is around a pass cannot go with it; the motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LeadConflict {
    /// The pass begins where a rapid ends.
    Rapid(usize),
    /// The pass goes on from, or into, a cut that is not meant.
    Excluded(usize),
    /// The pass begins at a place that is not its operation's to move.
    Fixed(usize),
}
