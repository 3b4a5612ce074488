//! This module runs the step: it simulates, decides, writes and simulates again.

use super::certification_findings::{describe_refutation, report_uncertified};
use super::limit::{FeedGoals, FeedWindow};
use super::measure::{
    BlockDivision, FeedBlock, LoadCriterion, LoadLimits, MeasureOptions, MeasuredProgram, measure_blocks,
};
use super::parameters::OptimizeFeed;
use super::prove::{build_report, prove_targets};
use super::settled_feeds::SettledFeeds;
use super::target_slips::{warn_of_distant_targets, warn_of_thick_target, warn_of_unreached_targets};
use super::write::add_load_notes;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::machine::time_program;
use crate::number::format_point;
use crate::parameters::Positive;
use crate::program::Program;
use crate::program::motion::{ActiveTool, Motion};
use crate::setup::Setup;
use crate::simulation_run::{EngagementModel, EngagementRunResult, Machining, SimulationRunOptions};
use crate::transform::axis_feed_limits::list_axis_feed_limits;
use crate::transform::{DrawnLimit, MotionSelection, StepContext, Transform};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The longest piece of path that is measured on its own where blocks may not be split, in mm. Margins and
/// half blocks depend on where the material is within a block.
const PIECE: f64 = 1.0;

/// This step finds the feed at which the chips of a slot are 0.05 mm thick.
///
/// ```
/// use clsmith::parameters::Positive;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{OptimizeFeed, run_steps};
///
/// let shop = b"machine: { max_feed: 8000 }\nstock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }\n\
///     tools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]\n";
/// let setup = Setup::load(&Source::new("shop.yaml", shop.to_vec())?)?;
/// let part = b"LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-10.0000,0.0000,-2.0000\n\
///     FEDRAT/MMPM,400.0000\nGOTO/40.0000,0.0000,-2.0000\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let mut step = OptimizeFeed::new(Positive::new(0.05).expect("0.05 mm is above 0"));
/// step.cell = Positive::new(0.5);
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &setup, program)?;
/// // A full slot with a chip of 0.05 mm, four teeth and 5000 rev/min: about 1000 mm/min.
/// let slot = outcome.program.motions().last().and_then(|motion| motion.feed).expect("there is a feed");
/// assert!(slot.value > 900.0 && slot.value <= 1000.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for OptimizeFeed {
    fn measures(&self) -> bool {
        true
    }

    fn drawn_limits(&self, mm_per_unit: f64) -> Vec<DrawnLimit> {
        self.limits_for_drawings(mm_per_unit)
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let job = OptimizeFeedJob::new(self, &program, context)?;
        let mut measured_before = job.simulate_blocks(self, &program, None, context)?;
        let (before, ran) = (&measured_before.blocks, &mut measured_before.ran);
        let resolution = ran.resolution;
        if !before.measurements.iter().any(|measurement| measurement.cuts) {
            return Err(job.describe_nothing_cut(&program, ran, context));
        }
        // Assumptions and crashes are only reported once, for the program before the change.
        context.findings.append(&mut ran.findings);
        warn_of_distant_targets(&job.goals, before, context);
        let on_machine = job.find_machine_seconds(&program, context);
        let settled = job.settle_feeds(self, program, &measured_before, context)?;
        let MeasuredProgram { blocks: before, shares, .. } = measured_before;
        let SettledFeeds { mut program, excused, parts, after: measured } = settled;
        let MeasuredProgram { blocks: after, shares: shares_after, proof, .. } = measured;
        if let Some(motion) = proof.and_then(|proof| proof.refuted_motion) {
            return Err(describe_refutation(&program, motion, context));
        }
        if job.engagement == EngagementModel::Certified {
            report_uncertified(shares_after.as_ref(), context);
        }
        prove_targets(&job.goals, &program, &after, &excused, context)?;
        warn_of_unreached_targets(&job.goals, &after, context);
        add_load_notes(&job.goals, (&mut program, context.step), &before, &after, &parts);
        let bounds = (resolution, shares_after.is_some(), proof);
        context.shares.replace(shares.into_iter().chain(shares_after));
        let on_machine = on_machine.zip(job.find_machine_seconds(&program, context));
        let report = build_report(&job.goals, &program, (&before, &after), bounds, context.step);
        context.add_report(report.with_machine_seconds(on_machine));
        Ok(program)
    }
}

