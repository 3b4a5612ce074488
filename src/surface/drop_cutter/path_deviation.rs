//! This module checks a path over a mesh independently: how deep it cuts into the mesh, and how far above it
//! stays.
//!
//! It does not use contact points. The cutter is a solid with a signed distance, and the mesh is a set of
//! points. The distance is convex and changes by at most the displacement. So a triangle is subdivided until
//! no part of it can be nearer than the nearest point known so far, minus an allowed error. The error between
//! the samples along the path is also known.
//!
//! Boxes around triangles are pruned the same way: the distance grows away from the axis and falls upwards, so the nearest
//! place that a box could have is at its upper side, where it is nearest to the axis. A sample so takes the logarithm of the
//! number of triangles, and the time of a program grows with its path alone.

use super::DropCutterShape;
use super::triangle_boxes::{TriangleBox, TriangleBoxes};
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

/// Measures gouge and gap of a cutter on one path: [`CutterClearanceField::measure_path`] for a mesh that is asked once.
/// Returns `None` for a path without points or with a number that is not finite.
pub fn measure_deviation(
    mesh: &Mesh,
    cutter: DropCutterShape,
    path: &[[f64; 3]],
    resolution_mm: f64,
) -> Option<PathDeviation> {
    CutterClearanceField::new(mesh, cutter).measure_path(path, resolution_mm, resolution_mm)
}

/// A mesh that is sorted for measuring how far paths of a cutter are from it.
#[derive(Debug, Clone)]
pub struct CutterClearanceField {
    cutter: DropCutterShape,
    triangles: TriangleBoxes,
    /// Further away, the distance is more than the radius, which is the most that is told.
    air: AirClip,
}

impl CutterClearanceField {
    /// Sorts a mesh's triangles, once for any number of paths.
    pub fn new(mesh: &Mesh, cutter: DropCutterShape) -> Self {
        let triangles = mesh.triangle_vertices().map(|corners| corners.map(Vector3::from)).collect();
        let air = AirClip::around_from_above(mesh.bounds(), 2.0 * cutter.radius_mm());
        Self { cutter, triangles: TriangleBoxes::new(triangles), air }
    }

