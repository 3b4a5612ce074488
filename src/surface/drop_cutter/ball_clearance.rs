//! This module measures how far a ball-end cutter with the shank above it is from a mesh. The result is the
//! exact distance in space, triangle by triangle.
//!
//! The cutter consists of all points that are nearer than its radius to the ray upwards from the ball's
//! centre. So its distance from a triangle is the distance of a ray from a triangle. That needs only points,
//! edges and the inside, and does not use the code that lowers cutters, so it is an independent proof.

use super::triangle_columns::TriangleColumns;
use crate::stock::{AirClip, Mesh};
use nalgebra::Vector3;

type Triangle = [Vector3<f64>; 3];

/// The clearance of a path over a mesh, in mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathClearance {
    /// The least distance of the mesh from the cutter's ray, minus the radius. It is negative if the mesh is
    /// inside the cutter.
    pub low_mm: f64,
    /// The tip at which this is so.
    pub low_at_mm: [f64; 3],
    /// The largest distance along the path, minus the radius.
    pub high_mm: f64,
    /// The tip at which this is so.
    pub high_at_mm: [f64; 3],
}

/// A mesh that is sorted in square columns for a ball.
#[derive(Debug, Clone)]
pub(crate) struct BallClearanceField {
    radius: f64,
    columns: TriangleColumns,
    triangles: Vec<(Triangle, Vector3<f64>, Vector3<f64>)>,
    /// Outside of it, the distance is more than the radius, which is the most that is told.
    air: AirClip,
}

impl BallClearanceField {
    /// Sorts a mesh's triangles for a ball of `radius_mm`.
    pub(crate) fn new(mesh: &Mesh, radius_mm: f64) -> Self {
        let bounded = |corners: [[f64; 3]; 3]| {
            let [a, b, c] = corners.map(Vector3::from);
            ([a, b, c], a.inf(&b).inf(&c), a.sup(&b).sup(&c))
        };
        Self {
            radius: radius_mm,
            columns: TriangleColumns::new(mesh, radius_mm),
            triangles: mesh.triangle_vertices().map(bounded).collect(),
            air: AirClip::around_from_above(mesh.bounds(), 2.0 * radius_mm),
        }
    }

    /// Measures the clearance along a path of straight lines, every `step_mm` and at its points. Returns
    /// `None` for a path without points or with a number that is not finite.
    ///
    /// The distance of a point of the mesh from a cutter that moves straight is a convex function of the
    /// travel. So between two samples a point gets no deeper into the cutter than a ball's sagitta, `step^2 /
    /// (8 R)`.
    pub(crate) fn measure_clearance(&self, path: &[[f64; 3]], step_mm: f64) -> Option<PathClearance> {
        let first = path.first().filter(|_| path.iter().flatten().all(|value| value.is_finite()))?;
        let mut distance = self.clearance_at(*first, self.radius);
        let mut found =
            PathClearance { low_mm: distance, low_at_mm: *first, high_mm: distance, high_at_mm: *first };
        for pair in path.windows(2) {
            let [from, to] = pair else { continue };
            let [from, to] = [*from, *to].map(Vector3::from);
            let length = (to - from).norm();
            let count = (length / step_mm).ceil().max(1.0);
            let near = self.air.near_steps(from.into(), to.into(), count);
            let mut index = near[0];
            while index <= count {
                let tip: [f64; 3] = from.lerp(&to, index / count).into();
                // The distance cannot grow by more than the travel since the sample before.
                distance = self.clearance_at(tip, (distance + length / count + 1e-6).min(self.radius));
                if distance < found.low_mm {
                    (found.low_mm, found.low_at_mm) = (distance, tip);
                }
                if distance > found.high_mm {
                    (found.high_mm, found.high_at_mm) = (distance, tip);
                }
                index = AirClip::step_behind(index, near, count);
            }
        }
        Some(found)
    }

