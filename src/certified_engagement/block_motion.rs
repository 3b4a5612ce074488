//! This module holds the motions of a program as certified engagement takes them.

use super::cutter_pose::{CutterPose, TipArc};
use nalgebra::{Rotation3, Unit};

/// One motion of a program: from pose to pose on a line, or with the tip on an arc. The axis turns at a
/// constant rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockMotion {
    /// The pose at the start. The axis is made a unit vector.
    pub from: CutterPose,
    /// The pose at the end.
    pub to: CutterPose,
    /// The arc or helix of the tip, if it is not a line.
    pub arc: Option<TipArc>,
    /// The number of the cutter.
    pub cutter: usize,
}

impl BlockMotion {
    /// Returns the pose at a time from 0 to 1.
    pub(crate) fn pose_at(&self, time: f64) -> CutterPose {
        let turn = self.from.axis.angle(&self.to.axis);
        pose_at(&self.from, &self.to, self.arc.as_ref(), turn, time)
    }
}

/// How blocks are divided in steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimits {
    /// The largest angle by which an axis turns on a step, radians.
    pub most_turn_rad: f64,
    /// The largest distance of an arc from its chord, mm.
    pub most_sagitta_mm: f64,
}

impl Default for StepLimits {
    fn default() -> Self {
        Self { most_turn_rad: 0.005, most_sagitta_mm: 2e-4 }
    }
}

/// The reason why a program cannot be certified.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum CertifiedProgramError {
    /// There is no stock.
    NoStock,
    /// A number is not finite, or beyond a kilometre.
    NotFinite,
    /// An axis has no direction, or turns by half a turn in one block.
    Axis,
    /// An arc has no axis, or misses its end by more than a hundredth of a millimetre.
    Arc,
    /// A block names a cutter that does not exist.
    Cutter,
}

/// Coordinates beyond this (mm) are refused.
pub(super) const FARTHEST_MM: f64 = 1e6;

pub(super) fn normalized(pose: &CutterPose) -> Result<CutterPose, CertifiedProgramError> {
    // The largest of absolute values would pass over a NaN.
    let is_known = |part: &f64| part.abs() <= FARTHEST_MM;
    if !pose.tip.iter().all(is_known) || !pose.axis.iter().all(is_known) {
        return Err(CertifiedProgramError::NotFinite);
    }
    let axis = pose.axis.try_normalize(1e-9).ok_or(CertifiedProgramError::Axis)?;
    Ok(CutterPose { tip: pose.tip, axis })
}

/// Returns the pose at a share of a motion.
pub(super) fn pose_at(
    from: &CutterPose,
    to: &CutterPose,
    arc: Option<&TipArc>,
    turn: f64,
    share: f64,
) -> CutterPose {
    if share <= 0.0 {
        return *from;
    }
    if share >= 1.0 {
        return *to;
    }
    let straight = from.tip + (to.tip - from.tip) * share;
    let tip = arc.map_or(straight, |arc| {
        // What the arc misses its end by is spread evenly; files round the ends of arcs.
        let rise = arc.normal * (to.tip - from.tip).dot(&arc.normal);
        let slip = to.tip - (arc.turned(from.tip, 1.0) + rise);
        arc.turned(from.tip, share) + (rise + slip) * share
    });
    let axis = match from.axis.cross(&to.axis).try_normalize(1e-12) {
        Some(axis) if turn > 1e-10 => {
            Rotation3::from_axis_angle(&Unit::new_unchecked(axis), turn * share) * from.axis
        }
        _ => from.axis,
    };
    CutterPose { tip, axis }
}
