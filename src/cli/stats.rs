//! This module runs `clsmith stats`.

use super::command_exit::CommandExit;
use super::display_args::DisplayArgs;
use super::finding_args::FindingArgs;
use super::input_files;
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::check::check_program;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::parameters::LengthUnit;
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::{Dialect, Program, Record, Statement};
use clsmith::report::stats;
use clsmith::setup::Setup;
use std::io::{self, Write};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  clsmith stats part.cls
  clsmith stats --json part.cls | jq .operations
  clsmith stats --units inch part.ncl        for a file that does not state its unit
  clsmith stats --setup shop.yaml part.cls   with the time of rapids, if the machine's rapid_feed is known";

/// Measures programs: operations, tools, lengths, times, feeds, bounding box
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct StatsArgs {
    /// The programs; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// As JSON: one document for each file, one after the other
    #[arg(long)]
    json: bool,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::parse_dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    /// Unit of lengths of a file that does not state it: mm or inch
    #[arg(long, value_parser = input_files::parse_length_unit, value_name = "UNIT")]
    units: Option<LengthUnit>,
    /// A setup file
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    #[command(flatten)]
    display: DisplayArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl StatsArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let policy = self.findings.build_policy()?;
        let setup = self.setup.as_deref().map_or_else(|| Ok(Setup::default()), input_files::read_setup)?;
        let mut out = io::stdout().lock();
        let mut exit = CommandExit::Done;
        for (index, path) in self.files.iter().enumerate() {
            let source = match input_files::read_source(path) {
                Ok(source) => source,
                Err(failure) => {
                    exit = exit.max(Stop::from(failure).about(path).tell_of_one_file(&self.findings)?);
                    continue;
                }
            };
            let parsed = parse_with_vocabulary(&source, self.dialect, &setup.vocabulary);
            let mut found = parsed.diagnostics;
            found.extend(find_missing_points(&parsed.program));
            let found = policy.apply(found);
            if !found.is_empty() {
                self.show_findings(&found, Some(source.name()))?;
            }
            if found.iter().any(Diagnostic::is_error) {
                exit = CommandExit::Errors;
            }
            let stats = stats::ProgramStats::with_assumed_unit(&parsed.program, &setup, self.units);
            let stats = stats.shown_in(self.display.asked());
            if self.json {
                out.write_all(stats::to_json(&stats).as_bytes())?;
            } else {
                if index > 0 {
                    writeln!(out)?;
                }
                out.write_all(stats::to_text(&stats).as_bytes())?;
            }
        }
        out.flush()?;
        Ok(exit)
    }

    fn show_findings(&self, findings: &[Diagnostic], file: Option<&str>) -> io::Result<()> {
        self.findings.write_findings(&mut io::stderr().lock(), terminal::is_stderr_terminal(), findings, file)
    }
}

/// Finds statements that may be points of the path, without which lengths and times are too small.
fn find_missing_points(program: &Program) -> Vec<Diagnostic> {
    let unknown = |statement: &Statement| matches!(statement.record(), Record::Other);
    if !program.live_statements().any(|(_, statement)| unknown(statement)) {
        return Vec::new();
    }
    let mut found = check_program(program);
    found.retain(|finding| finding.code == codes::POINTS_MISSING);
    found
}
