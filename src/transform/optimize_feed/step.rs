//! The step: simulate, decide, write, simulate again.

use super::feeds::{Feeds, Rules, feeds};
use super::gather::{Gathered, gather};
use super::limits::Limits;
use super::parameters::{Criterion, OptimizeFeed};
use super::split::{Splits, split};
use crate::diagnostic::{Diagnostic, codes};
use crate::machining::{Engaged, Machining, Options, Source};
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program, Statement};
use crate::setup::Setup;
use crate::transform::feed_plan::{FeedPlan, decimals_of_feed, rounded_down};
use crate::transform::{Context, Selection, StepReport, Transform};
use crate::values::Positive;
use crate::write::Editor;
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
    fn apply(&self, program: Program, context: &mut Context<'_>) -> Result<Program, Box<Diagnostic>> {
        let job = Job::new(self, &program, context)?;
        let (before, ran) = job.look(self, &program, context)?;
        if !before.marks.iter().any(|mark| mark.cuts) {
            return Err(job.nothing_cut(&program, &ran, context));
        }
        // Assumptions and crashes are told once, of the program as it came.
        context.findings.extend(ran.findings);
        let Written { mut program, excused, parts } = job.write(program, &before, context)?;
        let told = std::mem::take(&mut context.findings);
        let proof = job.look(self, &program, context);
        context.findings = told;
        let (after, _) = proof?;
        job.prove(&program, &after, &excused, context)?;
        job.note((&mut program, context.step), &before, &after, &parts);
        context.reports.push(StepReport::OptimizeFeed(job.report(
            &program,
            &before,
            &after,
            ran.grain,
            context.step,
        )));
        Ok(program)
    }
}

/// The corrected program.
struct Written {
    program: Program,
    /// Numbers of the motions that pass a target at the lowest feed allowed.
    excused: BTreeSet<usize>,
    /// For each motion before, its motions now.
    parts: Vec<Range<usize>>,
}

/// The parameters in millimetres.
pub(super) struct Job {
    pub(super) limits: Vec<(Criterion, f64)>,
    pub(super) rules: Rules,
    options: Options,
    source: Source,
    pub(super) units: LengthUnit,
}

impl Job {
    fn new(step: &OptimizeFeed, program: &Program, context: &Context<'_>) -> Result<Self, Box<Diagnostic>> {
        let mm = context.recipe.units.in_mm();
        let Some(rules) = step.rules(mm, &context.setup.machine) else {
            let message = "there is no highest feed: neither the step's `max_feed` nor the setup's `machine: { max_feed: ... }`";
            return Err(context.fail(message, &[]));
        };
        if rules.min_feed > rules.max_feed {
            let (low, high) = (rules.min_feed / mm, rules.max_feed / mm);
            return Err(
                context.fail(format!("the lowest feed {low} is above the highest {high}"), &["min_feed"])
            );
        }
        let source = step.source(mm).map_err(|key| {
            let other = if key == "cell" { "dexels" } else { "layers" };
            context.fail(format!("`{key}` has a meaning with `engagement: {other}` only"), &[key])
        })?;
        let longest = rules.split.map_or(PIECE, |split| split.shortest.min(PIECE));
        let limits = step.all_limits(mm);
        let options = Options {
            cell: step.cell.map(Positive::get).map(|cell| cell * mm),
            longest,
            forces: limits.iter().any(|(criterion, _)| criterion.needs_material()),
            ..Options::default()
        };
        Ok(Self { limits, rules, options, source, units: context.file_units(program) })
    }

