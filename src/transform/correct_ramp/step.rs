//! The step: find, judge, correct, write, measure again.

use super::correct::{Corrected, Lengthened, Task, correct};
use super::cutter::{self, Cutter};
use super::find::{Found, find};
use super::kind::Kind;
use super::level::Levels;
use super::limits::{Indexable, Limits, Measured, keeps};
use super::parameters::{CorrectRamp, IfImpossible, Plunges, RampRegion};
use super::prove;
use super::region::Region;
use super::report::{Outcome, RampReport, Report};
use super::words;
use super::write::{self, Unwritable, Written};
use crate::diagnostic::Diagnostic;
use crate::program::motion::{Motion, Tool};
use crate::program::record::CutterCompensation;
use crate::program::{LengthUnit, Program, Record, Statement, operation};
use crate::transform::{Context, Selection, StepReport, Transform};
use crate::values::{Finite, NonNegative, Positive};
use crate::write::Editor;
use std::sync::Arc;

/// How far printed coordinates may put two points nearer together, in the file's unit: half of the fourth decimal at both ends, both ways.
const ROUNDING: f64 = 2e-4;

/// Where a ramp may begin above the depth of cut, mm (Zhou 2020: 2 to 3 mm).
const CLEARANCE: f64 = 2.5;

/// A ramp that is to be written anew.
pub(super) struct Plan {
    pub found: Found,
    pub limits: Limits,
    pub corrected: Corrected,
    /// Its place among the reports.
    pub report: usize,
}

impl Transform for CorrectRamp {
    fn apply(&self, program: Program, context: &mut Context<'_>) -> Result<Program, Box<Diagnostic>> {
        let file = context.file_units(&program);
        let motions: Vec<Motion> = program.motions().collect();
        let mut look = Look::new(self, &program, &motions, file, context);
        look.judge_all(context)?;
        let Look { plans, mut reports, .. } = look;
        let mut editor = Editor::new(program, context.step);
        let mut written: Vec<Written> = Vec::with_capacity(plans.len());
        for plan in &plans {
            let done = write::write(&mut editor, &motions, &plan.found, &plan.corrected.ramp, file.in_mm())?;
            written.push(
                done.map_err(|why| words::unproven(editor.program(), &motions, &plan.found, why, context))?,
            );
        }
        let program = editor.finish()?;
        let rounding = ROUNDING * file.in_mm();
        prove::prove(&program, &motions, &plans, &written, (file, rounding), &mut reports).map_err(
            |(plan, why)| match plans.get(plan) {
                Some(plan) => words::unproven(&program, &motions, &plan.found, why, context),
                None => context.fail(why.to_string(), &[]),
            },
        )?;
        context.reports.push(StepReport::CorrectRamp(Report { ramps: reports }));
        Ok(program)
    }
}

/// An indexable cutter and its limits.
type Known = (Indexable, Limits);

/// The ramps of a program and what is to become of them.
struct Look<'a> {
    step: &'a CorrectRamp,
    program: &'a Program,
    motions: &'a [Motion],
    file: LengthUnit,
    operations: Vec<String>,
    levels: Levels<'a>,
    polygon: Option<Region>,
    /// Statements that switch cutter compensation, and whether on.
    compensation: Vec<(usize, bool)>,
    cutters: Vec<(Option<Arc<Tool>>, Option<Known>)>,
    plans: Vec<Plan>,
    reports: Vec<RampReport>,
    impossible: Vec<Diagnostic>,
}

