//! This module holds the vertical plane of a profile in space.

use super::chain_piece::Point;
use nalgebra::{Point3, Vector3};

/// A plane along the tool axis. From `origin`, u counts along a horizontal direction and z along the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePlane {
    origin: Point3<f64>,
    along: Vector3<f64>,
    up: Vector3<f64>,
}

impl ProfilePlane {
    /// Makes the plane through `origin` along `direction` and `up` (the tool axis), which may have any
    /// length. If the direction is not perpendicular to the axis, its perpendicular part counts. Returns
    /// `None` if they are parallel or have no length.
    pub fn new(origin: Point3<f64>, direction: Vector3<f64>, up: Vector3<f64>) -> Option<Self> {
        let up = up.try_normalize(0.0)?;
        let direction = direction.try_normalize(0.0)?;
        // Below a millionth, the perpendicular part is only rounding.
        let along = (direction - up * direction.dot(&up)).try_normalize(1e-6)?;
        Some(Self { origin, along, up })
    }

    /// Converts a point of space to the plane's coordinates; the part across the plane is ignored.
    pub fn to_plane(&self, point: Point3<f64>) -> Point {
        let from = point - self.origin;
        Point::new(from.dot(&self.along), from.dot(&self.up))
    }

    /// Returns the distance of a point of space from the plane, mm. It is positive to the left if u points
    /// ahead and z up.
    pub fn signed_distance_mm(&self, point: Point3<f64>) -> f64 {
        (point - self.origin).dot(&self.up.cross(&self.along))
    }

    /// Converts a point of the plane to space.
    pub fn to_space(&self, point: Point) -> Point3<f64> {
        self.origin + self.along * point.u + self.up * point.z
    }
}