    /// Returns the distance of the mesh from the ray above the ball's centre, minus the radius, or `most` if
    /// it is more.
    fn clearance_at(&self, [x, y, z]: [f64; 3], most: f64) -> f64 {
        let centre = Vector3::new(x, y, z + self.radius);
        let reach = self.radius + most.max(0.0);
        let mut least = reach * reach;
        for column in self.columns.columns_within([x - reach, y - reach], [x + reach, y + reach]) {
            for index in column {
                if let Some((triangle, low, high)) = self.triangles.get(*index as usize)
                    && squared_distance_to_box(&centre, low, high) < least
                {
                    least = least.min(squared_distance_to_triangle(&centre, triangle));
                }
            }
        }
        least.sqrt() - self.radius
    }
}

/// Returns the squared distance between a box and the ray upwards from a point.
fn squared_distance_to_box(at: &Vector3<f64>, low: &Vector3<f64>, high: &Vector3<f64>) -> f64 {
    let beside = |value: f64, low: f64, high: f64| (low - value).max(value - high).max(0.0);
    let (x, y) = (beside(at.x, low.x, high.x), beside(at.y, low.y, high.y));
    let below = (at.z - high.z).max(0.0);
    x * x + y * y + below * below
}

/// Returns the squared distance between a triangle and the ray upwards from a point.
fn squared_distance_to_triangle(at: &Vector3<f64>, triangle: &Triangle) -> f64 {
    let [a, b, c] = *triangle;
    let normal = (b - a).cross(&(c - a));
    let sides = [(a, b), (b, c), (c, a)];
    let edges =
        sides.iter().map(|(from, to)| squared_distance_to_edge(at, from, to)).fold(f64::INFINITY, f64::min);
    // The ray's start is over the inside, seen along the normal: then its distance from the plane counts.
    let over = sides.iter().all(|(from, to)| normal.dot(&(to - from).cross(&(at - from))) >= 0.0);
    let square = normal.norm_squared();
    let start = if over && square > 0.0 { (at - a).dot(&normal).powi(2) / square } else { f64::INFINITY };
    // The ray's line passes the inside, seen from above, and the plane there is above the start: the ray goes
    // through the triangle.
    let turned = sides.map(|(from, to)| {
        let (side, from) = (to - from, at - from);
        side.x * from.y - side.y * from.x
    });
    let around = turned.iter().all(|turn| *turn >= 0.0) || turned.iter().all(|turn| *turn <= 0.0);
    if around && normal.z != 0.0 && (a - at).dot(&normal) / normal.z >= 0.0 {
        return 0.0;
    }
    edges.min(start)
}

/// Returns the squared distance between an edge and the ray upwards from a point. It is the horizontal
/// distance where the ray is beside the edge, else the distance from the ray's start.
fn squared_distance_to_edge(at: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    let side = to - from;
    let nearest = |share: f64| from + side * share.clamp(0.0, 1.0);
    let level = side.x * side.x + side.y * side.y;
    // The point of the edge that is nearest to the endless vertical line.
    let beside =
        if level > 0.0 { ((at.x - from.x) * side.x + (at.y - from.y) * side.y) / level } else { 0.0 };
    let place = nearest(beside);
    let highest = if level > 0.0 { place.z } else { from.z.max(to.z) };
    if highest >= at.z {
        return (place.x - at.x).powi(2) + (place.y - at.y).powi(2);
    }
    let square = side.norm_squared();
    let share = if square > 0.0 { (at - from).dot(&side) / square } else { 0.0 };
    let start = (nearest(share) - at).norm_squared();
    // An edge that rises past the height of the start is beside the ray from there on.
    let rises = if side.z != 0.0 { (at.z - from.z) / side.z } else { f64::NAN };
    if (0.0..=1.0).contains(&rises) {
        let place = from + side * rises;
        return start.min((place.x - at.x).powi(2) + (place.y - at.y).powi(2));
    }
    start
}
