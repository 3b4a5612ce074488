//! This module runs `clsmith stats`.

use super::command_exit::CommandExit;
use super::display_args::DisplayArgs;
use super::finding_args::FindingArgs;
use super::input_files;
use super::judged_program::JudgedProgram;
use super::output_args::{JsonArgs, TextOutputArgs};
use super::run_limits::ReadLimitArgs;
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use clsmith::parameters::LengthUnit;
use clsmith::program::Dialect;
use clsmith::report::render::json::refusal_to_json;
use clsmith::report::stats;
use clsmith::setup::Setup;
use std::io;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith stats part.cls
  clsmith stats part.cls --json | jq .operations
  clsmith stats part.cls --json part.json    the text on the terminal, JSON in a file
  clsmith stats --units inch part.ncl        for a file that does not state its unit
  clsmith stats --setup shop.yaml part.cls   with the time of rapids, if the machine's rapid_feed is known

JSON of several programs is one document for each, one after the other.";

/// Measures programs: operations, tools, lengths, times, feeds, bounding box
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct StatsArgs {
    /// The programs; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    output: TextOutputArgs,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    dialect: Option<Dialect>,
    /// Unit of lengths of a file that does not state it
    #[arg(long, value_parser = input_files::length_unit_parser(), value_name = "UNIT")]
    units: Option<LengthUnit>,
    /// A setup file
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    #[command(flatten)]
    display: DisplayArgs,
    #[command(flatten)]
    limits: ReadLimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl StatsArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.output.find_wrong_ending().map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))?;
        let policy = self.findings.build_policy()?;
        self.limits.start_threads()?;
        let setup = self.setup.as_deref().map_or_else(|| Ok(Setup::default()), input_files::read_setup)?;
        let (mut text, mut documents) = (String::new(), String::new());
        let mut exit = CommandExit::Done;
        for path in &self.files {
            let source = match self.limits.read_program(path) {
                Ok(source) => source,
                Err(failure) => {
                    if self.json.is_wanted() {
                        let found = policy.apply(failure.findings().to_vec());
                        documents.push_str(&refusal_to_json(&path.to_string_lossy(), &found));
                    }
                    exit = exit.max(Stop::from(failure).about(path).tell_of_one_file(&self.findings)?);
                    continue;
                }
            };
            let asked = self.setup.is_some().then_some(&setup);
            let JudgedProgram { program, findings: found, .. } =
                JudgedProgram::read_source(&source, self.dialect, self.units, asked, &policy);
            let found = policy.apply(found);
            if !found.is_empty() {
                self.show_findings(&found, Some(source.name()))?;
            }
            if found.iter().any(Diagnostic::is_error) {
                exit = CommandExit::Errors;
            }
            let stats = stats::ProgramStats::with_assumed_unit(&program, &setup, self.units);
            let stats = stats.shown_in(self.display.asked());
            if self.json.is_wanted() {
                documents.push_str(&stats::to_json(&stats, &found));
            }
            if !text.is_empty() {
                text.push('\n');
            }
            text.push_str(&stats::to_text(&stats));
        }
        let inputs: Vec<&Path> = self.files.iter().chain(&self.setup).map(PathBuf::as_path).collect();
        self.json.write_document(&inputs, || documents)?;
        if !self.json.is_standard() || !self.output.is_standard() {
            self.output.write_text(&text, &inputs)?;
        }
        Ok(exit)
    }

    fn show_findings(&self, findings: &[Diagnostic], file: Option<&str>) -> io::Result<()> {
        self.findings.write_findings(&mut io::stderr().lock(), terminal::is_stderr_terminal(), findings, file)
    }
}
