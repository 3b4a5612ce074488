//! From contact points to the path of the ball's tip, and back.

use super::chain::{Chain, LARGEST};
use super::chain_piece::{ChainPiece, Point};
use super::graph_segment::{GraphSegment, HeightGraph, PiecePart, UPRIGHT};
use super::rolling_ball::roll_ball;
use super::upper_envelope::{UpperEnvelope, find_upper_envelope};

/// The smallest radius of a ball, mm: a thousand times what pieces of a chain may be apart.
pub const SMALLEST_BALL: f64 = 1e-3;

/// Ends of a path closer than this (mm) need no line between them.
const MEETS: f64 = 1e-10;

/// A chain's end this near (mm) to the outermost place is beside it: files round places to a ten-thousandth.
const BESIDE: f64 = 1e-3;

/// Why there is no path.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum BallCompensationError {
    /// The ball's radius cannot be used.
    #[error("a ball of radius {0} mm: it must be from {SMALLEST_BALL} to {LARGEST:e} mm")]
    Radius(f64),
}

/// The path of the tip (the south pole) of a ball of `radius` mm that touches `profile` from above everywhere it can:
/// `z(u) = max over q with |u - q_u| <= R of q_z + sqrt(R^2 - (u - q_u)^2) - R`.
///
/// The path is exact: lines, offset arcs of arcs (larger by R where the profile bulges, smaller where it is hollow), and arcs
/// of radius R about corners. Loops at hollow corners are gone; where the height jumps (beside walls, below overhangs) the
/// path goes straight up or down. It runs the way the profile runs from start to end in u. Distances between path and envelope
/// stay below 1e-9 mm for parts up to a metre (rounding, and pieces narrower than 1e-9 mm count as upright); a difference of
/// height is larger only where the path is steep.
///
/// Where the path starts and ends: the ball stands on the profile's free end with the end's own normal, so the tip is at
/// `u - R sin U`; where something in front keeps it away from there, it stands where it touches both. It does not roll about a free
/// end. A wall up to the end is followed to its top, a wall down at the end to its foot. Where the profile's end lies under the
/// profile itself (by more than 0.001 mm), the path goes to where the ball's side leaves the outermost place.
///
/// Seen from above only the highest points matter; [`find_unreachable_parts`](super::find_unreachable_parts) tells what the ball does not touch.
///
/// O(n) for profiles that never turn back in u, else O(n log n). Source: Dragoi 2009, section 3, with the offset's loops removed.
///
/// # Errors
/// [`BallCompensationError`] when the radius is not from [`SMALLEST_BALL`] to [`LARGEST`].
pub fn compensate_profile(profile: &Chain, radius: f64) -> Result<Chain, BallCompensationError> {
    check_radius(radius)?;
    Ok(make_centre_path(profile, radius).centre_to_tip(radius))
}

/// The contact profile that a ball of `was_radius` mm leaves when its tip follows `tip`: the inverse of [`compensate_profile`], and
/// the same with z turned over. Of a path that gouges, what is left is lower than what was meant.
///
/// # Errors
/// [`BallCompensationError`] when the radius is not from [`SMALLEST_BALL`] to [`LARGEST`].
pub fn recover_profile(tip: &Chain, was_radius: f64) -> Result<Chain, BallCompensationError> {
    Ok(compensate_profile(&tip.flipped(), was_radius)?.flipped())
}

pub(super) fn check_radius(radius: f64) -> Result<(), BallCompensationError> {
    if (SMALLEST_BALL..=LARGEST).contains(&radius) {
        Ok(())
    } else {
        Err(BallCompensationError::Radius(radius))
    }
}

/// The envelope of a ball's centre over a chain, and how it ends on either side.
pub(super) struct CentreEnvelope {
    pub stretches: Vec<GraphSegment>,
    pub low: EnvelopeEnd,
    pub high: EnvelopeEnd,
    pub forward: bool,
}

/// How the envelope ends on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum EnvelopeEnd {
    /// At the chain's free end: the ball does not roll about it.
    Free(Point),
    /// Beside a wall that goes down to the chain's end at this height.
    Wall(f64),
    /// At a place of the chain that is not its end.
    Nose,
}

/// The envelope over the whole chain, nothing trimmed.
pub(super) fn make_centre_envelope(chain: &Chain, radius: f64) -> CentreEnvelope {
    let sky = find_upper_envelope(chain);
    let forward = chain.end().u >= chain.start().u;
    let (first, last) = (chain.pieces().first(), chain.pieces().last());
    let (low_piece, high_piece) = if forward { (first, last) } else { (last, first) };
    let (low, high) = if forward { (chain.start(), chain.end()) } else { (chain.end(), chain.start()) };
    let outer = |side: f64| outermost_point(&sky, side).unwrap_or(low);
    let (left, right) = (outer(-1.0), outer(1.0));
    let scale = sky.stretches.iter().map(largest_coordinate).fold(0.0, f64::max);
    let scale = sky.tops.iter().map(|(top, _)| top.u.abs().max(top.z.abs())).fold(scale, f64::max);
    CentreEnvelope {
        low: classify_end(low, low_piece, left),
        high: classify_end(high, high_piece, right),
        stretches: roll_ball(&sky, radius, scale),
        forward,
    }
}

