//! The vertical plane of a profile, in space.

use super::chain_piece::Point;
use nalgebra::{Point3, Vector3};

/// A plane along the tool axis: u counts from `origin` along a horizontal direction, z from `origin` along the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfilePlane {
    origin: Point3<f64>,
    along: Vector3<f64>,
    up: Vector3<f64>,
}

impl ProfilePlane {
    /// The plane through `origin` along `direction` and `up` (the tool axis), both of any length. `None` when they are parallel or have
    /// no length; of a direction that is not square to the axis, the square part counts.
    pub fn new(origin: Point3<f64>, direction: Vector3<f64>, up: Vector3<f64>) -> Option<Self> {
        let up = up.try_normalize(0.0)?;
        let direction = direction.try_normalize(0.0)?;
        // Below a microradian the direction is only rounding.
        let along = (direction - up * direction.dot(&up)).try_normalize(1e-6)?;
        Some(Self { origin, along, up })
    }

    /// A point of space, seen in the plane.
    pub fn to_plane(&self, point: Point3<f64>) -> Point {
        let from = point - self.origin;
        Point::new(from.dot(&self.along), from.dot(&self.up))
    }

    /// How far a point of space lies off the plane, mm; positive to the left when looking along u with z up.
    pub fn signed_distance_mm(&self, point: Point3<f64>) -> f64 {
        (point - self.origin).dot(&self.up.cross(&self.along))
    }

    /// A point of the plane, in space.
    pub fn to_space(&self, point: Point) -> Point3<f64> {
        self.origin + self.along * point.u + self.up * point.z
    }
}
