//! What a run of `apply` writes and tells.

use super::Apply;
use crate::cli::files::STANDARD;
use crate::cli::output::Outputs;
use crate::cli::plot::as_file;
use crate::cli::progress::Progress;
use clsmith::diagnostic::Diagnostic;
use clsmith::fingerprint::RecipePrint;
use clsmith::job::{Job, is_changed};
use clsmith::parse::parse;
use clsmith::program::Program;
use clsmith::report::changes::{self, Changes};
use clsmith::report::comparison::Subject;
use clsmith::report::{picture, step_report};
use clsmith::source::Source;
use clsmith::transform::StepReport;
use clsmith::undo::RunReport;
use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

/// A program that its recipe is through with.
pub(super) struct Ran<'r> {
    pub job: &'r Job<'r>,
    pub setup_files: &'r [Arc<Source>],
    pub source: &'r Arc<Source>,
    pub program: &'r Program,
    pub findings: &'r [Diagnostic],
    pub reports: &'r [StepReport],
}

impl Ran<'_> {
    /// The program as it was read.
    fn before(&self) -> Program {
        parse(self.source, Some(self.program.dialect())).program
    }

    fn changes(&self, before: &Program) -> Changes {
        let recipe = self.job.recipe;
        Changes::of(before, self.program, &recipe.step_names(), Some(recipe.units))
    }
}

impl Apply {
    /// Writes what is wanted beside the program: run report, drawing, page and summary. A finding for the first that cannot be written.
    pub(super) fn write_beside(
        &self,
        run: &Ran<'_>,
        target: Option<&Path>,
        outputs: &Outputs,
        progress: &Progress,
    ) -> io::Result<Option<Diagnostic>> {
        if let (Some(path), Some(print)) = (&self.json, run.job.print)
            && let Some(found) = self.run_report(path, run, print, target, outputs)?
        {
            return Ok(Some(found));
        }
        if let Some(path) = &self.plot
            && let Some(found) = self.draw(path, run.reports, outputs)?
        {
            return Ok(Some(found));
        }
        if !self.reports.is_wanted() {
            return Ok(None);
        }
        let digits = run.job.print.map(|print| print.sha256.to_string());
        let subject = Subject {
            before: Some(&run.before()),
            program: run.program,
            recipe: Some(run.job.recipe),
            setup: run.job.setup,
            setup_files: run.setup_files,
            units: Some(run.job.recipe.units),
            findings: run.findings,
            reports: run.reports,
            print: digits.as_deref(),
        };
        progress.begin(&format!("{}: report", run.source.name()));
        let written = self.reports.write_all_of(subject, progress, outputs);
        progress.clear();
        written
    }

    /// Writes what the run did as JSON; a finding when that fails.
    fn run_report(
        &self,
        path: &Path,
        run: &Ran<'_>,
        print: &RecipePrint,
        target: Option<&Path>,
        outputs: &Outputs,
    ) -> io::Result<Option<Diagnostic>> {
        let file = target.filter(|target| !self.dry_run && *target != Path::new(STANDARD));
        let file = file.map(|file| file.to_string_lossy().into_owned());
        let changes = run.changes(&run.before());
        let report = RunReport::of(run.program, file, print, run.job.recipe.provenance, &changes);
        outputs.write(path, |out| report.write(out))
    }

    /// Draws what the steps have to show.
    fn draw(&self, path: &Path, reports: &[StepReport], outputs: &Outputs) -> io::Result<Option<Diagnostic>> {
        let panels: Vec<_> = reports.iter().flat_map(step_report::panels).collect();
        let Some(text) = picture::draw(&panels)? else {
            if !self.quiet {
                eprintln!("{}: not drawn, no step has anything to show", path.display());
            }
            return Ok(None);
        };
        let bytes = as_file(path, text)?;
        outputs.write(path, |out| out.write_all(&bytes))
    }

    /// What was changed, for who looks on.
    pub(super) fn summary(&self, run: &Ran<'_>, target: Option<&Path>) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let to = match target {
            Some(path) if path == Path::new(STANDARD) => " -> standard output".to_owned(),
            Some(path) => format!(" -> {}", path.display()),
            None => String::new(),
        };
        if !is_changed(run.program) {
            writeln!(err, "{}{to}: nothing to change, every byte as it was", run.source.name())?;
            return show_reports(&mut err, run.reports);
        }
        err.write_all(changes::to_text(&run.changes(&run.before())).as_bytes())?;
        show_reports(&mut err, run.reports)?;
        if to.is_empty() { Ok(()) } else { writeln!(err, "{to}", to = to.trim_start()) }
    }
}

/// What the steps say about themselves, also when they had nothing to change.
fn show_reports(err: &mut impl Write, reports: &[StepReport]) -> io::Result<()> {
    reports.iter().try_for_each(|report| err.write_all(step_report::to_text(report).as_bytes()))
}

/// Writes the program; a finding when that fails.
pub(super) fn write(program: &Program, target: &Path, outputs: &Outputs) -> io::Result<Option<Diagnostic>> {
    outputs.write(target, |out| program.pieces().try_for_each(|piece| out.write_all(piece)))
}
