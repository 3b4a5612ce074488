//! How low the tool may go around passes, as far as their profiles tell.

use crate::surface::profile::{Chain, ChainPiece, Point, ProfilePlane};
use nalgebra::Point3;

/// The lowest that the tip may go at a place that lies in the plane of a pass, given as the planes and their exact paths of the tip; `lift`
/// (mm) higher for the centre. Counted along the tool axis; `None` where no pass is.
pub(super) fn lowest_tip_height_mm<'a>(
    passes: impl Iterator<Item = (&'a ProfilePlane, &'a Chain)>,
    lift: f64,
    at: Point3<f64>,
) -> Option<f64> {
    let one = |(plane, exact): (&ProfilePlane, &Chain)| {
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

/// The highest point of a piece at `u`; arcs by their chords of a hundredth, which is for clearance alone.
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
