//! This module finds the parts of a profile that a ball cannot touch.

use super::ball_compensation::{BallCompensationError, EnvelopeEnd, check_radius, make_centre_envelope};
use super::chain::Chain;
use super::chain_piece::{ChainPiece, Point};
use super::graph_segment::{GraphSegment, HeightGraph, PiecePart, UPRIGHT};
use std::f64::consts::TAU;

/// A part of a profile that the ball does not touch: a corner or hollow that is tighter than the ball, or a
/// part under an overhang.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnreachablePart {
    /// The index of the piece in which it begins.
    pub first: usize,
    /// The index of the piece in which it ends.
    pub last: usize,
    /// The point at which it begins.
    pub from: Point,
    /// The point at which it ends.
    pub to: Point,
    /// The thickness of the material that is left, mm: the distance of the part's furthest point from the
    /// ball in its positions beside the part.
    pub left_mm: f64,
}

/// A part of a piece that the ball touches, with the fraction of the piece's length and the ball's centre at
/// both ends.
struct TouchedPart {
    piece: usize,
    from: (f64, Point),
    to: (f64, Point),
}

/// Finds the parts of `profile` that a ball of `radius_mm` does not touch and where more than `tolerance_mm`
/// is left, in the order of the profile.
///
/// Walls are touched by the side of the ball where it goes up or down beside them. The remaining thickness is
/// measured at the ends of pieces, and at the middle and the quarters of arcs.
///
/// ```
/// use clsmith::internals::surface::profile::{Chain, Point, find_unreachable_parts};
///
/// let groove = [[0.0, 0.0], [10.0, 0.0], [11.0, -5.0], [12.0, 0.0], [22.0, 0.0]];
/// let groove = Chain::from_points(&groove.map(|[u, z]| Point::new(u, z)))?;
/// // A ball of 3 mm radius does not reach the ground of a groove that is 2 mm wide.
/// let parts = find_unreachable_parts(&groove, 3.0, 0.01)?;
/// assert_eq!(parts.len(), 1);
/// assert!(parts[0].left_mm > 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns a [`BallCompensationError`] in the same cases as
/// [`compensate_profile`](super::compensate_profile).
pub fn find_unreachable_parts(
    profile: &Chain,
    radius_mm: f64,
    tolerance_mm: f64,
) -> Result<Vec<UnreachablePart>, BallCompensationError> {
    check_radius(radius_mm)?;
    let mut touches = find_touched_parts(profile, radius_mm);
    touches.sort_by(|a, b| a.piece.cmp(&b.piece).then(a.from.0.total_cmp(&b.from.0)));
    let mut found = Vec::new();
    // An unreachable part goes from the furthest end of all touched parts so far (or the chain's start) to
    // the start of the next one.
    let mut reached: (usize, f64, Option<Point>) = (0, 0.0, None);
    let end = (profile.pieces().len().saturating_sub(1), 1.0);
    let stops = touches.iter().map(|touch| (touch.piece, touch.from.0, Some(touch.from.1)));
    let stops = stops.chain([(end.0, end.1, None)]);
    let nexts = touches.iter().map(|touch| (touch.piece, touch.to.0, Some(touch.to.1)));
    for (stop, next) in stops.zip(nexts.map(Some).chain([None])) {
        let balls = [reached.2, stop.2];
        if (stop.0, stop.1) > (reached.0, reached.1) {
            found.extend(
                measure_unreachable_part(profile, (reached.0, reached.1), (stop.0, stop.1), balls, radius_mm)
                    .filter(|part| part.left_mm > tolerance_mm),
            );
        }
        if let Some(next) = next
            && (next.0 > reached.0 || (next.0 == reached.0 && next.1 >= reached.1))
        {
            reached = next;
        }
    }
    Ok(found)
}

/// Measures the part between two positions on the chain, or returns `None` if it has no length.
fn measure_unreachable_part(
    profile: &Chain,
    from: (usize, f64),
    to: (usize, f64),
    balls: [Option<Point>; 2],
    radius: f64,
) -> Option<UnreachablePart> {
    let mut left = 0.0_f64;
    let mut look = |point: Point| {
        let near = balls.iter().flatten().map(|ball| ball.distance(point)).fold(f64::INFINITY, f64::min);
        // A ball that goes straight from one position to the other passes all points between.
        let near = match balls {
            [Some(a), Some(b)]
                if (a.u - b.u).abs() <= UPRIGHT && (a.z.min(b.z)..=a.z.max(b.z)).contains(&point.z) =>
            {
                near.min((point.u - a.u).abs())
            }
            _ => near,
        };
        left = left.max(near - radius);
    };
    let mut bounds: Option<(usize, Point, usize, Point)> = None;
    for (index, piece) in profile.pieces().iter().enumerate().take(to.0 + 1).skip(from.0) {
        let begin = if index == from.0 { from.1 } else { 0.0 };
        let end = if index == to.0 { to.1 } else { 1.0 };
        if (end - begin) * piece.length_mm() <= UPRIGHT {
            continue;
        }
        let (start, stop) = (piece.point_at(begin), piece.point_at(end));
        look(start);
        look(stop);
        if matches!(piece, ChainPiece::Arc(_)) {
            for share in [0.25, 0.5, 0.75] {
                look(piece.point_at(begin + (end - begin) * share));
            }
        }
        bounds = Some(match bounds {
            None => (index, start, index, stop),
            Some((first, at, ..)) => (first, at, index, stop),
        });
    }
    bounds.map(|(first, from, last, to)| UnreachablePart { first, last, from, to, left_mm: left })
}

