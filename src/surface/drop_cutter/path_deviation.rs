//! This module checks a path over a mesh independently: how deep it cuts into the mesh, and how far above it
//! stays.
//!
//! It does not use contact points. The cutter is a solid with a signed distance, and the mesh is a set of
//! points. The distance is convex and changes by at most the displacement. So a triangle is subdivided until
//! no part of it can be nearer than the nearest point known so far, minus an allowed error. The error between
//! the samples along the path is also known.

use super::DropCutterShape;
use super::triangle_columns::TriangleColumns;
use crate::stock::{AirClip, Mesh};
use nalgebra::Vector3;

type Triangle = [Vector3<f64>; 3];

/// The deviation of a path from a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PathDeviation {
    /// The largest depth of the mesh in the cutter's solid, mm; 0 if it never enters it.
    pub gouge_mm: f64,
    /// The tip at which this is so.
    pub gouge_at_mm: [f64; 3],
    /// The largest distance between the cutter and the mesh along the path, mm, up to the cutter's radius.
    pub gap_mm: f64,
    /// The tip at which this is so.
    pub gap_at_mm: [f64; 3],
    /// By how much either value may be larger in truth, mm, because of the distance of samples.
    pub error_mm: f64,
}

/// Measures gouge and gap of a cutter whose tip moves along a path of straight lines, as distances in space.
/// This is an independent check that takes time. `resolution_mm` (at least 1e-6) is the allowed error.
/// Returns `None` for a path without points or with a number that is not finite.
pub fn measure_deviation(
    mesh: &Mesh,
    cutter: DropCutterShape,
    path: &[[f64; 3]],
    resolution_mm: f64,
) -> Option<PathDeviation> {
    let resolution = resolution_mm.max(1e-6);
    let first = path.first().filter(|_| path.iter().flatten().all(|value| value.is_finite()))?;
    let error = resolution / 2.0;
    let field = TriangleField::new(mesh, &cutter);
    // Further away, the distance is more than the radius, which is the most that is told.
    let air = AirClip::around_from_above(mesh.bounds(), 2.0 * cutter.radius_mm());
    let mut distance = field.distance_to_cutter(&cutter, *first, cutter.radius_mm(), error);
    let (mut low, mut low_at, mut high, mut high_at) = (distance, *first, distance, *first);
    for pair in path.windows(2) {
        let [from, to] = pair else { continue };
        let [from, to] = [*from, *to].map(Vector3::from);
        let length = (to - from).norm();
        let count = (length / resolution).ceil().max(1.0);
        let near = air.near_steps(from.into(), to.into(), count);
        let mut index = near[0];
        while index <= count {
            let tip: [f64; 3] = from.lerp(&to, index / count).into();
            // The distance cannot grow by more than the travel since the sample before.
            let most = (distance + length / count + resolution).min(cutter.radius_mm());
            distance = field.distance_to_cutter(&cutter, tip, most, error);
            if distance < low {
                (low, low_at) = (distance, tip);
            }
            if distance > high {
                (high, high_at) = (distance, tip);
            }
            index = AirClip::step_behind(index, near, count);
        }
    }
    Some(PathDeviation {
        gouge_mm: (-low).max(0.0),
        gouge_at_mm: low_at,
        gap_mm: high.max(0.0),
        gap_at_mm: high_at,
        error_mm: resolution,
    })
}

/// Returns the signed distance of a point from the cutter's solid, negative inside, and its gradient. The
/// solid is a vertical cylinder with the radius of the flat that begins one corner radius above the tip,
/// enlarged by the corner radius on all sides.
fn signed_distance(cutter: &DropCutterShape, from_tip: Vector3<f64>) -> (f64, Vector3<f64>) {
    let corner = cutter.corner_radius_mm();
    let r = from_tip.x.hypot(from_tip.y);
    let out = if r > 0.0 { Vector3::new(from_tip.x / r, from_tip.y / r, 0.0) } else { Vector3::zeros() };
    let (beside, below) = (r - cutter.flat_radius_mm(), corner - from_tip.z);
    if beside > 0.0 && below > 0.0 {
        let far = beside.hypot(below);
        return (far - corner, (out * beside - Vector3::z() * below) / far);
    }
    if beside > below { (beside - corner, out) } else { (below - corner, -Vector3::z()) }
}