fn largest_coordinate(stretch: &GraphSegment) -> f64 {
    let place = stretch.left.u.abs().max(stretch.right.u.abs());
    match stretch.graph {
        HeightGraph::Line { left, right } => place.max(left.z.abs()).max(right.z.abs()),
        HeightGraph::Round { centre, radius, .. } => place.max(centre.z.abs()).max(radius),
    }
}

/// The highest point at the skyline's end on one side (-1 left, 1 right).
fn outermost_point(sky: &UpperEnvelope, side: f64) -> Option<Point> {
    let stretch = if side < 0.0 { sky.stretches.first() } else { sky.stretches.last() };
    let of_stretch = stretch.map(|stretch| if side < 0.0 { stretch.left } else { stretch.right });
    let of_tops = if side < 0.0 { sky.tops.first() } else { sky.tops.last() };
    let far = of_stretch.into_iter().chain(of_tops.map(|(top, _)| *top)).map(|point| point.u * side);
    let far = far.fold(f64::NEG_INFINITY, f64::max);
    let near = |point: &Point| point.u * side >= far - UPRIGHT;
    // Tops are sorted by u, so those at the end are together.
    let tops: &mut dyn Iterator<Item = &(Point, usize)> =
        if side < 0.0 { &mut sky.tops.iter() } else { &mut sky.tops.iter().rev() };
    let tops = tops.map(|(top, _)| *top).take_while(near);
    tops.chain(of_stretch.filter(near)).max_by(|a, b| a.z.total_cmp(&b.z))
}

fn classify_end(free: Point, piece: Option<&ChainPiece>, outer: Point) -> EnvelopeEnd {
    if free.distance(outer) <= BESIDE {
        return EnvelopeEnd::Free(outer);
    }
    let upright = piece.is_some_and(|piece| (piece.start().u - piece.end().u).abs() <= BESIDE);
    let below = (free.u - outer.u).abs() <= BESIDE && free.z < outer.z;
    if below && upright { EnvelopeEnd::Wall(free.z) } else { EnvelopeEnd::Nose }
}

/// The path of the centre.
pub(super) fn make_centre_path(chain: &Chain, radius: f64) -> Chain {
    let CentreEnvelope { mut stretches, low, high, forward } = make_centre_envelope(chain, radius);
    let about = |stretch: &GraphSegment, free: Point| match stretch.graph {
        HeightGraph::Round { centre, .. } => {
            stretch.part == PiecePart::Vertex
                && (centre.u - free.u).abs() <= UPRIGHT
                && (centre.z - free.z).abs() <= UPRIGHT
        }
        HeightGraph::Line { .. } => false,
    };
    let mut start = stretches.first().map(|stretch| stretch.left);
    let mut stop = stretches.last().map(|stretch| stretch.right);
    if let EnvelopeEnd::Free(free) = high {
        while let Some(cap) = stretches.pop_if(|stretch| about(stretch, free)) {
            stop = Some(cap.left);
        }
    }
    let mut dropped = 0;
    if let EnvelopeEnd::Free(free) = low {
        for cap in stretches.iter().take_while(|stretch| about(stretch, free)) {
            start = Some(cap.right);
            dropped += 1;
        }
        // A chain of no extent has one cap for both ends, and the ball stands on it.
        if stretches.is_empty()
            && let EnvelopeEnd::Free(other) = high
            && other.distance(free) <= UPRIGHT
        {
            start = Some(Point::new(free.u, free.z + radius));
            stop = start;
        }
    }
    if let (EnvelopeEnd::Wall(foot), Some(top)) = (low, start) {
        start = Some(Point::new(top.u, foot.min(top.z)));
    }
    if let (EnvelopeEnd::Wall(foot), Some(top)) = (high, stop) {
        stop = Some(Point::new(top.u, foot.min(top.z)));
    }
    if stretches.len() == dropped && start.is_some_and(|start| stop.is_some_and(|stop| stop.u < start.u)) {
        start = stop;
    }
    join_segments(stretches.get(dropped..).unwrap_or_default(), start, stop, forward)
}

/// The chain of stretches between two points, with straight lines where they do not meet.
fn join_segments(
    stretches: &[GraphSegment],
    start: Option<Point>,
    stop: Option<Point>,
    forward: bool,
) -> Chain {
    let mut pieces: Vec<ChainPiece> = Vec::with_capacity(stretches.len() + 2);
    let mut reached = start;
    let mut bridge = |pieces: &mut Vec<ChainPiece>, to: Point, end: Point| {
        if let Some(from) = reached.filter(|from| from.distance(to) > MEETS) {
            pieces.push(ChainPiece::line(from, to));
        }
        reached = Some(end);
    };
    for stretch in stretches {
        bridge(&mut pieces, stretch.left, stretch.right);
        pieces.push(stretch.to_piece());
    }
    if let Some(stop) = stop {
        bridge(&mut pieces, stop, stop);
        if pieces.is_empty() {
            pieces.push(ChainPiece::line(stop, stop));
        }
    }
    let chain = Chain::from_trusted(pieces);
    if forward { chain } else { chain.reversed() }
}
