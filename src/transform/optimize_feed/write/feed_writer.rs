//! This module plans and writes feeds. Motions that get several feeds are split, then FEDRATs are inserted.

use super::motion_split::{SplitProgram, split_motions};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::Program;
use crate::transform::StepContext;
use crate::transform::feed_plan::{FeedPlan, decimals_of_feed, round_feed_down};
use crate::transform::optimize_feed::limit::FeedGoals;
use crate::transform::optimize_feed::measure::{FeedBlock, MeasuredBlocks};
use crate::transform::optimize_feed::plan::{BlockFeeds, plan_block_feeds};
use crate::write::ProgramEditor;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// The relative difference that arithmetic leaves between equal feeds.
const NOISE: f64 = 1e-6;

/// The corrected program.
pub(in crate::transform::optimize_feed) struct OptimizedProgram {
    pub program: Program,
    /// The indices of the motions that exceed a target at the lowest allowed feed.
    pub excused: BTreeSet<usize>,
    /// For each motion before the change, the motions that it has become.
    pub parts: Vec<Range<usize>>,
}

/// Decides the feeds and writes them.
pub(in crate::transform::optimize_feed) fn plan_and_write_feeds(
    goals: &FeedGoals,
    program: Program,
    before: &MeasuredBlocks,
    context: &mut StepContext<'_>,
) -> Result<OptimizedProgram, Failure> {
    let (planned, split) = plan_and_split(goals, &program, before, context)?;
    report_below_minimum(&program, before, &planned, context);
    let SplitProgram { program, parts, .. } = split;
    let slowest = planned.below_minimum.iter().filter_map(|block| before.measurements.get(*block));
    let excused =
        slowest.filter_map(|measurement| parts.get(measurement.motion).cloned()).flatten().collect();
    let wanted = list_wanted_feeds(before, &planned, &parts);
    let plan = FeedPlan::for_numbered_motions(&program, |number, motion| {
        let wanted = wanted.get(&number)?;
        let value = motion.feed?.value;
        let actual = motion.feed?.mm_per_minute(goals.units, motion.spindle_rpm(), Some(motion.length()))?;
        if (wanted - actual).abs() <= NOISE * actual {
            return None;
        }
        let decimals = motion.feed_from.map_or(0, |statement| decimals_of_feed(&program, statement));
        Some(round_feed_down(value * wanted / actual, decimals))
    });
    let mut editor = ProgramEditor::new(program, context.step);
    plan.write_feeds(&mut editor, &mut context.findings)?;
    Ok(OptimizedProgram { program: editor.finish()?, excused, parts })
}

/// Plans feeds and splits motions for them. If a motion cannot be split, it is marked, and everything is
/// planned again, because its whole block then needs a single feed.
fn plan_and_split(
    goals: &FeedGoals,
    program: &Program,
    before: &MeasuredBlocks,
    context: &mut StepContext<'_>,
) -> Result<(BlockFeeds, SplitProgram), Failure> {
    let mut blocks = before.blocks.clone();
    loop {
        let planned = plan_block_feeds(&blocks, &goals.rules);
        let mut findings = Vec::new();
        let wanted = list_wanted_splits(before, &planned);
        let split = split_motions(program.clone(), context.step, &wanted, &mut findings)?;
        let kept: BTreeSet<usize> = split.kept.iter().map(|(motion, _)| *motion).collect();
        let unsplit: Vec<&mut FeedBlock> = blocks
            .iter_mut()
            .zip(&before.measurements)
            .filter(|(block, measurement)| block.splittable && kept.contains(&measurement.motion))
            .map(|(block, _)| block)
            .collect();
        if unsplit.is_empty() {
            context.findings.extend(findings);
            return Ok((planned, split));
        }
        unsplit.into_iter().for_each(|block| block.splittable = false);
    }
}

/// Returns each motion that gets several feeds, with the fractions of its length at which it is split.
fn list_wanted_splits(before: &MeasuredBlocks, planned: &BlockFeeds) -> Vec<(usize, Vec<f64>)> {
    let measured = before.measurements.iter().zip(&planned.segments);
    let inner = measured.filter_map(|(measurement, segments)| {
        let (_, rest) = segments.split_last()?;
        let ends: Vec<f64> = rest.iter().map(|segment| segment.end).collect();
        (!ends.is_empty()).then_some((measurement.motion, ends))
    });
    inner.collect()
}

/// Returns the feed in mm/min that each motion of the split program shall have, where it may change.
fn list_wanted_feeds(
    before: &MeasuredBlocks,
    planned: &BlockFeeds,
    parts: &[Range<usize>],
) -> BTreeMap<usize, f64> {
    let mut wanted = BTreeMap::new();
    let blocks = before.blocks.iter().zip(&before.measurements).zip(&planned.segments);
    for ((_, measurement), segments) in blocks.filter(|((block, _), _)| block.touched) {
        let Some(range) = parts.get(measurement.motion) else { continue };
        wanted.extend(range.clone().zip(segments.iter().map(|segment| segment.feed)));
    }
    wanted
}

/// Reports blocks that exceed the target at the lowest allowed feed.
fn report_below_minimum(
    program: &Program,
    before: &MeasuredBlocks,
    planned: &BlockFeeds,
    context: &mut StepContext<'_>,
) {
    // The place in the recipe is the same for all, and finding it reads the recipe.
    let message = "the target is exceeded here at the lowest allowed feed";
    let at_minimum = context.label_parameter(
        Diagnostic::new(codes::BELOW_MINIMUM, message),
        &["min_feed"],
        "the lowest feed",
    );
    for block in &planned.below_minimum {
        let Some(measurement) = before.measurements.get(*block) else { continue };
        let span = program.statement(measurement.statement).origin();
        let mut finding = at_minimum.clone().with_label(program.source(), span, "more than the target");
        // The place in the program is the primary one.
        finding.labels.rotate_right(1);
        context.findings.push(finding);
    }
}
