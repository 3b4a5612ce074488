//! The longest chords within a tolerance.

use super::chain::{Chain, LARGEST};
use super::compensate::centres;
use super::fit::longest_arc;
use super::piece::{Arc, Piece, Point};

/// Arcs are looked at in points between which they bulge by this share of the tolerance; chords keep to the rest of it.
const SHARE: f64 = 1.0 / 64.0;

/// A bend sharper than this is a corner, when both sides go straight for [`ARM`] tolerances: 20 degrees.
const CORNER: f64 = 0.35;
const ARM: f64 = 2.0;

/// Looking for what a corner's sides do ends after so many pieces.
const ARM_PIECES: usize = 64;

/// Beyond the last vertex that a chord reaches, it looks this much further (and as far again as it has come).
const LOOK_AHEAD: usize = 64;

/// On which side of the chain chords may lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Side {
    /// Either side; vertices lie on the chain.
    #[default]
    Both,
    /// On the chain or above it: a tip path that never gouges.
    Above,
    /// On the chain or below it.
    Below,
}

/// Why there are no chords.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ChordError {
    /// The tolerance cannot be used.
    #[error("a tolerance of {0} mm: it must be from 0.000001 to {LARGEST:e} mm")]
    Tolerance(f64),
}

/// The chain made of few long chords, nowhere farther than `tolerance` mm from `chain`, and the chain nowhere farther from them.
///
/// Each chord is the longest that the tolerance allows from where the one before ends (wedges of directions, Sklansky and Gonzalez
/// 1980, with chord ends on the chain): on a curve of radius of curvature rho it is close to `2 sqrt(2 rho tolerance)`.
/// Corners are kept: bends sharper than 20 degrees with straight sides of two tolerances. Vertices of lines stay where they
/// are or go; on arcs they lie anywhere.
///
/// With `keep_arcs`, arcs that bulge by more than two tolerances stay arcs, and chords that lie on a circle within the
/// tolerance become one arc when it bulges by more than four tolerances. Smaller arcs go.
///
/// Above and below, the chain is offset by half the tolerance to that side and followed within the other half, which takes
/// some 1.4 times as many chords; both ends move by half the tolerance along the normal there.
///
/// O(n) for chords, O(n log n) with `keep_arcs`.
///
/// # Errors
/// [`ChordError`] when the tolerance is not from 1e-6 to [`LARGEST`] mm.
pub fn chords(chain: &Chain, tolerance: f64, keep_arcs: bool, side: Side) -> Result<Chain, ChordError> {
    if !(1e-6..=LARGEST).contains(&tolerance) {
        return Err(ChordError::Tolerance(tolerance));
    }
    let half = tolerance / 2.0;
    Ok(match side {
        Side::Both => follow(chain, tolerance, keep_arcs),
        // The path of a small ball's centre is the offset of a chain, without loops.
        Side::Above => follow(&centres(chain, half), half, keep_arcs),
        Side::Below => follow(&centres(&chain.flipped(), half), half, keep_arcs).flipped(),
    })
}

/// A place on the chain at which a chord may end.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub point: Point,
    /// The arc that leads here from the place before; `None` for a line.
    arc: Option<Arc>,
    corner: bool,
}

