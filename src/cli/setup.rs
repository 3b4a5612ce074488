//! This module runs `clsmith setup`.

use super::command_exit::CommandExit;
use super::finding_args::FindingArgs;
use super::input_files;
use super::output_args::{JsonArgs, TextOutputArgs};
use super::stop::Stop;
use clap::{Args, Subcommand};
use clsmith::report::measured_times::{MeasuredTimes, read_timing_log};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  clsmith setup measure-time corners.csv           corner constant, acceleration and rapids for the setup
  clsmith setup measure-time corners.csv --json    the same for programs

The log is CSV with a head, and `#` before comments. A row is a corner (corner_deg, feed_mm_min, lost_s), a straight motion
at feed from rest to rest (length_mm, feed_mm_min, seconds), or a rapid of one axis (axis, length_mm, seconds), of two
lengths at least; degrees stand under length_mm for a rotary axis.";

/// Makes values for a setup from measurements
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct SetupArgs {
    #[command(subcommand)]
    task: SetupTask,
}

/// What is made.
#[derive(Debug, Subcommand)]
enum SetupTask {
    MeasureTime(MeasureTimeArgs),
}

/// Fits corner constant, acceleration and rapids to timed blocks
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
struct MeasureTimeArgs {
    /// The log of timed blocks; `-` is standard input
    #[arg(value_name = "LOG")]
    log: PathBuf,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    output: TextOutputArgs,
    #[command(flatten)]
    findings: FindingArgs,
}

impl SetupArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        match &self.task {
            SetupTask::MeasureTime(task) => task.run(),
        }
    }

    /// Returns the options for findings.
    pub(super) fn findings(&self) -> &FindingArgs {
        match &self.task {
            SetupTask::MeasureTime(task) => &task.findings,
        }
    }
}

impl MeasureTimeArgs {
    fn run(&self) -> Result<CommandExit, Stop> {
        let times = MeasuredTimes::from_log(&read_timing_log(&input_files::read_source(&self.log)?)?);
        let inputs = [self.log.as_path()];
        self.json.write_document(&inputs, || times.to_json())?;
        if !self.json.is_standard() || !self.output.is_standard() {
            self.output.write_text(&times.to_text(), &inputs)?;
        }
        Ok(CommandExit::Done)
    }
}