/// Finds the parts that the ball touches.
fn find_touched_parts(profile: &Chain, radius: f64) -> Vec<TouchedPart> {
    let envelope = make_centre_envelope(profile, radius);
    let mut touches = Vec::with_capacity(envelope.stretches.len());
    let mut before: Option<&GraphSegment> = None;
    for stretch in &envelope.stretches {
        if let Some(piece) = profile.pieces().get(stretch.piece) {
            let at = |centre: Point| (fraction_along(piece, contact_point(stretch, centre, radius)), centre);
            touches.push(make_touched_part(stretch.piece, at(stretch.left), at(stretch.right)));
        }
        if let Some(before) = before {
            let (from, to) = (before.right.z, stretch.left.z);
            let (wall, side) = if to > from { (stretch, radius) } else { (before, -radius) };
            add_touched_walls(&mut touches, profile, wall.piece, stretch.left.u, side, [from, to]);
        }
        before = Some(stretch);
    }
    // The ball's side also touches walls down to the chain's ends.
    for (end, stretch, high) in
        [(envelope.low, envelope.stretches.first(), false), (envelope.high, envelope.stretches.last(), true)]
    {
        if let (EnvelopeEnd::Wall(foot), Some(stretch)) = (end, stretch) {
            let top = if high { stretch.right } else { stretch.left };
            let side = if high { -radius } else { radius };
            add_touched_walls(&mut touches, profile, stretch.piece, top.u, side, [foot, top.z]);
            // The foot counts even if the wall is not exactly vertical.
            let at_end = high == envelope.forward;
            let last = profile.pieces().len().saturating_sub(1);
            let (piece, share) = if at_end { (last, 1.0) } else { (0, 0.0) };
            let ball = Point::new(top.u, foot.min(top.z));
            touches.push(TouchedPart { piece, from: (share, ball), to: (share, ball) });
        }
    }
    touches
}

fn make_touched_part(piece: usize, a: (f64, Point), b: (f64, Point)) -> TouchedPart {
    let (from, to) = if a.0 <= b.0 { (a, b) } else { (b, a) };
    TouchedPart { piece, from, to }
}

/// Adds the parts of vertical pieces around `piece` that the ball's side touches while its centre moves
/// between two heights at u.
fn add_touched_walls(
    touches: &mut Vec<TouchedPart>,
    profile: &Chain,
    piece: usize,
    u: f64,
    side: f64,
    heights: [f64; 2],
) {
    let [a, b] = heights;
    let (low, high) = (a.min(b), a.max(b));
    if high - low <= UPRIGHT {
        return;
    }
    let pieces = profile.pieces();
    let stands = |index: &usize| {
        pieces.get(*index).is_some_and(|piece| {
            let near = |point: Point| (point.u - (u + side)).abs() <= 2.0 * UPRIGHT;
            matches!(piece, ChainPiece::Line(_)) && near(piece.start()) && near(piece.end())
        })
    };
    // The top of a wall may belong to the vertical piece or to its neighbour on either side.
    let before = (0..piece).rev().take_while(stands);
    let after = (piece + 1..pieces.len()).take_while(stands);
    for index in before.chain(after).chain(Some(piece).filter(stands)) {
        let Some(wall) = pieces.get(index) else { continue };
        let (bottom, top) = (wall.start().z.min(wall.end().z), wall.start().z.max(wall.end().z));
        let (from, to) = (low.max(bottom), high.min(top));
        if from < to {
            let at = |z: f64| (fraction_along(wall, Point::new(u + side, z)), Point::new(u, z));
            touches.push(make_touched_part(index, at(from), at(to)));
        }
    }
}

/// Returns the point that the ball touches when its centre is at a point of a segment.
fn contact_point(stretch: &GraphSegment, centre: Point, radius: f64) -> Point {
    match (stretch.part, stretch.graph) {
        (PiecePart::Vertex, HeightGraph::Round { centre: vertex, .. }) => vertex,
        // The inverse of the offset: back from the centre's arc or line by the ball's radius.
        (_, HeightGraph::Round { centre: middle, radius: offset, upper }) => {
            let was = if upper { offset - radius } else { offset + radius };
            middle.lerp(centre, was / offset)
        }
        (_, HeightGraph::Line { left, right }) => {
            let share = radius / left.distance(right);
            Point::new(centre.u - (left.z - right.z) * share, centre.z - (right.u - left.u) * share)
        }
    }
}

/// Returns the position of a point on a piece as a fraction of the piece's length.
fn fraction_along(piece: &ChainPiece, point: Point) -> f64 {
    match piece {
        ChainPiece::Line(line) => {
            let (du, dz) = (line.to.u - line.from.u, line.to.z - line.from.z);
            let square = du * du + dz * dz;
            if square <= 0.0 {
                return 0.0;
            }
            (((point.u - line.from.u) * du + (point.z - line.from.z) * dz) / square).clamp(0.0, 1.0)
        }
        ChainPiece::Arc(arc) => {
            let angle = (point.z - arc.centre.z).atan2(point.u - arc.centre.u);
            let along = ((angle - arc.start_rad) * arc.sweep_rad.signum()).rem_euclid(TAU);
            let sweep = arc.sweep_rad.abs();
            if sweep <= 0.0 {
                return 0.0;
            }
            // A point that is beyond an end by rounding belongs to the nearer end.
            if along <= sweep {
                along / sweep
            } else if along - sweep < TAU - along {
                1.0
            } else {
                0.0
            }
        }
    }
}
