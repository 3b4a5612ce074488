//! The envelope by brute force, for comparison.

use clsmith::internals::surface::profile::{Chain, ChainPiece, Point};

/// A chain through points.
pub fn polyline(points: &[[f64; 2]]) -> Chain {
    Chain::from_points(&points.iter().map(|[u, z]| Point::new(*u, *z)).collect::<Vec<_>>()).unwrap()
}

/// How far a centre is from the swept-out part: the least distance of its upward ray from the chain, in closed form for
/// each piece (segments and arcs cut finely would do as well, but not to 1e-9).
pub fn clearance(profile: &Chain, centre: Point) -> f64 {
    profile.pieces().iter().map(|piece| from_piece(piece, centre)).fold(f64::INFINITY, f64::min)
}

fn from_point(point: Point, centre: Point) -> f64 {
    (point.u - centre.u).abs().hypot((centre.z - point.z).max(0.0))
}

fn from_piece(piece: &ChainPiece, centre: Point) -> f64 {
    let mut best = from_point(piece.start(), centre).min(from_point(piece.end(), centre));
    // Where the piece crosses the ray or is level with the centre the distance is from the ray's foot or zero.
    match piece {
        ChainPiece::Line(line) => {
            let (du, dz) = (line.to.u - line.from.u, line.to.z - line.from.z);
            let square = du * du + dz * dz;
            let mut shares = vec![
                ((centre.u - line.from.u) * du + (centre.z - line.from.z) * dz) / square,
                (centre.u - line.from.u) / du,
                (centre.z - line.from.z) / dz,
            ];
            shares.retain(|share| (0.0..=1.0).contains(share));
            for share in shares {
                best = best.min(from_point(piece.point_at(share), centre));
            }
        }
        ChainPiece::Arc(arc) => {
            let towards = (centre.z - arc.centre.z).atan2(centre.u - arc.centre.u);
            let level = ((centre.z - arc.centre.z) / arc.radius_mm).asin();
            let over = ((centre.u - arc.centre.u) / arc.radius_mm).acos();
            let pi = std::f64::consts::PI;
            for angle in [towards, towards + pi, level, pi - level, over, -over, 0.0, pi] {
                let share = ((angle - arc.start_rad) * arc.sweep_rad.signum()).rem_euclid(2.0 * pi)
                    / arc.sweep_rad.abs();
                if (0.0..=1.0).contains(&share) {
                    best = best.min(from_point(piece.point_at(share), centre));
                }
            }
        }
    }
    best
}

/// The height of a chain that runs one way in u, at u; the higher one where it stands upright.
pub fn height(chain: &Chain, u: f64) -> Option<f64> {
    let mut best: Option<f64> = None;
    for piece in chain.pieces() {
        let z = match piece {
            ChainPiece::Line(line) => {
                let (low, high) = (line.from.u.min(line.to.u), line.from.u.max(line.to.u));
                if u < low || u > high {
                    continue;
                }
                if high - low < 1e-9 {
                    line.from.z.max(line.to.z)
                } else {
                    line.from.z + (u - line.from.u) / (line.to.u - line.from.u) * (line.to.z - line.from.z)
                }
            }
            ChainPiece::Arc(arc) => {
                let (a, b) = (piece.start().u, piece.end().u);
                if u < a.min(b) || u > a.max(b) {
                    continue;
                }
                let across = u - arc.centre.u;
                let root = (arc.radius_mm * arc.radius_mm - across * across).max(0.0).sqrt();
                let upper = (arc.start_rad + arc.sweep_rad / 2.0).sin() > 0.0;
                arc.centre.z + if upper { root } else { -root }
            }
        };
        best = Some(best.map_or(z, |best| best.max(z)));
    }
    best
}

/// Checks that a tip path touches the profile everywhere and gouges nowhere, within `tolerance`, in closed form at
/// samples of the path.
pub fn assert_touches(profile: &Chain, tip: &Chain, radius: f64, tolerance: f64) {
    for piece in tip.pieces() {
        let upright = (piece.start().u - piece.end().u).abs() < 1e-9;
        for index in 0..=8 {
            let point = piece.point_at(f64::from(index) / 8.0);
            let clear = clearance(profile, Point::new(point.u, point.z + radius)) - radius;
            assert!(clear > -tolerance, "gouge {clear} at {point:?} of {piece:?}");
            assert!(upright || clear < tolerance, "gap {clear} at {point:?} of {piece:?}");
        }
    }
}

/// Checks that pieces meet and run in one direction.
pub fn assert_runs(chain: &Chain, forward: bool) {
    Chain::new(chain.pieces().to_vec()).unwrap();
    let sense = if forward { 1.0 } else { -1.0 };
    for piece in chain.pieces() {
        assert!((piece.end().u - piece.start().u) * sense > -1e-9, "{piece:?}");
    }
}
