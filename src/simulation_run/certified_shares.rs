//! This module bounds the share of motions from the motions themselves, without a grid.
//!
//! The share of a point of the cutter is the speed along its normal divided by the speed of the tip. Feed per tooth
//! times share is the chip, so the largest feed of a motion follows from its largest share.

use super::certified_stock::list_stock_gaps;
use super::{Machining, RunPhase, RunWatcher};
use crate::certified_engagement::{
    BlockMotion, CertifiedProgram, CutterContour, CutterPose, EngagementCriterion, EngagementOptions,
    EngagementWitness, StepLimits, TipArc, WarmStart,
};
use crate::cutter::CutterModel;
use crate::diagnostic::Failure;
use crate::engagement::{MotionPiece, PathLinearizer, PathPiece};
use crate::program::geometry::{CircularArc, MotionPath, Pose};
use crate::program::motion::Motion;
use crate::stock::SolidBody;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The largest distance of a spline, or of the path of a machine, from its chords, mm: as little as arcs of the core may be off theirs.
const CHORD_TOLERANCE_MM: f64 = 2e-4;

/// An arc whose end lies further than this (mm) from its circle is taken as chords.
const MOST_SLIP_MM: f64 = 0.005;

/// The part of the lower bound by which the upper one may be larger, where the budget allows it: for feeds, which follow
/// from the upper one.
pub(crate) const FEED_TOLERANCE: f64 = 0.005;

/// Blocks that follow each other on one thread. What one leaves for the next ends with its run, so that the number of
/// threads changes nothing.
const BLOCKS_OF_A_RUN: usize = 64;

/// The share of a piece of a motion, by the speed of the tip as programmed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CertifiedPiece {
    /// Where the piece begins, as a fraction of the motion's length.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// The share that a point which is proved to cut has; 0 if none was found.
    pub lower: f64,
    /// The share that no point exceeds; 0 where nothing is cut.
    pub upper: f64,
    /// Whether the interval is as narrow as was asked.
    pub is_tight: bool,
}

/// The shares of the motions of a program that were asked for.
#[derive(Debug, Default)]
pub(crate) struct CertifiedShares {
    pieces: BTreeMap<usize, Vec<CertifiedPiece>>,
    /// The blocks from which they were found.
    blocks: Vec<BlockMotion>,
    /// The speed of the tip on each block by that of its motion as programmed, to which the shares of pieces refer.
    paces: Vec<f64>,
    claims: Vec<ShareClaim>,
    /// Whether a body of the stock is known in columns only, because another program left it.
    pub has_columns: bool,
    /// The number of motions that were asked for and cannot be bounded in this way, because of their tool or their path.
    pub unbounded: usize,
}

/// What is claimed of one block: the share of its points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ShareClaim {
    /// The index of the block.
    pub block: usize,
    /// The index of its motion.
    pub motion: usize,
    pub lower: f64,
    pub upper: f64,
    /// Where a point was found that cuts with the lower share.
    pub witness: Option<EngagementWitness>,
}

/// The blocks of a program, and the pieces of motions that are asked for.
#[derive(Default)]
pub(super) struct BlockList {
    blocks: Vec<BlockMotion>,
    /// The speed of the tip on each block by that of its motion as programmed.
    pub paces: Vec<f64>,
    pub asked: Vec<AskedPiece>,
    unbounded: usize,
}

/// A piece of a motion that is asked for, and its blocks: several for a spline.
pub(super) struct AskedPiece {
    pub motion: usize,
    pub from: f64,
    pub to: f64,
    pub first: usize,
    pub count: usize,
}

impl CertifiedShares {
    /// Returns the pieces of a motion, in order. Returns `None` for a motion that was not asked for or cannot be bounded.
    pub(crate) fn pieces_of(&self, motion: usize) -> Option<&[CertifiedPiece]> {
        self.pieces.get(&motion).map(Vec::as_slice)
    }

    /// Returns the blocks of all motions of tools that are known.
    pub(super) fn blocks(&self) -> &[BlockMotion] {
        &self.blocks
    }

    /// Returns the speed of the tip on a block by that of its motion as programmed.
    pub(super) fn pace_of(&self, block: usize) -> f64 {
        self.paces.get(block).copied().unwrap_or(1.0)
    }

    /// Returns what is claimed of the blocks that were asked for.
    pub(super) fn claims(&self) -> impl Iterator<Item = &ShareClaim> {
        self.claims.iter()
    }

    /// Returns how many pieces have an interval that is wider than was asked, because the budget was used.
    pub(crate) fn count_wide_pieces(&self) -> usize {
        self.pieces.values().flatten().filter(|piece| !piece.is_tight).count()
    }
}

