//! This module cuts a chain where it passes vertical lines and a level, and keeps the wanted parts.

use crate::surface::profile::{Chain, ChainPiece, Point};
use std::f64::consts::{PI, TAU};

/// Parts that are shorter than this are rounding, mm.
const SHORTEST: f64 = 1e-9;

/// Cuts a chain at every u of `upright` and at the height `level`, and returns the connected parts whose
/// middles are wanted.
pub(super) fn cut_chain(
    chain: &Chain,
    upright: &[f64],
    level: f64,
    wanted: impl Fn(Point) -> bool,
) -> Vec<Chain> {
    let mut parts: Vec<Vec<ChainPiece>> = Vec::new();
    let mut open = false;
    for piece in chain.pieces() {
        // Sorted fractions of all crossings divide the piece in parts that are wanted or not as a whole.
        let mut shares = vec![0.0, 1.0];
        for u in upright {
            shares.extend(find_crossing_fractions(piece, |point| point.u, *u, 0.0));
        }
        shares.extend(find_crossing_fractions(piece, |point| point.z, level, PI / 2.0));
        shares.sort_unstable_by(f64::total_cmp);
        for pair in shares.windows(2) {
            let [from, to] = *pair else { continue };
            let length = piece.length_mm();
            if (to - from) * length < SHORTEST && length >= SHORTEST {
                continue;
            }
            if !wanted(piece.point_at(f64::midpoint(from, to))) {
                open = false;
                continue;
            }
            // A piece that is not cut stays the same to the last bit.
            let part = if from == 0.0 && to == 1.0 { *piece } else { piece.sub_piece(from, to) };
            match parts.last_mut().filter(|_| open) {
                Some(last) => last.push(part),
                None => parts.push(vec![part]),
            }
            open = true;
        }
    }
    parts.into_iter().filter_map(|pieces| Chain::new(pieces).ok()).collect()
}

/// Returns the fractions of a piece's length at which a coordinate has a value. `turn` is the angle from the
/// coordinate's direction to +u.
fn find_crossing_fractions(
    piece: &ChainPiece,
    coordinate: impl Fn(Point) -> f64,
    value: f64,
    turn: f64,
) -> Vec<f64> {
    let inside = |share: &f64| *share > 0.0 && *share < 1.0;
    match piece {
        ChainPiece::Line(line) => {
            let (from, to) = (coordinate(line.from), coordinate(line.to));
            // A line along which the coordinate is constant gives a fraction that is not finite.
            [(value - from) / (to - from)].into_iter().filter(inside).collect()
        }
        ChainPiece::Arc(arc) => {
            // The coordinate on the circle is c + R cos(angle - turn), so it has the value at two angles.
            let cosine = (value - coordinate(arc.centre)) / arc.radius_mm;
            if cosine.abs() > 1.0 {
                return Vec::new();
            }
            let half = cosine.acos();
            let angles =
                [turn + half, turn - half].into_iter().flat_map(|angle| [angle - TAU, angle, angle + TAU]);
            let share = |angle: f64| {
                // Both angles count from the start of the arc, and may be up to two turns away from it.
                let start = arc.start_rad.rem_euclid(TAU);
                (angle - start) / arc.sweep_rad
            };
            angles.map(share).filter(inside).collect()
        }
    }
}
