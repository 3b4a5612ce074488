//! This module runs `clsmith check`.

use super::command_exit::CommandExit;
use super::finding_args::{FindingArgs, FindingFormat};
use super::input_files;
use super::judged_program::JudgedProgram;
use super::output_args::{JsonArgs, TextOutputArgs};
use super::run_limits::ReadLimitArgs;
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::parameters::LengthUnit;
use clsmith::program::Dialect;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::report::render::json;
use clsmith::setup::Setup;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith check part.cls
  clsmith check --setup shop.yaml part.cls           also ramps, feeds and axes, for the tools and the machine of the setup
  clsmith check recipe.yaml shop.yaml                recipes and setups, without a program
  clsmith check --deny warnings programs/*.cls       fail on warnings, too
  clsmith check --allow CL0001 part.aptsource        a broken line is known and meant
  clsmith check --format line part.cls               file:line:column: CODE: message
  clsmith check part.cls --json | jq '.diagnostics[].code'   the findings for programs
  clsmith check --format sarif part.cls -o out.sarif";

/// Finds faults of programs, with their exact places
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct CheckArgs {
    /// The programs, and recipes and setups (`.yaml`); `-` is a program on standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// A setup file: ramps are judged for the inserts of its tools, feeds, poles and travels by its machine
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    dialect: Option<Dialect>,
    /// Unit of lengths of a file that does not state it
    #[arg(long, value_parser = input_files::length_unit_parser(), value_name = "UNIT")]
    units: Option<LengthUnit>,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    output: TextOutputArgs,
    #[command(flatten)]
    limits: ReadLimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl CheckArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.output.find_wrong_ending().map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))?;
        let policy = self.findings.build_policy()?;
        self.limits.start_threads()?;
        let setup = self.setup.as_deref().map(input_files::read_setup).transpose()?;
        // Findings are printed as they are found, unless they go to a file, or JSON takes standard output.
        let at_once = self.output.is_standard() && !self.json.is_standard();
        let (mut text, mut all) = (Vec::new(), Vec::new());
        let mut worst = CommandExit::Done;
        let seen = at_once && terminal::is_stdout_terminal();
        for path in &self.files {
            let name = path.to_string_lossy().into_owned();
            let found = match is_yaml(path) {
                true => check_yaml(path),
                false => self.check_program(path, setup.as_ref(), &policy),
            };
            let found = policy.apply(found.unwrap_or_else(Failure::into_findings));
            if found.iter().any(Diagnostic::is_error) {
                worst = CommandExit::Errors;
            }
            if !self.is_one_document() {
                self.findings.write_findings(&mut text, seen, &found, Some(&name))?;
            }
            if at_once {
                io::stdout().lock().write_all(&text)?;
                text.clear();
            }
            all.extend(found);
        }
        if self.is_one_document() {
            let file =
                self.files.first().filter(|_| self.files.len() == 1).map(|path| path.to_string_lossy());
            self.findings.write_findings(&mut text, seen, &all, file.as_deref())?;
        }
        self.write_outputs(&String::from_utf8_lossy(&text), &all)?;
        Ok(worst)
    }

    /// Returns whether the findings of all files are a single document.
    fn is_one_document(&self) -> bool {
        matches!(self.findings.format, FindingFormat::Json | FindingFormat::Sarif)
    }

    /// Writes the findings as JSON if that is wanted, and the text that was not printed yet.
    fn write_outputs(&self, text: &str, all: &[Diagnostic]) -> Result<(), Stop> {
        let inputs: Vec<&Path> = self.files.iter().chain(&self.setup).map(PathBuf::as_path).collect();
        if self.json.is_wanted() {
            let mut document = Vec::new();
            json::render_json(&mut document, all)?;
            let document = String::from_utf8_lossy(&document).into_owned();
            self.json.write_document(&inputs, || document)?;
        }
        match self.json.is_standard() && self.output.is_standard() {
            true => Ok(()),
            false => self.output.write_text(text, &inputs),
        }
    }

    /// Reads and checks a program. With a setup, its ramps, feeds and axes are checked for the tools and the
    /// machine.
    fn check_program(
        &self,
        path: &Path,
        setup: Option<&Setup>,
        policy: &FindingPolicy,
    ) -> Result<Vec<Diagnostic>, Failure> {
        let source = self.limits.read_program(path)?;
        Ok(JudgedProgram::read_source(&source, self.dialect, self.units, setup, policy).findings)
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
        let setup = Setup::load(&source)?.read_machine_file(input_files::read_bytes)?;
        setup.read_material_file(input_files::read_bytes)?;
    }
    Ok(Vec::new())
}
