//! `clsmith apply`.

mod problem;
mod written;

use super::exit::Exit;
use super::files::{self, Loaded, STANDARD};
use super::findings::FindingArgs;
use super::output::{Outputs, overwritten, unless_nobody_reads};
use super::progress::Progress;
use super::reports::ReportArgs;
use super::terminal;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use clsmith::fingerprint::RecipePrint;
use clsmith::job::{Done, Job};
use clsmith::program::Dialect;
use clsmith::recipe::Provenance;
use clsmith::report::unified;
use clsmith::source::Source;
use clsmith::transform::Step;
use clsmith::write::is_interrupt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use written::{Ran, write};

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

Every output appears whole or not at all, and never over an input. With several inputs each stands for
itself: those with errors are not written, the others are, and the exit code is 1.";

/// Corrects programs by a recipe
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Apply {
    /// The recipe (YAML)
    recipe: PathBuf,
    /// The programs; `-` is standard input
    #[arg(required = true, value_name = "INPUT")]
    inputs: Vec<PathBuf>,
    /// Where to write: a file, `-` for standard output, or with several inputs a folder
    #[arg(short, long, value_name = "PATH", required_unless_present_any = ["dry_run", "diff"])]
    output: Option<PathBuf>,
    /// Run and report, write nothing
    #[arg(long)]
    dry_run: bool,
    /// Show the changed lines on standard output as a patch; writes nothing unless -o is given
    #[arg(long)]
    diff: bool,
    /// Draw what the steps did as SVG, or PNG where the file ends so: ramps before and after
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    reports: ReportArgs,
    /// What changed as JSON, with all that `clsmith undo` needs to give the original back
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// What the output says about the run, in comments: none, header or comments; overrides the recipe
    #[arg(long, value_parser = files::provenance, value_name = "WHAT")]
    provenance: Option<Provenance>,
    /// A setup file; overrides the recipe's setup
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = files::dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    /// Say nothing but findings
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    findings: FindingArgs,
}