impl Machining<'_> {
    /// Bounds the shares of motions. `parts_of` gives, for each motion that is asked for, the fractions of its length at
    /// which its pieces end; the last one is 1. Returns `None` where the stock has no gap, or a coordinate is beyond a
    /// kilometre.
    ///
    /// `earlier` are shares of the same program with other feeds, which are taken where all motions are the same.
    /// `tolerance` is the part of the lower bound by which the upper one may be larger, where the budget allows it.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn certify_shares(
        &self,
        parts_of: &dyn Fn(usize) -> Option<Vec<f64>>,
        (earlier, tolerance): (Option<&CertifiedShares>, f64),
        watch: &dyn RunWatcher,
    ) -> Result<Option<CertifiedShares>, Failure> {
        let Some((program, list)) = self.prepare_blocks(parts_of) else { return Ok(None) };
        watch.begin_phase(RunPhase::Simulating);
        let shares = certify_asked(&program, list, (earlier, tolerance), watch)?;
        let is_in_columns = |body: &SolidBody| matches!(body, SolidBody::Remains(_));
        Ok(Some(CertifiedShares { has_columns: self.stock.bodies().iter().any(is_in_columns), ..shares }))
    }

    /// Prepares a search over the blocks of all motions. Returns `None` where the stock has no gap, or a coordinate is beyond
    /// a kilometre.
    pub(super) fn prepare_blocks(
        &self,
        parts_of: &dyn Fn(usize) -> Option<Vec<f64>>,
    ) -> Option<(CertifiedProgram, BlockList)> {
        let stock = list_stock_gaps(&self.stock)?;
        let contours: Vec<Option<CutterContour>> = self.list_contours();
        let list = self.list_blocks(&contours, parts_of);
        // A motion of a tool without a contour is not in the list, so another contour in its place is never used.
        let contours = contours.into_iter().flatten().collect();
        let Ok(mut program) = CertifiedProgram::new(stock, contours, StepLimits::default()) else {
            debug_assert!(false, "stock and cutters were checked");
            return None;
        };
        // Coordinates beyond a kilometre have no bound.
        list.blocks.iter().all(|block| program.push_block(block).is_ok()).then_some((program, list))
    }

    /// Returns whether the blocks of this program, in these parts, are those that shares are known of.
    pub(super) fn has_motions_of(
        &self,
        known: &CertifiedShares,
        parts_of: &dyn Fn(usize) -> Option<Vec<f64>>,
    ) -> bool {
        self.list_blocks(&self.list_contours(), parts_of).blocks == known.blocks
    }

    /// Returns the contours of all cutters; `None` for one that is narrower above its widest place or does not cut in its
    /// middle.
    pub(super) fn list_contours(&self) -> Vec<Option<CutterContour>> {
        let contour = |cutter: &CutterModel| CutterContour::from_meridian(&cutter.profile).ok();
        self.tooling.cutters().iter().map(contour).collect()
    }

    /// Lists the blocks of all motions, rapids too: they remove material.
    fn list_blocks(
        &self,
        contours: &[Option<CutterContour>],
        parts_of: &dyn Fn(usize) -> Option<Vec<f64>>,
    ) -> BlockList {
        let mut list = BlockList::default();
        let mut path = self.start_path(CHORD_TOLERANCE_MM, f64::INFINITY);
        // The numbers of the contours that exist.
        let mut numbers = Vec::with_capacity(contours.len());
        let mut next = 0;
        for contour in contours {
            numbers.push(contour.as_ref().map(|_| next));
            next += usize::from(contour.is_some());
        }
        for (number, motion) in self.program.motions().enumerate() {
            path.adopt_workpiece_frame(&motion);
            if motion.path == MotionPath::Start {
                continue;
            }
            let parts = parts_of(number);
            let cutter =
                self.tooling.cutter_index(&motion).and_then(|index| numbers.get(index).copied().flatten());
            match cutter {
                Some(cutter) => list.add_motion(&mut path, (number, &motion), cutter, parts),
                // What the tool removes is taken to stay, which is the worse case for the other tools.
                None => list.unbounded += usize::from(parts.is_some()),
            }
        }
        list
    }
}

impl BlockList {
    /// Returns a block.
    pub(super) fn block(&self, number: usize) -> Option<&BlockMotion> {
        self.blocks.get(number)
    }

    fn add_motion(
        &mut self,
        path: &mut PathLinearizer,
        (number, motion): (usize, &Motion),
        cutter: usize,
        parts: Option<Vec<f64>>,
    ) {
        let ends: &[f64] = parts.as_deref().unwrap_or(&[1.0]);
        let arc = match &motion.path {
            MotionPath::Arc(arc) if path.slip_of_arc_mm(motion, arc) < MOST_SLIP_MM => Some(arc),
            _ => None,
        };
        let mut pieces: Vec<MotionPiece> = Vec::new();
        match (arc, &motion.path) {
            (Some(arc), _) => {
                pieces.extend(divide_motion(ends, |share| path.place_on_arc(motion, arc, share)))
            }
            (None, MotionPath::Line) if !path.leaves_programmed_path(number) => {
                pieces.extend(divide_motion(ends, |share| path.place_on_line(motion, share)));
            }
            // Chords end where the curve bends, not where pieces do.
            _ => path.append_pieces((number, motion), cutter, &mut pieces),
        }
        let blocks = pieces.iter().map(|step| BlockMotion {
            from: to_cutter_pose(&step.piece.from),
            to: to_cutter_pose(&step.piece.to),
            arc: arc.map(|arc| to_tip_arc(path, motion, arc, step.to - step.from)),
            cutter,
        });
        let first = self.blocks.len();
        self.blocks.extend(blocks);
        self.paces.extend(pieces.iter().map(|step| step.pace));
        if parts.is_none() {
            return;
        }
        let mut from = 0.0;
        for &to in ends {
            // A chord that reaches over the end of a piece counts for both.
            let begin = pieces.partition_point(|step| step.to <= from);
            let count = pieces.partition_point(|step| step.from < to).saturating_sub(begin);
            self.asked.push(AskedPiece { motion: number, from, to, first: first + begin, count });
            from = to;
        }
    }
}

