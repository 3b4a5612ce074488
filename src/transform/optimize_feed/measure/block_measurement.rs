//! This module simulates a program and collects its blocks with their loads.

use super::certified_blocks::{
    BlockDivision, BlockFacts, ChipProof, certify_blocks, divide_block, prove_chips,
};
use super::feed_block::{FeedBlock, FeedLimit, LimitedPiece};
use super::load_limits::{LoadLimits, SpindleRotation};
use super::machine_stops::has_machine_stop;
use super::same_motions::{SameMotions, follow_motions};
use super::short_pieces::lower_short_pieces;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::record::SpindleDirection;
use crate::program::{Program, StatementId};
use crate::simulation_run::certified_shares::CertifiedShares;
use crate::simulation_run::{
    EngagedMotion, EngagementModel, EngagementRunResult, Machining, RunWatcher, SimulationRunOptions,
    StockResolution,
};
use std::collections::BTreeMap;

/// The path as blocks, with the loads at its targets.
#[derive(Debug, Clone, Default)]
pub(in crate::transform::optimize_feed) struct MeasuredBlocks {
    /// The feed motions in order.
    pub blocks: Vec<FeedBlock>,
    /// What is measured of each block besides the limits of its pieces.
    pub measurements: Vec<BlockMeasurement>,
    /// Cuts whose feed or spindle speed is not known, and other obstacles to a simulation.
    pub errors: Vec<Diagnostic>,
}

/// The measurements of a block.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::transform::optimize_feed) struct BlockMeasurement {
    /// The index of its motion.
    pub motion: usize,
    /// Its last statement.
    pub statement: StatementId,
    /// Its operation.
    pub operation: usize,
    /// Whether it cuts.
    pub cuts: bool,
    /// For each limit, the load of the block at its programmed feed: the estimate and its bound. The estimate of a
    /// certified chip is proved to be cut.
    pub measured: Vec<[f64; 2]>,
}

/// How a program is measured.
pub(in crate::transform::optimize_feed) struct MeasureOptions<'s> {
    /// The options of the run over columns or layers.
    pub run: SimulationRunOptions,
    /// Where engagements come from.
    pub model: EngagementModel,
    /// How blocks are divided whose pieces are certified one by one.
    pub divide: &'s dyn Fn(&FeedBlock) -> BlockDivision,
    /// The largest feed in mm/min that axes follow, by the statement that ends a motion.
    pub axis_limits: &'s BTreeMap<StatementId, f64>,
    /// The same program as it was measured before its feeds were changed. With it, the shares of the changed program are
    /// tested at points.
    pub earlier: Option<&'s MeasuredProgram>,
}

/// A program that was measured.
pub(in crate::transform::optimize_feed) struct MeasuredProgram {
    /// Its blocks.
    pub blocks: MeasuredBlocks,
    /// What is known of each block besides, in the same order.
    pub(super) facts: Vec<BlockFacts>,
    /// The run over columns or layers.
    pub ran: EngagementRunResult,
    /// The certified shares; `None` if they were not asked for, or cannot be known for this stock.
    pub shares: Option<CertifiedShares>,
    /// The test of the shares at points; `None` if it was not asked for, or if there is none for this stock.
    pub proof: Option<ChipProof>,
}

/// Simulates a program and collects its blocks. `touches` tells which motions may get another feed.
pub(in crate::transform::optimize_feed) fn measure_blocks(
    machining: &Machining<'_>,
    options: &MeasureOptions<'_>,
    limits: &LoadLimits,
    watch: &dyn RunWatcher,
    mut touches: impl FnMut(&Motion) -> bool,
) -> Result<MeasuredProgram, Failure> {
    let earlier = options.earlier;
    let known = earlier.and_then(|earlier| follow_motions(machining, options, limits, earlier, &mut touches));
    let (mut gathered, facts, ran, ends_of) = match known {
        Some(SameMotions { blocks, facts, ran, ends }) => (blocks, facts, ran, Some(ends)),
        None => {
            let (gathered, facts, ran) = gather_blocks(machining, options, limits, watch, &mut touches)?;
            (gathered, facts, ran, None)
        }
    };
    let shares = match options.model {
        EngagementModel::Certified => {
            let divide = |block: &FeedBlock, motion: usize| {
                let known = ends_of.as_ref().and_then(|ends| ends.get(&motion).cloned());
                known.unwrap_or_else(|| divide_block(block, (options.divide)(block)))
            };
            let known = (earlier.and_then(|earlier| earlier.shares.as_ref()), watch);
            certify_blocks(machining, limits, &mut gathered, &facts, &divide, known)?
        }
        _ => None,
    };
    let proof = match &shares {
        Some(shares) if earlier.is_some() => machining.test_shares(shares, watch)?,
        _ => None,
    };
    let proof = proof.map(|proof| prove_chips(machining, limits, (&gathered, &facts), &proof));
    Ok(MeasuredProgram { blocks: gathered, facts, ran, shares, proof })
}

/// Simulates a program in columns or layers and makes blocks of it.
fn gather_blocks(
    machining: &Machining<'_>,
    options: &MeasureOptions<'_>,
    limits: &LoadLimits,
    watch: &dyn RunWatcher,
    touches: &mut dyn FnMut(&Motion) -> bool,
) -> Result<(MeasuredBlocks, Vec<BlockFacts>, EngagementRunResult), Failure> {
    let (mut gathered, mut facts) = (MeasuredBlocks::default(), Vec::new());
    let mut before = None;
    let ran = machining.find_engagements(&options.run, options.model, watch, &mut |engaged| {
        let touched = touches(engaged.motion);
        let axis_limit = options.axis_limits.get(&engaged.motion.last_statement()).copied();
        facts.extend(gathered.add_motion(machining, limits, engaged, (touched, axis_limit), &mut before));
    })?;
    let reach = match ran.resolution {
        StockResolution::Cell(cell) => AROUND * cell,
        StockResolution::Layer(_) => SHORT,
    };
    // Only now are the pieces behind a short piece known, and they count for it as well.
    lower_short_pieces(&mut gathered.blocks, reach);
    Ok((gathered, facts, ran))
}

