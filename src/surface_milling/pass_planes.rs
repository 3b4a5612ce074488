//! Parallel vertical planes.

/// More planes than this are a mistake in the step.
pub const MOST_PLANES: usize = 100_000;

/// Which way the planes stand: they hold z and a horizontal direction u.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PassPlanes {
    /// From x to u, radians.
    angle: f64,
    /// Whether offsets count to the right of u instead of to its left.
    to_the_right: bool,
}

impl PassPlanes {
    /// Along x; offsets are y.
    pub const ZX: Self = Self { angle: 0.0, to_the_right: false };
    /// Along y; offsets are x.
    pub const YZ: Self = Self { angle: std::f64::consts::FRAC_PI_2, to_the_right: true };

    /// Along a direction at an angle (degrees) from x; offsets count to its left.
    pub fn from_degrees(degrees: f64) -> Self {
        Self { angle: degrees.to_radians(), to_the_right: false }
    }

    /// From x to u, radians.
    pub fn angle_radians(&self) -> f64 {
        self.angle
    }

    /// An offset as [`crate::surface::mesh_section::VerticalMeshSections`] counts it (to the left of u); the same the other way round.
    pub fn offset_to_left(&self, offset: f64) -> f64 {
        if self.to_the_right { -offset } else { offset }
    }

    /// The direction of u, exact along the axes.
    pub fn direction(&self) -> [f64; 2] {
        match *self {
            Self::ZX => [1.0, 0.0],
            Self::YZ => [0.0, 1.0],
            Self { angle, .. } => [angle.cos(), angle.sin()],
        }
    }

    /// The point in space of (u, z) in the plane at an offset.
    pub fn point_at(&self, offset: f64, u: f64, z: f64) -> [f64; 3] {
        let ([cos, sin], left) = (self.direction(), self.offset_to_left(offset));
        [u * cos - left * sin, u * sin + left * cos, z]
    }

    /// How far along u a point lies.
    pub fn distance_along(&self, [x, y]: [f64; 2]) -> f64 {
        let [cos, sin] = self.direction();
        x * cos + y * sin
    }
}

/// Offsets from `from` to `to`, both among them, evenly and no farther apart than `step`; none when there would be more than
/// [`MOST_PLANES`] or a number is not finite. One plane when both ends are the same.
pub fn plane_offsets(from: f64, to: f64, step: f64) -> Option<Vec<f64>> {
    let wide = to - from;
    // A hair more than a whole number of steps is a whole number.
    let count = (wide.abs() / step - 1e-9).ceil().max(0.0);
    if !(wide.is_finite() && step > 0.0 && count < MOST_PLANES as f64) {
        return None;
    }
    let count = count as usize;
    let at = |index: usize| if index == count { to } else { from + wide * (index as f64 / count as f64) };
    Some((0..=count).map(at).collect())
}
