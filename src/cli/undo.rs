//! This module runs `clsmith undo`.

use super::command_exit::CommandExit;
use super::command_outputs::{CommandOutputs, refuse_overwritten_input};
use super::finding_args::FindingArgs;
use super::input_files::{self, STANDARD};
use super::output_endings::{OutputContent, find_wrong_ending};
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::diagnostic::Failure;
use clsmith::source::Source;
use clsmith::undo;
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

/// Restores the original from a corrected program and the report of the run
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct UndoArgs {
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
    pub(in crate::cli) findings: FindingArgs,
}

impl UndoArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.findings.build_policy()?;
        if [&self.file, &self.report].iter().all(|path| *path == Path::new(STANDARD)) {
            return Err(Stop::Usage("standard input can be read only once".to_owned()));
        }
        let inputs = [self.file.as_path(), self.report.as_path()];
        let outputs = CommandOutputs::default().for_inputs(inputs);
        outputs.stop_on_ctrl_c(|| {})?;
        self.write_original(&outputs).map_err(|stop| stop.about(&self.file))?;
        Ok(CommandExit::Done)
    }

    fn write_original(&self, outputs: &CommandOutputs) -> Result<(), Stop> {
        let target = self.output.as_path();
        refuse_overwritten_input([target].into_iter(), &[&self.file, &self.report])?;
        if let Some(wrong) = find_wrong_ending([("-o", Some(target), OutputContent::Program)]) {
            return Err(Stop::Usage(wrong));
        }
        let (file, undone) = self.restore_original()?;
        outputs.write_output(target, |out| out.write_all(&undone.bytes))?;
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
        Ok(())
    }

    fn restore_original(&self) -> Result<(Arc<Source>, undo::RestoredOriginal), Failure> {
        let report = input_files::read_source(&self.report)?;
        let run = undo::UndoData::read_report(&report)?;
        let file = input_files::read_source(&self.file)?;
        let undone = run.restore_original(&file, &report)?;
        Ok((file, undone))
    }
}
