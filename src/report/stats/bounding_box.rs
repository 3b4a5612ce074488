//! This module computes boxes around paths.

use crate::program::geometry::{CircularArc, MotionPath};
use crate::program::motion::Motion;
use nalgebra::Point3;
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// The largest number of turns of a helix that are examined. Its extremes are in the first and the last turn,
/// and a file may state any number.
const MOST_TURNS: f64 = 1000.0;

/// A box parallel to the axes, in the file's unit until it is converted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MotionBoundingBox {
    /// Lowest x, y, z.
    pub min: [f64; 3],
    /// Highest x, y, z.
    pub max: [f64; 3],
}

impl MotionBoundingBox {
    fn include_point(bounds: &mut Option<Self>, point: &Point3<f64>) {
        let at: [f64; 3] = point.coords.into();
        let bounds = bounds.get_or_insert(Self { min: at, max: at });
        for ((low, high), value) in bounds.min.iter_mut().zip(&mut bounds.max).zip(at) {
            *low = low.min(value);
            *high = high.max(value);
        }
    }

    /// Extends a box by a motion: exact for lines, arcs and helices, by samples for splines.
    pub(super) fn include_motion(bounds: &mut Option<Self>, motion: &Motion) {
        let (from, to) = (motion.from.point, motion.to.point);
        Self::include_point(bounds, &from);
        Self::include_point(bounds, &to);
        match &motion.path {
            MotionPath::Arc(arc) => Self::include_arc(bounds, arc),
            MotionPath::Spline(_) => {
                motion
                    .path
                    .sample_points(from, to)
                    .iter()
                    .for_each(|point| Self::include_point(bounds, point));
            }
            MotionPath::Line | MotionPath::Start => {}
        }
    }

    /// Includes the points of an arc or a helix at which a coordinate is largest or smallest. Along the angle
    /// `a`, a coordinate is a constant plus `u cos a + v sin a + p a`. Its derivative is zero at `a = phi +
    /// asin(p / r)` and `a = phi + pi - asin(p / r)`, with `r = hypot(u, v)` and `phi = atan2(v, u)`.
    fn include_arc(bounds: &mut Option<Self>, arc: &CircularArc) {
        let axis = arc.axis.into_inner();
        let spoke = arc.start - arc.center;
        let u = spoke - axis * axis.dot(&spoke);
        let v = axis.cross(&u);
        let pitch = if arc.sweep > 0.0 { axis * (arc.rise / arc.sweep) } else { axis * 0.0 };
        for ((&u, &v), &p) in u.iter().zip(v.iter()).zip(pitch.iter()) {
            let radius = u.hypot(v);
            if radius <= 0.0 || p.abs() > radius {
                continue;
            }
            let (phi, lag) = (v.atan2(u), (p / radius).asin());
            for turn in [phi + lag, phi + PI - lag] {
                let mut angle = turn.rem_euclid(TAU);
                while angle < arc.sweep.min(TAU * MOST_TURNS) {
                    Self::include_point(bounds, &arc.point_at(angle / arc.sweep));
                    angle += TAU;
                }
            }
        }
    }
}
