//! `clsmith check`.

use super::exit::Exit;
use super::files;
use super::findings::{FindingArgs, Format};
use super::terminal;
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
pub struct Check {
    /// The programs; `-` is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = files::dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    #[command(flatten)]
    findings: FindingArgs,
}

impl Check {
    pub fn run(&self) -> io::Result<Exit> {
        let policy = match self.findings.policy() {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith check: {problem}");
                return Ok(Exit::Usage);
            }
        };
        let mut out = io::stdout().lock();
        let mut all = Vec::new();
        let mut worst = Exit::Done;
        for path in &self.files {
            let (name, found) = match files::read(path) {
                Ok(source) => {
                    let (_, found) = read_and_check(&source, self.dialect);
                    (source.name().to_owned(), found)
                }
                Err(found) => (path.to_string_lossy().into_owned(), vec![*found]),
            };
            let found = policy.apply(found);
            if found.iter().any(Diagnostic::is_error) {
                worst = Exit::Errors;
            }
            match self.findings.format {
                // One document for all files.
                Format::Json | Format::Sarif => all.extend(found),
                Format::Human | Format::Line => {
                    self.findings.show(&mut out, terminal::output_is_seen(), &found, Some(&name))?;
                }
            }
        }
        if matches!(self.findings.format, Format::Json | Format::Sarif) {
            let file =
                self.files.first().filter(|_| self.files.len() == 1).map(|path| path.to_string_lossy());
            self.findings.show(&mut out, terminal::output_is_seen(), &all, file.as_deref())?;
        }
        out.flush()?;
        Ok(worst)
    }
}
