//! This module checks a tip path by an independent method: many samples and their distances.

use super::chain::Chain;
use super::chain_piece::{ChainPiece, Point};

/// The number of samples in a block that is examined or skipped as a whole.
const BLOCK: usize = 64;

/// The largest number of samples of a chain: one lost decimal point would else take gigabytes and hours.
const MOST_SAMPLES: f64 = 5e6;

/// The deviation of a tip path from a profile, measured with samples.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ProfileDeviation {
    /// The largest depth of the ball (or of the shank above it, as wide as the ball) in the profile, mm; 0 if
    /// there is none.
    pub gouge_mm: f64,
    /// The position of the tip at which this is so.
    pub gouge_at: Point,
    /// The largest distance of the ball from touching the profile, mm; 0 if it touches everywhere.
    pub gap_mm: f64,
    /// The position of the tip at which this is so.
    pub gap_at: Point,
    /// By how much both may differ from the truth because of the distance of samples, mm.
    pub bound_mm: f64,
}

/// Samples a tip path and a profile every `step_mm` and at vertices and ends, and measures how far the ball
/// of `radius_mm` is from the profile at every sample of the path. Where the path goes straight up or down
/// the ball need not touch anything, so gaps are not measured there.
///
/// Of the profile's samples, the one nearest to the ball counts; samples above its centre count with their
/// horizontal distance, for the shank. So the check does not use envelopes, offsets or contact points.
/// Between two samples, a line or an arc of curvature k is at most `step_mm^2/8 (1/R + k)` nearer than the
/// samples, and the same holds along the path; the bound is the sum of both. If `step_mm` is small against the
/// radii, both results are within the bound: gouges are measured too small, gaps too large. Whether all of
/// the profile was reached is not checked here: see
/// [`find_unreachable_parts`](super::find_unreachable_parts).
///
/// A chain that would have more than five million samples gets them further apart, and the bound says so.
pub fn check_tip_path(profile: &Chain, tip: &Chain, radius_mm: f64, step_mm: f64) -> ProfileDeviation {
    let length_mm = |chain: &Chain| chain.pieces().iter().map(ChainPiece::length_mm).sum::<f64>();
    let step_mm = step_mm.max(length_mm(profile).max(length_mm(tip)) / MOST_SAMPLES);
    let mut samples = Vec::new();
    sample_chain(profile, step_mm, |point, _| samples.push(point));
    samples.sort_by(|a, b| a.u.total_cmp(&b.u));
    let mut field = SampleBlocks::new(samples);
    let start = tip.start();
    let mut verdict = ProfileDeviation {
        gouge_mm: 0.0,
        gouge_at: start,
        gap_mm: 0.0,
        gap_at: start,
        bound_mm: step_mm * step_mm / 8.0
            * (2.0 / radius_mm + largest_curvature(profile) + largest_curvature(tip)),
    };
    sample_chain(tip, step_mm, |point, upright| {
        let centre = Point::new(point.u, point.z + radius_mm);
        let distance = field.distance_to_nearest(centre);
        if radius_mm - distance > verdict.gouge_mm {
            (verdict.gouge_mm, verdict.gouge_at) = (radius_mm - distance, point);
        }
        if !upright && distance - radius_mm > verdict.gap_mm {
            (verdict.gap_mm, verdict.gap_at) = (distance - radius_mm, point);
        }
    });
    verdict
}

/// Returns the largest curvature of a chain's arcs, 1/mm.
fn largest_curvature(chain: &Chain) -> f64 {
    let of = |piece: &ChainPiece| match piece {
        ChainPiece::Arc(arc) => 1.0 / arc.radius_mm,
        ChainPiece::Line(_) => 0.0,
    };
    chain.pieces().iter().map(of).fold(0.0, f64::max)
}

/// Gives the points of a chain that are at most `step` apart, and whether they are on a vertical line.
fn sample_chain(chain: &Chain, step: f64, mut give: impl FnMut(Point, bool)) {
    // This also replaces a step that is not a number.
    let step = step.max(1e-6);
    for piece in chain.pieces() {
        // A slightly tilted joint beside a wall counts as vertical.
        let upright = matches!(piece, ChainPiece::Line(line) if (line.to.u - line.from.u).abs() < 1e-9);
        let count = (piece.length_mm() / step).ceil().clamp(1.0, 2.0 * MOST_SAMPLES) as usize;
        for index in 0..=count {
            give(piece.point_at(index as f64 / count as f64), upright);
        }
    }
}

fn square(number: f64) -> f64 {
    number * number
}

/// The samples with u ascending, in blocks with their bounds, and the last position of the ball's centre.
struct SampleBlocks {
    samples: Vec<Point>,
    blocks: Vec<SampleBlock>,
    /// The index of the block that had the nearest sample.
    near: usize,
    last: Option<Point>,
    /// The total distance that the centre has travelled.
    way: f64,
}

struct SampleBlock {
    from: f64,
    to: f64,
    top: f64,
    /// The distance of its nearest sample when the centre had travelled `way`. Since then it has changed by
    /// at most the distance travelled.
    distance: f64,
    way: f64,
}

impl SampleBlocks {
    fn new(samples: Vec<Point>) -> Self {
        let blocks = samples
            .chunks(BLOCK)
            .map(|chunk| SampleBlock {
                from: chunk.first().map_or(0.0, |point| point.u),
                to: chunk.last().map_or(0.0, |point| point.u),
                top: chunk.iter().map(|point| point.z).fold(f64::NEG_INFINITY, f64::max),
                distance: f64::NEG_INFINITY,
                way: 0.0,
            })
            .collect();
        Self { samples, blocks, near: 0, last: None, way: 0.0 }
    }

    /// Returns the distance of the nearest sample from the ray upwards from `centre`.
    fn distance_to_nearest(&mut self, centre: Point) -> f64 {
        self.way += self.last.map_or(0.0, |last| last.distance(centre));
        self.last = Some(centre);
        let mut best = f64::INFINITY;
        self.scan_block(self.near, centre, &mut best);
        // Go outwards from the block below the centre, until blocks are further away sideways than the best
        // sample.
        let middle = self.blocks.partition_point(|block| block.to < centre.u);
        for index in middle..self.blocks.len() {
            if self.blocks.get(index).is_none_or(|block| block.from - centre.u >= best) {
                break;
            }
            self.scan_block(index, centre, &mut best);
        }
        for index in (0..middle).rev() {
            if self.blocks.get(index).is_none_or(|block| centre.u - block.to >= best) {
                break;
            }
            self.scan_block(index, centre, &mut best);
        }
        best
    }

    /// Examines a block, unless its bounds show that it has no nearer sample.
    fn scan_block(&mut self, index: usize, centre: Point, best: &mut f64) {
        let Some(block) = self.blocks.get_mut(index) else { return };
        if block.distance - (self.way - block.way) >= *best {
            return;
        }
        let across = (block.from - centre.u).max(centre.u - block.to).max(0.0);
        if square(across) + square((centre.z - block.top).max(0.0)) >= *best * *best {
            return;
        }
        let samples = self.samples.get(index * BLOCK..).unwrap_or_default();
        let mut nearest = f64::INFINITY;
        for sample in samples.iter().take(BLOCK) {
            let away = square(sample.u - centre.u) + square((centre.z - sample.z).max(0.0));
            nearest = nearest.min(away);
        }
        block.distance = nearest.sqrt();
        block.way = self.way;
        if block.distance < *best {
            *best = block.distance;
            self.near = index;
        }
    }
}
