//! This module holds one element of a cutter's contour.

/// One element of a contour. Normals point out of the cutter; the angle of a normal is measured from
/// straight down.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ContourElement {
    /// A straight part: a bottom, a cylinder or a cone.
    Line {
        /// The lower end: r and z, mm.
        from: [f64; 2],
        /// The upper end.
        to: [f64; 2],
        /// The outward unit normal.
        normal: [f64; 2],
    },
    /// A circular part, which bulges outwards.
    Arc {
        /// The centre: r and z, mm.
        center: [f64; 2],
        /// The radius, mm.
        radius: f64,
        /// The angles of the normal at the lower and the upper end, radians.
        angles: [f64; 2],
        /// The sines and cosines of these angles.
        ends: [[f64; 2]; 2],
    },
}

impl ContourElement {
    /// Makes an arc; `angles` are those of the normal at its lower and upper end, radians from straight down.
    pub fn arc(center: [f64; 2], radius: f64, angles: [f64; 2]) -> Self {
        let ends = angles.map(|angle| [angle.sin(), angle.cos()]);
        Self::Arc { center, radius, angles, ends }
    }

    /// Returns the range of the element's parameter: 0 to 1 of a line, the normal's angle of an arc.
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Line { .. } => [0.0, 1.0],
            Self::Arc { angles, .. } => *angles,
        }
    }

    /// Returns the point at a parameter: r and z, mm.
    pub fn point(&self, at: f64) -> [f64; 2] {
        match self {
            Self::Line { from, to, .. } => {
                [from[0] + (to[0] - from[0]) * at, from[1] + (to[1] - from[1]) * at]
            }
            Self::Arc { center, radius, .. } => {
                let (sin, cos) = at.sin_cos();
                [center[0] + radius * sin, center[1] - radius * cos]
            }
        }
    }

    /// Returns the outward normal at a parameter: its part across the axis and its part along the axis.
    pub fn normal(&self, at: f64) -> [f64; 2] {
        match self {
            Self::Line { normal, .. } => *normal,
            Self::Arc { .. } => {
                let (sin, cos) = at.sin_cos();
                [sin, -cos]
            }
        }
    }

    /// Returns the length of one unit of the parameter, mm.
    pub fn length_per_unit(&self) -> f64 {
        match self {
            Self::Line { from, to, .. } => (to[0] - from[0]).hypot(to[1] - from[1]),
            Self::Arc { radius, .. } => *radius,
        }
    }

    /// Returns the angles of the normals at both ends, radians.
    pub(super) fn normal_angles(&self) -> [f64; 2] {
        match self {
            Self::Line { normal, .. } => [normal[0].atan2(-normal[1]); 2],
            Self::Arc { angles, .. } => *angles,
        }
    }

    /// Returns the largest distance of the element from the axis, mm.
    pub(super) fn largest_radius(&self) -> f64 {
        match self {
            Self::Line { from, to, .. } => from[0].max(to[0]),
            Self::Arc { center, radius, .. } => center[0] + radius,
        }
    }

    /// Returns the gap of a point at (r, z), and its gradient.
    #[inline]
    pub(super) fn gap(&self, r: f64, z: f64) -> (f64, [f64; 2]) {
        match self {
            Self::Line { from, normal, .. } => {
                (normal[0] * (r - from[0]) + normal[1] * (z - from[1]), *normal)
            }
            Self::Arc { center, radius, ends: [[s0, c0], [s1, c1]], .. } => {
                let (dr, dz) = (r - center[0], z - center[1]);
                let (low, high) = (dr * s0 - dz * c0, dr * s1 - dz * c1);
                // Within the arc's sector the point is beyond the lower end, before the upper end, and
                // outwards.
                if dr * c0 + dz * s0 >= 0.0 && dr * c1 + dz * s1 <= 0.0 && low + high > 0.0 {
                    let length = (dr * dr + dz * dz).sqrt();
                    return (length - radius, [dr / length, dz / length]);
                }
                if low >= high { (low - radius, [*s0, -c0]) } else { (high - radius, [*s1, -c1]) }
            }
        }
    }

    /// Returns the largest r at a height at which the gap is at most `gap`; infinite where the element does
    /// not bound r; `None` where there is none.
    #[inline]
    pub(super) fn radius_at(&self, z: f64, gap: f64) -> Option<f64> {
        let bound = |normal: [f64; 2], rest: f64| {
            if normal[0] > 1e-12 { Some(rest / normal[0]) } else { (rest >= 0.0).then_some(f64::INFINITY) }
        };
        match self {
            Self::Line { from, normal, .. } => {
                let most = bound(*normal, gap - normal[1] * (z - from[1]))?;
                Some(from[0] + most)
            }
            Self::Arc { center, radius, ends: [[s0, c0], [s1, c1]], .. } => {
                let (reach, dz) = (radius + gap, z - center[1]);
                let lower = bound([*s0, -c0], reach + c0 * dz);
                let upper = bound([*s1, -c1], reach + c1 * dz);
                let across = if reach > 0.0 && -dz <= reach * c0 && -dz >= reach * c1 {
                    (reach * reach - dz * dz).max(0.0).sqrt()
                } else {
                    f64::INFINITY
                };
                Some(center[0] + across.min(lower?).min(upper?))
            }
        }
    }
}
