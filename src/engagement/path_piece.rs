//! This module holds a straight piece of a cutter's path.

use crate::program::geometry::Pose;

/// Tips that are closer together than this (mm) count as standing still. It is below the resolution of any
/// file.
pub(super) const STILL: f64 = 1e-7;

/// A straight piece of the path. Between its ends the tip moves on a straight line, and the axis turns at a
/// constant rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPiece {
    /// The pose at the start.
    pub from: Pose,
    /// The pose at the end.
    pub to: Pose,
    /// The cutter's index in the list that is given to [`super::Simulation::sweep_pieces`].
    pub cutter: usize,
}

impl PathPiece {
    /// Returns the length of path that advance ratios refer to, mm: the tip's path or, if the tip stands
    /// still, the path of the outermost point of flutes with a radius and a length.
    pub(super) fn reference_length_mm(&self, [radius, flutes]: [f64; 2]) -> f64 {
        let travel = (self.to.point - self.from.point).norm();
        if travel > STILL {
            return travel;
        }
        let angle = self.from.axis.cross(&self.to.axis).norm().atan2(self.from.axis.dot(&self.to.axis));
        angle * radius.hypot(flutes)
    }
}
