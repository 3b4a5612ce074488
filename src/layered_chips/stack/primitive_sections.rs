//! This module cuts blocks and cylinders by level planes.

use nalgebra::{Vector2, Vector3};

/// The largest distance of the chords of a section from its curve, mm.
const CHORD: f64 = 5e-4;

/// The fewest and the most chords of half an ellipse.
const CHORDS: [f64; 2] = [8.0, 4096.0];

/// The sine or cosine of the tilt below which a cylinder counts as vertical or horizontal. The difference is
/// below the rounding of coordinates.
const ALIGNED: f64 = 1e-8;

/// Returns a block's section at a height; it is empty outside the block.
pub(super) fn section_block([x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3], z: f64) -> Vec<[f64; 2]> {
    if z < z0 || z >= z1 { Vec::new() } else { vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]] }
}

/// A cylinder: the centre of one end, the direction of its axis, its length and its radius.
pub(super) struct SectionedCylinder {
    from: Vector3<f64>,
    axis: Vector3<f64>,
    length: f64,
    radius: f64,
}

impl SectionedCylinder {
    /// Makes the cylinder between the centres of its ends, grown by an allowance in radius and at both ends.
    /// Its axis points upwards.
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

    /// Returns the section at a height: an ellipse, cut off where the plane passes through the ends. It is
    /// empty outside the cylinder.
    ///
    /// Let s be the horizontal coordinate along the axis, w the one across it, and d the height over `from`.
    /// Then a point is at `s sin + d cos` along the axis and at `q = s cos - d sin` above it, with sin and
    /// cos of the tilt from the vertical. It is inside if `q^2 + w^2 <= r^2` and it is between the ends.
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
            // A horizontal cylinder has a rectangle as its section.
            let half = (radius * radius - rise * rise).max(0.0).sqrt();
            (level / sin, vec![[self.length, half], [0.0, half]])
        } else {
            let ends = [0.0, self.length].map(|along| (along - rise * cos) / sin);
            // The ratio of q to the radius at both ends. Beyond 1 the ellipse closes before the end.
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

/// Returns points of an ellipse with two given semi-axes between two angles, at most half a turn apart. For a
/// whole half the ellipse is enlarged so that the polygon has the right area.
fn sample_ellipse_arc(long: f64, wide: f64, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let [fewest, most] = CHORDS;
    let chord = 2.0 * (1.0 - (CHORD / long.max(wide)).min(1.0)).acos();
    let turn = to - from;
    let half = turn >= std::f64::consts::PI;
    let count = (turn / chord).ceil().clamp(if half { fewest } else { 1.0 }, most);
    let step = turn / count;
    // A polygon of n = pi / step chords on the half has sin(step) / step of the area.
    let grown = if half { (step / step.sin()).sqrt() } else { 1.0 };
    let point = |index: usize| {
        let (sin, cos) = (from + step * index as f64).sin_cos();
        [long * grown * cos, wide * grown * sin]
    };
    (0..=count as usize).map(point).collect()
}
