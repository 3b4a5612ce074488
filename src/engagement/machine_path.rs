//! This module holds what the simulation asks of a machine: the path on which it takes the tool, where that is not the
//! programmed one.

use super::path_piece::slerp_axis;
use crate::program::geometry::Pose;
use nalgebra::Vector3;
use std::fmt;

/// How far up the tool axis from the tip, in mm, a point is followed as closely as the tip itself.
pub const FOLLOWED_HEIGHT_MM: f64 = 20.0;

/// How often one of the even parts of a motion is halved at most. Of a part of 10 degrees, 0.04 are left then: at a distance
/// r from the axis that is 6e-8 r beside the path (r a²/8), so less than the finest tolerance, 2e-4 mm, up to 3 m.
const HALVINGS: u32 = 8;

/// The path on which a machine takes the tool through a program, where it is not the programmed one.
pub trait MachinePath: fmt::Debug + Send + Sync {
    /// Returns into how many even parts a motion has to be divided, so that no bend of its path is missed. `None` for a
    /// motion that the machine makes as it is programmed.
    fn even_parts(&self, number: usize) -> Option<usize>;

    /// Returns the pose at a share of the time of a motion, from 0 to 1, in the workpiece frame in mm. `None` for a
    /// motion that the machine makes as it is programmed.
    fn pose_at(&self, number: usize, share: f64) -> Option<Pose>;
}

/// Returns the places between which straight pieces are near the path of a machine, each with its share of the motion's time.
/// At the same time, neither the tip nor a point [`FOLLOWED_HEIGHT_MM`] above it is further than `tolerance_mm` from
/// where the machine has it. `None` for a motion that is made as it is programmed.
pub(super) fn follow_machine_path(
    path: &dyn MachinePath,
    number: usize,
    tolerance_mm: f64,
) -> Option<Vec<(f64, Pose)>> {
    let parts = path.even_parts(number)?;
    let mut last = (0.0, path.pose_at(number, 0.0)?);
    let mut places = vec![last];
    let mut follow = PathBisection { path, number, tolerance_mm, places: &mut places };
    for part in 1..=parts {
        let share = part as f64 / parts as f64;
        let next = (share, path.pose_at(number, share)?);
        follow.bisect_part(last, next, HALVINGS)?;
        last = next;
    }
    Some(places)
}

struct PathBisection<'p> {
    path: &'p dyn MachinePath,
    number: usize,
    tolerance_mm: f64,
    places: &'p mut Vec<(f64, Pose)>,
}

impl PathBisection<'_> {
    /// Adds the places after the first of two, the second one included.
    fn bisect_part(&mut self, from: (f64, Pose), to: (f64, Pose), halvings: u32) -> Option<()> {
        let mut is_fine = true;
        for part in [0.25, 0.5, 0.75] {
            let there = self.path.pose_at(self.number, from.0 + (to.0 - from.0) * part)?;
            is_fine &= distance_from_chord_mm(&from.1, &to.1, part, &there) <= self.tolerance_mm;
        }
        if is_fine || halvings == 0 {
            self.places.push(to);
            return Some(());
        }
        let share = (from.0 + to.0) / 2.0;
        let middle = (share, self.path.pose_at(self.number, share)?);
        self.bisect_part(from, middle, halvings - 1)?;
        self.bisect_part(middle, to, halvings - 1)
    }
}

/// Returns the tool axis at a share of the shortest turn between two poses.
pub fn axis_on_shortest_turn(from: &Pose, to: &Pose, share: f64) -> Vector3<f64> {
    slerp_axis(&from.axis, &to.axis, from.axis.angle(&to.axis), share)
}

/// Returns how far a pose is, at the tip or [`FOLLOWED_HEIGHT_MM`] above it, from that at a share of a straight piece.
pub fn distance_from_chord_mm(from: &Pose, to: &Pose, share: f64, pose: &Pose) -> f64 {
    let tip = pose.point - (from.point + (to.point - from.point) * share);
    let above = (pose.axis - axis_on_shortest_turn(from, to, share)) * FOLLOWED_HEIGHT_MM;
    tip.norm().max((tip + above).norm())
}
