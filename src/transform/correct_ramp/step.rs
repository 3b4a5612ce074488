//! This module runs the step: it finds ramps, judges and corrects them, writes them and measures them again.

use super::drilled_entry::{HoleSearch, find_drilling_motions};
use super::findings;
use super::level_motions::LevelMotions;
use super::parameters::{CorrectRamp, ImpossibleRampHandling, PlungeHandling, RampLimitRule, RampRegionSpec};
use super::planned_ramp::PlannedRamp;
use super::ramp_correction::{CorrectedRamp, LengtheningMethod, RampTask, correct_ramp};
use super::ramp_cutter::{self, RampCutter};
use super::ramp_kind::RampKind;
use super::ramp_limits::{IndexableCutter, RampLimits, RampMeasurement, is_within_limits};
use super::ramp_pillar::{PillarSearch, find_pillar};
use super::ramp_proof;
use super::ramp_search::{FoundRamp, find_ramps};
use super::ramp_writer::{self, RampWriteFault, UnwritableRamp, WrittenRamp};
use super::report::{CorrectRampReport, RampOutcome, RampPillar, RampReport};
use super::tool_region::ToolRegion;
use crate::diagnostic::{Diagnostic, Failure};
use crate::parameters::{Finite, NonNegative, Positive};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::motion::{ActiveTool, Motion};
use crate::program::record::CutterCompensation;
use crate::program::{LengthUnit, Program, Record, Statement, StatementId, operation};
use crate::transform::{MotionSelection, StepContext, Transform};
use crate::write::ProgramEditor;
use std::sync::Arc;

/// How much nearer printed coordinates may bring two points, in the file's unit: half of the fourth decimal
/// at both ends, in both directions.
const ROUNDING: f64 = 2e-4;

/// How far above the depth of cut a ramp may begin, in mm (Zhou 2020: 2 to 3 mm).
pub(super) const CLEARANCE_MM: f64 = 2.5;

/// This ramp is too short for a face mill with inserts.
///
/// ```
/// use clsmith::parameters::Positive;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::correct_ramp::{CorrectRampReport, RampRegionSpec, RampToolSpec};
/// use clsmith::transform::{CorrectRamp, run_steps};
///
/// let part = b"TOOL PATH/WEB,TOOL,FM50\nSPINDL/RPM,3000,CLW\nRAPID\nGOTO/0.0000,0.0000,5.0000\n\
///     FEDRAT/MMPM,500.0000\nPAINT/COLOR,42\nGOTO/20.0000,0.0000,-2.0000\n\
///     PAINT/COLOR,31\nGOTO/80.0000,0.0000,-2.0000\nEND-OF-PATH\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let step = CorrectRamp {
///     tool: Some(RampToolSpec {
///         diameter: Positive::new(50.0),
///         insert_radius: Positive::new(6.0),
///         insert_height: Positive::new(5.0),
///     }),
///     region: RampRegionSpec::None,
///     ..CorrectRamp::default()
/// };
/// let outcome = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?;
/// let report = outcome.reports[0].downcast_ref::<CorrectRampReport>().expect("the step reports its ramps");
/// // A leg of 20 mm is too short for a cutter that does not cut within 38 mm.
/// assert_eq!(report.ramps.len(), 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
impl Transform for CorrectRamp {
    fn measures(&self) -> bool {
        true
    }

    fn apply(&self, program: Program, context: &mut StepContext<'_>) -> Result<Program, Failure> {
        let file = context.file_length_unit(&program);
        let motions: Vec<Motion> = program.motions().collect();
        let mut judge = RampJudge::new(self, &program, &motions, file, context);
        // All ramps are judged before any is written: the plans count the motions of the program as it was,
        // and every ramp that cannot be corrected is reported in one run.
        judge.judge_ramps(context)?;
        let RampJudge { plans, mut reports, .. } = judge;
        let mut editor = ProgramEditor::new(program, context.step);
        let mut written: Vec<WrittenRamp> = Vec::with_capacity(plans.len());
        for plan in &plans {
            let done = ramp_writer::write_ramp(
                &mut editor,
                &motions,
                &plan.found,
                &plan.corrected.ramp,
                file.mm_per_unit(),
            );
            written.push(done.map_err(|fault| match fault {
                RampWriteFault::Unwritable(why) => {
                    findings::describe_unproven_ramp(editor.program(), plan.begins, why, context)
                }
                RampWriteFault::Failed(failure) => failure,
            })?);
        }
        let program = editor.finish()?;
        let rounding = ROUNDING * file.mm_per_unit();
        ramp_proof::prove_ramps(&program, &motions, &plans, &written, (file, rounding), &mut reports)
            .map_err(|(plan, why)| match plans.get(plan) {
                Some(plan) => findings::describe_unproven_ramp(&program, plan.begins, why, context),
                None => context.step_failure(why.to_string(), &[]),
            })?;
        context.add_report(CorrectRampReport { ramps: reports });
        Ok(program)
    }
}

