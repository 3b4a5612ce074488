//! This module divides a piece into legs: parts on which the axis turns so little that the sweep's surface
//! over a column has only one minimum in time.

use super::column_line::ColumnLine;
use super::revolved_solid::RevolvedSolid;
use nalgebra::Vector3;

/// A pose of the cutter; heights count from the grid's base.
#[derive(Debug, Clone, Copy)]
pub(super) struct GridPose {
    pub tip: Vector3<f64>,
    pub axis: Vector3<f64>,
}

/// The end of the interval in which a column is inside the cutter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SolidSpanEnd {
    Lower,
    Upper,
}

/// The cutter over a column at one time. For the upper end the sign of the value is reversed, so that a lower
/// value always means that more is cut.
#[derive(Debug, Clone, Copy)]
pub(super) struct SolidColumnSample {
    pub value: f64,
    /// The change of the value per leg.
    pub slope: f64,
    /// The height of the other end.
    pub other: f64,
}

/// A part of a piece; its own time runs from 0 to 1.
#[derive(Debug, Clone)]
pub(super) struct SweepLeg {
    pub from: GridPose,
    pub to: GridPose,
    /// The tip's displacement, and the turn of the axis as a rotation vector.
    pub travel: Vector3<f64>,
    pub spin: Vector3<f64>,
    /// The angle of the turn in radians, and the direction in which the axis starts to move.
    pub angle: f64,
    toward: Vector3<f64>,
}

/// The motion of the whole piece.
#[derive(Debug, Clone)]
pub(super) struct TurningMotion {
    from: GridPose,
    travel: Vector3<f64>,
    toward: Vector3<f64>,
    /// The angle between the two axes, radians.
    pub angle: f64,
}

impl TurningMotion {
    /// Makes the motion on which the tip moves straight and the axis along the great circle. Between opposite
    /// axes the great circle is not unique, and any of them is taken.
    pub(super) fn new(from: GridPose, to: GridPose) -> Self {
        let cross = from.axis.cross(&to.axis);
        let cos = from.axis.dot(&to.axis);
        let angle = cross.norm().atan2(cos);
        let aside = to.axis - from.axis * cos;
        let (angle, toward) = match () {
            () if angle < 1e-9 => (0.0, Vector3::zeros()),
            () if aside.norm() > 1e-9 => (angle, aside.normalize()),
            () => (angle, unit_vector_across(&from.axis)),
        };
        Self { from, travel: to.tip - from.tip, toward, angle }
    }

    /// Returns the pose at the start.
    pub(super) fn start(&self) -> GridPose {
        self.from
    }

    /// Returns the tip's displacement, mm.
    pub(super) fn travel(&self) -> Vector3<f64> {
        self.travel
    }

    /// Returns the turn of the axis as a rotation vector, radians.
    pub(super) fn spin(&self) -> Vector3<f64> {
        self.from.axis.cross(&self.toward) * self.angle
    }

    /// Divides the motion in equal legs.
    pub(super) fn split_legs(&self, count: usize) -> Vec<SweepLeg> {
        let part = 1.0 / count as f64;
        let at = |share: f64| {
            // Slerp, written with the direction of the turn: a(t) = a cos(t angle) + d sin(t angle).
            let (sin, cos) = (self.angle * share).sin_cos();
            let axis = self.from.axis * cos + self.toward * sin;
            (
                GridPose { tip: self.from.tip + self.travel * share, axis },
                self.toward * cos - self.from.axis * sin,
            )
        };
        (0..count)
            .map(|index| {
                let (from, toward) = at(index as f64 * part);
                let (to, _) = at((index + 1) as f64 * part);
                let angle = self.angle * part;
                // The rotation vector is the axis cross the direction in which it moves, times the angle.
                let spin = from.axis.cross(&toward) * angle;
                SweepLeg { from, to, travel: self.travel * part, spin, angle, toward }
            })
            .collect()
    }
}

/// Returns the sine and cosine of an angle. Most legs turn by a small angle, for which series are exact to
/// 1e-12.
#[inline]
fn small_sin_cos(angle: f64) -> (f64, f64) {
    if angle > 0.05 {
        return angle.sin_cos();
    }
    let square = angle * angle;
    let sin = angle * (1.0 - square / 6.0 * (1.0 - square / 20.0));
    (sin, 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0)))
}

/// Returns a unit vector across an axis, as near to x as possible, or near to y for an axis along x.
pub(super) fn unit_vector_across(axis: &Vector3<f64>) -> Vector3<f64> {
    let along = if axis.x.abs() < 1.0 - 1e-6 { Vector3::x() } else { Vector3::y() };
    (along - axis * along.dot(axis)).normalize()
}

impl SweepLeg {
    /// Returns the pose at a time of the leg.
    #[inline]
    pub(super) fn pose_at(&self, at: f64) -> GridPose {
        if at <= 0.0 {
            return self.from;
        }
        if at >= 1.0 {
            return self.to;
        }
        let tip = self.from.tip + self.travel * at;
        if self.angle == 0.0 {
            return GridPose { tip, axis: self.from.axis };
        }
        let (sin, cos) = small_sin_cos(self.angle * at);
        GridPose { tip, axis: self.from.axis * cos + self.toward * sin }
    }

    /// Returns the velocity (displacement per leg) of a point of the cutter, which is given from the tip.
    #[inline]
    pub(super) fn velocity_of(&self, from_tip: &Vector3<f64>) -> Vector3<f64> {
        if self.angle == 0.0 { self.travel } else { self.travel + self.spin.cross(from_tip) }
    }

    /// Returns the cutter over a column at a time of the leg, or `None` if it is not over the column.
    #[inline]
    pub(super) fn sample_column(
        &self,
        solid: &RevolvedSolid,
        [x, y]: [f64; 2],
        side: SolidSpanEnd,
        at: f64,
    ) -> Option<SolidColumnSample> {
        let GridPose { tip, axis } = self.pose_at(at);
        let (x, y) = (x - tip.x, y - tip.y);
        let [low, high] = solid.intersect_line(&ColumnLine::new([x, y], [axis.x, axis.y, axis.z]))?;
        let (s, sign) = if side == SolidSpanEnd::Lower { (low, 1.0) } else { (high, -1.0) };
        let here = Vector3::new(x, y, s);
        let (normal, _) = normal_and_distance(solid, &here, &axis);
        // The normal points down on the lower surface and up on the upper one; where the two meet the surface
        // is vertical.
        let up = (-sign * normal.z).max(1e-9) * -sign;
        // The surface point over the column moves along z at v.n / n_z.
        let slope = sign * self.velocity_of(&here).dot(&normal) / up;
        let [value, other] = if side == SolidSpanEnd::Lower { [low, high] } else { [high, low] };
        Some(SolidColumnSample { value: sign * (tip.z + value), slope, other: tip.z + other })
    }
}

/// Returns the outward unit normal of the nearest face to a point given from the tip, and the distance of the
/// point outside of it.
#[inline]
pub(super) fn normal_and_distance(
    solid: &RevolvedSolid,
    here: &Vector3<f64>,
    axis: &Vector3<f64>,
) -> (Vector3<f64>, f64) {
    let z = here.dot(axis);
    let out = here - axis * z;
    let rho = out.norm();
    let gap = solid.surface_distance(rho, z);
    let radial = if rho > 1e-9 { gap.radial / rho } else { 0.0 };
    (out * radial + axis * gap.axial, gap.gap)
}
