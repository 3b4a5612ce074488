//! This module runs `clsmith apply`.

mod outputs;
mod usage_problem;

use super::closed_pipe::ignore_closed_pipe;
use super::command_exit::CommandExit;
use super::command_outputs::{CommandOutputs, refuse_overwritten_input};
use super::display_args::DisplayArgs;
use super::finding_args::FindingArgs;
use super::input_files::{self, LoadedRecipe, STANDARD};
use super::output_args::JsonArgs;
use super::progress::{CommandProgress, ProgressArgs};
use super::report_args::ReportArgs;
use super::run_limits::LimitArgs;
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::batch::set_older_output_aside;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::fingerprint::RecipeFingerprint;
use clsmith::job::{CorrectionJob, JobOutcome, catch_defect};
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::{Dialect, Program};
use clsmith::recipe::Provenance;
use clsmith::report::unified_diff;
use clsmith::simulation_run::{RunPhase, RunWatcher};
use clsmith::source::Source;
use outputs::{ApplyOutcome, ApplyRun, write_program};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  clsmith apply recipe.yaml part.cls -o out.cls
  clsmith apply recipe.yaml part.cls --diff          show the changed lines, write nothing
  clsmith apply recipe.yaml part.cls --dry-run       run, report, write nothing
  clsmith apply recipe.yaml - -o - < part.cls        from standard input to standard output
  clsmith apply recipe.yaml programs/*.cls -o done/  several files into a folder
  clsmith apply ramps.yaml part.cls --dry-run --plot ramps.svg   draw corrected ramps, before and after
  clsmith apply recipe.yaml part.cls -o out.cls --report out.html --summary out.md
                                                     what changed, to look at and for a merge request
  clsmith apply recipe.yaml part.cls -o out.cls --provenance comments --json out.json
                                                     what changed, in the program itself; `undo` needs out.json
  clsmith apply recipe.yaml part.cls --dry-run --json | jq .changes
                                                     what would change, for programs

Every output appears whole or not at all, and never over an input. With several inputs each stands for
itself: those with errors are not written, the others are, and the exit code is 1.";

/// Corrects programs by a recipe
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ApplyArgs {
    /// The recipe (YAML)
    recipe: PathBuf,
    /// The programs; `-` is standard input
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// Where to write: a file, `-` for standard output, or a folder if there are several inputs
    #[arg(short, long, value_name = "PATH", required_unless_present_any = ["dry_run", "diff"])]
    output: Option<PathBuf>,
    /// Run and report, write nothing
    #[arg(long)]
    dry_run: bool,
    /// Show the changed lines on standard output as a patch; writes nothing unless -o is given
    #[arg(long)]
    diff: bool,
    /// Draw what the steps did as SVG, or as PNG if the file ends in .png: ramps before and after
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    reports: ReportArgs,
    #[command(flatten)]
    json: JsonArgs,
    /// What the output states about the run, in comments. It overrides the recipe
    #[arg(long, value_parser = input_files::provenance_parser(), value_name = "WHAT")]
    provenance: Option<Provenance>,
    /// A setup file. It overrides the recipe's setup
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    dialect: Option<Dialect>,
    #[command(flatten)]
    progress: ProgressArgs,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    display: DisplayArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl ApplyArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.find_usage_problem().map_or(Ok(()), |problem| Err(Stop::Usage(problem)))?;
        let policy = self.findings.build_policy()?;
        let loaded = input_files::read_recipe(&self.recipe, self.setup.as_deref());
        let LoadedRecipe { mut recipe, setup, texts } =
            loaded.map_err(|failure| Stop::from(failure).about(&self.recipe))?;
        recipe.provenance = self.provenance.unwrap_or(recipe.provenance);
        // The fingerprint reads models and stock once more, so it is only computed if it is needed.
        let needed = self.json.is_wanted() || recipe.provenance != Provenance::None;
        let wanted = needed || self.reports.is_wanted();
        let print = match wanted.then(|| RecipeFingerprint::read_files(&texts, &recipe, &setup)).transpose() {
            Ok(print) => print,
            // Nothing else needs the fingerprint, and a page can do without it.
            Err(_) if !needed => None,
            Err(failure) => return Err(Stop::from(failure).about(&self.recipe)),
        };
        // The first text is the recipe, and the others are files of its setup.
        let setup_files = texts.get(1..).unwrap_or_default();
        let outputs = CommandOutputs::default();
        self.limits.threads().start_threads()?;
        let progress = CommandProgress::new(self.progress, outputs.interrupt(), self.limits.of_run());
        outputs.stop_on_ctrl_c(progress.clear_on_ctrl_c())?;
        let job = CorrectionJob::new(&recipe, &setup, &policy)
            .with_print(print.as_ref())
            .with_dialect(self.dialect)
            .with_watcher(&progress);
        let mut worst = CommandExit::Done;
        for input in &self.inputs {
            if outputs.interrupt().is_raised() {
                return Err(Stop::Interrupted);
            }
            progress.begin_program(&input.to_string_lossy());
            let applied = catch_defect(&input.to_string_lossy(), || {
                self.apply_to_input(&job, setup_files, input, &outputs, &progress)
            });
            if let Err(stop) = applied.unwrap_or_else(|defect| Err(defect.into())) {
                progress.clear_bar();
                worst = worst.max(stop.about(input).tell_of_one_file(&self.findings)?);
            }
        }
        Ok(worst)
    }

    fn apply_to_input(
        &self,
        job: &CorrectionJob<'_>,
        setup_files: &[Arc<Source>],
        input: &Path,
        outputs: &CommandOutputs,
        progress: &CommandProgress,
    ) -> Result<(), Stop> {
        let outputs = &outputs.for_inputs([input]);
        let target = self.output_path(input);
        let setup_file =
            job.recipe.setup_file.as_deref().map(|name| input_files::path_beside_recipe(&self.recipe, name));
        let drawn = self.named_outputs().map(|(_, path)| path).chain(self.reports.output_paths());
        let outs = target.iter().map(PathBuf::as_path).chain(drawn);
        self.check_outputs(outs, setup_file.as_deref(), job)?;
        let source = progress.read_program(input)?;
        // What is no CL data at all is told as that: its output has its ending for the same reason.
        if let Some(wrong) = self.find_wrong_ending(target.as_deref())
            && !parse_with_vocabulary(&source, job.dialect, &job.setup.vocabulary).refused
        {
            return Err(Stop::Usage(wrong));
        }
        let outcome = match job.try_source(&source) {
            Ok(JobOutcome { program, findings, reports, simulation }) => {
                ApplyOutcome { program, findings, reports, simulation }
            }
            Err(Failure::Interrupted) => return Err(Stop::Interrupted),
            // Reports of a refused program are still written, because they show what is wrong with it.
            Err(Failure::Found(findings)) => {
                let parsed = parse_with_vocabulary(&source, job.dialect, &job.setup.vocabulary);
                ApplyOutcome { program: parsed.program, findings, reports: Vec::new(), simulation: None }
            }
        };
        let mut run = ApplyRun { job, setup_files, source: &source, outcome, shown_in: self.display.asked() };
        self.finish_run(&mut run, target.as_deref(), outputs, progress)
            .map_err(|stop| stop.about(Path::new(source.name())))
    }

    /// Shows the findings and writes the requested outputs. Reports are always written, the program only if
    /// there is no error.
    fn finish_run(
        &self,
        run: &mut ApplyRun<'_>,
        target: Option<&Path>,
        outputs: &CommandOutputs,
        progress: &CommandProgress,
    ) -> Result<(), Stop> {
        let simulated = self.simulate_for_reports(run, progress);
        progress.begin_phase(RunPhase::Writing);
        progress.clear_bar();
        let simulated = simulated?;
        let refused = run.outcome.findings.iter().any(Diagnostic::is_error);
        if let Some(older) =
            target.filter(|target| refused && !self.dry_run && *target != Path::new(STANDARD))
        {
            // Somebody might take an older output for the result of this run, and machine a part with it.
            let found = set_older_output_aside(older, &older.to_string_lossy());
            run.outcome.findings.extend(run.job.policy.apply(found.into_iter().collect()));
        }
        let findings = &run.outcome.findings;
        if !findings.is_empty() {
            self.show_findings(findings, run.source.name())?;
        }
        if self.diff && !refused {
            self.print_diff(&run.outcome.program)?;
        }
        let target = target.filter(|_| !self.dry_run && !refused);
        // The program is written last. If an older file were replaced and the report could not be written,
        // the run could not be undone.
        self.write_side_outputs(run, simulated.as_ref(), target, outputs)?;
        if refused {
            if !self.progress.quiet {
                eprintln!("{}: {}", run.source.name(), self.describe_refusal());
            }
            return Err(Stop::Exit(CommandExit::Errors));
        }
        if let Some(target) = target {
            write_program(&run.outcome.program, target, outputs)?;
        }
        if !self.progress.quiet {
            ignore_closed_pipe(self.show_summary(run, target))?;
        }
        Ok(())
    }

    /// Returns the message about a program with errors.
    fn describe_refusal(&self) -> &'static str {
        match self.named_outputs().next().is_some() || self.reports.is_wanted() {
            true => "the program was not written, the reports of it were",
            false => "nothing was written",
        }
    }

    fn print_diff(&self, program: &Program) -> io::Result<()> {
        let mut out = io::stdout().lock();
        let seen = terminal::is_stdout_terminal();
        let color = self.findings.color.is_wanted(seen);
        let options = unified_diff::UnifiedDiffOptions::default().with_color(color).with_display(seen);
        unified_diff::write_unified_diff(&mut out, program, &options)?;
        out.flush()
    }

    /// Returns the path of the output for an input. Returns `None` if nothing is to be written.
    fn output_path(&self, input: &Path) -> Option<PathBuf> {
        let output = self.output.as_ref()?;
        if output != Path::new(STANDARD) && output.is_dir() {
            return Some(output.join(input.file_name().unwrap_or(input.as_os_str())));
        }
        Some(output.clone())
    }

    /// Checks that no output is an input, the recipe, the setup, or a model, stock or material that they
    /// name.
    fn check_outputs<'a>(
        &self,
        outs: impl Iterator<Item = &'a Path>,
        setup_file: Option<&Path>,
        job: &CorrectionJob<'_>,
    ) -> Result<(), Stop> {
        let given = self.inputs.iter().chain([&self.recipe]).chain(&self.setup).map(PathBuf::as_path);
        let read = job.recipe.steps.iter().flat_map(|step| step.transform().reads());
        let models: Vec<PathBuf> = read.map(|file| file.resolve_beside(&self.recipe)).collect();
        let all = given
            .chain(setup_file)
            .chain(models.iter().map(PathBuf::as_path))
            .chain(job.setup.referenced_files());
        refuse_overwritten_input(outs, &all.collect::<Vec<_>>())
    }

    fn show_findings(&self, findings: &[Diagnostic], file: &str) -> io::Result<()> {
        let mut err = io::stderr().lock();
        ignore_closed_pipe(self.findings.write_findings(
            &mut err,
            terminal::is_stderr_terminal(),
            findings,
            Some(file),
        ))
    }
}
