//! An independent look at a path over a mesh: how deep it cuts into it, and how far above it stays.
//!
//! Nothing here knows contacts. The cutter is a solid with a signed distance, and the mesh a set of points. The distance is a convex
//! function that changes by no more than one moves, so a triangle is divided until no part of it can be nearer than the nearest point
//! seen so far, less an allowed error; and so is the error between places looked at along the path known.

use super::DropCutterShape;
use super::triangle_columns::TriangleColumns;
use crate::sim::Mesh;
use nalgebra::Vector3;

type Triangle = [Vector3<f64>; 3];

/// How a path lies over a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathDeviation {
    /// How deep the mesh reaches into the cutter's solid at most, mm; 0 when it never does.
    pub gouge: f64,
    /// The tip where that is.
    pub gouge_at: [f64; 3],
    /// The largest distance between the cutter and the mesh along the path, mm, up to the cutter's radius.
    pub gap: f64,
    /// The tip where that is.
    pub gap_at: [f64; 3],
    /// How much larger either can be in truth, mm: between the places looked at.
    pub error: f64,
}

/// Gouges and gaps of a cutter whose tip goes along a path of straight lines, as distances in space: an independent check that takes its
/// time. `resolution` (mm, at least 1e-6) is the allowed error. None for a path without points, or with one that is not finite.
pub fn measure_deviation(
    mesh: &Mesh,
    cutter: DropCutterShape,
    path: &[[f64; 3]],
    resolution: f64,
) -> Option<PathDeviation> {
    let resolution = resolution.max(1e-6);
    let first = path.first().filter(|_| path.iter().flatten().all(|value| value.is_finite()))?;
    let error = resolution / 2.0;
    let field = TriangleField::new(mesh, &cutter);
    let mut distance = field.distance_to_cutter(&cutter, *first, cutter.radius_mm(), error);
    let (mut low, mut low_at, mut high, mut high_at) = (distance, *first, distance, *first);
    for pair in path.windows(2) {
        let [from, to] = pair else { continue };
        let [from, to] = [*from, *to].map(Vector3::from);
        let length = (to - from).norm();
        let count = (length / resolution).ceil().max(1.0);
        let mut index = 1.0;
        while index <= count {
            let tip: [f64; 3] = from.lerp(&to, index / count).into();
            // No farther than before, plus the way.
            let most = (distance + length / count + resolution).min(cutter.radius_mm());
            distance = field.distance_to_cutter(&cutter, tip, most, error);
            if distance < low {
                (low, low_at) = (distance, tip);
            }
            if distance > high {
                (high, high_at) = (distance, tip);
            }
            index += 1.0;
        }
    }
    Some(PathDeviation {
        gouge: (-low).max(0.0),
        gouge_at: low_at,
        gap: high.max(0.0),
        gap_at: high_at,
        error: resolution,
    })
}

/// Signed distance of a point from the cutter's solid, negative inside, and its gradient. The solid is an upright cylinder of the flat's
/// radius that begins a corner radius above the tip, made larger by the corner radius on all sides.
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

/// A mesh's triangles, and by columns which of them are where.
struct TriangleField {
    columns: TriangleColumns,
    triangles: Vec<Triangle>,
}

impl TriangleField {
    fn new(mesh: &Mesh, cutter: &DropCutterShape) -> Self {
        let triangles = mesh.triangle_vertices().map(|corners| corners.map(Vector3::from)).collect();
        Self { columns: TriangleColumns::new(mesh, cutter.radius_mm()), triangles }
    }

    /// The least signed distance of the mesh from a cutter, `most` where it is more; at most `error` too large.
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

/// Lowers the least distance to that of a triangle, divided as long as a part may be nearer.
fn lower_least_distance(cutter: &DropCutterShape, triangle: Triangle, error: f64, least: &mut f64) {
    let (whole, distance) = TrianglePart::new(cutter, triangle);
    *least = least.min(distance);
    subdivide_triangle(cutter, &whole, error, least);
}

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
    // The more promising first.
    parts.sort_unstable_by(|one, other| one.nearest.total_cmp(&other.nearest));
    for part in &parts {
        subdivide_triangle(cutter, part, error, least);
    }
}

/// A part of a triangle, relative to the tip.
struct TrianglePart {
    corners: Triangle,
    /// Nothing of it is nearer.
    nearest: f64,
    /// From its middle to the farthest corner.
    size: f64,
}

impl TrianglePart {
    /// With the distance of its middle.
    fn new(cutter: &DropCutterShape, corners: Triangle) -> (Self, f64) {
        let [a, b, c] = corners;
        let middle = (a + b + c) / 3.0;
        let (distance, gradient) = signed_distance(cutter, middle);
        let r = middle.x.hypot(middle.y);
        let out = if r > 0.0 { Vector3::new(middle.x / r, middle.y / r, 0.0) } else { Vector3::zeros() };
        let sides = corners.map(|corner| corner - middle);
        let least = |along: Vector3<f64>| sides.iter().map(|side| along.dot(side)).fold(0.0, f64::min);
        // Convex functions lie above their tangent planes, and the distance is no less than that from the level below the tip and from
        // the endless cylinder: those are what holds where a flat end's edge lets the gradient jump.
        let nearest = (distance + least(gradient))
            .max(least(-Vector3::z()) - middle.z)
            .max(r - cutter.radius_mm() + least(out));
        let size = sides.iter().map(Vector3::norm).fold(0.0, f64::max);
        (Self { corners, nearest, size }, distance)
    }
}
