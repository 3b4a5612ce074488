//! This module describes the parallel vertical planes of the passes.

/// The most planes. A request for more is a mistake in the step.
pub const MOST_PLANES: usize = 100_000;

/// The direction of the planes: they contain z and a horizontal direction u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassPlanes {
    /// The angle from x to u, radians.
    angle: f64,
    /// Whether offsets count to the right of u instead of to its left.
    to_the_right: bool,
}

impl PassPlanes {
    /// Planes along x; their offset is y.
    pub const ZX: Self = Self { angle: 0.0, to_the_right: false };
    /// Planes along y; their offset is x.
    pub const YZ: Self = Self { angle: std::f64::consts::FRAC_PI_2, to_the_right: true };

    /// Makes planes along a direction at an angle (degrees) from x. Their offsets count to its left.
    pub fn from_degrees(degrees: f64) -> Self {
        Self { angle: degrees.to_radians(), to_the_right: false }
    }

    /// Returns the angle from x to u, radians.
    pub fn angle_rad(&self) -> f64 {
        self.angle
    }

    /// Converts an offset to one that counts to the left of u, as in
    /// [`crate::surface::mesh_section::VerticalMeshSections`]. The inverse conversion is the same.
    pub(crate) fn offset_to_left(&self, offset_mm: f64) -> f64 {
        if self.to_the_right { -offset_mm } else { offset_mm }
    }

    /// Returns the direction of u; it is exact along the axes.
    pub fn direction(&self) -> [f64; 2] {
        match *self {
            Self::ZX => [1.0, 0.0],
            Self::YZ => [0.0, 1.0],
            Self { angle, .. } => [angle.cos(), angle.sin()],
        }
    }

    /// Returns the point in space of (u, z) in the plane at an offset.
    pub fn point_at(&self, offset_mm: f64, u: f64, z: f64) -> [f64; 3] {
        let ([cos, sin], left) = (self.direction(), self.offset_to_left(offset_mm));
        [u * cos - left * sin, u * sin + left * cos, z]
    }

    /// Returns the coordinate u of a point.
    pub(crate) fn distance_along(&self, [x, y]: [f64; 2]) -> f64 {
        let [cos, sin] = self.direction();
        x * cos + y * sin
    }
}

/// Returns offsets from `from` to `to`, both included, with equal distances of at most `step`. If both ends
/// are the same there is one plane. Returns `None` if there would be more than [`MOST_PLANES`] or a number is
/// not finite.
pub fn plane_offsets(from: f64, to: f64, step: f64) -> Option<Vec<f64>> {
    let wide = to - from;
    // Slightly more than a whole number of steps counts as a whole number.
    let count = (wide.abs() / step - 1e-9).ceil().max(0.0);
    if !(wide.is_finite() && step > 0.0 && count < MOST_PLANES as f64) {
        return None;
    }
    let count = count as usize;
    let at = |index: usize| if index == count { to } else { from + wide * (index as f64 / count as f64) };
    Some((0..=count).map(at).collect())
}