fn follow(chain: &Chain, tolerance: f64, keep_arcs: bool) -> Chain {
    let mut run = vec![Place { point: chain.start(), arc: None, corner: false }];
    let mut pieces: Vec<Piece> = Vec::new();
    for piece in chain.pieces() {
        match piece {
            Piece::Arc(arc) if keep_arcs && arc.sagitta() > 2.0 * tolerance => {
                chord_run(&run, tolerance, keep_arcs, &mut pieces);
                run.clear();
                keep(&mut pieces, *arc, tolerance);
                run.push(Place { point: piece.end(), arc: None, corner: false });
            }
            Piece::Arc(arc) => {
                let most = (1.0 - (SHARE * tolerance / arc.radius).min(1.0)).acos() * 2.0;
                let count = (arc.sweep.abs() / most).ceil().clamp(1.0, 1e7);
                for index in 0..count as usize {
                    let part = Arc {
                        start: arc.start + arc.sweep * (index as f64 / count),
                        sweep: arc.sweep / count,
                        ..*arc
                    };
                    let point = Piece::Arc(part).end();
                    run.push(Place { point, arc: Some(part), corner: false });
                }
            }
            Piece::Line(line) => run.push(Place { point: line.to, arc: None, corner: false }),
        }
    }
    chord_run(&run, tolerance, keep_arcs, &mut pieces);
    if pieces.is_empty() {
        pieces.push(Piece::line(chain.start(), chain.end()));
    }
    Chain::trusted(pieces)
}

/// Adds an arc, or makes the last one longer when it is of the same circle.
fn keep(pieces: &mut Vec<Piece>, arc: Arc, tolerance: f64) {
    // Both circles agree ten times better than the tolerance asks, so that sums of many merges stay within it.
    let close = tolerance / 10.0;
    if let Some(Piece::Arc(last)) = pieces.last_mut()
        && last.centre.distance(arc.centre) <= close.min(1e-6)
        && (last.radius - arc.radius).abs() <= close.min(1e-6)
        && last.sweep.signum() == arc.sweep.signum()
        && (last.sweep + arc.sweep).abs() < std::f64::consts::TAU
        && Piece::Arc(*last).end().distance(Piece::Arc(arc).start()) <= close.min(1e-6)
    {
        last.sweep += arc.sweep;
        return;
    }
    pieces.push(Piece::Arc(arc));
}

/// Adds the chords of places between two arcs that stay.
fn chord_run(run: &[Place], tolerance: f64, keep_arcs: bool, pieces: &mut Vec<Piece>) {
    let mut run = run.to_vec();
    let exact = if run.iter().any(|place| place.arc.is_some()) { 1.0 - SHARE } else { 1.0 };
    mark_corners(&mut run, tolerance);
    let Some(first) = run.first() else { return };
    let mut anchor = first.point;
    let mut at = 0;
    while at + 1 < run.len() {
        let next = longest_chord(&run, at, anchor, tolerance * exact);
        if keep_arcs
            && let Some((end, arc)) = longest_arc(&run, at, anchor, next.0, tolerance * exact)
            && let Some(place) = run.get(end)
        {
            pieces.push(Piece::Arc(arc));
            (at, anchor) = (end, place.point);
            continue;
        }
        if anchor != next.1 {
            pieces.push(Piece::line(anchor, next.1));
        }
        (at, anchor) = next;
    }
}

impl Place {
    /// Whether a chord or arc may not go on past it.
    pub fn is_corner(&self) -> bool {
        self.corner
    }
}

