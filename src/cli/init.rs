//! This module runs `clsmith init`.

use super::command_exit::CommandExit;
use super::command_outputs::CommandOutputs;
use super::finding_args::FindingArgs;
use super::input_files;
use super::run_limits::ReadLimitArgs;
use super::stop::Stop;
use super::terminal;
use clap::Args;
use clsmith::check::{list_unknown_words, read_and_check};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::program::Dialect;
use clsmith::recipe::recipe_schema;
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
    /// Say nothing but findings
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    limits: ReadLimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl InitArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let policy = self.findings.build_policy()?;
        self.limits.start_threads()?;
        let source = self.limits.read_program(&self.program)?;
        let (program, found) = read_and_check(&source, self.dialect);
        let found = policy.apply(found);
        if !found.is_empty() {
            let mut err = io::stderr().lock();
            self.findings.write_findings(
                &mut err,
                terminal::is_stderr_terminal(),
                &found,
                Some(source.name()),
            )?;
        }
        if found.iter().any(Diagnostic::is_error) {
            return Ok(CommandExit::Errors);
        }
        let stats = ProgramStats::from_program(&program, &Setup::default());
        let folder = self.output.as_deref().or_else(|| self.program.parent()).unwrap_or(Path::new(""));
        let schema =
            |schema: &serde_json::Value| serde_json::to_string_pretty(schema).map_err(io::Error::from);
        let files = [
            ("setup.yaml", starter_files::write_starter_setup(&stats, &list_unknown_words(&program))),
            ("recipe.yaml", starter_files::write_starter_recipe(&stats, "setup.yaml")),
            ("clsmith-setup.schema.json", schema(&Setup::schema())?),
            ("clsmith-recipe.schema.json", schema(&recipe_schema::<Step>())?),
        ];
        // Only the YAML files are protected. A schema is the same for all programs, so it may be written
        // again.
        for (name, _) in files.iter().filter(|(name, _)| name.ends_with(".yaml")) {
            let path = folder.join(name);
            if path.exists() {
                let message = format!("{} is there already; it is not overwritten", path.display());
                let help = "Move it away, or give another folder by -o.";
                return Err(Diagnostic::new(codes::UNWRITABLE, message).with_help(help).into());
            }
        }
        let outputs = CommandOutputs::default().for_inputs([self.program.as_path()]);
        for (name, text) in &files {
            let path = folder.join(name);
            outputs.write_output(&path, |out| out.write_all(text.as_bytes()))?;
            if !self.quiet {
                eprintln!("{}: written", path.display());
            }
        }
        Ok(CommandExit::Done)
    }
}
