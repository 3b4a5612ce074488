//! `clsmith check`.

use super::command_exit::CommandExit;
use super::finding_args::{FindingArgs, FindingFormat};
use super::input_files;
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::check::read_and_check;
use clsmith::diagnostic::Diagnostic;
use clsmith::program::Dialect;
use std::io::{self, Write};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  clsmith check part.cls
  clsmith check --deny warnings programs/*.cls       fail on warnings, too
  clsmith check --allow CL0001 part.aptsource        a broken line is known and meant
  clsmith check --format line part.cls               file:line:column: CODE: message
  clsmith check --format sarif part.cls > out.sarif";

/// Finds what is wrong with programs, with the exact place
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct CheckArgs {
    /// The programs; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::parse_dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl CheckArgs {
    pub fn run(&self) -> Result<CommandExit, Stop> {
        let policy = self.findings.build_policy()?;
        let mut out = io::stdout().lock();
        let mut all = Vec::new();
        let mut worst = CommandExit::Done;
        for path in &self.files {
            let (name, found) = match input_files::read_source(path) {
                Ok(source) => {
                    let (_, found) = read_and_check(&source, self.dialect);
                    (source.name().to_owned(), found)
                }
                Err(failure) => (path.to_string_lossy().into_owned(), failure.into_findings()),
            };
            let found = policy.apply(found);
            if found.iter().any(Diagnostic::is_error) {
                worst = CommandExit::Errors;
            }
            match self.findings.format {
                // One document for all files.
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
}
