//! Looking at a tip path with other means: many samples, and distances.

use super::chain::Chain;
use super::chain_piece::{ChainPiece, Point};

/// Samples in a block that is skipped or looked at as a whole.
const BLOCK: usize = 64;

/// What samples of a profile and a tip path show.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProfileDeviation {
    /// How deep the ball (or the shank above it, as wide as the ball) goes into the profile at most, mm; 0 when nowhere.
    pub gouge: f64,
    /// Place of the tip where that is.
    pub gouge_at: Point,
    /// How far the ball is from touching the profile at most, mm; 0 when it touches everywhere.
    pub gap: f64,
    /// Place of the tip where that is.
    pub gap_at: Point,
    /// How far both may be from the truth because of the distance of samples, mm.
    pub bound: f64,
}

/// Samples a tip path and a profile every `step` mm, at corners and ends, and measures how far the ball of `radius` mm is
/// from the profile in all places of the path. Where the path goes straight up or down it need not touch anything, so gaps are not
/// looked at there.
///
/// Of the profile's samples under the ball the nearest counts; those above its centre count by their horizontal distance,
/// for the shank. So this knows nothing of envelopes, offsets or contact points. Between two samples a line or arc of curvature k is at
/// most `step^2/8 (1/R + k)` nearer than they are, and the same holds along the path: the bound is the sum of both.
/// Both results may be off by the bound when `step` is small against radii; gouges are told too small, gaps too large.
/// That all of the profile was reached is not told here: see [`find_unreachable_parts`](super::find_unreachable_parts).
pub fn check_tip_path(profile: &Chain, tip: &Chain, radius: f64, step: f64) -> ProfileDeviation {
    let mut samples = Vec::new();
    sample_chain(profile, step, |point, _| samples.push(point));
    samples.sort_by(|a, b| a.u.total_cmp(&b.u));
    let mut field = SampleBlocks::new(samples);
    let start = tip.start();
    let mut verdict = ProfileDeviation {
        gouge: 0.0,
        gouge_at: start,
        gap: 0.0,
        gap_at: start,
        bound: step * step / 8.0 * (2.0 / radius + largest_curvature(profile) + largest_curvature(tip)),
    };
    sample_chain(tip, step, |point, upright| {
        let centre = Point::new(point.u, point.z + radius);
        let distance = field.distance_to_nearest(centre);
        if radius - distance > verdict.gouge {
            (verdict.gouge, verdict.gouge_at) = (radius - distance, point);
        }
        if !upright && distance - radius > verdict.gap {
            (verdict.gap, verdict.gap_at) = (distance - radius, point);
        }
    });
    verdict
}

/// The largest curvature of a chain's arcs, as far as samples can see it.
fn largest_curvature(chain: &Chain) -> f64 {
    let of = |piece: &ChainPiece| match piece {
        ChainPiece::Arc(arc) => 1.0 / arc.radius,
        ChainPiece::Line(_) => 0.0,
    };
    chain.pieces().iter().map(of).fold(0.0, f64::max)
}

/// Gives out points of a chain, no farther apart than `step`, and whether they lie on an upright line.
fn sample_chain(chain: &Chain, step: f64, mut give: impl FnMut(Point, bool)) {
    // Also what is no number becomes a step.
    let step = step.max(1e-6);
    for piece in chain.pieces() {
        // A slightly slanted join beside a wall is as good as upright.
        let upright = matches!(piece, ChainPiece::Line(line) if (line.to.u - line.from.u).abs() < 1e-9);
        let count = (piece.length_mm() / step).ceil().clamp(1.0, 1e8) as usize;
        for index in 0..=count {
            give(piece.point_at(index as f64 / count as f64), upright);
        }
    }
}

fn square(number: f64) -> f64 {
    number * number
}

/// Samples by ascending u, in blocks with their bounds, and the ball's centre that was looked at last.
struct SampleBlocks {
    samples: Vec<Point>,
    blocks: Vec<SampleBlock>,
    /// The block in which the nearest sample was.
    near: usize,
    last: Option<Point>,
    /// How far the centre has come in all.
    way: f64,
}

struct SampleBlock {
    from: f64,
    to: f64,
    top: f64,
    /// The distance of its nearest sample when the centre had come so far: it has changed by no more than the way since.
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

    /// The distance of the nearest sample from the ray upwards from `centre`.
    fn distance_to_nearest(&mut self, centre: Point) -> f64 {
        self.way += self.last.map_or(0.0, |last| last.distance(centre));
        self.last = Some(centre);
        let mut best = f64::INFINITY;
        self.scan_block(self.near, centre, &mut best);
        // Outwards from the block over which the centre stands, until blocks are farther away sideways than the best.
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