/// Divides a motion at fractions of its length; `place` gives the pose at a fraction.
fn divide_motion(ends: &[f64], place: impl Fn(f64) -> Pose) -> Vec<MotionPiece> {
    let mut from = 0.0;
    let piece = |&to: &f64| {
        let piece = MotionPiece {
            piece: PathPiece { from: place(from), to: place(to), cutter: 0 },
            from,
            to,
            pace: 1.0,
        };
        from = to;
        piece
    };
    ends.iter().map(piece).collect()
}

fn to_cutter_pose(pose: &Pose) -> CutterPose {
    CutterPose { tip: pose.point.coords, axis: pose.axis }
}

/// Makes a share of an arc in the workpiece frame.
fn to_tip_arc(path: &PathLinearizer, motion: &Motion, arc: &CircularArc, share: f64) -> TipArc {
    let centre = path.place_pose(motion, Pose { point: arc.center, axis: arc.axis.into_inner() });
    TipArc { center: centre.point.coords, normal: centre.axis, angle: arc.sweep * share }
}

/// Bounds what is asked for, in runs of blocks.
fn certify_asked(
    program: &CertifiedProgram,
    list: BlockList,
    (earlier, tolerance): (Option<&CertifiedShares>, f64),
    watch: &dyn RunWatcher,
) -> Result<CertifiedShares, Failure> {
    let known: BTreeMap<usize, ShareClaim> = earlier
        .filter(|earlier| earlier.blocks == list.blocks)
        .iter()
        .flat_map(|earlier| &earlier.claims)
        .map(|claim| (claim.block, *claim))
        .collect();
    let options = EngagementOptions { tolerance, ..EngagementOptions::default() };
    let done = AtomicUsize::new(0);
    let all = list.asked.len() as f64;
    let certify_run = |run: &[AskedPiece]| -> Result<Vec<Vec<ShareClaim>>, Failure> {
        let mut warm = WarmStart::default();
        let mut claims = Vec::with_capacity(run.len());
        for asked in run {
            // One block may take seconds, so the watcher is asked before each.
            watch.check_stop()?;
            claims.push(certify_piece(program, asked, &known, &options, &mut warm));
        }
        let done = done.fetch_add(run.len(), Ordering::Relaxed) + run.len();
        watch.report_progress(done as f64, all);
        Ok(claims)
    };
    let runs: Result<Vec<_>, Failure> = list.asked.par_chunks(BLOCKS_OF_A_RUN).map(certify_run).collect();
    let mut shares = CertifiedShares { unbounded: list.unbounded, ..CertifiedShares::default() };
    for (asked, claims) in list.asked.iter().zip(runs?.into_iter().flatten()) {
        let pace = |claim: &ShareClaim| list.paces.get(claim.block).copied().unwrap_or(1.0);
        let largest = |of: fn(&ShareClaim) -> f64| {
            claims.iter().map(|claim| of(claim) * pace(claim)).fold(0.0, f64::max)
        };
        let (lower, upper) = (largest(|claim| claim.lower), largest(|claim| claim.upper));
        let is_tight = upper <= lower * (1.0 + 2.0 * FEED_TOLERANCE);
        let piece = CertifiedPiece { from: asked.from, to: asked.to, lower, upper, is_tight };
        shares.pieces.entry(asked.motion).or_default().push(piece);
        shares.claims.extend(claims);
    }
    shares.blocks = list.blocks;
    shares.paces = list.paces;
    Ok(shares)
}

/// Bounds the blocks of one piece.
fn certify_piece(
    program: &CertifiedProgram,
    asked: &AskedPiece,
    known: &BTreeMap<usize, ShareClaim>,
    options: &EngagementOptions,
    warm: &mut WarmStart,
) -> Vec<ShareClaim> {
    let mut claim = |block: usize| {
        known.get(&block).copied().unwrap_or_else(|| {
            let found = program.certify_block(block, EngagementCriterion::Share, options, warm);
            let (lower, upper, witness) = (found.lower, found.upper, found.witness);
            ShareClaim { block, motion: asked.motion, lower, upper, witness }
        })
    };
    (asked.first..asked.first + asked.count).map(&mut claim).collect()
}
