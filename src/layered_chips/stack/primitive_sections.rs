//! Level sections of blocks and cylinders.

use nalgebra::{Vector2, Vector3};

/// How far the chords of a section may be from its curve, mm.
const CHORD: f64 = 5e-4;

/// Fewest and most chords of half an ellipse.
const CHORDS: [f64; 2] = [8.0, 4096.0];

/// Sine or cosine of the tilt below which a cylinder stands upright or lies: both then differ by less than is rounded.
const ALIGNED: f64 = 1e-8;

/// A block's section at a height; empty beside it.
pub(super) fn section_block([x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3], z: f64) -> Vec<[f64; 2]> {
    if z < z0 || z >= z1 { Vec::new() } else { vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]] }
}

/// A cylinder: centre of one end, direction of its axis, length and radius.
pub(super) struct SectionedCylinder {
    from: Vector3<f64>,
    axis: Vector3<f64>,
    length: f64,
    radius: f64,
}

impl SectionedCylinder {
    /// Between the centres of its ends, grown by an allowance in radius and at both ends; its axis points up.
    pub(super) fn new(diameter: f64, ends: [[f64; 3]; 2], allowance: f64) -> Self {
        let [mut from, mut to] = ends.map(Vector3::from);
        if from.z > to.z {
            std::mem::swap(&mut from, &mut to);
        }
        let length = (to - from).norm();
        let axis = (to - from) / length;
        let radius = diameter / 2.0 + allowance;
        Self { from: from - axis * allowance, axis, length: length + 2.0 * allowance, radius }
    }

    /// Its section at a height: an ellipse, cut off where the plane leaves through the ends; empty beside it.
    ///
    /// With s along the axis seen from above, w across and d the height over `from`, a point is s sin + d cos along the axis and
    /// q = s cos - d sin above it (sin, cos of the tilt from upright), and inside for q^2 + w^2 <= r^2 and between the ends.
    pub(super) fn section_at(&self, z: f64) -> Vec<[f64; 2]> {
        let level = Vector2::new(self.axis.x, self.axis.y);
        let (sin, cos) = (level.norm(), self.axis.z);
        let (rise, radius) = (z - self.from.z, self.radius);
        let (u, outline) = if sin < ALIGNED {
            if rise < 0.0 || rise >= self.length {
                return Vec::new();
            }
            (Vector2::x(), sample_ellipse_arc(radius, radius, [0.0, std::f64::consts::PI]))
        } else if cos < ALIGNED {
            if rise < -radius || rise >= radius {
                return Vec::new();
            }
            let half = (radius * radius - rise * rise).max(0.0).sqrt();
            (level / sin, vec![[self.length, half], [0.0, half]])
        } else {
            let ends = [0.0, self.length].map(|along| (along - rise * cos) / sin);
            // q over the radius at the ends, from the far one to the near one; beyond 1 the ellipse closes before it.
            let [near, far] = ends.map(|s| ((s * cos - rise * sin) / radius).clamp(-1.0, 1.0));
            if near >= far {
                return Vec::new();
            }
            let middle = rise * sin / cos;
            let points = sample_ellipse_arc(radius / cos, radius, [far.acos(), near.acos()]);
            (level / sin, points.into_iter().map(|[s, w]| [middle + s, w]).collect())
        };
        let center = Vector2::new(self.from.x, self.from.y);
        let place = |[s, w]: [f64; 2]| (center + u * s + Vector2::new(-u.y, u.x) * w).into();
        let across = outline.iter().rev().map(|[s, w]| [*s, -w]);
        outline.iter().copied().chain(across).map(place).collect()
    }
}

/// Points of an ellipse with given half axes between two angles up to half a turn; of a whole half, on an ellipse that is larger by so much
/// that the area is right.
fn sample_ellipse_arc(long: f64, wide: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let [fewest, most] = CHORDS;
    let chord = 2.0 * (1.0 - (CHORD / long.max(wide)).min(1.0)).acos();
    let turn = to - from;
    let half = turn >= std::f64::consts::PI;
    let count = (turn / chord).ceil().clamp(if half { fewest } else { 1.0 }, most);
    let step = turn / count;
    let grown = if half { (step / step.sin()).sqrt() } else { 1.0 };
    let point = |index: usize| {
        let (sin, cos) = (from + step * index as f64).sin_cos();
        [long * grown * cos, wide * grown * sin]
    };
    (0..=count as usize).map(point).collect()
}