/// Lowers the limits that depend on the material's law by the error of its fit.
///
/// # Errors
/// Returns a finding at the key if no limit depends on it, or the material does not tell its error.
fn widen_by_fit_error(
    limits: &mut [(LoadCriterion, f64)],
    context: &mut StepContext<'_>,
) -> Result<(), Failure> {
    let keys = ["fit_error_margin"];
    if !limits.iter().any(|(criterion, _)| criterion.needs_material()) {
        let message = "no limit of this step depends on a material; remove `fit_error_margin`";
        return Err(context.step_failure(message.to_owned(), &keys));
    }
    let labelled =
        |failure: Failure| failure.map_findings(|found| context.label_step(found, "asked for by this step"));
    let material = context.setup.require_material().map_err(labelled)?;
    let Some(residual) = material.origin.residual_part else {
        let name = material.name.as_deref().unwrap_or("of the setup");
        let message = format!(
            "the material {name} does not say by how much measured forces differed from its law (`residual`)"
        );
        let error = context.step_finding(codes::FIT_ERROR_MISSING, message, &keys, "asked for here");
        return Err(error.into());
    };
    let message = format!(
        "limits of forces are divided by {:.3}: measured cuts differed by {:.1} % from the law of the material",
        1.0 + residual,
        residual * 100.0
    );
    let note = context.step_finding(codes::ASSUMPTION, message, &keys, "asked for here");
    for (_, limit) in limits.iter_mut().filter(|(criterion, _)| criterion.needs_material()) {
        *limit /= 1.0 + residual;
    }
    context.findings.push(note);
    Ok(())
}

