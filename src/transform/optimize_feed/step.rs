//! The step: simulate, decide, write, simulate again.

use super::block_feeds::{BlockFeeds, FeedRules, plan_block_feeds};
use super::block_measurement::{MeasuredBlocks, measure_blocks};
use super::load_limits::LoadLimits;
use super::motion_split::{SplitProgram, split_motions};
use super::parameters::{LoadCriterion, OptimizeFeed};
use crate::diagnostic::{Diagnostic, codes, Failure};
use crate::parameters::Positive;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::simulation_run::{EngagementModel, EngagementRunResult, Machining, SimulationRunOptions};
use crate::transform::feed_plan::{FeedPlan, decimals_of_feed, round_feed_down};
use crate::transform::{MotionSelection, StepContext, Transform};
use crate::write::ProgramEditor;
use std::collections::BTreeSet;
use std::ops::Range;

/// Longest piece of path that is looked at on its own where blocks may not be split, mm: margins and half blocks need to know
/// where in a block the material is.
const PIECE: f64 = 1.0;

/// What arithmetic makes of equal loads.
const NOISE: f64 = 1e-6;

/// Findings of one kind that are told one by one.
const TOLD: usize = 10;

impl Transform for OptimizeFeed {
    fn measures(&self) -> bool {
        true
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let job = OptimizeFeedJob::new(self, &program, context)?;
        let (before, ran) = job.simulate_blocks(self, &program, context)?;
        if !before.marks.iter().any(|mark| mark.cuts) {
            return Err(job.describe_nothing_cut(&program, &ran, context));
        }
        // Assumptions and crashes are told once, of the program as it came.
        context.findings.extend(ran.findings);
        let OptimizedProgram { mut program, excused, parts } =
            job.plan_and_write_feeds(program, &before, context)?;
        let told = std::mem::take(&mut context.findings);
        let proof = job.simulate_blocks(self, &program, context);
        context.findings = told;
        let (after, _) = proof?;
        job.prove_targets(&program, &after, &excused, context)?;
        job.add_load_notes((&mut program, context.step), &before, &after, &parts);
        context.add_report(job.build_report(&program, &before, &after, ran.grain, context.step));
        Ok(program)
    }
}

/// The corrected program.
struct OptimizedProgram {
    program: Program,
    /// Numbers of the motions that pass a target at the lowest feed allowed.
    excused: BTreeSet<usize>,
    /// For each motion before, its motions now.
    parts: Vec<Range<usize>>,
}

/// The parameters in millimetres.
pub(super) struct OptimizeFeedJob {
    pub(super) limits: Vec<(LoadCriterion, f64)>,
    pub(super) rules: FeedRules,
    options: SimulationRunOptions,
    source: EngagementModel,
    pub(super) units: LengthUnit,
}

impl OptimizeFeedJob {
    fn new(
        step: &OptimizeFeed,
        program: &Program,
        context: &StepContext<'_>,
    ) -> Result<Self, Failure> {
        let mm = context.units.mm_per_unit();
        let Some(rules) = step.feed_rules(mm, &context.setup.machine) else {
            let message = "there is no highest feed: neither the step's `max_feed` nor the setup's `machine: { max_feed: ... }`";
            return Err(context.step_failure(message, &[]));
        };
        if rules.min_feed > rules.max_feed {
            let (low, high) = (rules.min_feed / mm, rules.max_feed / mm);
            return Err(context
                .step_failure(format!("the lowest feed {low} is above the highest {high}"), &["min_feed"]));
        }
        let source = step.engagement_model(mm).map_err(|key| {
            let other = if key == "cell" { "dexels" } else { "layers" };
            context.step_failure(format!("`{key}` has a meaning with `engagement: {other}` only"), &[key])
        })?;
        let longest = rules.split.map_or(PIECE, |split| split.shortest.min(PIECE));
        let limits = step.limits_in_mm(mm);
        let options = SimulationRunOptions {
            cell: step.cell.map(Positive::get).map(|cell| cell * mm),
            longest,
            forces: limits.iter().any(|(criterion, _)| criterion.needs_material()),
            ..SimulationRunOptions::default()
        };
        Ok(Self { limits, rules, options, source, units: context.file_length_unit(program) })
    }