impl Apply {
    pub fn run(&self) -> io::Result<Exit> {
        if let Some(problem) = self.problem() {
            eprintln!("clsmith apply: {problem}");
            return Ok(Exit::Usage);
        }
        let policy = match self.findings.policy() {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith apply: {problem}");
                return Ok(Exit::Usage);
            }
        };
        let Loaded { mut recipe, setup, texts } = match files::recipe(&self.recipe, self.setup.as_deref()) {
            Ok(loaded) => loaded,
            Err(found) => {
                self.show(&found, Some(&self.recipe.to_string_lossy()))?;
                return Ok(Exit::Errors);
            }
        };
        recipe.provenance = self.provenance.unwrap_or(recipe.provenance);
        // It reads models and stock once more, so not for nothing.
        let needed = self.json.is_some() || recipe.provenance != Provenance::None;
        let wanted = needed || self.reports.is_wanted();
        let print = match wanted.then(|| RecipePrint::of(&texts, &recipe, &setup)).transpose() {
            Ok(print) => print,
            // A page says itself what it cannot read, and goes without.
            Err(_) if !needed => None,
            Err(found) => {
                self.show(&[*found], Some(&self.recipe.to_string_lossy()))?;
                return Ok(Exit::Errors);
            }
        };
        // The recipe is the first of them.
        let setup_files = texts.get(1..).unwrap_or_default();
        let outputs = Outputs::default();
        let progress = Progress::new(self.quiet, outputs.interrupt());
        outputs.stop_on_ctrl_c(progress.clearing())?;
        let watch = &progress;
        let job = Job {
            recipe: &recipe,
            setup: &setup,
            print: print.as_ref(),
            policy: &policy,
            dialect: self.dialect,
            watch,
        };
        let mut worst = Exit::Done;
        for input in &self.inputs {
            if outputs.interrupt().is_raised() {
                return Ok(Exit::Interrupted);
            }
            progress.begin(&input.to_string_lossy());
            let done = self.one(&job, setup_files, input, &outputs, &progress);
            match done {
                Ok(exit) => worst = worst.max(exit),
                Err(error) if is_interrupt(&error) => return Ok(Exit::Interrupted),
                Err(error) => return Err(error),
            }
        }
        Ok(worst)
    }

    fn one(
        &self,
        job: &Job<'_>,
        setup_files: &[Arc<Source>],
        input: &Path,
        outputs: &Outputs,
        progress: &Progress,
    ) -> io::Result<Exit> {
        let target = self.target(input);
        let setup_file = job.recipe.setup_file.as_deref().map(|name| files::beside(&self.recipe, name));
        let drawn = self.named().map(|(_, path)| path).chain(self.reports.outputs());
        let outs = target.iter().map(PathBuf::as_path).chain(drawn);
        if let Some(found) = self.overwrites(outs, setup_file.as_deref(), job) {
            self.show(&[found], Some(&input.to_string_lossy()))?;
            return Ok(Exit::Errors);
        }
        let source = match files::read(input) {
            Ok(source) => source,
            Err(found) => {
                self.show(&[*found], Some(&input.to_string_lossy()))?;
                return Ok(Exit::Errors);
            }
        };
        let Done { program, findings, reports } = job.run(&source);
        progress.clear();
        if !findings.is_empty() {
            self.show(&findings, Some(source.name()))?;
        }
        let Some(program) = program else {
            if !self.quiet {
                eprintln!("{}: nothing was written", source.name());
            }
            return Ok(Exit::Errors);
        };
        if self.diff {
            let mut out = io::stdout().lock();
            let seen = terminal::output_is_seen();
            let color = self.findings.color.wanted(seen);
            unified::write(
                &mut out,
                &program,
                &unified::Options { color, display: seen, ..Default::default() },
            )?;
            out.flush()?;
        }
        let run = Ran {
            job,
            setup_files,
            source: &source,
            program: &program,
            findings: &findings,
            reports: &reports,
        };
        // The program comes last: one that was replaced without its report could not be undone.
        if let Some(found) = self.write_beside(&run, target.as_deref(), outputs, progress)? {
            self.show(&[found], Some(source.name()))?;
            return Ok(Exit::Errors);
        }
        if !self.dry_run
            && let Some(target) = &target
            && let Some(found) = write(&program, target, outputs)?
        {
            self.show(&[found], Some(source.name()))?;
            return Ok(Exit::Errors);
        }
        if !self.quiet {
            let target = target.as_deref().filter(|_| !self.dry_run);
            unless_nobody_reads(self.summary(&run, target))?;
        }
        Ok(Exit::Done)
    }

    /// The output of an input; `None` when nothing is to be written.
    fn target(&self, input: &Path) -> Option<PathBuf> {
        let output = self.output.as_ref()?;
        if output != Path::new(STANDARD) && output.is_dir() {
            return Some(output.join(input.file_name().unwrap_or(input.as_os_str())));
        }
        Some(output.clone())
    }

    /// No output may be an input, the recipe, the setup, or a model, stock or material that these read.
    fn overwrites<'a>(
        &self,
        outs: impl Iterator<Item = &'a Path>,
        setup_file: Option<&Path>,
        job: &Job<'_>,
    ) -> Option<Diagnostic> {
        let given = self.inputs.iter().chain([&self.recipe]).chain(&self.setup).map(PathBuf::as_path);
        let read = job.recipe.steps.iter().filter_map(Step::reads);
        let models: Vec<PathBuf> = read.map(|file| file.beside(&self.recipe)).collect();
        let all = given.chain(setup_file).chain(models.iter().map(PathBuf::as_path)).chain(job.setup.files());
        overwritten(outs, &all.collect::<Vec<_>>())
    }

    fn show(&self, findings: &[Diagnostic], file: Option<&str>) -> io::Result<()> {
        let mut err = io::stderr().lock();
        unless_nobody_reads(self.findings.show(&mut err, terminal::errors_are_seen(), findings, file))
    }
}
