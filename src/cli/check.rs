//! This module runs `clsmith check`.

use super::command_exit::CommandExit;
use super::finding_args::{FindingArgs, FindingFormat};
use super::input_files;
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::check::read_and_check_with_vocabulary;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::program::Dialect;
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::setup::Setup;
use clsmith::transform::correct_ramp::check_ramps;
use clsmith::transform::find_feeds_above_machine;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  clsmith check part.cls
  clsmith check --setup shop.yaml part.cls           also ramps, for the inserts of the setup's tools, and feeds
  clsmith check recipe.yaml shop.yaml                recipes and setups, without a program
  clsmith check --deny warnings programs/*.cls       fail on warnings, too
  clsmith check --allow CL0001 part.aptsource        a broken line is known and meant
  clsmith check --format line part.cls               file:line:column: CODE: message
  clsmith check --format sarif part.cls > out.sarif";

/// Finds faults of programs, with their exact places
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct CheckArgs {
    /// The programs, and recipes and setups (`.yaml`); `-` is a program on standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// A setup file: ramps are judged for the inserts of its tools, feeds by its machine
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::parse_dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl CheckArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let policy = self.findings.build_policy()?;
        let setup = self.setup.as_deref().map(input_files::read_setup).transpose()?;
        let mut out = io::stdout().lock();
        let mut all = Vec::new();
        let mut worst = CommandExit::Done;
        for path in &self.files {
            let name = path.to_string_lossy().into_owned();
            let found = match is_yaml(path) {
                true => check_yaml(path),
                false => self.check_program(path, setup.as_ref()),
            };
            let found = policy.apply(found.unwrap_or_else(Failure::into_findings));
            if found.iter().any(Diagnostic::is_error) {
                worst = CommandExit::Errors;
            }
            match self.findings.format {
                // There is a single document for all files.
                FindingFormat::Json | FindingFormat::Sarif => all.extend(found),
                FindingFormat::Human | FindingFormat::Line => {
                    self.findings.write_findings(
                        &mut out,
                        terminal::is_stdout_terminal(),
                        &found,
                        Some(&name),
                    )?;
                }
            }
        }
        if matches!(self.findings.format, FindingFormat::Json | FindingFormat::Sarif) {
            let file =
                self.files.first().filter(|_| self.files.len() == 1).map(|path| path.to_string_lossy());
            self.findings.write_findings(&mut out, terminal::is_stdout_terminal(), &all, file.as_deref())?;
        }
        out.flush()?;
        Ok(worst)
    }

    /// Reads and checks a program, with what the setup knows of tools and machine.
    fn check_program(&self, path: &Path, setup: Option<&Setup>) -> Result<Vec<Diagnostic>, Failure> {
        let source = input_files::read_source(path)?;
        let vocabulary = setup.map(|setup| Arc::clone(&setup.vocabulary)).unwrap_or_default();
        let (program, mut found) = read_and_check_with_vocabulary(&source, self.dialect, &vocabulary);
        // A program that is wrong in itself has other ramps when it is right.
        let sound = !found.iter().any(Diagnostic::is_error);
        if let Some(setup) = setup.filter(|_| sound) {
            let unit = ResolvedLengthUnit::from_program(&program, None).unit;
            found.extend(check_ramps(&program, setup, unit));
            found.extend(find_feeds_above_machine(&program, setup, unit));
        }
        Ok(found)
    }
}

fn is_yaml(path: &Path) -> bool {
    path.extension().is_some_and(|end| end.eq_ignore_ascii_case("yaml") || end.eq_ignore_ascii_case("yml"))
}

/// Reads a recipe with all files that it names, or a setup. Its keys tell which of them a file is.
fn check_yaml(path: &Path) -> Result<Vec<Diagnostic>, Failure> {
    let source = input_files::read_source(path)?;
    let has_key = |key: &[u8]| source.bytes().split(|byte| *byte == b'\n').any(|line| line.starts_with(key));
    if has_key(b"steps:") || has_key(b"version:") {
        input_files::read_recipe(path, None)?;
    } else {
        Setup::load(&source)?.read_material_file(input_files::read_bytes)?;
    }
    Ok(Vec::new())
}
