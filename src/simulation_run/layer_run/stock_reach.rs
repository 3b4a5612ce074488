//! This module decides whether a piece of path can touch the stock at all.

use crate::engagement::PathPiece;
use crate::layered_chips::FlatMill;
use crate::stock::AxisBox;
use nalgebra::Point3;

/// Returns whether a mill's flutes can be inside the box of the stock anywhere on a piece; `true` if in
/// doubt.
///
/// The test uses the box around the flutes at both ends, grown by the radius and by the distance of the
/// turning upper end from its chord. A piece that cannot be modelled does not matter if it has nothing to
/// cut.
pub(super) fn can_reach_stock(piece: &PathPiece, mill: &FlatMill, stock: AxisBox) -> bool {
    let turn = piece.from.axis.angle(&piece.to.axis);
    // A point at the length L turns on an arc whose sagitta is L (1 - cos(turn / 2)).
    let grown = mill.radius_mm + mill.flute_length_mm * (1.0 - (turn / 2.0).cos());
    let points: [Point3<f64>; 4] = [
        piece.from.point,
        piece.to.point,
        piece.from.point + piece.from.axis * mill.flute_length_mm,
        piece.to.point + piece.to.axis * mill.flute_length_mm,
    ];
    let (low, high) = stock;
    low.iter().zip(&high).enumerate().all(|(side, (low, high))| {
        let along = points.iter().filter_map(|point| point.coords.get(side).copied());
        let (least, most) =
            along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), at| (a.min(at), b.max(at)));
        // Written with `!` so that a number that is not finite counts as doubt.
        !(least - grown > *high || most + grown < *low)
    })
}
