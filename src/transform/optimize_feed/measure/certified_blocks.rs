//! This module replaces the limits that columns give to blocks by certified ones.
//!
//! Columns propose where a block may be divided: where its load changes. They decide nothing: the largest share of each
//! piece is bounded from the motions themselves, and its feed follows from that.

use super::block_measurement::MeasuredBlocks;
use super::feed_block::{FeedBlock, FeedLimit, LimitedPiece};
use super::load_criterion::LoadCriterion;
use super::load_limits::{ContactLoads, LoadLimits, SpindleRotation};
use crate::cutter::CutterModel;
use crate::diagnostic::Failure;
use crate::simulation_run::certified_contacts::ContactGrid;
use crate::simulation_run::certified_contacts::ContactPiece;
use crate::simulation_run::certified_shares::{CertifiedPiece, CertifiedShares, FEED_TOLERANCE};
use crate::simulation_run::{Machining, RunWatcher, ShareProof};
use std::collections::BTreeMap;

/// How the pieces of a block are chosen whose shares are bounded one by one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::transform::optimize_feed) enum BlockDivision {
    /// The whole block is one piece, but for the air at its ends.
    Whole,
    /// Its two halves.
    Halves,
    /// At most so many pieces, where its load changes.
    Parts(usize),
}

/// What is known of a block besides its limits.
#[derive(Debug, Clone)]
pub(super) struct BlockFacts {
    /// The index of its motion.
    pub motion: usize,
    /// The index of its cutter.
    pub cutter: Option<usize>,
    pub turning: Option<SpindleRotation>,
    /// The limit of each of its pieces by loads other than chips, mm/min.
    pub other_limits: Vec<f64>,
}

/// Bounds the chips and loads of all touched blocks, and returns the shares that were found. `divide` gives the fractions
/// of a block's length at which its pieces end, for the block and the number of its motion. Returns `None` for stock of which only
/// columns are known; the blocks then stay as they are.
///
/// # Errors
/// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
pub(super) fn certify_blocks(
    machining: &Machining<'_>,
    limits: &LoadLimits,
    gathered: &mut MeasuredBlocks,
    facts: &[BlockFacts],
    divide: &dyn Fn(&FeedBlock, usize) -> Vec<f64>,
    (earlier, watch): (Option<&CertifiedShares>, &dyn RunWatcher),
) -> Result<Option<CertifiedShares>, Failure> {
    let mut parts: BTreeMap<usize, Vec<f64>> = BTreeMap::new();
    for (block, facts) in gathered.blocks.iter().zip(facts) {
        if block.touched && block.has_length() && facts.turning.is_some() && facts.cutter.is_some() {
            parts.insert(facts.motion, divide(block, facts.motion));
        }
    }
    let shares =
        machining.certify_shares(&|motion| parts.get(&motion).cloned(), (earlier, FEED_TOLERANCE), watch)?;
    let Some(shares) = shares else { return Ok(None) };
    let contacts = examine_loads(machining, limits, (gathered, facts), &parts, watch)?;
    let blocks = gathered.blocks.iter_mut().zip(&mut gathered.measurements).zip(facts);
    for ((block, measurement), facts) in blocks {
        let cutter = facts.cutter.and_then(|index| machining.tooling().cutters().get(index));
        let (Some(cutter), Some(turning), Some(pieces)) =
            (cutter, facts.turning, shares.pieces_of(facts.motion))
        else {
            continue;
        };
        let contacts = contacts.get(&facts.motion);
        let others = match contacts {
            Some(contacts) => OtherLimits::from_contacts(contacts),
            None => OtherLimits::from_columns(block, &facts.other_limits),
        };
        let limited = pieces.iter().map(|piece| LimitedPiece {
            length: (piece.to - piece.from) * block.length,
            limit: limit_piece(limits, piece, cutter, turning, others.lowest_between(piece.from, piece.to)),
        });
        block.pieces = limited.collect();
        measurement.cuts = pieces.iter().any(|piece| piece.upper > 0.0);
        let share = |of: fn(&CertifiedPiece) -> f64| pieces.iter().map(of).fold(0.0, f64::max);
        let shares = [share(|piece| piece.lower), share(|piece| piece.upper)];
        let measured = measurement.measured.iter_mut().zip(limits.criterion_limits());
        for (place, (measured, (criterion, _))) in measured.enumerate() {
            if let Some(contacts) = contacts.filter(|_| *criterion != LoadCriterion::ChipThickness) {
                let bounds = contacts.iter().filter_map(|piece| piece.made.bounds.get(place));
                let bound = bounds.copied().fold(0.0, f64::max);
                // What columns estimate is no more than what is proved.
                *measured = [measured[0].min(bound), bound];
            }
            if *criterion == LoadCriterion::ChipThickness {
                *measured =
                    shares.map(|share| limits.chip_of_share_mm(share, cutter, block.programmed, turning));
            }
        }
    }
    Ok(Some(shares))
}

