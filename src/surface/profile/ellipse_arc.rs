//! This module holds arcs of ellipses.

use super::chain_piece::Point;
use super::parametric_curve::ParametricCurve;

/// An arc of an ellipse. Its point at parameter t is `centre + a cos t e1 + b sin t e2`, where e1 is +u
/// turned by `tilt_rad`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EllipseArc {
    /// The centre, mm.
    pub centre: Point,
    /// Half the first axis, mm.
    pub a: f64,
    /// Half the second axis, mm.
    pub b: f64,
    /// The angle of the first axis from +u towards +z, radians.
    pub tilt_rad: f64,
    /// The parameter of the start, radians.
    pub start_rad: f64,
    /// The parameter from start to end with its sign, radians.
    pub sweep_rad: f64,
}

impl ParametricCurve for EllipseArc {
    fn point_at(&self, parameter: f64) -> Point {
        let (sin, cos) = (self.start_rad + self.sweep_rad * parameter).sin_cos();
        let (sin_tilt, cos_tilt) = self.tilt_rad.sin_cos();
        let (first, second) = (self.a * cos, self.b * sin);
        Point::new(
            self.centre.u + first * cos_tilt - second * sin_tilt,
            self.centre.z + first * sin_tilt + second * cos_tilt,
        )
    }

    fn knots(&self) -> Vec<f64> {
        vec![0.0, 0.25, 0.5, 0.75, 1.0]
    }
}
