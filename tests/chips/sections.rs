//! An independent look at sections: made in space and cut by half planes.

use super::brute;
use clsmith::engagement::PathPiece;
use clsmith::layered_chips::{FlatMill, Polygon};
use clsmith::program::geometry::Pose;
use nalgebra::{Point3, Rotation3, Unit, Vector3};

/// Corners of a sampled ellipse.
const CORNERS: usize = 360;

pub fn place(point: [f64; 3], axis: [f64; 3]) -> Pose {
    Pose { point: Point3::from(point), axis: Vector3::from(axis).normalize() }
}

pub fn piece(from: Pose, to: Pose) -> PathPiece {
    PathPiece { from, to, cutter: 0 }
}

/// The axis `tilt` degrees from upright towards `towards` degrees from x.
pub fn axis(tilt: f64, towards: f64) -> [f64; 3] {
    let (t, w) = (tilt.to_radians(), towards.to_radians());
    [t.sin() * w.cos(), t.sin() * w.sin(), t.cos()]
}

/// The place of the cutter at a time: the tip straight, the axis turned about the normal of both axes.
pub fn place_at(piece: &PathPiece, t: f64) -> Pose {
    let (from, to) = (piece.from.axis, piece.to.axis);
    let normal = from.cross(&to);
    let axis = match Unit::try_new(normal, 1e-14) {
        Some(normal) => Rotation3::from_axis_angle(&normal, from.angle(&to) * t) * from,
        None => from,
    };
    Pose { point: piece.from.point + (piece.to.point - piece.from.point) * t, axis }
}

/// The section of a mill at a place with the layer at z: lines of the cylinder that meet the layer, then cut by the planes of the ends.
pub fn section(mill: &FlatMill, place: &Pose, z: f64) -> Vec<[f64; 2]> {
    let a = place.axis;
    let u = a.cross(&if a.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() }).normalize();
    let v = a.cross(&u);
    let corner = |index: usize| {
        let angle = std::f64::consts::TAU * (index as f64 + 0.5) / CORNERS as f64;
        // A polygon of the same area as the circle.
        let grown =
            (std::f64::consts::TAU / CORNERS as f64 / (std::f64::consts::TAU / CORNERS as f64).sin()).sqrt();
        let line = place.point + (u * angle.cos() + v * angle.sin()) * (mill.radius_mm * grown);
        line + a * ((z - line.z) / a.z)
    };
    let mut corners: Vec<Point3<f64>> = (0..CORNERS).map(corner).collect();
    corners = half_plane(&corners, |p| (p - place.point).dot(&a));
    if mill.flute_length_mm.is_finite() {
        corners = half_plane(&corners, |p| mill.flute_length_mm - (p - place.point).dot(&a));
    }
    corners.into_iter().map(|p| [p.x, p.y]).collect()
}

fn half_plane(corners: &[Point3<f64>], height: impl Fn(&Point3<f64>) -> f64) -> Vec<Point3<f64>> {
    let mut kept = Vec::new();
    for (index, a) in corners.iter().enumerate() {
        let b = &corners[(index + 1) % corners.len()];
        let (ha, hb) = (height(a), height(b));
        if ha >= 0.0 {
            kept.push(*a);
        }
        if (ha >= 0.0) != (hb >= 0.0) {
            kept.push(a + (b - a) * (ha / (ha - hb)));
        }
    }
    kept
}

/// What a mill covers on a layer and did not cover at the beginning: the union of sections at `count` times less the first.
pub fn fresh(mill: &FlatMill, piece: &PathPiece, z: f64, count: usize) -> Vec<Polygon> {
    let at = |index: usize| section(mill, &place_at(piece, index as f64 / count as f64), z);
    let sections: Vec<Vec<[f64; 2]>> = (0..=count).map(at).filter(|border| border.len() > 2).collect();
    let first: Vec<Vec<[f64; 2]>> = [at(0)].into_iter().filter(|border| border.len() > 2).collect();
    brute::difference(&brute::dense_union(&sections), &brute::dense_union(&first))
}

/// A block as stock.
pub fn block(from: [f64; 3], to: [f64; 3]) -> clsmith::stock::Stock {
    clsmith::stock::Stock::new(vec![clsmith::stock::SolidBody::Block { from, to }], 0.0).unwrap()
}