impl<'a> Look<'a> {
    fn new(
        step: &'a CorrectRamp,
        program: &'a Program,
        motions: &'a [Motion],
        file: LengthUnit,
        context: &Context<'_>,
    ) -> Self {
        let recipe = context.recipe.units.in_mm();
        let polygon = match &step.region {
            RampRegion::Hull | RampRegion::Milled => None,
            RampRegion::None => Some(Region::Everywhere),
            RampRegion::Polygon(corners) => {
                let corners: Vec<[f64; 2]> =
                    corners.iter().map(|corner| corner.map(|value: Finite| value.get() * recipe)).collect();
                // The corners were checked where the recipe was read.
                Region::polygon(&corners).ok()
            }
        };
        Self {
            step,
            program,
            motions,
            file,
            operations: operation::operations(program).into_iter().map(|operation| operation.name).collect(),
            levels: Levels::new(motions, file.in_mm()),
            polygon,
            compensation: compensation(program),
            cutters: Vec::new(),
            plans: Vec::new(),
            reports: Vec::new(),
            impossible: Vec::new(),
        }
    }

    fn judge_all(&mut self, context: &mut Context<'_>) -> Result<(), Box<Diagnostic>> {
        let recipe = context.recipe.units.in_mm();
        let depth = self.step.depth_of_cut.map(|depth| depth.get() * recipe);
        let mut selection = Selection::new(&self.step.r#where, self.program, context);
        let mut meant = Vec::new();
        for found in find(self.motions, self.file.in_mm(), depth) {
            let first = self.motions.get(found.motions.start);
            if first.is_some_and(|motion| selection.contains(motion, context)) {
                meant.push(found);
            }
        }
        // What `where` selects is asked of ramps alone; a program may well have none.
        if meant.is_empty() && !self.motions.iter().any(|motion| selection.contains(motion, context)) {
            selection.report(context);
        }
        let mut solid: Vec<(usize, Option<Arc<Tool>>)> = Vec::new();
        let count = meant.len();
        for found in meant {
            let Some(first) = self.motions.get(found.motions.start) else { continue };
            match self.limits(first, context)? {
                Some(known) => self.judge(found, known, context),
                None => solid.push((found.motions.start, first.tool.clone())),
            }
        }
        if let Some((index, tool)) = solid.first() {
            // A tool list with inserts serves many programs, and not each has an indexable cutter.
            let all = solid.len() == count && !context.setup.tools.iter().any(|entry| entry.insert.is_some());
            let told =
                words::without_insert(self.program, self.motions, *index, tool.as_deref(), all, context);
            if all {
                return Err(told);
            }
            context.findings.push(*told);
        }
        let mut impossible = std::mem::take(&mut self.impossible);
        match impossible.pop() {
            Some(last) => {
                context.findings.extend(impossible);
                Err(Box::new(last))
            }
            None => Ok(()),
        }
    }

    /// The limits of a motion's tool; `None` for a tool without inserts.
    fn limits(&mut self, motion: &Motion, context: &Context<'_>) -> Result<Option<Known>, Box<Diagnostic>> {
        if let Some((_, limits)) = self.cutters.iter().find(|(tool, _)| *tool == motion.tool) {
            return Ok(*limits);
        }
        let none = Tool::default();
        let tool = motion.tool.as_deref().unwrap_or(&none);
        let limits = match cutter::of(self.step, tool, self.file, context) {
            Cutter::Solid => None,
            Cutter::Unknown(found) => return Err(found),
            Cutter::Indexable(cutter) => {
                let limits = cutter.limits().map_err(|error| context.fail(error.to_string(), &["tool"]))?;
                Some((cutter, limits))
            }
        };
        self.cutters.push((motion.tool.clone(), limits));
        Ok(limits)
    }

    fn judge(&mut self, found: Found, (cutter, limits): Known, context: &mut Context<'_>) {
        let recipe = context.recipe.units.in_mm();
        let (step, mm) = (self.step, self.file.in_mm());
        let clearance = step.clearance.map_or(CLEARANCE, |clearance: NonNegative| clearance.get() * recipe);
        let begin = step.depth_of_cut.map(|depth: Positive| depth.get() * recipe + clearance);
        let rounding = ROUNDING * mm;
        if keeps(&found.ramp, &limits, rounding) {
            let report = self.report(&found, limits, Outcome::Fits);
            self.reports.push(report);
            return;
        }
        let region = match &self.polygon {
            Some(polygon) => polygon.clone(),
            None if step.region == RampRegion::Hull => self.levels.hull(&found),
            None => {
                // No candidate goes farther than three legs away: the circle of few legs is the widest.
                let reach = 3.0 * limits.shortest_leg.max(found.ramp.length());
                self.levels.milled(&found, cutter.diameter / 2.0, reach)
            }
        };
        let task = Task { limits, begin, region: &region, passes: &found.passes, rounding };
        let kept_plunge = step.plunges == Plunges::Keep && Kind::of(&found.ramp) == Kind::Plunge;
        let corrected = correct(&found.ramp, &task);
        let mut report = self.report(&found, limits, Outcome::Kept);
        let written = write::check(self.program, self.motions, &found.motions)
            .and_then(|()| if self.is_compensated(&found) { Err(Unwritable::Compensation) } else { Ok(()) });
        let why_not = match (&corrected, written, found.has_level) {
            _ if kept_plunge => Some("`plunges: keep` leaves straight descents as they are".to_owned()),
            (_, _, false) => Some("it does not end at a level where cutting goes on".to_owned()),
            (Err(why), _, _) => Some(why.to_string()),
            (_, Err(why), _) => Some(why.to_string()),
            _ => None,
        };
        let place = words::Place { program: self.program, motions: self.motions, found: &found };
        match (corrected, why_not) {
            (Ok(Some(corrected)), None) => {
                context.findings.push(words::corrected(&place, &report, &corrected, context));
                report.outcome = Outcome::Corrected;
                report.lengthened = corrected.lengthened;
                report.compression = corrected.compression;
                report.passes = corrected.passes;
                self.plans.push(Plan { found, limits, corrected, report: self.reports.len() });
            }
            (_, why) => {
                let why = why.unwrap_or_default();
                let keep = kept_plunge || step.if_impossible == IfImpossible::Keep;
                let told = words::impossible(&place, &report, &why, keep, context);
                if keep { context.findings.push(told) } else { self.impossible.push(told) }
            }
        }
        self.reports.push(report);
    }

    /// Whether cutter compensation is on at a ramp, or switched in it.
    fn is_compensated(&self, found: &Found) -> bool {
        let motions = self.motions.get(found.motions.clone()).unwrap_or_default();
        let start = motions.first().map_or(0, |motion| motion.statements.start);
        let end = motions.last().map_or(0, |motion| motion.statements.end);
        let before = self.compensation.partition_point(|(statement, _)| *statement < start);
        let within = self.compensation.iter().skip(before).take_while(|(statement, _)| *statement < end);
        let on =
            before.checked_sub(1).and_then(|last| self.compensation.get(last)).is_some_and(|(_, on)| *on);
        on || within.count() > 0
    }

    fn report(&self, found: &Found, limits: Limits, outcome: Outcome) -> RampReport {
        let first = self.motions.get(found.motions.start);
        let origin = first
            .and_then(|motion| self.program.statement(motion.statements.start))
            .map(|statement| statement.origin())
            .unwrap_or_default();
        RampReport {
            operation: self.operations.get(found.operation).cloned().unwrap_or_default(),
            line: self.program.source().line_column(origin.start).0 as u64,
            kind: Kind::of(&found.ramp).name(),
            limit_leg_mm: limits.shortest_leg,
            limit_degrees: limits.steepest.atan().to_degrees(),
            before: Measured::of(&found.ramp),
            outcome,
            after: None,
            lengthened: Lengthened::No,
            compression: 1.0,
            passes: 1,
            added_mm: 0.0,
            added_seconds: None,
            path_before: prove::drawn(&found.ramp),
            path_after: Vec::new(),
        }
    }
}

fn compensation(program: &Program) -> Vec<(usize, bool)> {
    let switch = |(statement, found): (usize, &Statement)| match found.record() {
        Record::CutterCompensation(mode) => Some((statement, *mode != CutterCompensation::Off)),
        _ => None,
    };
    program.live().filter_map(switch).collect()
}
