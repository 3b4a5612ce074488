//! This module tells how low the tool may go around passes, as far as their profiles show it.

use crate::surface::profile::{Chain, ChainPiece, Point, ProfilePlane};
use nalgebra::Point3;

/// Returns the lowest height of the tip along the tool axis at a point that lies in the plane of a pass.
/// Passes are given as their planes and the exact paths of the tip. `lift` (mm) is added for the centre of
/// the ball. Returns `None` if no pass lies there.
pub(super) fn lowest_tip_height_mm<'a>(
    passes: impl Iterator<Item = (&'a ProfilePlane, &'a Chain)>,
    lift: f64,
    at: Point3<f64>,
) -> Option<f64> {
    let one = |(plane, exact): (&ProfilePlane, &Chain)| {
        // A profile only describes the part in its own plane. Beside it nothing is known.
        if plane.signed_distance_mm(at).abs() > 0.01 {
            return None;
        }
        let flat = plane.to_plane(at);
        let top = exact
            .pieces()
            .iter()
            .filter_map(|piece| highest_z_at(piece, flat.u))
            .fold(f64::NEG_INFINITY, f64::max);
        let up = plane.to_space(Point::new(0.0, 1.0)) - plane.to_space(Point::default());
        top.is_finite().then(|| plane.to_space(Point::new(flat.u, top + lift)).coords.dot(&up))
    };
    passes.filter_map(one).reduce(f64::max)
}

/// Returns the highest point of a piece at `u`. Arcs are approximated by a hundred chords, which is enough
/// for clearance.
fn highest_z_at(piece: &ChainPiece, u: f64) -> Option<f64> {
    let count = if matches!(piece, ChainPiece::Arc(_)) { 100 } else { 1 };
    let point = |part: usize| piece.point_at(part as f64 / count as f64);
    let part = |part: usize| {
        let (a, b) = (point(part), point(part + 1));
        let inside = (a.u.min(b.u) - 1e-9..=a.u.max(b.u) + 1e-9).contains(&u);
        inside.then(|| {
            if (b.u - a.u).abs() < 1e-9 { a.z.max(b.z) } else { a.lerp(b, (u - a.u) / (b.u - a.u)).z }
        })
    };
    (0..count).filter_map(part).reduce(f64::max)
}
