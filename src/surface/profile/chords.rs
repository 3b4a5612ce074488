//! This module replaces a chain by the longest chords within a tolerance.

use super::arc_fit::fit_longest_arc;
use super::ball_compensation::make_centre_path;
use super::chain::{Chain, ChainError, LARGEST};
use super::chain_piece::{ArcPiece, ChainPiece, Point};
use super::chord_vertex::ChordVertex;
use super::direction_wedge::find_longest_chord;
use std::f64::consts::FRAC_PI_2;

/// Arcs are sampled at points between which the sagitta is this fraction of the tolerance; chords keep within
/// the rest.
const SHARE: f64 = 1.0 / 64.0;

/// A bend of more than this angle (20 degrees) is a corner if both sides go straight for [`ARM`] tolerances.
const CORNER: f64 = 0.35;
const ARM: f64 = 2.0;

/// Concave corners that turn by more than this (120 degrees) are treated as if they turned by this.
const SHARPEST: f64 = 2.0 * std::f64::consts::FRAC_PI_3;

/// The most pieces that are examined on each side of a corner.
const ARM_PIECES: usize = 64;

/// The side of the chain on which chords may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ChordSide {
    /// Chords may be on either side; their vertices are on the chain.
    #[default]
    Both,
    /// Chords are on the chain or above it, as a tip path needs that must not gouge.
    Above,
    /// Chords are on the chain or below it.
    Below,
}

/// The reason why there are no chords.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChordError {
    /// The tolerance cannot be used.
    #[error("a tolerance of {0} mm: it must be from 0.000001 to {LARGEST:e} mm")]
    Tolerance(f64),
    /// The curve has numbers that a chain cannot hold.
    #[error(transparent)]
    Chain(#[from] ChainError),
}

/// Returns a chain of few long chords that is nowhere further than `tolerance_mm` from `chain`, and of which
/// `chain` is nowhere further.
///
/// Each chord is the longest that the tolerance allows from the end of the one before. The method is that of
/// wedges of directions (Sklansky and Gonzalez 1980), with chord ends on the chain. On a curve with the
/// radius of curvature rho, a chord is close to `2 sqrt(2 rho tolerance_mm)` long. Corners are kept: bends of
/// more than 20 degrees between straight sides of two tolerances. Vertices of lines stay where they are or
/// are removed; on arcs, vertices are anywhere.
///
/// With `keep_arcs`, arcs with a sagitta of more than two tolerances stay arcs, and chords on a circle within
/// the tolerance become one arc if its sagitta is more than four tolerances. Smaller arcs become chords.
///
/// With `Above` and `Below`, the chain is offset by 0.41 of the tolerance to that side (less if concave
/// corners are sharper than a right angle) and followed within as much again, which takes about 1.5 times as
/// many chords. Both ends move by the offset along the normal there. Only in concave corners that turn by
/// more than 120 degrees the distance may exceed the tolerance.
///
/// The cost is O(n) for chords and O(n log n) with `keep_arcs`.
///
/// # Errors
/// Returns a [`ChordError`] if the tolerance is not from 1e-6 to [`LARGEST`] mm.
pub fn fit_chords(
    chain: &Chain,
    tolerance_mm: f64,
    keep_arcs: bool,
    side: ChordSide,
) -> Result<Chain, ChordError> {
    if !(1e-6..=LARGEST).contains(&tolerance_mm) {
        return Err(ChordError::Tolerance(tolerance_mm));
    }
    Ok(match side {
        ChordSide::Both => follow_chain(chain, tolerance_mm, keep_arcs),
        ChordSide::Above => fit_chords_above(chain, tolerance_mm, keep_arcs),
        ChordSide::Below => fit_chords_above(&chain.flipped(), tolerance_mm, keep_arcs).flipped(),
    })
}

/// Returns chords on or above a chain. They are within h of the chain's offset by h, which is the path of the
/// centre of a ball of radius h.
fn fit_chords_above(chain: &Chain, tolerance: f64, keep_arcs: bool) -> Chain {
    let sense = if chain.end().u >= chain.start().u { 1.0 } else { -1.0 };
    let mut before = Point::default();
    // The sharpest concave bend between pieces. A right angle may also be hidden in many small bends.
    let mut bend = FRAC_PI_2;
    for piece in chain.pieces().iter().filter(|piece| piece.length_mm() > 0.0) {
        let after = piece.direction_at(0.0);
        let turn = (before.u * after.z - before.z * after.u).atan2(before.u * after.u + before.z * after.z);
        bend = bend.max(turn * sense);
        before = piece.direction_at(1.0);
    }
    // In a concave corner with the turn b, the offset is h / cos(b / 2) from the corner. Together with the h
    // of the chords this is the tolerance.
    let corner = 1.0 / (0.5 * bend.min(SHARPEST)).cos();
    let height = tolerance / (1.0 + corner);
    follow_chain(&make_centre_path(chain, height), height, keep_arcs)
}

