//! This module converts contact points to the path of the ball's tip, and back.

use super::chain::{Chain, LARGEST};
use super::chain_piece::{ChainPiece, Point};
use super::graph_segment::{GraphSegment, HeightGraph, PiecePart, UPRIGHT};
use super::rolling_ball::roll_ball;
use super::upper_envelope::{UpperEnvelope, find_upper_envelope};

/// The smallest radius of a ball, mm. It is a thousand times the largest distance between pieces of a chain.
pub const SMALLEST_BALL: f64 = 1e-3;

/// Two ends of a path that are closer than this (mm) are not joined by a line.
const MEETS: f64 = 1e-10;

/// A chain's end that is this near (mm) to the outermost point counts as being there, because files round
/// coordinates to a ten-thousandth.
const BESIDE: f64 = 1e-3;

/// The reason why there is no path.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BallCompensationError {
    /// The ball's radius cannot be used.
    #[error("a ball of radius {0} mm: it must be from {SMALLEST_BALL} to {LARGEST:e} mm")]
    Radius(f64),
}

/// Returns the path of the tip (the south pole) of a ball of `radius_mm` that touches `profile` from above
/// wherever it can: `z(u) = max over q with |u - q_u| <= R of q_z + sqrt(R^2 - (u - q_u)^2) - R`.
///
/// The path is exact. It consists of lines, of offsets of arcs (larger by R where the profile is convex,
/// smaller where it is concave), and of arcs of radius R around convex vertices. There are no loops at
/// concave vertices. Where the height jumps, beside walls and below overhangs, the path goes straight up or
/// down. It has the direction of the profile in u. The path is within 1e-9 mm of the envelope for parts up to
/// a metre (rounding; pieces narrower than 1e-9 mm count as vertical). The difference in height is only
/// larger where the path is steep.
///
/// At the start and the end of the path, the ball touches the profile's free end with the normal of the end,
/// so the tip is at `u - R sin U`. If another part of the profile keeps it away from there, it is where it
/// touches both. It does not roll around a free end. A wall up to the end is followed to its top, a wall down
/// at the end to its foot. If the profile's end is below the profile itself (by more than 0.001 mm), the path
/// goes to where the ball's side leaves the outermost point.
///
/// Only the highest points over each u matter; [`find_unreachable_parts`](super::find_unreachable_parts)
/// finds the parts that the ball does not touch.
///
/// The cost is O(n) for profiles that never turn back in u, else O(n log n). The source is Dragoi 2009,
/// section 3, with the loops of the offset removed.
///
/// ```
/// use clsmith::internals::surface::profile::{Chain, Point, check_tip_path, compensate_profile};
///
/// let profile = Chain::from_points(&[Point::new(0.0, 0.0), Point::new(10.0, 0.0), Point::new(20.0, 10.0)])?;
/// let tip = compensate_profile(&profile, 2.0)?;
/// let measured = check_tip_path(&profile, &tip, 2.0, 0.01);
/// assert!(measured.gouge_mm < 1e-9);
/// // Driven as it is, the profile itself would let the ball cut into the slope.
/// assert!(check_tip_path(&profile, &profile, 2.0, 0.01).gouge_mm > 0.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns a [`BallCompensationError`] if the radius is not from [`SMALLEST_BALL`] to [`LARGEST`].
pub fn compensate_profile(profile: &Chain, radius_mm: f64) -> Result<Chain, BallCompensationError> {
    check_radius(radius_mm)?;
    Ok(make_centre_path(profile, radius_mm).centre_to_tip(radius_mm))
}

/// Returns the contact profile that a ball of `was_radius_mm` leaves if its tip follows `tip`. This is the
/// inverse of [`compensate_profile`], and the same computation with z mirrored. If the path gouges, the
/// result is lower than what was intended.
///
/// # Errors
/// Returns a [`BallCompensationError`] if the radius is not from [`SMALLEST_BALL`] to [`LARGEST`].
pub fn recover_profile(tip: &Chain, was_radius_mm: f64) -> Result<Chain, BallCompensationError> {
    Ok(compensate_profile(&tip.flipped(), was_radius_mm)?.flipped())
}

