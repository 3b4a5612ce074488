//! The course of a command that measures one program by its setup: `simulate` and `chips`.

use crate::cli::exit::Exit;
use crate::cli::files::STANDARD;
use crate::cli::findings::FindingArgs;
use crate::cli::output::{Outputs, print_summary, unless_nobody_reads};
use crate::cli::progress::Progress;
use crate::cli::stop::Stop;
use crate::cli::terminal;
use clsmith::diagnostic::Diagnostic;
use clsmith::parse::parse;
use clsmith::program::{Dialect, Program};
use clsmith::report::policy::Policy;
use clsmith::write::is_interrupt;
use std::io;
use std::path::Path;

/// What every such command is given.
pub struct Measuring<'a> {
    /// The subcommand.
    pub command: &'static str,
    /// The program.
    pub program: &'a Path,
    /// Where outputs go.
    pub outputs: Vec<&'a Path>,
    /// Neither summary nor progress.
    pub quiet: bool,
    /// Threads; as many as there are cores if `None`.
    pub threads: Option<u16>,
    /// Which findings stop, and how they are shown.
    pub findings: &'a FindingArgs,
}

/// Findings, and who stops the run on the way: what a command's own part gets.
pub struct Under<'r> {
    /// Which findings stop.
    pub policy: &'r Policy,
    /// Progress, and Ctrl-C.
    pub progress: &'r Progress,
    /// Findings that do not stop the run.
    pub findings: &'r mut Vec<Diagnostic>,
}

impl Under<'_> {
    /// Reads a program; errors in its text stop the run.
    pub fn program(&mut self, path: &Path, dialect: Option<Dialect>) -> Result<Program, Stop> {
        let source = crate::cli::files::read(path).map_err(|found| *found)?;
        let parsed = parse(&source, dialect);
        self.findings.extend(parsed.diagnostics);
        if self.policy.apply(self.findings.clone()).iter().any(Diagnostic::is_error) {
            return Err(Stop::Found(Vec::new()));
        }
        Ok(parsed.program)
    }
}

impl Measuring<'_> {
    /// Measures, tells, and writes: nothing is written while an error stands. `problem` is what is wrong with the command line; `measure`
    /// makes everything but the outputs; `write` returns what kept an output from being written.
    pub fn run<T>(
        &self,
        problem: Option<String>,
        measure: impl FnOnce(&mut Under<'_>) -> Result<T, Stop>,
        summary: impl FnOnce(&T) -> String,
        write: impl FnOnce(&T, &[Diagnostic], &Outputs) -> io::Result<Option<Diagnostic>>,
    ) -> io::Result<Exit> {
        let policy = match problem.map_or_else(|| self.findings.policy(), Err) {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith {}: {problem}", self.command);
                return Ok(Exit::Usage);
            }
        };
        if let Some(threads) = self.threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
            pool.build_global().map_err(io::Error::other)?;
        }
        let outputs = Outputs::default();
        let progress = Progress::new(self.quiet, outputs.interrupt());
        outputs.stop_on_ctrl_c(progress.clearing())?;
        let mut findings = Vec::new();
        let done = measure(&mut Under { policy: &policy, progress: &progress, findings: &mut findings });
        progress.clear();
        let measured = match done {
            Ok(measured) => measured,
            Err(Stop::Interrupted) => return Ok(Exit::Interrupted),
            Err(Stop::Found(found)) => {
                findings.extend(found);
                self.show(&policy.apply(findings))?;
                return self.nothing();
            }
        };
        let findings = policy.apply(findings);
        if !findings.is_empty() {
            self.show(&findings)?;
        }
        if !self.quiet {
            // Standard output may be an output's.
            let is_taken = self.outputs.contains(&Path::new(STANDARD));
            unless_nobody_reads(print_summary(&summary(&measured), is_taken))?;
        }
        if findings.iter().any(Diagnostic::is_error) {
            return self.nothing();
        }
        match write(&measured, &findings, &outputs) {
            Ok(None) => Ok(Exit::Done),
            Ok(Some(found)) => {
                self.show(&[found])?;
                Ok(Exit::Errors)
            }
            Err(error) if is_interrupt(&error) => Ok(Exit::Interrupted),
            Err(error) => Err(error),
        }
    }

    fn nothing(&self) -> io::Result<Exit> {
        if !self.quiet && !self.outputs.is_empty() {
            eprintln!("{}: nothing was written", self.program.display());
        }
        Ok(Exit::Errors)
    }

    fn show(&self, findings: &[Diagnostic]) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let file = self.program.to_string_lossy();
        let seen = terminal::errors_are_seen();
        unless_nobody_reads(self.findings.show(&mut err, seen, findings, Some(&file)))
    }
}
