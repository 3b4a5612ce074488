//! `clsmith undo`.

use super::command_exit::CommandExit;
use super::command_outputs::{CommandOutputs, find_overwritten_input, ignore_closed_pipe};
use super::finding_args::FindingArgs;
use super::input_files::{self, STANDARD};
use super::terminal;
use clap::Args;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::source::Source;
use clsmith::undo;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  clsmith apply recipe.yaml part.cls -o out.cls --json out.json
  clsmith undo out.cls --report out.json -o again.cls       again.cls is part.cls, byte for byte
  clsmith undo out.cls --report out.json -o - | diff - part.cls

The report holds the old bytes of all that the recipe changed, and digests of both files: nothing is written
unless the file is the one that the run wrote and what comes out is the original. After several runs, undo the
last one first. Only `apply --json` writes such a report; pages (`apply --report`), logs of hooks and results of
batches are none.";

/// Gives the original back, from a corrected program and the report of the run
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct UndoArgs {
    /// The corrected program; `-` is standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The report of the run that corrected it (`apply --json`)
    #[arg(long, value_name = "JSON")]
    report: PathBuf,
    /// Where to write: a file, or `-` for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Say nothing but findings
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    findings: FindingArgs,
}

impl UndoArgs {
    pub fn run(&self) -> io::Result<CommandExit> {
        if let Err(problem) = self.findings.build_policy() {
            eprintln!("clsmith undo: {problem}");
            return Ok(CommandExit::Usage);
        }
        if [&self.file, &self.report].iter().all(|path| *path == Path::new(STANDARD)) {
            eprintln!("clsmith undo: standard input can be read only once");
            return Ok(CommandExit::Usage);
        }
        let outputs = CommandOutputs::default();
        outputs.stop_on_ctrl_c(|| {})?;
        match self.write_original(&outputs)? {
            None => Ok(CommandExit::Done),
            Some(found) => {
                let name = self.file.to_string_lossy();
                let mut err = io::stderr().lock();
                let seen = terminal::is_stderr_terminal();
                ignore_closed_pipe(self.findings.write_findings(&mut err, seen, &[found], Some(&name)))?;
                Ok(CommandExit::Errors)
            }
        }
    }

    fn write_original(&self, outputs: &CommandOutputs) -> io::Result<Option<Diagnostic>> {
        let target = self.output.as_path();
        if let Some(found) = find_overwritten_input([target].into_iter(), &[&self.file, &self.report]) {
            return Ok(Some(found));
        }
        let (file, undone) = match self.restore_original() {
            Ok(found) => found,
            Err(failure) => return Ok(failure.into_findings().into_iter().next()),
        };
        if let Some(found) = outputs.write_output(target, |out| out.write_all(&undone.bytes))? {
            return Ok(Some(found));
        }
        if !self.quiet {
            let to = if target == Path::new(STANDARD) {
                "standard output".into()
            } else {
                target.to_string_lossy()
            };
            let places = match undone.places {
                1 => "1 place".to_owned(),
                places => format!("{places} places"),
            };
            eprintln!("{}: {places} undone -> {to}", file.name());
            eprintln!("  the original, sha256 {}", undone.sha256);
        }
        Ok(None)
    }

    fn restore_original(&self) -> Result<(Arc<Source>, undo::RestoredOriginal), Failure> {
        let report = input_files::read_source(&self.report)?;
        let run = undo::UndoData::read_report(&report)?;
        let file = input_files::read_source(&self.file)?;
        let undone = run.restore_original(&file, &report)?;
        Ok((file, undone))
    }
}