/// An indexable cutter and its limits.
type CutterAndLimits = (IndexableCutter, RampLimits);

/// The ramps of a program, and the decisions about them.
struct RampJudge<'a> {
    step: &'a CorrectRamp,
    program: &'a Program,
    motions: &'a [Motion],
    file: LengthUnit,
    operations: Vec<String>,
    levels: LevelMotions<'a>,
    polygon: Option<ToolRegion>,
    /// The statements that switch cutter compensation, and whether they switch it on.
    compensation: Vec<(StatementId, bool)>,
    /// The indices of the motions that drill.
    drilled: Arc<[usize]>,
    cutters: Vec<(Option<Arc<ActiveTool>>, Option<CutterAndLimits>)>,
    plans: Vec<PlannedRamp>,
    reports: Vec<RampReport>,
    impossible: Vec<Diagnostic>,
}

impl<'a> RampJudge<'a> {
    fn new(
        step: &'a CorrectRamp,
        program: &'a Program,
        motions: &'a [Motion],
        file: LengthUnit,
        context: &StepContext<'_>,
    ) -> Self {
        let recipe = context.units.mm_per_unit();
        let polygon = match &step.region {
            RampRegionSpec::Hull | RampRegionSpec::Milled => None,
            RampRegionSpec::None => Some(ToolRegion::Everywhere),
            RampRegionSpec::Polygon(vertices) => {
                let vertices: Vec<[f64; 2]> =
                    vertices.iter().map(|vertex| vertex.map(|value: Finite| value.get() * recipe)).collect();
                // The vertices were checked when the recipe was read.
                ToolRegion::from_polygon(&vertices).ok()
            }
        };
        Self {
            step,
            program,
            motions,
            file,
            operations: operation::find_operations(program)
                .into_iter()
                .map(|operation| operation.name)
                .collect(),
            levels: LevelMotions::new(motions, file.mm_per_unit()),
            polygon,
            compensation: find_compensation_switches(program),
            drilled: find_drilling_motions(motions),
            cutters: Vec::new(),
            plans: Vec::new(),
            reports: Vec::new(),
            impossible: Vec::new(),
        }
    }

