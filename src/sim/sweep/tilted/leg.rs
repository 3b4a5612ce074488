//! A leg: a stretch of a piece on which the axis turns so little that the sweep's surface over a column has one valley.

use super::column_line::ColumnLine;
use super::revolved_solid::RevolvedSolid;
use nalgebra::Vector3;

/// A place of the cutter, heights from the grid's base.
#[derive(Debug, Clone, Copy)]
pub(super) struct GridPose {
    pub tip: Vector3<f64>,
    pub axis: Vector3<f64>,
}

/// Which end of the solid's interval in a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SolidSpanEnd {
    Lower,
    Upper,
}

/// The solid over a column at one time. For the upper side heights are turned round, so that low is always far.
#[derive(Debug, Clone, Copy)]
pub(super) struct SolidColumnSample {
    pub value: f64,
    /// Change of the value over the leg.
    pub slope: f64,
    /// Height of the other end.
    pub other: f64,
}

/// A stretch of a piece; its own time runs from 0 to 1.
#[derive(Debug, Clone)]
pub(super) struct SweepLeg {
    pub from: GridPose,
    pub to: GridPose,
    /// The tip's way, and the turn as a vector.
    pub travel: Vector3<f64>,
    pub spin: Vector3<f64>,
    /// Angle of the turn, and the direction into which the axis leaves.
    pub angle: f64,
    toward: Vector3<f64>,
}

/// The whole piece's motion.
#[derive(Debug, Clone)]
pub(super) struct TurningMotion {
    from: GridPose,
    travel: Vector3<f64>,
    toward: Vector3<f64>,
    /// Angle between the two axes.
    pub angle: f64,
}

impl TurningMotion {
    /// Tip straight, axis along the great circle; opposite axes turn through some direction across.
    pub fn new(from: GridPose, to: GridPose) -> Self {
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

    /// The motion in equal legs.
    pub fn split_legs(&self, count: usize) -> Vec<SweepLeg> {
        let part = 1.0 / count as f64;
        let at = |share: f64| {
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
                let spin = from.axis.cross(&toward) * angle;
                SweepLeg { from, to, travel: self.travel * part, spin, angle, toward }
            })
            .collect()
    }
}

/// Sine and cosine; of the small angles of most legs by their series, to 1e-12.
#[inline]
fn small_sin_cos(angle: f64) -> (f64, f64) {
    if angle > 0.05 {
        return angle.sin_cos();
    }
    let square = angle * angle;
    let sin = angle * (1.0 - square / 6.0 * (1.0 - square / 20.0));
    (sin, 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0)))
}

/// A unit vector across an axis: along x as far as it can be, else along y.
pub(super) fn unit_vector_across(axis: &Vector3<f64>) -> Vector3<f64> {
    let along = if axis.x.abs() < 1.0 - 1e-6 { Vector3::x() } else { Vector3::y() };
    (along - axis * along.dot(axis)).normalize()
}

impl SweepLeg {
    /// The pose at a time.
    #[inline]
    pub fn pose_at(&self, at: f64) -> GridPose {
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

    /// Velocity of a point of the cutter, given from the tip.
    #[inline]
    pub fn velocity_of(&self, from_tip: &Vector3<f64>) -> Vector3<f64> {
        if self.angle == 0.0 { self.travel } else { self.travel + self.spin.cross(from_tip) }
    }

    /// The solid over a column at a time.
    #[inline]
    pub fn sample_column(
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
        // The lower surface looks down, the upper up; where they meet the surface is vertical.
        let up = (-sign * normal.z).max(1e-9) * -sign;
        let slope = sign * self.velocity_of(&here).dot(&normal) / up;
        let [value, other] = if side == SolidSpanEnd::Lower { [low, high] } else { [high, low] };
        Some(SolidColumnSample { value: sign * (tip.z + value), slope, other: tip.z + other })
    }
}

/// The outward unit normal of the face next to a point given from the tip, and how far outside the point is.
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
