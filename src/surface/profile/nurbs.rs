//! This module holds rational B-splines (NURBS) of any degree.

use super::chain_piece::Point;
use super::parametric_curve::ParametricCurve;
use super::profile_plane::ProfilePlane;
use crate::program::geometry::Spline;

/// A NURBS curve.
#[derive(Debug, Clone, PartialEq)]
pub struct NurbsCurve {
    degree: usize,
    /// The control points with their weights w as (w u, w z, w).
    controls: Vec<[f64; 3]>,
    knots: Vec<f64>,
}

/// The reason why numbers do not make a NURBS curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NurbsError {
    /// There are fewer control points than the degree needs, or the degree is 0.
    #[error("a curve of degree {degree} needs at least {} control points, not {controls}", degree + 1)]
    Controls {
        /// The degree.
        degree: usize,
        /// The number of control points.
        controls: usize,
    },
    /// There are not as many weights as control points.
    #[error("{controls} control points and {weights} weights")]
    Weights {
        /// The number of control points.
        controls: usize,
        /// The number of weights.
        weights: usize,
    },
    /// A weight is not positive; the value is its index.
    #[error("weight {0} is not positive")]
    Weight(usize),
    /// The number of knots is not that of control points + degree + 1.
    #[error("{0} knots: control points + degree + 1 are needed")]
    Knots(usize),
    /// A knot is smaller than the one before, or the range of the parameter has no length.
    #[error("the knots do not ascend")]
    Order,
    /// A number is not finite.
    #[error("a number is not finite")]
    Number,
}

impl NurbsCurve {
    /// Makes the curve of `controls` (mm), their `weights` and the full knot vector.
    ///
    /// # Errors
    /// Returns a [`NurbsError`] if counts, order or signs do not fit.
    pub fn new(
        degree: usize,
        controls: &[Point],
        weights: &[f64],
        knots: Vec<f64>,
    ) -> Result<Self, NurbsError> {
        let count = controls.len();
        if degree == 0 || count <= degree {
            return Err(NurbsError::Controls { degree, controls: count });
        }
        if weights.len() != count {
            return Err(NurbsError::Weights { controls: count, weights: weights.len() });
        }
        if knots.len() != count + degree + 1 {
            return Err(NurbsError::Knots(knots.len()));
        }
        let points = controls.iter().flat_map(|point| [point.u, point.z]);
        if !points.chain(weights.iter().copied()).chain(knots.iter().copied()).all(f64::is_finite) {
            return Err(NurbsError::Number);
        }
        if let Some(index) = weights.iter().position(|weight| *weight <= 0.0) {
            return Err(NurbsError::Weight(index));
        }
        let ascending = knots.windows(2).all(|pair| matches!(pair, [a, b] if a <= b));
        let has_length = knots.get(degree) < knots.get(count);
        if !ascending || !has_length {
            return Err(NurbsError::Order);
        }
        let controls = controls
            .iter()
            .zip(weights)
            .map(|(point, weight)| [point.u * weight, point.z * weight, *weight])
            .collect();
        Ok(Self { degree, controls, knots })
    }

    /// Makes the curve of a program's spline in the coordinates of a vertical plane.
    ///
    /// # Errors
    /// Returns a [`NurbsError`] if the spline's counts do not fit.
    pub fn from_spline(spline: &Spline, plane: &ProfilePlane) -> Result<Self, NurbsError> {
        let controls: Vec<Point> = spline.controls.iter().map(|point| plane.to_plane(*point)).collect();
        Self::new(3, &controls, &vec![1.0; controls.len()], spline.knots.clone())
    }

    fn knot_at(&self, index: usize) -> f64 {
        self.knots.get(index).copied().unwrap_or_default()
    }
}

impl ParametricCurve for NurbsCurve {
    /// Computes a point with de Boor's algorithm on the weighted points.
    fn point_at(&self, parameter: f64) -> Point {
        let (degree, count) = (self.degree, self.controls.len());
        let parameter = parameter.clamp(self.knot_at(degree), self.knot_at(count));
        // The knot span that contains the parameter; the end belongs to the last span that has a length.
        let end = self.knot_at(count);
        let after =
            self.knots.partition_point(|knot| if parameter < end { *knot <= parameter } else { *knot < end });
        let span = after.saturating_sub(1).clamp(degree, count - 1);
        let mut points: Vec<[f64; 3]> =
            self.controls.iter().skip(span - degree).take(degree + 1).copied().collect();
        // Each level replaces neighbouring points by their weighted means; the last point is the curve's.
        for level in 1..=degree {
            for index in (level..=degree).rev() {
                let low = self.knot_at(span + index - degree);
                let high = self.knot_at(span + index + 1 - level);
                let share = if high > low { (parameter - low) / (high - low) } else { 0.0 };
                let left = points.get(index - 1).copied().unwrap_or_default();
                if let Some(right) = points.get_mut(index) {
                    for (value, before) in right.iter_mut().zip(left) {
                        *value = before * (1.0 - share) + *value * share;
                    }
                }
            }
        }
        match points.get(degree) {
            Some([u, z, weight]) => Point::new(u / weight, z / weight),
            None => Point::default(),
        }
    }

    fn knots(&self) -> Vec<f64> {
        let mut knots: Vec<f64> =
            self.knots.iter().take(self.controls.len() + 1).skip(self.degree).copied().collect();
        knots.dedup();
        knots
    }
}