    /// Measures gouge and gap of the cutter whose tip moves along a path of straight lines, as distances in space.
    /// This is an independent check that takes time. Samples are `step_mm` apart, and the distance at each of them is at
    /// most half of `resolution_mm` (at least 1e-6) too large. Returns `None` for a path without points or with a number
    /// that is not finite.
    ///
    /// Between two samples at which the mesh is not in the cutter it gets in by no more than half the step; with a corner
    /// radius r by no more than `step^2 / (8 r)` ([`CutterClearanceField::widest_step_mm`]).
    pub fn measure_path(&self, path: &[[f64; 3]], step_mm: f64, resolution_mm: f64) -> Option<PathDeviation> {
        let (step, resolution) = (step_mm.max(1e-6), resolution_mm.max(1e-6));
        let first = path.first().filter(|_| path.iter().flatten().all(|value| value.is_finite()))?;
        let (error, radius) = (resolution / 2.0, self.cutter.radius_mm());
        let mut nearest = None;
        let mut distance = self.distance_to_cutter(*first, radius, error, &mut nearest);
        let (mut low, mut low_at, mut high, mut high_at) = (distance, *first, distance, *first);
        for pair in path.windows(2) {
            let [from, to] = pair else { continue };
            let [from, to] = [*from, *to].map(Vector3::from);
            let length = (to - from).norm();
            let count = (length / step).ceil().max(1.0);
            let near = self.air.near_steps(from.into(), to.into(), count);
            let mut index = near[0];
            while index <= count {
                let tip: [f64; 3] = from.lerp(&to, index / count).into();
                // The distance cannot grow by more than the travel since the sample before.
                let most = (distance + length / count + resolution).min(radius);
                distance = self.distance_to_cutter(tip, most, error, &mut nearest);
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

    /// Returns the largest distance of samples at which the mesh gets no deeper than `error_mm` into the cutter between
    /// two samples, if it is not in it at both.
    ///
    /// The cutter is a convex core enlarged by the corner radius r on all sides. A point of the mesh is nearest to the core
    /// where the path is square to the shortest way between them. So with the distance f there, the nearer sample, at most
    /// half a step d away, has a distance of at most sqrt(f^2 + d^2/4), which is at least r: f is not below r by more than
    /// d^2 / (8 r). A flat end has no such bound, and gets a step of twice the error.
    pub fn widest_step_mm(&self, error_mm: f64) -> f64 {
        (8.0 * self.cutter.corner_radius_mm() * error_mm).sqrt().max(2.0 * error_mm)
    }

    /// Returns the least signed distance of the mesh from the cutter, or `most` if it is more. It is at most
    /// `error` too large. `nearest` is the triangle that was nearest at the place before, which mostly still is, and then the one
    /// that is nearest here.
    fn distance_to_cutter(
        &self,
        tip: [f64; 3],
        most: f64,
        error: f64,
        nearest: &mut Option<Triangle>,
    ) -> f64 {
        let (cutter, tip) = (&self.cutter, Vector3::from(tip));
        let bound = |around: &TriangleBox| box_distance_bound(cutter, &tip, around);
        let mut least = most;
        let known = *nearest;
        if let Some(triangle) = known {
            lower_least_distance(cutter, triangle.map(|corner| corner - tip), error, &mut least);
        }
        // A box cannot matter if it is not nearer than the nearest point by more than the error.
        let mut enough = least - error;
        let mut examine = |triangle: &Triangle| {
            let before = least;
            if known.as_ref() != Some(triangle) {
                lower_least_distance(cutter, triangle.map(|corner| corner - tip), error, &mut least);
            }
            if least < before {
                *nearest = Some(*triangle);
            }
            least - error
        };
        self.triangles.examine_nearest(&bound, &mut enough, &mut examine);
        least
    }
}

/// Returns a lower bound of the signed distance of all points of a box from a cutter: the distance of the place on the box's
/// upper side that is nearest to the axis.
fn box_distance_bound(cutter: &DropCutterShape, tip: &Vector3<f64>, around: &TriangleBox) -> f64 {
    let beside = |at: f64, low: f64, high: f64| (low - at).max(at - high).max(0.0);
    let x = beside(tip.x, around.low.x, around.high.x);
    let y = beside(tip.y, around.low.y, around.high.y);
    signed_distance(cutter, Vector3::new(x, y, around.high.z - tip.z)).0
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

/// Returns a lower bound over a triangle of the larger one of two linear functions, from their values at its corners.
///
/// Any mean of the two is below the larger one, and the least value of a mean is at a corner. The best mean is one of
/// the functions, or one at which two corners are equally low: linear programming.
fn least_of_planes(one: [f64; 3], other: [f64; 3]) -> f64 {
    let lowest = |share: f64| {
        let mean = one.iter().zip(&other).map(|(one, other)| share * one + (1.0 - share) * other);
        mean.fold(f64::INFINITY, f64::min)
    };
    let ([a, b, c], [u, v, w]) = (one, other);
    let mut best = lowest(0.0).max(lowest(1.0));
    for (first, second) in [((a, u), (b, v)), ((b, v), (c, w)), ((c, w), (a, u))] {
        // share a + (1 - share) u = share b + (1 - share) v.
        let (by_one, by_other) = (first.0 - second.0, second.1 - first.1);
        let share = by_other / (by_one + by_other);
        if share > 0.0 && share < 1.0 {
            best = best.max(lowest(share));
        }
    }
    best
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
        // A convex function is above its tangent planes. The distance is also not less than the larger of those from the
        // plane at the tip's height and from the endless cylinder; this bound holds where the gradient jumps at the edge
        // of a flat end.
        let nearest = (distance + least(gradient)).max(least_of_planes(
            sides.map(|side| -middle.z - side.z),
            sides.map(|side| r - cutter.radius_mm() + out.dot(&side)),
        ));
        let size = sides.iter().map(Vector3::norm).fold(0.0, f64::max);
        (Self { corners, nearest, size }, distance)
    }
}
