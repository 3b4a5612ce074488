//! This module holds a straight piece of a cutter's path, and how an axis turns on it.

use crate::program::geometry::Pose;
use nalgebra::Vector3;

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

    /// Returns the part of the piece between two shares of it.
    pub(crate) fn part_between(&self, shares: [f64; 2]) -> Self {
        let turn = self.from.axis.angle(&self.to.axis);
        let [from, to] = shares.map(|share| match share {
            0.0 => self.from,
            1.0 => self.to,
            _ => Pose {
                point: self.from.point + (self.to.point - self.from.point) * share,
                axis: slerp_axis(&self.from.axis, &self.to.axis, turn, share),
            },
        });
        Self { from, to, cutter: self.cutter }
    }
}

/// Interpolates between two unit axes that are `turn` radians apart, along the great circle (slerp).
pub(super) fn slerp_axis(from: &Vector3<f64>, to: &Vector3<f64>, turn: f64, share: f64) -> Vector3<f64> {
    if share <= 0.0 || turn == 0.0 {
        return *from;
    }
    if share >= 1.0 {
        return *to;
    }
    if turn < 1e-9 {
        return from.lerp(to, share);
    }
    (from * ((1.0 - share) * turn).sin() + to * (share * turn).sin()) / turn.sin()
}