    fn judge_ramps(&mut self, context: &mut StepContext<'_>) -> Result<(), Failure> {
        let recipe = context.units.mm_per_unit();
        let depth = self.step.depth_of_cut.map(|depth| depth.get() * recipe);
        let mut selection = MotionSelection::new(&self.step.r#where, self.program, context);
        let mut meant = Vec::new();
        for found in find_ramps(self.motions, self.file.mm_per_unit(), depth) {
            let first = self.motions.get(found.motions.start);
            if first.is_some_and(|motion| selection.contains(motion, context)) {
                meant.push(found);
            }
        }
        // `where` is only asked about ramps. A program may well have none, so the warning needs all motions.
        if meant.is_empty() && !self.motions.iter().any(|motion| selection.contains(motion, context)) {
            selection.report_if_empty(self.program, context);
        }
        let mut solid: Vec<(StatementId, Option<Arc<ActiveTool>>)> = Vec::new();
        let count = meant.len();
        for found in meant {
            context.watch.check_stop()?;
            let Some(first) = self.motions.get(found.motions.start) else { continue };
            match self.find_tool_limits(first, context)? {
                Some(known) => self.judge_ramp(found, known, context),
                None => solid.push((first.last_statement(), first.tool.clone())),
            }
        }
        if let Some((first, tool)) = solid.first() {
            // A tool list with inserts serves many programs, and not every program has an indexable cutter.
            let all = solid.len() == count && !context.setup.tools.iter().any(|entry| entry.insert.is_some());
            let told =
                findings::describe_missing_inserts(self.program, *first, tool.as_deref(), all, context);
            if all {
                return Err(told.into());
            }
            context.findings.push(told);
        }
        let impossible = std::mem::take(&mut self.impossible);
        if impossible.is_empty() { Ok(()) } else { Err(impossible.into()) }
    }

    /// Returns the limits of a motion's tool. Returns `None` for a tool without inserts.
    fn find_tool_limits(
        &mut self,
        motion: &Motion,
        context: &StepContext<'_>,
    ) -> Result<Option<CutterAndLimits>, Failure> {
        if let Some((_, limits)) = self.cutters.iter().find(|(tool, _)| *tool == motion.tool) {
            return Ok(*limits);
        }
        let none = ActiveTool::default();
        let tool = motion.tool.as_deref().unwrap_or(&none);
        let limits = match ramp_cutter::resolve_ramp_cutter(self.step, tool, self.file, context) {
            RampCutter::Solid => None,
            RampCutter::Unknown(found) => return Err(found.into()),
            RampCutter::Indexable(cutter) => {
                let limits = cutter
                    .ramp_limits()
                    .map_err(|error| context.step_failure(error.to_string(), &["tool"]))?;
                let limits = match self.step.limit {
                    RampLimitRule::Paper => limits,
                    RampLimitRule::Survivable => limits.halved_for_turns(),
                };
                Some((cutter, limits))
            }
        };
        self.cutters.push((motion.tool.clone(), limits));
        Ok(limits)
    }

    fn judge_ramp(
        &mut self,
        found: FoundRamp,
        (cutter, limits): CutterAndLimits,
        context: &mut StepContext<'_>,
    ) {
        let recipe = context.units.mm_per_unit();
        let (step, mm) = (self.step, self.file.mm_per_unit());
        let clearance =
            step.clearance.map_or(CLEARANCE_MM, |clearance: NonNegative| clearance.get() * recipe);
        let begin = step.depth_of_cut.map(|depth: Positive| depth.get() * recipe + clearance);
        let rounding = ROUNDING * mm;
        // A ramp that fits needs no region, and computing one takes long.
        let survivable = step.limit == RampLimitRule::Survivable;
        let within = is_within_limits(&found.ramp, &limits, rounding);
        let is_cleared = |search| find_pillar(&found.ramp, &cutter, search).is_none();
        // A ramp on the limits has pillars as high as the inserts clear, and none may be taken to stand between columns then.
        let holes = HoleSearch {
            motions: self.motions,
            drilled: Arc::clone(&self.drilled),
            setup: context.setup,
            mm_per_unit: mm,
        };
        let is_plunge = RampKind::classify_ramp(&found.ramp) == RampKind::Plunge;
        let fits = if is_plunge && holes.is_plunge_over_hole(&found, &cutter) {
            true
        } else if survivable {
            within && is_cleared(PillarSearch::AtColumns) || is_cleared(PillarSearch::BetweenColumns)
        } else {
            within
        };
        if fits {
            let mut report = self.build_report(&found, limits, RampOutcome::Fits);
            report.pillar_before = survivable.then(RampPillar::default);
            self.reports.push(report);
            return;
        }
        let region = match &self.polygon {
            Some(polygon) => polygon.clone(),
            None if step.region == RampRegionSpec::Hull => self.levels.level_hull(&found),
            None => {
                // No candidate goes farther than three legs away. The circle of a few legs is the widest.
                let reach = 3.0 * limits.shortest_leg.max(found.ramp.length_mm());
                self.levels.milled_region(&found, cutter.diameter / 2.0, reach)
            }
        };
        let task = RampTask { limits, begin, region: &region, passes: &found.passes, rounding };
        let kept_plunge = step.plunges == PlungeHandling::Keep && is_plunge;
        // Where no ramp helps, a hole that the program has drilled may.
        let corrected = match correct_ramp(&found.ramp, &task) {
            Err(why) => match holes.find_drilled_entry(&found, &cutter, &region) {
                Some(ramp) => Ok(Some(CorrectedRamp {
                    ramp,
                    lengthened: LengtheningMethod::OverHole,
                    compression: 1.0,
                    passes: 1,
                })),
                None => Err(why),
            },
            corrected => corrected,
        };
        let mut report = self.build_report(&found, limits, RampOutcome::Kept);
        if survivable {
            let stands = find_pillar(&found.ramp, &cutter, PillarSearch::AtColumns);
            report.pillar_before = Some(stands.map(RampPillar::from_contact).unwrap_or_default());
        }
        let written =
            ramp_writer::check_writable(self.program, self.motions, &found.motions).and_then(|()| {
                // With cutter compensation on, the control moves the path sideways, so points for the centre
                // of the tool would be wrong.
                if self.is_compensated(&found) { Err(UnwritableRamp::Compensation) } else { Ok(()) }
            });
        let why_not = match (&corrected, written, found.has_level) {
            _ if kept_plunge => Some("`plunges: keep` leaves straight descents unchanged".to_owned()),
            (_, _, false) => Some("it does not end at a level where cutting continues".to_owned()),
            (Err(why), _, _) => Some(format!(
                "{why}; and the program drills no hole before that is as wide as the middle of the cutter ({}) and as deep",
                DisplayUnits::from_mm(self.file).tell_fixed(ColumnUnit::Length, limits.shortest_leg, 3)
            )),
            // Only curved legs leave a pillar within the limits, which are those of straight ones.
            (Ok(None), _, _) => {
                Some("its legs are curved, and no straight ramp was found to replace them".to_owned())
            }
            (_, Err(why), _) => Some(why.to_string()),
            _ => None,
        };
        let place = findings::RampFindings { program: self.program, motions: self.motions, found: &found };
        match (corrected, why_not) {
            (Ok(Some(corrected)), None) => {
                context
                    .findings
                    .push(findings::describe_corrected_ramp(&place, &report, &corrected, context));
                report.outcome = RampOutcome::Corrected;
                report.lengthened = corrected.lengthened;
                report.compression = corrected.compression;
                report.passes = corrected.passes;
                let begins = place.begin_span();
                self.plans.push(PlannedRamp {
                    found,
                    limits,
                    cutter: survivable.then_some(cutter),
                    corrected,
                    begins,
                    report: self.reports.len(),
                });
            }
            (_, why) => {
                // A ramp within its limits has returned above, and an error of the correction is a reason.
                debug_assert!(why.is_some(), "a ramp that is not corrected has a reason");
                let why = why.unwrap_or_else(|| "the reason is not known".to_owned());
                let keep = kept_plunge || step.if_impossible == ImpossibleRampHandling::Keep;
                let finding = findings::describe_impossible_ramp(&place, &report, &why, keep, context);
                if keep { context.findings.push(finding) } else { self.impossible.push(finding) }
            }
        }
        self.reports.push(report);
    }

    /// Returns whether cutter compensation is on at a ramp, or is switched within it.
    fn is_compensated(&self, found: &FoundRamp) -> bool {
        let motions = self.motions.get(found.motions.clone()).unwrap_or_default();
        let (Some(first), Some(last)) = (motions.first(), motions.last()) else {
            debug_assert!(false, "a ramp has motions");
            return true;
        };
        let start = first.statements.first();
        let before = self.compensation.partition_point(|(statement, _)| *statement < start);
        let end = last.statements.last();
        let within = self.compensation.iter().skip(before).take_while(|(statement, _)| *statement <= end);
        let on =
            before.checked_sub(1).and_then(|last| self.compensation.get(last)).is_some_and(|(_, on)| *on);
        on || within.count() > 0
    }

    fn build_report(&self, found: &FoundRamp, limits: RampLimits, outcome: RampOutcome) -> RampReport {
        let first = self.motions.get(found.motions.start);
        debug_assert!(first.is_some(), "a ramp has motions");
        let line = |motion: &Motion| {
            let origin = self.program.statement(motion.statements.first()).origin();
            self.program.source().line_column(origin.start).0 as u64
        };
        RampReport {
            operation: self.operations.get(found.operation).cloned().unwrap_or_default(),
            line: first.map_or(0, line),
            kind: RampKind::classify_ramp(&found.ramp).display_name(),
            limit_leg_mm: limits.shortest_leg,
            limit_degrees: limits.steepest.atan().to_degrees(),
            before: RampMeasurement::measure_ramp(&found.ramp),
            outcome,
            pillar_before: None,
            pillar_after: None,
            after: None,
            lengthened: LengtheningMethod::No,
            compression: 1.0,
            passes: 1,
            added_mm: 0.0,
            added_seconds: None,
            path_before: ramp_proof::to_drawing_points(&found.ramp),
            path_after: Vec::new(),
        }
    }
}

fn find_compensation_switches(program: &Program) -> Vec<(StatementId, bool)> {
    let switch = |(statement, found): (StatementId, &Statement)| match found.record() {
        Record::CutterCompensation(mode) => Some((statement, *mode != CutterCompensation::Off)),
        _ => None,
    };
    program.live_statements().filter_map(switch).collect()
}