/// Follows a chain with chords and, if asked for, arcs within a tolerance.
fn follow_chain(chain: &Chain, tolerance: f64, keep_arcs: bool) -> Chain {
    let mut run = vec![ChordVertex { point: chain.start(), arc: None, corner: false }];
    let mut pieces: Vec<ChainPiece> = Vec::new();
    for piece in chain.pieces() {
        match piece {
            ChainPiece::Arc(arc) if keep_arcs && arc.sagitta_mm() > 2.0 * tolerance => {
                append_run_chords(&run, tolerance, keep_arcs, &mut pieces);
                run.clear();
                append_arc(&mut pieces, *arc, tolerance);
                run.push(ChordVertex { point: piece.end(), arc: None, corner: false });
            }
            ChainPiece::Arc(arc) => {
                // The sagitta is r (1 - cos(sweep / 2)) = 2 r sin^2(sweep / 4), which is solved for the
                // sweep.
                let most = 4.0 * (SHARE * tolerance / (2.0 * arc.radius_mm)).min(1.0).sqrt().asin();
                // The limit of a million only bounds the memory: an arc of 100 m within 1e-6 mm needs fewer.
                let count = (arc.sweep_rad.abs() / most).ceil().clamp(1.0, 1e6);
                for index in 0..count as usize {
                    let part = ArcPiece {
                        start_rad: arc.start_rad + arc.sweep_rad * (index as f64 / count),
                        sweep_rad: arc.sweep_rad / count,
                        ..*arc
                    };
                    let point = ChainPiece::Arc(part).end();
                    run.push(ChordVertex { point, arc: Some(part), corner: false });
                }
            }
            ChainPiece::Line(line) => run.push(ChordVertex { point: line.to, arc: None, corner: false }),
        }
    }
    append_run_chords(&run, tolerance, keep_arcs, &mut pieces);
    if pieces.is_empty() {
        pieces.push(ChainPiece::line(chain.start(), chain.end()));
    }
    Chain::from_trusted(pieces)
}

/// Adds an arc, or extends the last one if both are on the same circle.
fn append_arc(pieces: &mut Vec<ChainPiece>, arc: ArcPiece, tolerance: f64) {
    // Both circles must agree ten times better than the tolerance, so that many merges stay within it.
    let close = tolerance / 10.0;
    if let Some(ChainPiece::Arc(last)) = pieces.last_mut()
        && last.centre.distance(arc.centre) <= close.min(1e-6)
        && (last.radius_mm - arc.radius_mm).abs() <= close.min(1e-6)
        && last.sweep_rad.signum() == arc.sweep_rad.signum()
        && (last.sweep_rad + arc.sweep_rad).abs() < std::f64::consts::TAU
        && ChainPiece::Arc(*last).end().distance(ChainPiece::Arc(arc).start()) <= close.min(1e-6)
    {
        last.sweep_rad += arc.sweep_rad;
        return;
    }
    pieces.push(ChainPiece::Arc(arc));
}

/// Adds the chords of a run of vertices between two arcs that are kept.
fn append_run_chords(run: &[ChordVertex], tolerance: f64, keep_arcs: bool, pieces: &mut Vec<ChainPiece>) {
    let mut run = run.to_vec();
    let exact = if run.iter().any(|place| place.arc.is_some()) { 1.0 - SHARE } else { 1.0 };
    mark_corners(&mut run, tolerance);
    let Some(first) = run.first() else { return };
    let mut anchor = first.point;
    let mut at = 0;
    while at + 1 < run.len() {
        let next = find_longest_chord(&run, at, anchor, tolerance * exact);
        if keep_arcs
            && let Some((end, arc)) = fit_longest_arc(&run, at, anchor, next.0, tolerance * exact)
            && let Some(place) = run.get(end)
        {
            pieces.push(ChainPiece::Arc(arc));
            (at, anchor) = (end, place.point);
            continue;
        }
        if anchor != next.1 {
            pieces.push(ChainPiece::line(anchor, next.1));
        }
        (at, anchor) = next;
    }
}

/// Marks the corners of a run.
fn mark_corners(run: &mut [ChordVertex], tolerance: f64) {
    let arm = |places: &mut dyn Iterator<Item = &ChordVertex>, at: Point| {
        let mut far = places
            .take(ARM_PIECES)
            .map(|place| place.point)
            .skip_while(|point| point.distance(at) < 2.0 * ARM * tolerance);
        far.next().map(|point| (point.u - at.u, point.z - at.z))
    };
    let turn = |a: (f64, f64), b: (f64, f64)| {
        let angle = (a.0 * b.1 - a.1 * b.0).atan2(a.0 * b.0 + a.1 * b.1);
        angle.abs() > CORNER
    };
    let corners: Vec<usize> = run
        .windows(3)
        .enumerate()
        .filter_map(|(index, places)| {
            let [before, at, after] = places else { return None };
            // The cheap test comes first: the bend at this vertex alone.
            let near =
                |from: &ChordVertex, to: &ChordVertex| (to.point.u - from.point.u, to.point.z - from.point.z);
            if !turn(near(before, at), near(at, after)) {
                return None;
            }
            let back = arm(&mut run.get(..=index)?.iter().rev(), at.point)?;
            let on = arm(&mut run.get(index + 2..)?.iter(), at.point)?;
            turn((-back.0, -back.1), on).then_some(index + 1)
        })
        .collect();
    for index in corners {
        if let Some(place) = run.get_mut(index) {
            place.corner = true;
        }
    }
}