/// Returns the tools of the motions that may get another feed. Those that no such motion moves need no data.
fn list_selected_tools(
    step: &OptimizeFeed,
    program: &Program,
    context: &StepContext<'_>,
) -> Vec<Arc<ActiveTool>> {
    let mut selection = MotionSelection::new(&step.r#where, program, context);
    let mut tools: Vec<Arc<ActiveTool>> = Vec::new();
    for motion in program.motions() {
        let may_change = !motion.rapid && step.motions.contains(&motion.class);
        let tool = motion.tool.clone().unwrap_or_default();
        // Motions of one tool follow each other.
        let is_known = tools.last() == Some(&tool) || tools.contains(&tool);
        if may_change && !is_known && selection.contains(&motion, context) {
            tools.push(tool);
        }
    }
    tools
}

/// The parameters in millimetres.
pub(super) struct OptimizeFeedJob {
    pub(super) goals: FeedGoals,
    options: SimulationRunOptions,
    engagement: EngagementModel,
}

impl OptimizeFeedJob {
    fn new(step: &OptimizeFeed, program: &Program, context: &mut StepContext<'_>) -> Result<Self, Failure> {
        let mm_per_unit = context.units.mm_per_unit();
        let Some(rules) = step.feed_rules(mm_per_unit, &context.setup.machine) else {
            let message =
                "there is no highest feed: neither the step has `max_feed`, nor the setup a machine with one";
            let help = "Add `max_feed: 3000` to this step, or `machine: { max_feed: 10000 }` to the setup (in its \
                        unit per minute).";
            let error = context.step_finding(codes::STEP_FAILED, message, &[], "asked for here");
            return Err(error.with_help(help).into());
        };
        if rules.min_feed > rules.max_feed {
            let (low, high) = (rules.min_feed / mm_per_unit, rules.max_feed / mm_per_unit);
            let message = format!(
                "the lowest feed {low} is above the highest feed {high}; set `min_feed` to {high} or less"
            );
            return Err(context.step_failure(message, &["min_feed"]));
        }
        let engagement = step.engagement_model(mm_per_unit).map_err(|key| {
            let other = if key == "cell" { "columns" } else { "layers" };
            context.step_failure(format!("`{key}` is only used with `engagement: {other}`; remove `{key}`, or add `engagement: {other}`"), &[key])
        })?;
        let longest = rules.split.map_or(PIECE, |split| split.shortest.min(PIECE));
        let mut limits = step.limits_in_mm(mm_per_unit);
        if step.fit_error_margin {
            widen_by_fit_error(&mut limits, context)?;
        }
        let options = SimulationRunOptions {
            cell_mm: step.cell.map(Positive::get).map(|cell| cell * mm_per_unit),
            longest_piece_mm: longest,
            forces: limits.iter().any(|(criterion, _)| criterion.needs_material()),
            ..SimulationRunOptions::default().within_limits(context.watch)
        };
        let goals = FeedGoals { limits, rules, units: context.file_length_unit(program) };
        Ok(Self { goals, options, engagement })
    }

    /// Returns the time of a program on the machine in s. `None` if the setup does not know it.
    fn find_machine_seconds(&self, program: &Program, context: &StepContext<'_>) -> Option<f64> {
        let dynamics = context.setup.machine.dynamics()?;
        Some(time_program(program, self.goals.units, &dynamics).total())
    }

    /// Simulates a program.
    pub(super) fn simulate_blocks(
        &self,
        step: &OptimizeFeed,
        program: &Program,
        earlier: Option<&MeasuredProgram>,
        context: &mut StepContext<'_>,
    ) -> Result<MeasuredProgram, Failure> {
        let setup: &Setup = context.setup;
        let mut notes = Vec::new();
        // The cuts of other tools change the stock; data of them is welcome, and not demanded.
        let selected = list_selected_tools(step, program, context);
        let needed = |tool: &ActiveTool| selected.iter().any(|selected| **selected == *tool);
        let machining = Machining::for_tools(program, setup, self.goals.units, &needed, &mut notes);
        let machining = machining.map_err(|failure| {
            failure.map_findings(|found| {
                if found.labels.is_empty() { self.label_step(found, context) } else { found }
            })
        })?;
        context.findings.extend(notes);
        let needs =
            |need: fn(LoadCriterion) -> bool| self.goals.limits.iter().any(|(criterion, _)| need(*criterion));
        if needs(LoadCriterion::needs_teeth) {
            let gaps = machining.tooling().find_missing_teeth(program, setup, &needed);
            if !gaps.is_empty() {
                return Err(gaps.into());
            }
        }
        if needs(LoadCriterion::needs_stiffness) {
            let gaps = machining.tooling().find_missing_stiffness(program, setup, &needed);
            if !gaps.is_empty() {
                let labelled = gaps.into_iter().map(|gap| self.label_step(gap, context));
                return Err(labelled.collect::<Vec<_>>().into());
            }
        }
        let material = if needs(LoadCriterion::needs_material) {
            let labelled = |failure: Failure| failure.map_findings(|found| self.label_step(found, context));
            Some(setup.require_material().map_err(labelled)?.law)
        } else {
            None
        };
        warn_of_thick_target(&self.goals, machining.tooling(), context);
        let resolution = machining
            .choose_resolution(&self.options, self.engagement)
            .map_err(|failure| failure.map_findings(|found| self.label_resolution(found, context)))?;
        let limits = LoadLimits::new(self.goals.limits.clone(), machining.tooling(), material, resolution);
        let mut selection = MotionSelection::new(&step.r#where, program, context);
        let watch = context.watch;
        let axis_limits = if step.axes { list_axis_feed_limits(program, context)? } else { BTreeMap::new() };
        let options = MeasureOptions {
            axis_limits: &axis_limits,
            run: self.options,
            model: self.engagement,
            divide: &|block| self.divide_block(block),
            earlier,
        };
        let measured = measure_blocks(&machining, &options, &limits, watch, |motion: &Motion| {
            !motion.rapid && step.motions.contains(&motion.class) && selection.contains(motion, context)
        });
        let mut measured = measured
            .map_err(|failure| failure.map_findings(|found| self.label_resolution(found, context)))?;
        selection.report_if_empty(program, context);
        if !measured.blocks.errors.is_empty() {
            return Err(std::mem::take(&mut measured.blocks.errors).into());
        }
        Ok(measured)
    }

    /// Returns how a block is divided. Only where parts of blocks count has a block more than one.
    fn divide_block(&self, block: &FeedBlock) -> BlockDivision {
        match (self.goals.rules.window, self.goals.rules.split) {
            (FeedWindow::HalfBlocks, _) => BlockDivision::Halves,
            (_, Some(rule)) if rule.applies_to(block) => BlockDivision::Parts(2 * rule.at_most),
            _ => BlockDivision::Whole,
        }
    }

    fn label_step(&self, found: Diagnostic, context: &StepContext<'_>) -> Diagnostic {
        context.label_step(found, "asked for by this step")
    }

    fn label_resolution(&self, found: Diagnostic, context: &StepContext<'_>) -> Diagnostic {
        let keys = match self.engagement {
            EngagementModel::Certified | EngagementModel::Dexels => ["cell"],
            EngagementModel::Layers { .. } if found.code == codes::LAYERS => ["layer"],
            EngagementModel::Layers { .. } => ["engagement"],
        };
        context.label_parameter(found, &keys, "asked for here")
    }
}

impl OptimizeFeedJob {
    /// Builds the error for a program that cuts nothing at all. It is misplaced in its stock, and all of it
    /// would run at the air feed.
    fn describe_nothing_cut(
        &self,
        program: &Program,
        ran: &EngagementRunResult,
        context: &StepContext<'_>,
    ) -> Failure {
        let mut points = program.motions().filter(|motion| !motion.rapid).map(|motion| motion.to.point);
        let path = points.next().map(|first| points.fold((first, first), |(a, b), p| (a.inf(&p), b.sup(&p))));
        let unit = self.goals.units;
        let decimals = if unit == crate::program::LengthUnit::Inch { 3 } else { 1 };
        let path = path.map_or_else(String::new, |(low, high)| {
            let [low, high] = [low, high].map(|corner| format_point(corner.coords.into(), decimals));
            format!("; the feed motions end between {low} and {high}")
        });
        let lowest = format_point(ran.lowest_mm.map(|mm| mm / unit.mm_per_unit()), decimals);
        let message = format!(
            "no motion of this program cuts the stock. Check that `stock` has the coordinates of the program. In {unit}, the lowest corner of the stock is at {lowest}{path}"
        );
        context.step_failure(message, &[])
    }
}
