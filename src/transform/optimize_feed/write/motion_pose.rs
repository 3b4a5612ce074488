//! Poses along a motion.

use crate::program::geometry::{MotionPath, Pose};
use crate::program::motion::Motion;
use nalgebra::Vector3;

/// Axes closer than this are one axis.
const SAME_AXIS: f64 = 1e-9;

/// Axes nearer to opposite than this (radians) turn about no axis that anyone could tell.
const OPPOSITE: f64 = 1e-3;

/// Where the tool is at a fraction (0..=1) of a line's or an arc's length, its axis turning evenly. `None` on other paths, and where the
/// axis turns right over.
pub(super) fn interpolate_pose(motion: &Motion, fraction: f64) -> Option<Pose> {
    let point = match &motion.path {
        MotionPath::Line => motion.from.point + (motion.to.point - motion.from.point) * fraction,
        MotionPath::Arc(arc) => arc.point_at(fraction),
        MotionPath::Spline(_) | MotionPath::Start => return None,
    };
    Some(Pose { point, axis: interpolate_axis(motion.from.axis, motion.to.axis, fraction)? })
}

/// Whether the tool axis turns during a motion.
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