/// A piece is compared with the pieces that are so many cells of path before and after it. A shorter piece
/// may pass between two columns and seem to cut nothing.
const AROUND: f64 = 1.5;

/// The same distance for layers, in mm. What a shorter piece removes may be as thin as the error of chords.
const SHORT: f64 = 0.1;

/// The previous motion, as far as it decides whether a chain of blocks breaks.
#[derive(Debug)]
struct PreviousMotion {
    last: StatementId,
    tool: Option<usize>,
    moves_at_feed: bool,
}

impl MeasuredBlocks {
    /// Adds the block of a motion at feed, and returns what certification needs to know of it.
    fn add_motion(
        &mut self,
        machining: &Machining<'_>,
        limits: &LoadLimits,
        engaged: &EngagedMotion<'_>,
        (touched, axis_limit): (bool, Option<f64>),
        before: &mut Option<PreviousMotion>,
    ) -> Option<BlockFacts> {
        let motion = engaged.motion;
        let program = machining.program();
        let at_feed = !motion.rapid && !matches!(motion.path, MotionPath::Start);
        let last = motion.last_statement();
        // The machine stands still or moves at rapid where a chain breaks, so the feed can change freely
        // there.
        let goes_on = before.as_ref().is_some_and(|before| {
            before.moves_at_feed
                && at_feed
                && before.tool == engaged.cutter
                && !has_machine_stop(program, before.last, last)
        });
        *before = Some(PreviousMotion { last, tool: engaged.cutter, moves_at_feed: at_feed });
        if !at_feed {
            return None;
        }
        let unit = machining.length_unit();
        let length = motion.length() * unit.mm_per_unit();
        let rpm = motion.spindle_rpm();
        let feed = motion.feed.and_then(|feed| feed.mm_per_minute(unit, rpm, Some(motion.length())));
        let feed = feed.filter(|feed| *feed > 0.0);
        let cutter =
            engaged.cutter.and_then(|index| Some((machining.tooling().cutters().get(index)?, index)));
        let cuts = engaged.pieces.iter().any(|(_, found)| limits.is_cutting(found));
        let spindle = motion.spindle.as_deref();
        let turning = rpm.filter(|rpm| *rpm > 0.0).map(|rpm| SpindleRotation {
            rpm,
            direction: spindle.and_then(|spindle| spindle.direction).unwrap_or(SpindleDirection::Clockwise),
        });
        if cuts && touched && (feed.is_none() || turning.is_none()) {
            self.errors.push(describe_unknown_feed(program, motion, feed.is_none()));
        }
        let mut pieces = Vec::with_capacity(engaged.pieces.len());
        let mut other_limits = Vec::new();
        let mut measured: Vec<[f64; 2]> = vec![[0.0; 2]; limits.criterion_limits().len()];
        if let (Some((cutter, index)), Some(turning)) = (cutter, turning) {
            for (piece, found) in engaged.pieces {
                let mut limit = limits.find_feed_limit(found, cutter, index, turning);
                if limit == FeedLimit::Limit(f64::INFINITY) && !cuts {
                    // This may be a sliver of material that no limit can judge. Nothing else is known about
                    // it, so it keeps its feed.
                    limit = feed.map_or(FeedLimit::Air, FeedLimit::Limit);
                }
                other_limits.extend(limits.find_other_limit(found, index, turning));
                pieces.push(LimitedPiece { length: (piece.to - piece.from) * length, limit });
                let Some(feed) = feed.filter(|_| limits.is_cutting(found)) else { continue };
                for (measured, (criterion, _)) in measured.iter_mut().zip(limits.criterion_limits()) {
                    let [estimate, bound] =
                        limits.measure_criterion(*criterion, found, (cutter, index), feed, turning);
                    *measured = [measured[0].max(estimate), measured[1].max(bound)];
                }
            }
        }
        // A hole is one point of a cycle, and the parts of a spline would need control points and knots of
        // their own. So neither is split.
        let mut whole = motion.hole.is_some() || matches!(motion.path, MotionPath::Spline(_));
        // A point in between would change the path of a machine that leaves the line, and with it what is cut.
        whole |= machining.leaves_programmed_path(engaged.number);
        self.blocks.push(FeedBlock {
            length,
            programmed: feed.unwrap_or(0.0),
            // Without a FEDRAT to change or to copy, no feed can be written. The feed of a hole belongs to
            // its whole cycle.
            touched: touched && feed.is_some() && motion.feed_from.is_some() && motion.hole.is_none(),
            splittable: !whole,
            axis_limit: axis_limit.unwrap_or(f64::INFINITY),
            breaks_chain: !goes_on,
            pieces,
        });
        self.measurements.push(BlockMeasurement {
            motion: engaged.number,
            statement: motion.last_statement(),
            operation: motion.operation,
            cuts,
            measured,
        });
        Some(BlockFacts { motion: engaged.number, cutter: engaged.cutter, turning, other_limits })
    }
}

fn describe_unknown_feed(program: &Program, motion: &Motion, feed: bool) -> Diagnostic {
    let message = if feed {
        "this motion cuts, but its feed is not known"
    } else {
        "this motion cuts, but its spindle speed in rev/min is not known"
    };
    let span = program.statement(motion.last_statement()).origin();
    Diagnostic::new(codes::FEED_UNKNOWN, message).with_label(program.source(), span, "cuts here")
}