/// Bounds the loads other than chips of the pieces of blocks, by the numbers of their motions. Motions that cannot be
/// bounded are missing; all are, if only chips are limited.
fn examine_loads(
    machining: &Machining<'_>,
    limits: &LoadLimits,
    (gathered, facts): (&MeasuredBlocks, &[BlockFacts]),
    parts: &BTreeMap<usize, Vec<f64>>,
    watch: &dyn RunWatcher,
) -> Result<BTreeMap<usize, Vec<ContactPiece<ContactLoads>>>, Failure> {
    if limits.criterion_limits().iter().all(|(criterion, _)| *criterion == LoadCriterion::ChipThickness) {
        return Ok(BTreeMap::new());
    }
    let known = |(block, facts): (&FeedBlock, &BlockFacts)| {
        Some((facts.motion, (block.programmed, facts.cutter?, facts.turning?)))
    };
    let known: BTreeMap<usize, _> = gathered.blocks.iter().zip(facts).filter_map(known).collect();
    let none =
        ContactLoads { feed_limit_mm_min: f64::INFINITY, bounds: vec![0.0; limits.criterion_limits().len()] };
    let examine = |motion: usize, grids: &[ContactGrid]| match known.get(&motion) {
        Some((feed, cutter, turning)) if !grids.is_empty() => {
            limits.bound_contacts(grids, *cutter, *feed, *turning)
        }
        _ => none.clone(),
    };
    let contacts = machining.examine_contacts(&|motion| parts.get(&motion).cloned(), &examine, watch)?;
    Ok(contacts.unwrap_or_default())
}

/// The test of the chips of a program at points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::transform::optimize_feed) struct ChipProof {
    /// The number of points that were tried.
    pub samples: u64,
    /// The largest chip of a point that is cut, mm.
    pub largest_mm: f64,
    /// The index of the first motion of which a point is above its bound.
    pub refuted_motion: Option<usize>,
}

/// Makes chips of the shares that were found at points.
pub(super) fn prove_chips(
    machining: &Machining<'_>,
    limits: &LoadLimits,
    (gathered, facts): (&MeasuredBlocks, &[BlockFacts]),
    proof: &ShareProof,
) -> ChipProof {
    let chip = |(block, facts): (&FeedBlock, &BlockFacts)| {
        let share = proof.largest_shares.get(&facts.motion)?;
        let cutter = machining.tooling().cutters().get(facts.cutter?)?;
        Some(limits.chip_of_share_mm(*share, cutter, block.programmed, facts.turning?))
    };
    let chips = gathered.blocks.iter().zip(facts).filter_map(chip);
    ChipProof {
        samples: proof.samples,
        largest_mm: chips.fold(0.0, f64::max),
        refuted_motion: proof.refuted_motion,
    }
}

fn limit_piece(
    limits: &LoadLimits,
    piece: &CertifiedPiece,
    cutter: &CutterModel,
    turning: SpindleRotation,
    other_limit: f64,
) -> FeedLimit {
    // Where nothing is cut, what columns round is no load.
    if piece.upper <= 0.0 {
        return FeedLimit::Air;
    }
    FeedLimit::Limit(limits.feed_for_share_mm_min(piece.upper, cutter, turning).min(other_limit))
}

