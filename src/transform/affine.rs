//! This module holds rigid transforms with or without a mirror. They say what `move_origin` does to points,
//! vectors and the axes of arcs.

use nalgebra::{Matrix3, Point3, Unit, Vector3};

/// Vectors that differ by less than this are equal. It is far below the last decimal that any dialect prints
/// of an axis.
const SAME_VECTOR: f64 = 1e-9;

/// A transform `p -> linear * p + offset`, where `linear` rotates or mirrors but never scales.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Affine {
    /// The rotation, or the rotation and mirror.
    pub linear: Matrix3<f64>,
    /// The displacement that is added after it.
    pub offset: Vector3<f64>,
}

impl Affine {
    /// Makes the transform that moves nothing.
    pub(crate) fn identity() -> Self {
        Self { linear: Matrix3::identity(), offset: Vector3::zeros() }
    }

    /// Makes the transform that displaces every point by the same vector.
    pub(crate) fn translation(offset: Vector3<f64>) -> Self {
        Self { linear: Matrix3::identity(), offset }
    }

    /// Makes a right-handed rotation about an axis through a point. Rotations by quarter turns about x, y or
    /// z are exact: their matrix holds only 0, 1 and -1.
    pub(crate) fn rotation(axis: Unit<Vector3<f64>>, degrees: f64, about: Vector3<f64>) -> Self {
        let (sine, cosine) = exact_sine_cosine(degrees);
        let outer = axis.into_inner() * axis.transpose();
        let linear = Matrix3::identity() * cosine + axis.cross_matrix() * sine + outer * (1.0 - cosine);
        Self { linear, offset: about - linear * about }
    }

    /// Makes a mirror in the plane through a point.
    pub(crate) fn mirror(normal: Unit<Vector3<f64>>, through: Vector3<f64>) -> Self {
        let linear = Matrix3::identity() - normal.into_inner() * normal.transpose() * 2.0;
        Self { linear, offset: through - linear * through }
    }

    /// Returns the transform that does this one first and `next` after it.
    #[must_use]
    pub(crate) fn then(self, next: Self) -> Self {
        Self { linear: next.linear * self.linear, offset: next.linear * self.offset + next.offset }
    }

    /// Transforms a point.
    pub(crate) fn transform_point(&self, point: Point3<f64>) -> Point3<f64> {
        Point3::from(self.linear * point.coords + self.offset)
    }

    /// Transforms a displacement or a direction. These are rotated and mirrored, but not moved by the offset.
    pub(crate) fn transform_vector(&self, vector: Vector3<f64>) -> Vector3<f64> {
        self.linear * vector
    }

    /// Transforms the axis of an arc. The axis is a pseudo-vector: a mirror reverses it, because it reverses
    /// the sense in which the arc runs.
    pub(crate) fn transform_arc_axis(&self, axis: Vector3<f64>) -> Vector3<f64> {
        let turned = self.linear * axis;
        if self.has_mirror() { -turned } else { turned }
    }

    /// Returns whether the transform swaps left and right.
    pub(crate) fn has_mirror(&self) -> bool {
        self.linear.determinant() < 0.0
    }

    /// Returns whether the transform changes any direction.
    pub(crate) fn changes_directions(&self) -> bool {
        self.linear != Matrix3::identity()
    }

    /// Returns whether the transform changes nothing at all.
    pub(crate) fn is_identity(&self) -> bool {
        *self == Self::identity()
    }

    /// Returns whether the transform leaves a direction unchanged.
    pub(crate) fn keeps_direction(&self, direction: Vector3<f64>) -> bool {
        is_same_vector(self.transform_vector(direction), direction)
    }
}

/// Returns whether two vectors are equal up to rounding errors.
pub(crate) fn is_same_vector(a: Vector3<f64>, b: Vector3<f64>) -> bool {
    (a - b).norm() <= SAME_VECTOR
}

/// Returns the sine and cosine of an angle. Quarter turns are exact, where `f64::sin_cos` would leave 6e-17.
fn exact_sine_cosine(degrees: f64) -> (f64, f64) {
    let turn = degrees.rem_euclid(360.0);
    if turn == 0.0 {
        (0.0, 1.0)
    } else if turn == 90.0 {
        (1.0, 0.0)
    } else if turn == 180.0 {
        (0.0, -1.0)
    } else if turn == 270.0 {
        (-1.0, 0.0)
    } else {
        turn.to_radians().sin_cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarter_turns_are_exact() {
        let turn = Affine::rotation(Vector3::z_axis(), -270.0, Vector3::new(1.0, 0.0, 0.0));
        assert_eq!(turn.transform_point(Point3::new(3.0, 0.0, 7.0)), Point3::new(1.0, 2.0, 7.0));
        assert_eq!(Affine::rotation(Vector3::x_axis(), 360.0, Vector3::zeros()), Affine::identity());
    }

    #[test]
    fn a_mirror_turns_the_axis_of_an_arc_in_its_plane_over_and_keeps_the_normal() {
        let mirror = Affine::mirror(Vector3::x_axis(), Vector3::zeros());
        assert!(mirror.has_mirror());
        assert_eq!(mirror.transform_arc_axis(Vector3::z()), -Vector3::z());
        assert_eq!(mirror.transform_arc_axis(Vector3::x()), Vector3::x());
        assert_eq!(mirror.transform_vector(Vector3::z()), Vector3::z());
    }
}
