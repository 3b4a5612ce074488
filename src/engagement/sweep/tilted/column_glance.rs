//! This module tells with one look at a column that a whole piece takes nothing from it: most columns under a cutter
//! were cleared by the pieces before.

use super::leg::{GridPose, TurningMotion, normal_and_distance};
use super::revolved_solid::RevolvedSolid;
use nalgebra::Vector3;

/// The motion of a piece as a look at its start sees it.
///
/// A point P that stands still moves in the cutter's frame on `p(t) = R(t)' (P - tip - t u)`, with the tip's travel u and
/// the rotation R(t) about w. The cutter's gap is convex, so that it stays above its tangent plane at t = 0. What the
/// way of p bends is told by its second derivative `w x (w x p) + 2 w x u`, and what is left of third order is at most
/// `(|w|³ |p| + 3 |w|² |u|) / 6`.
#[derive(Debug, Clone)]
pub(super) struct ColumnGlance {
    from: GridPose,
    travel: Vector3<f64>,
    spin: Vector3<f64>,
    /// Twice the rotation vector times the travel.
    swerve: Vector3<f64>,
    turn: f64,
    way: f64,
}

impl ColumnGlance {
    /// Makes the glance of a motion.
    pub(super) fn new(motion: &TurningMotion) -> Self {
        let (travel, spin) = (motion.travel(), motion.spin());
        Self {
            from: motion.start(),
            travel,
            spin,
            swerve: 2.0 * spin.cross(&travel),
            turn: motion.angle,
            way: travel.norm(),
        }
    }

    /// Returns whether the motion surely takes nothing of what is more than `tolerance` mm below a point, straight down
    /// from it. Whether it does is not known otherwise.
    #[inline]
    pub(super) fn surely_misses(&self, solid: &RevolvedSolid, top: Vector3<f64>, tolerance: f64) -> bool {
        let apart = top - self.from.tip;
        let (normal, gap) = normal_and_distance(solid, &apart, &self.from.axis);
        // Deeper points are further away, also after the turn.
        let deeper = -normal.z - self.turn;
        if deeper < 0.0 {
            return false;
        }
        let (mut slope, mut bend, mut rest) = (-normal.dot(&self.travel), 0.0, 0.0);
        if self.turn > 0.0 {
            let swing = self.spin.cross(&apart);
            slope -= normal.dot(&swing);
            bend = normal.dot(&(self.spin.cross(&swing) + self.swerve)) / 2.0;
            let square = self.turn * self.turn;
            rest = square * (self.turn * (apart.norm() + self.way) + 3.0 * self.way) / 6.0;
        }
        // The least of slope t + bend t² for t in [0, 1].
        let mut least = (slope + bend).min(0.0);
        if bend > 0.0 && slope < 0.0 && slope + 2.0 * bend > 0.0 {
            least = -slope * slope / (4.0 * bend);
        }
        gap + least - rest + tolerance * deeper >= 0.0
    }
}
