//! This module writes and prints the results of `apply`.

use super::ApplyArgs;
use crate::cli::command_outputs::CommandOutputs;
use crate::cli::input_files::STANDARD;
use crate::cli::plot::encode_drawing;
use crate::cli::progress::CommandProgress;
use crate::cli::stop::Stop;
use clsmith::diagnostic::Diagnostic;
use clsmith::fingerprint::RecipeFingerprint;
use clsmith::job::{CorrectionJob, is_program_changed};
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::{LengthUnit, Program};
use clsmith::report::DisplayUnits;
use clsmith::report::changes::{self, RecipeChanges};
use clsmith::report::comparison::{Comparison, ComparisonRuns, ComparisonSubject};
use clsmith::report::path_drawing;
use clsmith::report::simulation::SimulationAttempt;
use clsmith::simulation_run::SimulationRunOptions;
use clsmith::source::Source;
use clsmith::transform::TransformReport;
use clsmith::undo::RunReport;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

/// The outcome for one program: the program after its recipe, or as it was read if it was refused.
pub(super) struct ApplyOutcome {
    pub program: Program,
    /// The findings, after the policy.
    pub findings: Vec<Diagnostic>,
    pub reports: Vec<Box<dyn TransformReport>>,
    /// The simulation that the run has made of the program.
    pub simulation: Option<SimulationAttempt>,
}

/// A run on one file: its inputs and its outcome.
pub(super) struct ApplyRun<'r> {
    pub job: &'r CorrectionJob<'r>,
    pub setup_files: &'r [Arc<Source>],
    pub source: &'r Arc<Source>,
    pub outcome: ApplyOutcome,
    /// The unit that readers asked for.
    pub shown_in: Option<LengthUnit>,
}

impl ApplyRun<'_> {
    /// Returns the program as it was read.
    fn parse_original(&self) -> Program {
        let after = &self.outcome.program;
        parse_with_vocabulary(self.source, Some(after.dialect()), after.vocabulary()).program
    }

    fn compare_with_original(&self, before: &Program) -> RecipeChanges {
        let recipe = self.job.recipe;
        let steps = recipe.step_names();
        RecipeChanges::from_programs(before, &self.outcome.program, &steps, Some(recipe.units))
            .with_machine(before, &self.outcome.program, self.job.setup)
            .shown_in(self.shown_in)
    }

    /// Returns the units that readers see.
    fn display_units(&self) -> DisplayUnits {
        DisplayUnits::of_recipe(&self.outcome.program, self.job.recipe.units, self.shown_in)
    }

    /// Returns the inputs of reports. `print` is the SHA-256 of the recipe and its files, if it was computed.
    fn report_subject<'a>(&'a self, before: &'a Program, print: Option<&'a str>) -> ComparisonSubject<'a> {
        ComparisonSubject {
            before: Some(before),
            program: &self.outcome.program,
            recipe: Some(self.job.recipe),
            setup: self.job.setup,
            setup_files: self.setup_files,
            units: Some(self.job.recipe.units),
            shown_in: self.shown_in,
            findings: &self.outcome.findings,
            reports: &self.outcome.reports,
            print,
        }
    }
}

/// The original, and the simulations of it and of the corrected program.
pub(super) struct SimulatedForReports {
    before: Program,
    runs: ComparisonRuns,
}

impl ApplyArgs {
    /// Simulates for reports what the run itself has not simulated.
    pub(super) fn simulate_for_reports(
        &self,
        run: &mut ApplyRun<'_>,
        progress: &CommandProgress,
    ) -> Result<Option<SimulatedForReports>, Stop> {
        if !self.reports.is_wanted() {
            return Ok(None);
        }
        let before = run.parse_original();
        let options = SimulationRunOptions::default();
        let made = run.outcome.simulation.take();
        let subject = run.report_subject(&before, None);
        let runs = ComparisonRuns::simulate_subject(&subject, made, &options, progress)?;
        Ok(Some(SimulatedForReports { before, runs }))
    }