/// The limits of the pieces of a block by loads other than chips, with their places.
struct OtherLimits {
    /// Begin and end as fractions of the block, and the limit.
    places: Vec<([f64; 2], f64)>,
}

impl OtherLimits {
    fn from_contacts(contacts: &[ContactPiece<ContactLoads>]) -> Self {
        let place =
            |piece: &ContactPiece<ContactLoads>| ([piece.from, piece.to], piece.made.feed_limit_mm_min);
        Self { places: contacts.iter().map(place).collect() }
    }

    fn from_columns(block: &FeedBlock, limits: &[f64]) -> Self {
        let whole: f64 = block.pieces.iter().map(|piece| piece.length).sum();
        let mut at = 0.0;
        let place = |(piece, limit): (&LimitedPiece, &f64)| {
            let from = at;
            at += piece.length / whole.max(f64::MIN_POSITIVE);
            ([from, at], *limit)
        };
        Self { places: block.pieces.iter().zip(limits).map(place).collect() }
    }

    fn lowest_between(&self, from: f64, to: f64) -> f64 {
        let near = self.places.iter().filter(|([begin, end], _)| *begin < to && *end > from);
        near.map(|(_, limit)| *limit).fold(f64::INFINITY, f64::min)
    }
}

/// Limits whose ratio is smaller than this belong to one piece, to begin with.
const SAME_LIMIT: f64 = 1.1;

/// Returns the fractions of a block's length at which its pieces end.
pub(super) fn divide_block(block: &FeedBlock, division: BlockDivision) -> Vec<f64> {
    let most = match division {
        BlockDivision::Whole => return divide_off_air(block),
        BlockDivision::Halves => return vec![0.5, 1.0],
        BlockDivision::Parts(most) => most.max(1),
    };
    let mut ratio = SAME_LIMIT;
    loop {
        let ends = find_changes(block, ratio);
        if ends.len() <= most {
            return ends;
        }
        ratio *= ratio;
    }
}

/// Divides off the air at both ends of a block, so that the margin beside material begins where that does.
fn divide_off_air(block: &FeedBlock) -> Vec<f64> {
    let whole: f64 = block.pieces.iter().map(|piece| piece.length).sum();
    let is_air = |piece: &&LimitedPiece| piece.limit == FeedLimit::Air;
    let before: f64 = block.pieces.iter().take_while(is_air).map(|piece| piece.length).sum();
    let behind: f64 = block.pieces.iter().rev().take_while(is_air).map(|piece| piece.length).sum();
    let ends = [before / whole, 1.0 - behind / whole];
    let mut ends: Vec<f64> = ends.into_iter().filter(|end| *end > 0.0 && *end < 1.0).collect();
    ends.dedup();
    ends.push(1.0);
    ends
}

/// Returns where the limits of a block change by more than a ratio from one run of pieces to the next.
fn find_changes(block: &FeedBlock, ratio: f64) -> Vec<f64> {
    let whole: f64 = block.pieces.iter().map(|piece| piece.length).sum();
    // Above the fastest feed that anybody programs, limits do not matter; infinite ratios would never end.
    const FASTEST: f64 = 1e6;
    const SLOWEST: f64 = 1e-3;
    let limit = |piece: &LimitedPiece| match piece.limit {
        FeedLimit::Air => FASTEST * FASTEST,
        FeedLimit::Limit(limit) => limit.clamp(SLOWEST, FASTEST),
    };
    let mut ends = Vec::new();
    let (mut at, mut range) = (0.0, None::<[f64; 2]>);
    for piece in &block.pieces {
        let own = limit(piece);
        let wider = range.map_or([own, own], |[low, high]| [low.min(own), high.max(own)]);
        if range.is_some() && wider[1] > wider[0] * ratio {
            ends.push(at / whole);
            range = Some([own, own]);
        } else {
            range = Some(wider);
        }
        at += piece.length;
    }
    ends.retain(|end| *end > 0.0 && *end < 1.0);
    ends.push(1.0);
    ends
}
