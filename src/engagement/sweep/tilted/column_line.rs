//! This module describes the line of a column in the frame of a tilted cutter.

/// A vertical line relative to a pose of the cutter; `s` counts upwards from the tip's height, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct ColumnLine {
    /// The height along the axis at s = 0.
    pub height: f64,
    /// The growth of that height with s, which is the z component of the axis.
    pub rise: f64,
    /// The square of the distance from the axis at s = 0.
    pub across2: f64,
    /// The square of the axis' horizontal component.
    pub lean2: f64,
}

impl ColumnLine {
    /// Makes the line at a horizontal offset from the tip of a cutter with a unit axis.
    #[inline]
    pub(super) fn new([x, y]: [f64; 2], axis: [f64; 3]) -> Self {
        let [ax, ay, az] = axis;
        let height = x * ax + y * ay;
        Self { height, rise: az, across2: x * x + y * y - height * height, lean2: ax * ax + ay * ay }
    }

    /// Returns the height along the axis at `s`.
    #[inline]
    pub(super) fn axial_height_at(&self, s: f64) -> f64 {
        self.height + self.rise * s
    }

    /// Returns the square of the distance from the axis at `s`.
    #[inline]
    pub(super) fn squared_radius_at(&self, s: f64) -> f64 {
        // |p|^2 - (p.a)^2 with p = (x, y, s), as a polynomial in s.
        (self.across2 + s * (self.lean2 * s - 2.0 * self.height * self.rise)).max(0.0)
    }

    /// Returns the range of `s` between two heights along the axis, or `None` for a line across the axis
    /// outside of them.
    #[inline]
    pub(super) fn clip_to_heights(&self, low: f64, high: f64) -> Option<[f64; 2]> {
        if self.rise.abs() < 1e-9 {
            return (low..=high).contains(&self.height).then_some([-1e6, 1e6]);
        }
        let ends = [(low - self.height) / self.rise, (high - self.height) / self.rise];
        Some(if self.rise > 0.0 { ends } else { [ends[1], ends[0]] })
    }
}