/// A mesh's triangles, with columns that list the triangles in them.
struct TriangleField {
    columns: TriangleColumns,
    triangles: Vec<Triangle>,
}

impl TriangleField {
    fn new(mesh: &Mesh, cutter: &DropCutterShape) -> Self {
        let triangles = mesh.triangle_vertices().map(|corners| corners.map(Vector3::from)).collect();
        Self { columns: TriangleColumns::new(mesh, cutter.radius_mm()), triangles }
    }

    /// Returns the least signed distance of the mesh from a cutter, or `most` if it is more. It is at most
    /// `error` too large.
    fn distance_to_cutter(&self, cutter: &DropCutterShape, tip: [f64; 3], most: f64, error: f64) -> f64 {
        let [x, y, z] = tip;
        let reach = cutter.radius_mm() + most.max(0.0);
        let tip = Vector3::new(x, y, z);
        let mut least = most;
        for column in self.columns.columns_within([x - reach, y - reach], [x + reach, y + reach]) {
            for index in column {
                if let Some(triangle) = self.triangles.get(*index as usize) {
                    lower_least_distance(cutter, triangle.map(|corner| corner - tip), error, &mut least);
                }
            }
        }
        least
    }
}

/// Lowers the least distance to that of a triangle. The triangle is subdivided as long as a part may be
/// nearer.
fn lower_least_distance(cutter: &DropCutterShape, triangle: Triangle, error: f64, least: &mut f64) {
    let (whole, distance) = TrianglePart::new(cutter, triangle);
    *least = least.min(distance);
    subdivide_triangle(cutter, &whole, error, least);
}

/// Subdivides a part of a triangle in four as long as it may be nearer than the least distance minus the
/// error.
fn subdivide_triangle(cutter: &DropCutterShape, part: &TrianglePart, error: f64, least: &mut f64) {
    if part.nearest >= *least - error || part.size <= error {
        return;
    }
    let [a, b, c] = part.corners;
    let [ab, bc, ca] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
    let mut parts = [[ab, bc, ca], [a, ab, ca], [ab, b, bc], [ca, bc, c]].map(|part| {
        let (part, distance) = TrianglePart::new(cutter, part);
        *least = least.min(distance);
        part
    });
    // The part with the lowest bound is examined first.
    parts.sort_unstable_by(|one, other| one.nearest.total_cmp(&other.nearest));
    for part in &parts {
        subdivide_triangle(cutter, part, error, least);
    }
}

/// A part of a triangle, relative to the tip.
struct TrianglePart {
    corners: Triangle,
    /// A lower bound of its distance.
    nearest: f64,
    /// The distance from its middle to the furthest vertex.
    size: f64,
}

impl TrianglePart {
    /// Makes a part; also returns the distance of its middle.
    fn new(cutter: &DropCutterShape, corners: Triangle) -> (Self, f64) {
        let [a, b, c] = corners;
        let middle = (a + b + c) / 3.0;
        let (distance, gradient) = signed_distance(cutter, middle);
        let r = middle.x.hypot(middle.y);
        let out = if r > 0.0 { Vector3::new(middle.x / r, middle.y / r, 0.0) } else { Vector3::zeros() };
        let sides = corners.map(|corner| corner - middle);
        let least = |along: Vector3<f64>| sides.iter().map(|side| along.dot(side)).fold(0.0, f64::min);
        // A convex function is above its tangent planes. The distance is also not less than that from the
        // plane at the tip's height and from the endless cylinder; these two bounds hold where the gradient
        // jumps at the edge of a flat end.
        let nearest = (distance + least(gradient))
            .max(least(-Vector3::z()) - middle.z)
            .max(r - cutter.radius_mm() + least(out));
        let size = sides.iter().map(Vector3::norm).fold(0.0, f64::max);
        (Self { corners, nearest, size }, distance)
    }
}