/// Marks the corners of a run.
fn mark_corners(run: &mut [Place], tolerance: f64) {
    let arm = |places: &mut dyn Iterator<Item = &Place>, at: Point| {
        let mut far = places.take(ARM_PIECES).map(|place| place.point).skip_while(|point| {
            point.distance(at) < 2.0 * ARM * tolerance
        });
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
            // The cheap look first: how it bends right here.
            let near = |from: &Place, to: &Place| (to.point.u - from.point.u, to.point.z - from.point.z);
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

/// The directions from an anchor in which a chord passes all places so far within the tolerance.
#[derive(Clone, Copy)]
struct Wedge {
    right: (f64, f64),
    left: (f64, f64),
}

fn cross(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.1 - a.1 * b.0
}

fn dot(a: (f64, f64), b: (f64, f64)) -> f64 {
    a.0 * b.0 + a.1 * b.1
}

impl Wedge {
    /// Directions that pass a place at (du, dz), farther away than the tolerance.
    fn past((du, dz): (f64, f64), distance: f64, tolerance: f64) -> Self {
        let (du, dz) = (du / distance, dz / distance);
        let sin = tolerance / distance;
        let cos = (1.0 - sin * sin).max(0.0).sqrt();
        Self {
            right: (du * cos + dz * sin, dz * cos - du * sin),
            left: (du * cos - dz * sin, dz * cos + du * sin),
        }
    }

    fn middle(&self) -> (f64, f64) {
        (self.right.0 + self.left.0, self.right.1 + self.left.1)
    }

    fn holds(&self, direction: (f64, f64)) -> bool {
        dot(self.middle(), direction) > 0.0
            && cross(self.right, direction) >= 0.0
            && cross(direction, self.left) >= 0.0
    }

    /// What both allow; `None` when that is nothing, or when they look opposite ways.
    fn and(self, other: Self) -> Option<Self> {
        if dot(self.middle(), other.middle()) <= 0.0 {
            return None;
        }
        let right = if cross(self.right, other.right) > 0.0 { other.right } else { self.right };
        let left = if cross(self.left, other.left) < 0.0 { other.left } else { self.left };
        (cross(right, left) >= 0.0).then_some(Self { right, left })
    }
}

/// The place that the longest chord from `anchor` (between place `at` and the next) reaches: index of the place at or
/// before it, and the point.
fn longest_chord(run: &[Place], at: usize, anchor: Point, tolerance: f64) -> (usize, Point) {
    let mut wedge: Option<Wedge> = None;
    let mut best = (at + 1, run.get(at + 1).map_or(anchor, |place| place.point));
    let mut best_wedge = None;
    let mut far = 0.0_f64;
    for (index, place) in run.iter().enumerate().skip(at + 1) {
        let to = (place.point.u - anchor.u, place.point.z - anchor.z);
        let distance = dot(to, to).sqrt();
        // A chain that comes back would not be followed to where it turned.
        if distance < far - tolerance {
            break;
        }
        // What lies this close to the anchor is passed in any direction.
        let near = distance <= tolerance;
        let allowed = wedge.is_none_or(|wedge| wedge.holds(to));
        if allowed && (distance >= far || index == at + 1) {
            best = (index, place.point);
            best_wedge = wedge;
        }
        if place.corner || index > best.0 + LOOK_AHEAD + 2 * (best.0 - at) {
            break;
        }
        far = far.max(distance);
        if !near {
            let past = Wedge::past(to, distance, tolerance);
            match wedge.map_or(Some(past), |wedge| wedge.and(past)) {
                Some(both) => wedge = Some(both),
                None => break,
            }
        }
    }
    along_arc(run, best, best_wedge, anchor, tolerance)
}

/// Goes on along an arc beyond the last place for as far as the wedge allows: by halving, to a millionth of the arc.
fn along_arc(
    run: &[Place],
    best: (usize, Point),
    wedge: Option<Wedge>,
    anchor: Point,
    tolerance: f64,
) -> (usize, Point) {
    let stop = (best.0, best.1);
    let Some(last) = run.get(best.0).filter(|place| !place.corner) else { return stop };
    let Some(arc) = run.get(best.0 + 1).and_then(|next| next.arc) else { return stop };
    let to = (last.point.u - anchor.u, last.point.z - anchor.z);
    let distance = dot(to, to).sqrt();
    let wedge = if distance > tolerance {
        let past = Wedge::past(to, distance, tolerance);
        match wedge.map_or(Some(past), |wedge| wedge.and(past)) {
            Some(both) => both,
            None => return stop,
        }
    } else {
        return stop;
    };
    let piece = Piece::Arc(arc);
    let allowed = |share: f64| {
        let point = piece.point(share);
        let to = (point.u - anchor.u, point.z - anchor.z);
        wedge.holds(to) && dot(to, to).sqrt() >= distance
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if allowed(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    if low > 0.0 { (best.0, piece.point(low)) } else { stop }
}