    /// Simulates a program.
    fn look(
        &self,
        step: &OptimizeFeed,
        program: &Program,
        context: &mut Context<'_>,
    ) -> Result<(Gathered, Engaged), Box<Diagnostic>> {
        let setup: &Setup = context.setup;
        let mut notes = Vec::new();
        let machining = Machining::new(program, setup, self.units, &mut notes).map_err(|found| {
            let placed = |found: Diagnostic| {
                if found.labels.is_empty() { *self.at_step(found, context) } else { found }
            };
            let found = found.into_iter().map(placed).collect();
            several(found, &mut context.findings)
        })?;
        context.findings.extend(notes);
        let needs = |need: fn(Criterion) -> bool| self.limits.iter().any(|(criterion, _)| need(*criterion));
        if needs(Criterion::needs_teeth) {
            let gaps = machining.tooling().teeth_gaps(program, setup);
            if !gaps.is_empty() {
                return Err(several(gaps, &mut context.findings));
            }
        }
        let material = if needs(Criterion::needs_material) {
            Some(setup.material().map_err(|found| self.at_step(*found, context))?.coefficients)
        } else {
            None
        };
        let grain =
            machining.grain(&self.options, self.source).map_err(|found| self.at_grain(*found, context))?;
        let limits = Limits::new(self.limits.clone(), machining.tooling(), material, grain);
        let mut selection = Selection::new(&step.r#where, program, context);
        let watch = context.watch;
        let gathered = gather(&machining, (&self.options, self.source), &limits, watch, |motion: &Motion| {
            !motion.rapid && step.motions.contains(&motion.class) && selection.contains(motion, context)
        });
        let gathered = gathered.map_err(|found| self.at_grain(*found, context))?;
        selection.report(context);
        let Some((mut gathered, ran)) = gathered else {
            return Err(context.fail("it was stopped before it was done", &[]));
        };
        if !gathered.errors.is_empty() {
            let mut errors = std::mem::take(&mut gathered.errors);
            let more = errors.len().saturating_sub(TOLD);
            errors.truncate(TOLD);
            if more > 0 {
                let message = format!("{more} more motions cut with a feed or a speed that cannot be known");
                errors.push(Diagnostic::new(codes::FEED_UNKNOWN, message));
            }
            return Err(several(errors, &mut context.findings));
        }
        Ok((gathered, ran))
    }

    fn at_step(&self, found: Diagnostic, context: &Context<'_>) -> Box<Diagnostic> {
        let place = context.recipe.step_place(usize::from(context.step.0));
        Box::new(found.label(&context.recipe.source, place, "asked for by this step"))
    }

    fn at_grain(&self, found: Diagnostic, context: &Context<'_>) -> Box<Diagnostic> {
        let keys = match self.source {
            Source::Dexels => ["cell"],
            Source::Layers { .. } if found.code == codes::LAYERS => ["layer"],
            Source::Layers { .. } => ["engagement"],
        };
        let place = context.recipe.step_value_place(usize::from(context.step.0), &keys);
        Box::new(found.label(&context.recipe.source, place, "asked for here"))
    }

    /// Decides the feeds and writes them.
    fn write(
        &self,
        program: Program,
        before: &Gathered,
        context: &mut Context<'_>,
    ) -> Result<Written, Box<Diagnostic>> {
        let mut blocks = before.blocks.clone();
        let step = context.step;
        let (splits, found) = loop {
            let found = feeds(&blocks, &self.rules);
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
            let splits = split(program.clone(), step, &wanted, &mut findings)?;
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
        self.warn(&program, before, &found, context);
        let Splits { program, parts, .. } = splits;
        let slowest = found.below_minimum.iter().filter_map(|block| before.marks.get(*block));
        let excused = slowest.filter_map(|mark| parts.get(mark.motion).cloned()).flatten().collect();
        let mut wanted = std::collections::BTreeMap::new();
        for ((mark, feeds), _) in
            before.marks.iter().zip(&found.parts).zip(&blocks).filter(|(_, block)| block.touched)
        {
            let Some(range) = parts.get(mark.motion) else { continue };
            wanted.extend(range.clone().zip(feeds.iter().map(|part| part.feed)));
        }
        let plan = FeedPlan::numbered(&program, |number, motion| {
            let wanted = wanted.get(&number)?;
            let value = motion.feed?.value;
            let actual =
                motion.feed?.mm_per_minute(self.units, motion.spindle_rpm(), Some(motion.length()))?;
            if (wanted - actual).abs() <= NOISE * actual {
                return None;
            }
            let decimals = motion.feed_from.map_or(0, |statement| decimals_of_feed(&program, statement));
            Some(rounded_down(value * wanted / actual, decimals))
        });
        let mut editor = Editor::new(program, step);
        plan.write(&mut editor, &mut context.findings)?;
        Ok(Written { program: editor.finish()?, excused, parts })
    }

    /// Blocks that pass the target at the lowest feed allowed.
    fn warn(&self, program: &Program, before: &Gathered, found: &Feeds, context: &mut Context<'_>) {
        for block in found.below_minimum.iter().take(TOLD) {
            let Some(mark) = before.marks.get(*block) else { continue };
            let span = program.statement(mark.statement).map(Statement::origin).unwrap_or_default();
            let message = "the target is passed here at the lowest feed allowed";
            let place = context.recipe.step_value_place(usize::from(context.step.0), &["min_feed"]);
            let finding = Diagnostic::new(codes::BELOW_MINIMUM, message)
                .label(program.source(), span, "more than the target")
                .label(&context.recipe.source, place, "the lowest feed");
            context.findings.push(finding);
        }
        if let Some(more) = found.below_minimum.len().checked_sub(TOLD).filter(|more| *more > 0) {
            let message = format!("the target is passed at the lowest feed allowed on {more} more motions");
            context.findings.push(Diagnostic::new(codes::BELOW_MINIMUM, message));
        }
    }
}

/// Of several errors the last one stops the step, the others are findings before it.
fn several(mut found: Vec<Diagnostic>, findings: &mut Vec<Diagnostic>) -> Box<Diagnostic> {
    let last = found.pop().unwrap_or_else(|| Diagnostic::new(codes::STEP_FAILED, "the step cannot run"));
    findings.extend(found);
    Box::new(last)
}

impl Job {
    /// A program that cuts nothing anywhere is in the wrong place over its stock, and all of it would run at the feed of air.
    fn nothing_cut(&self, program: &Program, ran: &Engaged, context: &Context<'_>) -> Box<Diagnostic> {
        let mut points = program.motions().filter(|motion| !motion.rapid).map(|motion| motion.to.point);
        let path = points.next().map(|first| points.fold((first, first), |(a, b), p| (a.inf(&p), b.sup(&p))));
        let mm = self.units.in_mm();
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
        context.fail(message, &[])
    }
}
