//! What a run of `apply` writes and tells.

use super::ApplyArgs;
use crate::cli::command_outputs::CommandOutputs;
use crate::cli::input_files::STANDARD;
use crate::cli::plot::encode_drawing;
use crate::cli::progress::CommandProgress;
use crate::cli::stop::Stop;
use clsmith::diagnostic::Diagnostic;
use clsmith::fingerprint::RecipeFingerprint;
use clsmith::job::{CorrectionJob, is_program_changed};
use clsmith::parse::parse;
use clsmith::program::Program;
use clsmith::report::changes::{self, RecipeChanges};
use clsmith::report::comparison::ComparisonSubject;
use clsmith::report::path_drawing;
use clsmith::source::Source;
use clsmith::transform::TransformReport;
use clsmith::undo::RunReport;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

/// A program that its recipe is through with.
pub(super) struct ApplyOutcome<'r> {
    pub job: &'r CorrectionJob<'r>,
    pub setup_files: &'r [Arc<Source>],
    pub source: &'r Arc<Source>,
    pub program: &'r Program,
    pub findings: &'r [Diagnostic],
    pub reports: &'r [Box<dyn TransformReport>],
}

impl ApplyOutcome<'_> {
    /// The program as it was read.
    fn parse_original(&self) -> Program {
        parse(self.source, Some(self.program.dialect())).program
    }

    fn compare_with_original(&self, before: &Program) -> RecipeChanges {
        let recipe = self.job.recipe;
        RecipeChanges::from_programs(before, self.program, &recipe.step_names(), Some(recipe.units))
    }
}

impl ApplyArgs {
    /// Writes what is wanted beside the program: run report, drawing, page and summary. A finding for the first that cannot be written.
    pub(super) fn write_side_outputs(
        &self,
        run: &ApplyOutcome<'_>,
        target: Option<&Path>,
        outputs: &CommandOutputs,
        progress: &CommandProgress,
    ) -> Result<(), Stop> {
        if let (Some(path), Some(print)) = (&self.json, run.job.print) {
            self.write_run_report(path, run, print, target, outputs)?;
        }
        if let Some(path) = &self.plot {
            self.draw_step_reports(path, run.reports, outputs)?;
        }
        if !self.reports.is_wanted() {
            return Ok(());
        }
        let digits = run.job.print.map(|print| print.sha256.to_string());
        let subject = ComparisonSubject {
            before: Some(&run.parse_original()),
            program: run.program,
            recipe: Some(run.job.recipe),
            setup: run.job.setup,
            setup_files: run.setup_files,
            units: Some(run.job.recipe.units),
            findings: run.findings,
            reports: run.reports,
            print: digits.as_deref(),
        };
        progress.begin_bar(&format!("{}: report", run.source.name()));
        let written = self.reports.simulate_and_write(subject, progress, outputs);
        progress.clear_bar();
        written
    }

    /// Writes what the run did as JSON; a finding when that fails.
    fn write_run_report(
        &self,
        path: &Path,
        run: &ApplyOutcome<'_>,
        print: &RecipeFingerprint,
        target: Option<&Path>,
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        let file = target.filter(|target| !self.dry_run && *target != Path::new(STANDARD));
        let file = file.map(|file| file.to_string_lossy().into_owned());
        let changes = run.compare_with_original(&run.parse_original());
        let report = RunReport::from_program(run.program, file, print, run.job.recipe.provenance, &changes);
        outputs.write_output(path, |out| report.write_json(out))
    }

    /// Draws what the steps have to show.
    fn draw_step_reports(
        &self,
        path: &Path,
        reports: &[Box<dyn TransformReport>],
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        let panels: Vec<_> = reports.iter().flat_map(|report| report.build_panels()).collect();
        let Some(text) = path_drawing::draw_path_panels(&panels)? else {
            if !self.quiet {
                eprintln!("{}: not drawn, no step has anything to show", path.display());
            }
            return Ok(());
        };
        let bytes = encode_drawing(path, text)?;
        outputs.write_output(path, |out| out.write_all(&bytes))
    }

    /// What was changed, for who looks on.
    pub(super) fn show_summary(&self, run: &ApplyOutcome<'_>, target: Option<&Path>) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let to = match target {
            Some(path) if path == Path::new(STANDARD) => " -> standard output".to_owned(),
            Some(path) => format!(" -> {}", path.display()),
            None => String::new(),
        };
        if !is_program_changed(run.program) {
            writeln!(err, "{}{to}: nothing to change, every byte as it was", run.source.name())?;
            return write_step_reports(&mut err, run.reports);
        }
        err.write_all(changes::to_text(&run.compare_with_original(&run.parse_original())).as_bytes())?;
        write_step_reports(&mut err, run.reports)?;
        if to.is_empty() { Ok(()) } else { writeln!(err, "{to}", to = to.trim_start()) }
    }
}

/// What the steps say about themselves, also when they had nothing to change.
fn write_step_reports(err: &mut impl Write, reports: &[Box<dyn TransformReport>]) -> io::Result<()> {
    reports.iter().try_for_each(|report| err.write_all(report.to_text().as_bytes()))
}

/// Writes the program; a finding when that fails.
pub(super) fn write_program(program: &Program, target: &Path, outputs: &CommandOutputs) -> Result<(), Stop> {
    outputs.write_output(target, |out| program.byte_chunks().try_for_each(|piece| out.write_all(piece)))
}
