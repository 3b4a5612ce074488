//! What the cylinder of a cutter has in common with a layer.

/// The ellipse at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerEllipse {
    /// Its centre, mm.
    pub centre: [f64; 2],
    /// Velocity of its centre, mm for the whole step.
    pub velocity: [f64; 2],
    /// xx, xy and yy of M, mm.
    pub shape: [f64; 3],
    /// The tool axis.
    pub axis: [f64; 3],
}

impl LayerEllipse {
    /// The point for a direction `(cos theta, sin theta)`.
    pub fn point_towards(&self, [cos, sin]: [f64; 2]) -> [f64; 2] {
        let ([x, y], [xx, xy, yy]) = (self.centre, self.shape);
        [x + xx * cos + xy * sin, y + xy * cos + yy * sin]
    }

    /// The direction `v` with `M v = p - c`; of length 1 on the ellipse.
    pub fn direction_to(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([cx, cy], [xx, xy, yy]) = (self.centre, self.shape);
        let (x, y, det) = (x - cx, y - cy, xx * yy - xy * xy);
        [(yy * x - xy * y) / det, (xx * y - xy * x) / det]
    }

    /// Length of `dP/dtheta`, mm.
    pub fn tangent_length_mm(&self, [cos, sin]: [f64; 2]) -> f64 {
        let [xx, xy, yy] = self.shape;
        (xy * cos - xx * sin).hypot(yy * cos - xy * sin)
    }

    /// Longer semi-axis, mm.
    pub fn long_semi_axis_mm(&self) -> f64 {
        let [xx, xy, yy] = self.shape;
        0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
    }

    /// Shorter semi-axis, mm: the cutter's radius.
    pub fn short_semi_axis_mm(&self) -> f64 {
        let [xx, xy, yy] = self.shape;
        0.5 * (xx + yy) - (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
    }
}
