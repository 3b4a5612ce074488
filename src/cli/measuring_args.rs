//! This module holds the options that all commands that measure one program share.

use super::display_args::DisplayArgs;
use super::finding_args::FindingArgs;
use super::input_files;
use super::progress::ProgressArgs;
use super::run_limits::LimitArgs;
use clap::Args;
use clsmith::parameters::LengthUnit;
use clsmith::program::Dialect;

/// How a program is read, what the work may take, and what is shown.
#[derive(Debug, Args)]
pub(super) struct MeasuringArgs {
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    pub dialect: Option<Dialect>,
    /// Unit of lengths of a file that does not state it
    #[arg(long, value_parser = input_files::length_unit_parser(), value_name = "UNIT")]
    pub units: Option<LengthUnit>,
    #[command(flatten)]
    pub progress: ProgressArgs,
    #[command(flatten)]
    pub limits: LimitArgs,
    #[command(flatten)]
    pub display: DisplayArgs,
    #[command(flatten)]
    pub findings: FindingArgs,
}