    /// Simulates a program.
    fn simulate_blocks(
        &self,
        step: &OptimizeFeed,
        program: &Program,
        context: &mut StepContext<'_>,
    ) -> Result<(MeasuredBlocks, EngagementRunResult), Failure> {
        let setup: &Setup = context.setup;
        let mut notes = Vec::new();
        let machining = Machining::new(program, setup, self.units, &mut notes).map_err(|failure| {
            failure.map_findings(|found| {
                if found.labels.is_empty() { self.label_step(found, context) } else { found }
            })
        })?;
        context.findings.extend(notes);
        let needs =
            |need: fn(LoadCriterion) -> bool| self.limits.iter().any(|(criterion, _)| need(*criterion));
        if needs(LoadCriterion::needs_teeth) {
            let gaps = machining.tooling().find_missing_teeth(program, setup);
            if !gaps.is_empty() {
                return Err(gaps.into());
            }
        }
        let material = if needs(LoadCriterion::needs_material) {
            let labelled = |failure: Failure| failure.map_findings(|found| self.label_step(found, context));
            Some(setup.require_material().map_err(labelled)?.coefficients)
        } else {
            None
        };
        let grain = machining
            .choose_resolution(&self.options, self.source)
            .map_err(|failure| failure.map_findings(|found| self.label_resolution(found, context)))?;
        let limits = LoadLimits::new(self.limits.clone(), machining.tooling(), material, grain);
        let mut selection = MotionSelection::new(&step.r#where, program, context);
        let watch = context.watch;
        let gathered =
            measure_blocks(&machining, (&self.options, self.source), &limits, watch, |motion: &Motion| {
                !motion.rapid && step.motions.contains(&motion.class) && selection.contains(motion, context)
            });
        let (mut gathered, ran) =
            gathered.map_err(|failure| failure.map_findings(|found| self.label_resolution(found, context)))?;
        selection.report_if_empty(context);
        if !gathered.errors.is_empty() {
            let mut errors = std::mem::take(&mut gathered.errors);
            let more = errors.len().saturating_sub(TOLD);
            errors.truncate(TOLD);
            if more > 0 {
                let message = format!("{more} more motions cut with a feed or a speed that cannot be known");
                errors.push(Diagnostic::new(codes::FEED_UNKNOWN, message));
            }
            return Err(errors.into());
        }
        Ok((gathered, ran))
    }

    fn label_step(&self, found: Diagnostic, context: &StepContext<'_>) -> Diagnostic {
        context.label_step(found, "asked for by this step")
    }

    fn label_resolution(&self, found: Diagnostic, context: &StepContext<'_>) -> Diagnostic {
        let keys = match self.source {
            EngagementModel::Dexels => ["cell"],
            EngagementModel::Layers { .. } if found.code == codes::LAYERS => ["layer"],
            EngagementModel::Layers { .. } => ["engagement"],
        };
        context.label_parameter(found, &keys, "asked for here")
    }

    /// Decides the feeds and writes them.
    fn plan_and_write_feeds(
        &self,
        program: Program,
        before: &MeasuredBlocks,
        context: &mut StepContext<'_>,
    ) -> Result<OptimizedProgram, Failure> {
        let mut blocks = before.blocks.clone();
        let step = context.step;
        let (splits, found) = loop {
            let found = plan_block_feeds(&blocks, &self.rules);
            let wanted: Vec<(usize, Vec<f64>)> = before
                .marks
                .iter()
                .zip(&found.parts)
                .filter_map(|(mark, parts)| {
                    let ends: Vec<f64> =
                        parts.split_last().map(|(_, rest)| rest.iter().map(|part| part.end).collect())?;
                    (!ends.is_empty()).then_some((mark.motion, ends))
                })
                .collect();
            let mut findings = Vec::new();
            let splits = split_motions(program.clone(), step, &wanted, &mut findings)?;
            let kept: BTreeSet<usize> = splits.kept.iter().map(|(motion, _)| *motion).collect();
            let whole = blocks
                .iter_mut()
                .zip(&before.marks)
                .filter(|(block, mark)| block.splittable && kept.contains(&mark.motion));
            let mut again = false;
            for (block, _) in whole {
                block.splittable = false;
                again = true;
            }
            if !again {
                context.findings.extend(findings);
                break (splits, found);
            }
        };
        self.report_below_minimum(&program, before, &found, context);
        let SplitProgram { program, parts, .. } = splits;
        let slowest = found.below_minimum.iter().filter_map(|block| before.marks.get(*block));
        let excused = slowest.filter_map(|mark| parts.get(mark.motion).cloned()).flatten().collect();
        let mut wanted = std::collections::BTreeMap::new();
        for ((mark, feeds), _) in
            before.marks.iter().zip(&found.parts).zip(&blocks).filter(|(_, block)| block.touched)
        {
            let Some(range) = parts.get(mark.motion) else { continue };
            wanted.extend(range.clone().zip(feeds.iter().map(|part| part.feed)));
        }
        let plan = FeedPlan::for_numbered_motions(&program, |number, motion| {
            let wanted = wanted.get(&number)?;
            let value = motion.feed?.value;
            let actual =
                motion.feed?.mm_per_minute(self.units, motion.spindle_rpm(), Some(motion.length()))?;
            if (wanted - actual).abs() <= NOISE * actual {
                return None;
            }
            let decimals = motion.feed_from.map_or(0, |statement| decimals_of_feed(&program, statement));
            Some(round_feed_down(value * wanted / actual, decimals))
        });
        let mut editor = ProgramEditor::new(program, step);
        plan.write_feeds(&mut editor, &mut context.findings)?;
        Ok(OptimizedProgram { program: editor.finish()?, excused, parts })
    }

    /// Blocks that pass the target at the lowest feed allowed.
    fn report_below_minimum(
        &self,
        program: &Program,
        before: &MeasuredBlocks,
        found: &BlockFeeds,
        context: &mut StepContext<'_>,
    ) {
        for block in found.below_minimum.iter().take(TOLD) {
            let Some(mark) = before.marks.get(*block) else { continue };
            let span = program.statement(mark.statement).origin();
            let message = "the target is passed here at the lowest feed allowed";
            let finding = Diagnostic::new(codes::BELOW_MINIMUM, message).with_label(
                program.source(),
                span,
                "more than the target",
            );
            context.findings.push(context.label_parameter(finding, &["min_feed"], "the lowest feed"));
        }
        if let Some(more) = found.below_minimum.len().checked_sub(TOLD).filter(|more| *more > 0) {
            let message = format!("the target is passed at the lowest feed allowed on {more} more motions");
            context.findings.push(Diagnostic::new(codes::BELOW_MINIMUM, message));
        }
    }
}

impl OptimizeFeedJob {
    /// A program that cuts nothing anywhere is in the wrong place over its stock, and all of it would run at the feed of air.
    fn describe_nothing_cut(
        &self,
        program: &Program,
        ran: &EngagementRunResult,
        context: &StepContext<'_>,
    ) -> Failure {
        let mut points = program.motions().filter(|motion| !motion.rapid).map(|motion| motion.to.point);
        let path = points.next().map(|first| points.fold((first, first), |(a, b), p| (a.inf(&p), b.sup(&p))));
        let mm = self.units.mm_per_unit();
        let path = path.map(|(low, high)| (low * mm, high * mm));
        let path = path.map_or_else(String::new, |(low, high)| {
            format!(
                "; the feed motions end between ({:.1}, {:.1}, {:.1}) and ({:.1}, {:.1}, {:.1})",
                low.x, low.y, low.z, high.x, high.y, high.z
            )
        });
        let [x, y, z] = ran.lowest;
        let message = format!(
            "no motion of this program cuts the stock: is it in the right place? In mm, the stock's lowest corner is at ({x:.1}, {y:.1}, {z:.1}){path}"
        );
        context.step_failure(message, &[])
    }
}