/// Checks that the ball's radius can be used.
pub(super) fn check_radius(radius: f64) -> Result<(), BallCompensationError> {
    if (SMALLEST_BALL..=LARGEST).contains(&radius) {
        Ok(())
    } else {
        Err(BallCompensationError::Radius(radius))
    }
}

/// The upper envelope of a ball's centre over a chain, and how it ends on both sides.
pub(super) struct CentreEnvelope {
    pub stretches: Vec<GraphSegment>,
    pub low: EnvelopeEnd,
    pub high: EnvelopeEnd,
    pub forward: bool,
}

/// The way in which the envelope ends on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum EnvelopeEnd {
    /// It ends at the chain's free end, and the ball does not roll around it.
    Free(Point),
    /// It ends beside a wall that goes down to the chain's end at this height.
    Wall(f64),
    /// It ends at a point of the chain that is not its end.
    Nose,
}

/// Computes the envelope over the whole chain, without trimming its ends.
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

/// Returns the largest absolute coordinate of a segment, from which rounding is estimated.
fn largest_coordinate(stretch: &GraphSegment) -> f64 {
    let place = stretch.left.u.abs().max(stretch.right.u.abs());
    match stretch.graph {
        HeightGraph::Line { left, right } => place.max(left.z.abs()).max(right.z.abs()),
        HeightGraph::Round { centre, radius, .. } => place.max(centre.z.abs()).max(radius),
    }
}

/// Returns the highest point at the end of the profile's upper envelope on one side (-1 left, 1 right).
fn outermost_point(sky: &UpperEnvelope, side: f64) -> Option<Point> {
    let stretch = if side < 0.0 { sky.stretches.first() } else { sky.stretches.last() };
    let of_stretch = stretch.map(|stretch| if side < 0.0 { stretch.left } else { stretch.right });
    let of_tops = if side < 0.0 { sky.tops.first() } else { sky.tops.last() };
    let far = of_stretch.into_iter().chain(of_tops.map(|(top, _)| *top)).map(|point| point.u * side);
    let far = far.fold(f64::NEG_INFINITY, f64::max);
    let near = |point: &Point| point.u * side >= far - UPRIGHT;
    // The tops are sorted by u, so those at the end are together.
    let tops: &mut dyn Iterator<Item = &(Point, usize)> =
        if side < 0.0 { &mut sky.tops.iter() } else { &mut sky.tops.iter().rev() };
    let tops = tops.map(|(top, _)| *top).take_while(near);
    tops.chain(of_stretch.filter(near)).max_by(|a, b| a.z.total_cmp(&b.z))
}

/// Finds how the envelope ends at a free end of the chain, of which `outer` is the outermost point on that
/// side.
fn classify_end(free: Point, piece: Option<&ChainPiece>, outer: Point) -> EnvelopeEnd {
    if free.distance(outer) <= BESIDE {
        return EnvelopeEnd::Free(outer);
    }
    let upright = piece.is_some_and(|piece| (piece.start().u - piece.end().u).abs() <= BESIDE);
    let below = (free.u - outer.u).abs() <= BESIDE && free.z < outer.z;
    if below && upright { EnvelopeEnd::Wall(free.z) } else { EnvelopeEnd::Nose }
}

/// Returns the path of the ball's centre.
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
    // The ball does not roll around a free end, so the caps around it are removed.
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
        // A chain without extent has one cap for both ends, and the ball is on top of it.
        if stretches.is_empty()
            && let EnvelopeEnd::Free(other) = high
            && other.distance(free) <= UPRIGHT
        {
            start = Some(Point::new(free.u, free.z + radius));
            stop = start;
        }
    }
    // The ball follows a wall at the end down to the wall's foot.
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

/// Joins segments between two points to a chain, with straight lines where they do not meet.
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
