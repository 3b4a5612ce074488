//! `clsmith apply`.

use super::exit::Exit;
use super::files::{self, Loaded, STANDARD};
use super::findings::FindingArgs;
use super::output::{Outputs, overwritten, unless_nobody_reads};
use super::plot::as_file;
use super::progress::Progress;
use super::reports::ReportArgs;
use super::terminal;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use clsmith::fingerprint::RecipePrint;
use clsmith::job::{Done, Job, is_changed};
use clsmith::parse::parse;
use clsmith::program::{Dialect, Program};
use clsmith::recipe::Provenance;
use clsmith::report::changes::{self, Changes};
use clsmith::report::comparison::Subject;
use clsmith::report::{picture, step_report, unified};
use clsmith::source::Source;
use clsmith::transform::{Recipe, Step, StepReport};
use clsmith::undo::RunReport;
use clsmith::write::{is_interrupt, same_file};
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

    /// What is wrong with the command line beyond what clap can say.
    fn problem(&self) -> Option<String> {
        let standard = |path: &PathBuf| path == Path::new(STANDARD);
        if self.inputs.iter().filter(|path| standard(path)).count() > 1 {
            return Some("standard input can be read only once".into());
        }
        if self.diff && self.output.as_ref().is_some_and(standard) {
            return Some("--diff and -o - both write to standard output".into());
        }
        let several = self.inputs.len() > 1;
        let extra: Vec<(&str, &Path)> = self.named().chain(self.reports.named()).collect();
        let taken = self.diff || self.output.as_ref().is_some_and(standard);
        let on_standard: Vec<&str> =
            extra.iter().filter(|(_, path)| *path == Path::new(STANDARD)).map(|(name, _)| *name).collect();
        match on_standard.as_slice() {
            [name, ..] if taken => {
                return Some(format!("{name} - shares standard output with --diff or -o -"));
            }
            [name, other, ..] => {
                return Some(format!("{name} - and {other} - both write to standard output"));
            }
            _ => {}
        }
        let target = self.inputs.first().and_then(|input| self.target(input));
        let files = target.iter().map(|path| ("-o", path.as_path())).chain(extra.iter().copied());
        let files: Vec<(&str, &Path)> = files.filter(|(_, path)| *path != Path::new(STANDARD)).collect();
        for (index, (other, path)) in files.iter().enumerate() {
            let same = |(_, earlier): &&(&str, &Path)| earlier == path || same_file(earlier, path);
            if let Some((name, _)) = files.iter().take(index).find(same) {
                return Some(format!("{other} and {name} name one file"));
            }
        }
        if several && let Some((name, _)) = extra.first() {
            return Some(format!("{name} shows one program; there are several"));
        }
        let folder = self.output.as_deref().filter(|path| !path.as_os_str().is_empty());
        if let Some(folder) = folder.filter(|folder| several && !folder.is_dir()) {
            let folder = folder.display();
            return Some(format!("with several inputs, -o names a folder that exists; `{folder}` is none"));
        }
        if several && self.output.is_some() {
            // Case aside: on some disks `A.cls` and `a.cls` are one file.
            let name = |input: &PathBuf| {
                input.file_name().map(|name| name.to_string_lossy().to_lowercase()).unwrap_or_default()
            };
            let mut names: Vec<String> = self.inputs.iter().map(name).collect();
            names.sort();
            let twice = names.iter().zip(names.iter().skip(1)).find(|(one, next)| one == next);
            if let Some((name, _)) = twice {
                return Some(format!("two inputs are called {name}; their outputs would be one file"));
            }
        }
        None
    }

    /// Options beside those of reports that name a file to write.
    fn named(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let both = [("--plot", &self.plot), ("--json", &self.json)];
        both.into_iter().filter_map(|(name, path)| Some((name, path.as_deref()?)))
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
        // The program comes last: one that was replaced without its report could not be undone.
        if let (Some(path), Some(print)) = (&self.json, job.print)
            && let Some(found) =
                self.run_report(path, &program, job.recipe, print, target.as_deref(), outputs)?
        {
            self.show(&[found], Some(source.name()))?;
            return Ok(Exit::Errors);
        }
        if let Some(path) = &self.plot
            && self.draw(path, &reports, outputs)? != Exit::Done
        {
            return Ok(Exit::Errors);
        }
        if self.reports.is_wanted() {
            let before = parse(&source, Some(program.dialect())).program;
            let digits = job.print.map(|print| print.sha256.to_string());
            let subject = Subject {
                before: Some(&before),
                program: &program,
                recipe: Some(job.recipe),
                setup: job.setup,
                setup_files,
                units: Some(job.recipe.units),
                findings: &findings,
                reports: &reports,
                print: digits.as_deref(),
            };
            progress.begin(&format!("{}: report", source.name()));
            let written = self.reports.write_all_of(subject, progress, outputs);
            progress.clear();
            if let Some(found) = written? {
                self.show(&[found], Some(source.name()))?;
                return Ok(Exit::Errors);
            }
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
            unless_nobody_reads(self.summary(job, &source, &program, &reports, target))?;
        }
        Ok(Exit::Done)
    }

    /// Writes what the run did as JSON; a finding when that fails.
    fn run_report(
        &self,
        path: &Path,
        program: &Program,
        recipe: &Recipe,
        print: &RecipePrint,
        target: Option<&Path>,
        outputs: &Outputs,
    ) -> io::Result<Option<Diagnostic>> {
        let before = parse(program.source(), Some(program.dialect())).program;
        let changes = Changes::of(&before, program, &recipe.step_names(), Some(recipe.units));
        let file = target.filter(|target| !self.dry_run && *target != Path::new(STANDARD));
        let file = file.map(|file| file.to_string_lossy().into_owned());
        let report = RunReport::of(program, file, print, recipe.provenance, &changes);
        outputs.write(path, |out| report.write(out))
    }

    /// Draws what the steps have to show.
    fn draw(&self, path: &Path, reports: &[StepReport], outputs: &Outputs) -> io::Result<Exit> {
        let panels: Vec<_> = reports.iter().flat_map(step_report::panels).collect();
        let Some(text) = picture::draw(&panels)? else {
            if !self.quiet {
                eprintln!("{}: not drawn, no step has anything to show", path.display());
            }
            return Ok(Exit::Done);
        };
        let bytes = as_file(path, text)?;
        match outputs.write(path, |out| out.write_all(&bytes))? {
            Some(found) => self.show(&[found], None).map(|()| Exit::Errors),
            None => Ok(Exit::Done),
        }
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

    fn summary(
        &self,
        job: &Job<'_>,
        source: &Arc<Source>,
        program: &Program,
        reports: &[StepReport],
        target: Option<&Path>,
    ) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let to = match target {
            Some(path) if path == Path::new(STANDARD) => " -> standard output".to_owned(),
            Some(path) => format!(" -> {}", path.display()),
            None => String::new(),
        };
        if !is_changed(program) {
            writeln!(err, "{}{to}: nothing to change, every byte as it was", source.name())?;
            return show_reports(&mut err, reports);
        }
        let before = parse(source, Some(program.dialect())).program;
        let steps = job.recipe.step_names();
        let found = Changes::of(&before, program, &steps, Some(job.recipe.units));
        err.write_all(changes::to_text(&found).as_bytes())?;
        show_reports(&mut err, reports)?;
        if to.is_empty() { Ok(()) } else { writeln!(err, "{to}", to = to.trim_start()) }
    }
}

/// What the steps say about themselves, also when they had nothing to change.
fn show_reports(err: &mut impl Write, reports: &[StepReport]) -> io::Result<()> {
    reports.iter().try_for_each(|report| err.write_all(step_report::to_text(report).as_bytes()))
}

/// Writes the program; a finding when that fails.
fn write(program: &Program, target: &Path, outputs: &Outputs) -> io::Result<Option<Diagnostic>> {
    outputs.write(target, |out| program.pieces().try_for_each(|piece| out.write_all(piece)))
}
