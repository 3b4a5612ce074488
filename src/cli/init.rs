//! This module runs `clsmith init`.

use super::command_exit::CommandExit;
use super::command_outputs::CommandOutputs;
use super::finding_args::FindingArgs;
use super::input_files;
use super::output_args::JsonArgs;
use super::run_limits::ReadLimitArgs;
use super::stop::Stop;
use super::terminal::{self, escape_controls};
use clap::Args;
use clsmith::check::{list_unknown_words, read_and_check};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::program::Dialect;
use clsmith::recipe::recipe_schema;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::report::starter_document::starter_to_json;
use clsmith::report::starter_files;
use clsmith::report::stats::ProgramStats;
use clsmith::setup::Setup;
use clsmith::transform::Step;
use std::io;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith init part.cls               setup.yaml and recipe.yaml beside it, from what the file says
  clsmith init part.cls -o shop       the same in the folder shop
  clsmith init part.cls --json        also what was found and written, for programs

Both files are valid at once, and say in comments what the program does and what it does not tell. Their schemas
stand beside them, so editors complete and check them. A setup or a recipe that is there already is not touched.";

/// Writes a first setup and a first recipe from what a program says
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct InitArgs {
    /// The program
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// The folder to write into; the program's if not given
    #[arg(short, long, alias = "out", value_name = "FOLDER")]
    output: Option<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    dialect: Option<Dialect>,
    #[command(flatten)]
    json: JsonArgs,
    /// Say nothing but findings
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    limits: ReadLimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

/// What was found in the program, and what was written.
#[derive(Debug, Default)]
struct InitOutcome {
    found: Option<(ProgramStats, Vec<String>)>,
    written: Vec<String>,
    findings: Vec<Diagnostic>,
}

impl InitArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let policy = self.findings.build_policy()?;
        self.limits.start_threads()?;
        let inputs = [self.program.as_path()];
        self.json.check_file(&inputs)?;
        let mut outcome = InitOutcome::default();
        match self.write_starters(&policy, &mut outcome) {
            Err(Stop::Found { findings, .. }) => outcome.findings.extend(findings),
            done => done?,
        }
        let InitOutcome { found, written, findings } = outcome;
        let name = self.program.to_string_lossy();
        if !findings.is_empty() {
            let mut err = io::stderr().lock();
            self.findings.write_findings(&mut err, terminal::is_stderr_terminal(), &findings, Some(&name))?;
        }
        if !self.quiet {
            written.iter().for_each(|path| eprintln!("{}: written", escape_controls(path)));
        }
        self.json.write_document(&inputs, || {
            let found = found.as_ref().map(|(stats, words)| (stats, words.as_slice()));
            starter_to_json(&name, found, &written, &findings)
        })?;
        let refused = findings.iter().any(Diagnostic::is_error);
        Ok(if refused { CommandExit::Errors } else { CommandExit::Done })
    }

    /// Reads the program and writes the files. What it finds and writes is in `outcome`, also if it stops.
    fn write_starters(&self, policy: &FindingPolicy, outcome: &mut InitOutcome) -> Result<(), Stop> {
        let source = self.limits.read_program(&self.program)?;
        let (program, found) = read_and_check(&source, self.dialect);
        outcome.findings = policy.apply(found);
        let stats = ProgramStats::from_program(&program, &Setup::default());
        let (stats, words) = &*outcome.found.insert((stats, list_unknown_words(&program)));
        if outcome.findings.iter().any(Diagnostic::is_error) {
            return Ok(());
        }
        let folder = self.output.as_deref().or_else(|| self.program.parent()).unwrap_or(Path::new(""));
        let schema =
            |schema: &serde_json::Value| serde_json::to_string_pretty(schema).map_err(io::Error::from);
        let files = [
            ("setup.yaml", starter_files::write_starter_setup(stats, words)),
            ("recipe.yaml", starter_files::write_starter_recipe(stats, "setup.yaml")),
            ("clsmith-setup.schema.json", schema(&Setup::schema())?),
            ("clsmith-recipe.schema.json", schema(&recipe_schema::<Step>())?),
        ]
        .map(|(name, text)| (folder.join(name), text));
        if let Some((path, _)) = files.iter().find(|(path, _)| self.json.path() == Some(path.as_path())) {
            return Err(Stop::Usage(format!("two outputs would go to {}", path.display())));
        }
        // Only the YAML files are protected. A schema is the same for all programs, so it may be written
        // again.
        let is_yaml = |path: &Path| path.extension().is_some_and(|end| end == "yaml");
        if let Some((path, _)) = files.iter().find(|(path, _)| is_yaml(path) && path.exists()) {
            let message = format!("{} is there already; it is not overwritten", path.display());
            let help = "Move it away, or give another folder by -o.";
            return Err(Diagnostic::new(codes::UNWRITABLE, message).with_help(help).into());
        }
        let outputs = CommandOutputs::default().for_inputs([self.program.as_path()]);
        for (path, text) in &files {
            outputs.write_output(path, |out| out.write_all(text.as_bytes()))?;
            outcome.written.push(path.to_string_lossy().into_owned());
        }
        Ok(())
    }
}
