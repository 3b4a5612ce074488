//! `clsmith stats`.

use super::exit::Exit;
use super::files;
use super::findings::FindingArgs;
use super::terminal;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use clsmith::parse::parse;
use clsmith::program::Dialect;
use clsmith::report::stats;
use clsmith::setup::Setup;
use clsmith::values::LengthUnit;
use std::io::{self, Write};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  clsmith stats part.cls
  clsmith stats --json part.cls | jq .operations
  clsmith stats --units inch part.ncl        for a file that does not state its unit
  clsmith stats --setup shop.yaml part.cls   with the time of rapids, if the machine's rapid_feed is known";

/// Says what is in programs: operations, tools, lengths, times, feeds, box
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Stats {
    /// The programs; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// As JSON: one document for each file, one after the other
    #[arg(long)]
    json: bool,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = files::dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    /// Unit of lengths of a file that does not state it: mm or inch
    #[arg(long, value_parser = files::units, value_name = "UNIT")]
    units: Option<LengthUnit>,
    /// A setup file
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    #[command(flatten)]
    findings: FindingArgs,
}

impl Stats {
    pub fn run(&self) -> io::Result<Exit> {
        let policy = match self.findings.policy() {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith stats: {problem}");
                return Ok(Exit::Usage);
            }
        };
        let setup = match self.setup.as_deref().map(files::setup).transpose() {
            Ok(setup) => setup.unwrap_or_else(Setup::default),
            Err(found) => {
                self.show(&found, None)?;
                return Ok(Exit::Errors);
            }
        };
        let mut out = io::stdout().lock();
        let mut exit = Exit::Done;
        for (index, path) in self.files.iter().enumerate() {
            let source = match files::read(path) {
                Ok(source) => source,
                Err(found) => {
                    self.show(&[*found], Some(&path.to_string_lossy()))?;
                    exit = Exit::Errors;
                    continue;
                }
            };
            let parsed = parse(&source, self.dialect);
            let found = policy.apply(parsed.diagnostics);
            if !found.is_empty() {
                self.show(&found, Some(source.name()))?;
            }
            if found.iter().any(Diagnostic::is_error) {
                exit = Exit::Errors;
            }
            let stats = stats::Stats::assuming(&parsed.program, &setup, self.units);
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

    fn show(&self, findings: &[Diagnostic], file: Option<&str>) -> io::Result<()> {
        self.findings.show(&mut io::stderr().lock(), terminal::errors_are_seen(), findings, file)
    }
}