    /// Writes the requested outputs besides the program: run report, drawing, page and summary.
    ///
    /// # Errors
    /// Returns a finding about the first output that cannot be written, or an interruption.
    pub(super) fn write_side_outputs(
        &self,
        run: &ApplyRun<'_>,
        simulated: Option<&SimulatedForReports>,
        target: Option<&Path>,
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        if let (Some(path), Some(print)) = (self.json.path(), run.job.print) {
            self.write_run_report(path, run, print, target, outputs)?;
        }
        if let Some(path) = &self.plot {
            self.draw_step_reports(path, &run.outcome.reports, run.display_units(), outputs)?;
        }
        let Some(simulated) = simulated else { return Ok(()) };
        let digits = run.job.print.map(|print| print.sha256.to_string());
        let subject = run.report_subject(&simulated.before, digits.as_deref());
        self.reports.write_reports(&Comparison::from_runs(subject, &simulated.runs), outputs)
    }

    /// Writes the report of the run as JSON. Returns a finding if that fails.
    fn write_run_report(
        &self,
        path: &Path,
        run: &ApplyRun<'_>,
        print: &RecipeFingerprint,
        target: Option<&Path>,
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        let file = target.filter(|target| *target != Path::new(STANDARD));
        let file = file.map(|file| file.to_string_lossy().into_owned());
        let changes = run.compare_with_original(&run.parse_original());
        let report =
            RunReport::from_program(&run.outcome.program, file, print, run.job.recipe.provenance, &changes);
        let report = report.with_findings(&run.outcome.findings);
        outputs.write_output(path, |out| report.write_json(out))
    }

    /// Writes the drawings of the steps as SVG or PNG.
    fn draw_step_reports(
        &self,
        path: &Path,
        reports: &[Box<dyn TransformReport>],
        units: DisplayUnits,
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        let panels: Vec<_> = reports.iter().flat_map(|report| report.build_panels(units)).collect();
        let Some(text) = path_drawing::draw_path_panels(&panels)? else {
            if !self.progress.quiet {
                eprintln!("{}: not drawn, because no step has a drawing", path.display());
            }
            return Ok(());
        };
        let bytes = encode_drawing(path, text)?;
        outputs.write_output(path, |out| out.write_all(&bytes))
    }

    /// Prints what was changed on standard error, for people.
    pub(super) fn show_summary(&self, run: &ApplyRun<'_>, target: Option<&Path>) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let to = match target {
            Some(path) if path == Path::new(STANDARD) => " -> standard output".to_owned(),
            Some(path) => format!(" -> {}", path.display()),
            None => String::new(),
        };
        if !is_program_changed(&run.outcome.program) {
            writeln!(err, "{}{to}: nothing to change, every byte as it was", run.source.name())?;
            return write_step_reports(&mut err, &run.outcome.reports, run.display_units());
        }
        err.write_all(changes::to_text(&run.compare_with_original(&run.parse_original())).as_bytes())?;
        write_step_reports(&mut err, &run.outcome.reports, run.display_units())?;
        if to.is_empty() { Ok(()) } else { writeln!(err, "{to}", to = to.trim_start()) }
    }
}

/// Prints what the steps report about themselves, which they also do if they changed nothing.
fn write_step_reports(
    err: &mut impl Write,
    reports: &[Box<dyn TransformReport>],
    units: DisplayUnits,
) -> io::Result<()> {
    reports.iter().try_for_each(|report| err.write_all(report.to_text(units).as_bytes()))
}

/// Writes the program. Returns a finding if that fails.
pub(super) fn write_program(program: &Program, target: &Path, outputs: &CommandOutputs) -> Result<(), Stop> {
    outputs.write_output(target, |out| program.byte_chunks().try_for_each(|piece| out.write_all(piece)))
}
