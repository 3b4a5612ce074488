//! This module runs `clsmith merge`.

use super::exit_for_records;
use crate::cli::closed_pipe::ignore_closed_pipe;
use crate::cli::command_exit::CommandExit;
use crate::cli::command_outputs::{CommandOutputs, print_summary};
use crate::cli::finding_args::FindingArgs;
use crate::cli::input_files;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::batch::{batch_results, merge, summary};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::output_files::is_same_file;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith merge done/results-*-of-8.jsonl -o done/results.jsonl
  clsmith merge done/results-*-of-8.jsonl -o - | jq -r 'select(.outcome == \"failed\") | .input'

The results are the same bytes as those of one machine that does the whole batch. Parts of different batches,
parts given twice, missing parts and missing files are errors, and then nothing is written. The exit code is that
of the batch: 1 if any of its files failed.";

/// Merges the results of a batch's shards, and reports if any are missing
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct MergeArgs {
    /// Results of all shards
    #[arg(required = true, value_name = "RESULTS")]
    parts: Vec<PathBuf>,
    /// Where to write: a file, or `-` for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Say nothing but findings
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl MergeArgs {
    pub(crate) fn run(&self) -> Result<CommandExit, Stop> {
        let policy = self.findings.build_policy()?;
        let standard = self.output == Path::new(input_files::STANDARD);
        if let Some(part) = self.parts.iter().find(|part| !standard && is_same_file(part, &self.output)) {
            let message =
                format!("writing {} would overwrite the results {}", self.output.display(), part.display());
            return Err(Diagnostic::new(codes::OUTPUT_IS_INPUT, message).into());
        }
        let mut parts = Vec::new();
        let mut wrong = Vec::new();
        for path in &self.parts {
            match input_files::read_source(path).and_then(|source| batch_results::read_results(&source)) {
                Ok(part) => parts.push(part),
                Err(failure) => wrong.extend(failure.into_findings()),
            }
        }
        if !wrong.is_empty() {
            return Err(policy.apply(wrong).into());
        }
        let merged = merge::merge_results(parts);
        let (head, records) = merged.map_err(|failure| policy.apply(failure.into_findings()))?;
        // Times are kept if the parts have them.
        let bytes = batch_results::results_to_bytes(&head, &records, true);
        CommandOutputs::default().write_output(&self.output, |out| out.write_all(&bytes))?;
        if !self.quiet {
            ignore_closed_pipe(print_summary(&summary::summary_to_text(&records, 0, None), standard))?;
        }
        Ok(exit_for_records(&records))
    }
}
