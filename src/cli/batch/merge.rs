//! `clsmith merge`.

use super::exit_of;
use crate::cli::exit::Exit;
use crate::cli::files;
use crate::cli::findings::FindingArgs;
use crate::cli::output::{Outputs, print_summary, unless_nobody_reads};
use crate::cli::terminal;
use clap::Args;
use clsmith::batch::{merge, results, summary};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::write::same_file;
use std::io;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith merge done/results-*-of-8.jsonl -o done/results.jsonl
  clsmith merge done/results-*-of-8.jsonl -o - | jq -r 'select(.outcome == \"failed\") | .input'

The results are the same bytes as those of one machine that does the whole batch. Parts of different batches,
parts given twice, missing parts and missing files are errors, and then nothing is written. The exit code is that
of the batch: 1 if any of its files failed.";

/// Puts the results of a batch's shards together, and says if any are missing
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Merge {
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
    findings: FindingArgs,
}

impl Merge {
    pub fn run(&self) -> io::Result<Exit> {
        let policy = match self.findings.policy() {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith merge: {problem}");
                return Ok(Exit::Usage);
            }
        };
        let standard = self.output == Path::new(files::STANDARD);
        if let Some(part) = self.parts.iter().find(|part| !standard && same_file(part, &self.output)) {
            let message =
                format!("writing {} would overwrite the results {}", self.output.display(), part.display());
            return self.refused(vec![Diagnostic::new(codes::OUTPUT_IS_INPUT, message)]);
        }
        let mut parts = Vec::new();
        let mut wrong = Vec::new();
        for path in &self.parts {
            match files::read(path).and_then(|source| results::read(&source)) {
                Ok(part) => parts.push(part),
                Err(found) => wrong.push(*found),
            }
        }
        if !wrong.is_empty() {
            return self.refused(policy.apply(wrong));
        }
        let (head, records) = match merge::merge(parts) {
            Ok(merged) => merged,
            Err(found) => return self.refused(policy.apply(found)),
        };
        // Times are kept where the parts have them.
        let bytes = results::to_bytes(&head, &records, true);
        if let Some(found) = Outputs::default().write(&self.output, |out| out.write_all(&bytes))? {
            return self.refused(vec![found]);
        }
        if !self.quiet {
            unless_nobody_reads(print_summary(&summary::to_text(&records, 0, None), standard))?;
        }
        Ok(exit_of(&records))
    }

    fn refused(&self, found: Vec<Diagnostic>) -> io::Result<Exit> {
        let mut err = io::stderr().lock();
        unless_nobody_reads(self.findings.show(&mut err, terminal::errors_are_seen(), &found, None))?;
        Ok(Exit::Errors)
    }
}
