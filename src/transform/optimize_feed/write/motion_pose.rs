//! This module computes poses along a motion.

use crate::program::geometry::{MotionPath, Pose};
use crate::program::motion::Motion;
use nalgebra::Vector3;

/// Axes that differ by less than this are the same axis.
const SAME_AXIS: f64 = 1e-9;

/// Axes that are nearer to opposite than this angle (radians) have no definite axis of rotation.
const OPPOSITE: f64 = 1e-3;

/// Returns the pose at a fraction (0..=1) of the length of a line or an arc. The tool axis turns evenly.
/// Returns `None` on other paths, and if the axis is reversed.
pub(super) fn interpolate_pose(motion: &Motion, fraction: f64) -> Option<Pose> {
    let point = match &motion.path {
        MotionPath::Line => motion.from.point + (motion.to.point - motion.from.point) * fraction,
        MotionPath::Arc(arc) => arc.point_at(fraction),
        MotionPath::Spline(_) | MotionPath::Start => return None,
    };
    Some(Pose { point, axis: interpolate_axis(motion.from.axis, motion.to.axis, fraction)? })
}

/// Returns whether the tool axis turns during a motion.
pub(super) fn has_turning_axis(motion: &Motion) -> bool {
    (motion.to.axis - motion.from.axis).amax() > SAME_AXIS
}

fn interpolate_axis(from: Vector3<f64>, to: Vector3<f64>, fraction: f64) -> Option<Vector3<f64>> {
    if (to - from).amax() <= SAME_AXIS {
        return Some(to);
    }
    let angle = from.cross(&to).norm().atan2(from.dot(&to));
    if std::f64::consts::PI - angle < OPPOSITE {
        return None;
    }
    let sine = angle.sin();
    let turned = from * (((1.0 - fraction) * angle).sin() / sine) + to * ((fraction * angle).sin() / sine);
    turned.try_normalize(0.5)
}
