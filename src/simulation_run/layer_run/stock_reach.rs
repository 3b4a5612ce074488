//! Whether a piece of path can touch the stock at all.

use crate::layered_chips::FlatMill;
use crate::sim::PathPiece;
use nalgebra::Point3;

/// Lower and upper corner of a box, mm.
type StockBox = ([f64; 3], [f64; 3]);

/// Whether a mill's flutes can be inside the box of the stock anywhere on a piece; `true` when in doubt.
///
/// The box around the flutes at both ends, grown by the radius and by how far a turn takes the upper end out of the straight line
/// between its places. A piece that cannot be modelled is no matter where there is nothing to cut.
pub(super) fn can_reach_stock(piece: &PathPiece, mill: &FlatMill, stock: StockBox) -> bool {
    let turn = piece.from.axis.angle(&piece.to.axis);
    let grown = mill.radius + mill.flutes * (1.0 - (turn / 2.0).cos());
    let points: [Point3<f64>; 4] = [
        piece.from.point,
        piece.to.point,
        piece.from.point + piece.from.axis * mill.flutes,
        piece.to.point + piece.to.axis * mill.flutes,
    ];
    let (low, high) = stock;
    low.iter().zip(&high).enumerate().all(|(side, (low, high))| {
        let along = points.iter().filter_map(|point| point.coords.get(side).copied());
        let (least, most) =
            along.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), at| (a.min(at), b.max(at)));
        !(least - grown > *high || most + grown < *low)
    })
}
