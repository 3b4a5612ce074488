//! This module holds the ellipse in which the cylinder of a cutter meets a layer.

/// The ellipse `p = c + M (cos theta, sin theta)` at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerEllipse {
    /// The centre c, mm.
    pub centre: [f64; 2],
    /// The velocity of the centre, mm for the whole step.
    pub velocity: [f64; 2],
    /// The entries xx, xy and yy of the symmetric matrix M, mm.
    pub shape: [f64; 3],
    /// The tool axis as a unit vector.
    pub axis: [f64; 3],
}

impl LayerEllipse {
    /// Returns the point for a direction `(cos theta, sin theta)`.
    pub fn point_towards(&self, [cos, sin]: [f64; 2]) -> [f64; 2] {
        let ([x, y], [xx, xy, yy]) = (self.centre, self.shape);
        [x + xx * cos + xy * sin, y + xy * cos + yy * sin]
    }

    /// Returns the direction `v` with `M v = p - c` for a point p. It has the length 1 if p is on the
    /// ellipse.
    pub(crate) fn direction_to(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([cx, cy], [xx, xy, yy]) = (self.centre, self.shape);
        let (x, y, det) = (x - cx, y - cy, xx * yy - xy * xy);
        [(yy * x - xy * y) / det, (xx * y - xy * x) / det]
    }

    /// Returns the length of `dP/dtheta`, mm.
    pub(crate) fn tangent_length_mm(&self, [cos, sin]: [f64; 2]) -> f64 {
        // dP/dtheta = M (-sin theta, cos theta).
        let [xx, xy, yy] = self.shape;
        (xy * cos - xx * sin).hypot(yy * cos - xy * sin)
    }

    /// Returns the longer semi-axis, mm.
    pub fn long_semi_axis_mm(&self) -> f64 {
        // The larger eigenvalue of M.
        let [xx, xy, yy] = self.shape;
        0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
    }

    /// Returns the shorter semi-axis, mm. It is the cutter's radius.
    pub fn short_semi_axis_mm(&self) -> f64 {
        let [xx, xy, yy] = self.shape;
        0.5 * (xx + yy) - (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
    }
}
