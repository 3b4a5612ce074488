//! This module measures a program again of which only feeds have changed: its motions remove the same material, so that
//! it needs no second run over columns.

use super::block_measurement::{MeasureOptions, MeasuredBlocks, MeasuredProgram};
use super::certified_blocks::BlockFacts;
use super::load_criterion::LoadCriterion;
use super::load_limits::LoadLimits;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::simulation_run::{EngagementModel, EngagementRunResult, Machining};
use std::collections::BTreeMap;

/// What the run before tells of the same motions.
pub(super) struct SameMotions {
    pub blocks: MeasuredBlocks,
    pub facts: Vec<BlockFacts>,
    pub ran: EngagementRunResult,
    /// The fractions of its length at which the pieces of a motion end.
    pub ends: BTreeMap<usize, Vec<f64>>,
}

/// Returns what the run before tells of a program whose feeds have changed. `None` where columns have to be asked again:
/// if motions were split, if loads other than certified chips are limited, or if the feed of a block has changed whose
/// chips are by columns.
pub(super) fn follow_motions(
    machining: &Machining<'_>,
    options: &MeasureOptions<'_>,
    limits: &LoadLimits,
    earlier: &MeasuredProgram,
    touches: &mut dyn FnMut(&Motion) -> bool,
) -> Option<SameMotions> {
    let chips_only =
        limits.criterion_limits().iter().all(|(criterion, _)| *criterion == LoadCriterion::ChipThickness);
    let shares =
        earlier.shares.as_ref().filter(|_| chips_only && options.model == EngagementModel::Certified)?;
    let (mut blocks, unit) = (earlier.blocks.clone(), machining.length_unit());
    let mut places = blocks.blocks.iter_mut().zip(&mut blocks.measurements);
    for (number, motion) in machining.program().motions().enumerate() {
        if motion.rapid || matches!(motion.path, MotionPath::Start) {
            continue;
        }
        let (block, measurement) = places.next().filter(|(_, known)| known.motion == number)?;
        let length = motion.length() * unit.mm_per_unit();
        let feed = motion
            .feed
            .and_then(|feed| feed.mm_per_minute(unit, motion.spindle_rpm(), Some(motion.length())));
        let feed = feed.filter(|feed| *feed > 0.0).unwrap_or(0.0);
        let is_touched =
            touches(&motion) && feed > 0.0 && motion.feed_from.is_some() && motion.hole.is_none();
        let is_bounded = shares.pieces_of(number).is_some();
        if length != block.length || is_touched != block.touched || feed != block.programmed && !is_bounded {
            return None;
        }
        block.programmed = feed;
        measurement.statement = motion.last_statement();
        block.axis_limit = options.axis_limits.get(&measurement.statement).copied().unwrap_or(f64::INFINITY);
    }
    if places.next().is_some() {
        return None;
    }
    let ends_of = |motion: usize| Some(shares.pieces_of(motion)?.iter().map(|piece| piece.to).collect());
    let ends = blocks.measurements.iter().filter_map(|known| Some((known.motion, ends_of(known.motion)?)));
    let ends = ends.collect();
    let ran = EngagementRunResult {
        resolution: earlier.ran.resolution,
        lowest_mm: earlier.ran.lowest_mm,
        findings: Vec::new(),
    };
    Some(SameMotions { blocks, facts: earlier.facts.clone(), ran, ends })
}
