//! This module runs `clsmith diff`.

use super::command_exit::CommandExit;
use super::finding_args::FindingArgs;
use super::input_files;
use super::output_args::{JsonArgs, TextOutputArgs};
use super::run_limits::ReadLimitArgs;
use super::terminal;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::{Dialect, Program};
use clsmith::report::diff;
use clsmith::report::render::json::refusal_to_json;
use clsmith::setup::Setup;
use std::io;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith diff part.cls corrected.cls
  clsmith diff part.cls corrected.cls --json | jq .same_meaning
  clsmith diff --summary part.cls corrected.cls

Exit codes: 0 the programs mean the same (they may be written differently), 3 they differ, 1 one of them
cannot be read, and they are not the same bytes.";

/// Compares two programs by meaning: geometry, feeds, records
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct DiffArgs {
    /// The first program; `-` is standard input
    a: PathBuf,
    /// The second program
    b: PathBuf,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    output: TextOutputArgs,
    /// Only the summary
    #[arg(long)]
    summary: bool,
    /// How many differences are listed; 0 lists all
    #[arg(long, default_value_t = 20, value_name = "N")]
    most: usize,
    /// The dialect of both, instead of finding it from the text
    #[arg(long, value_parser = input_files::dialect_parser(), value_name = "NAME")]
    dialect: Option<Dialect>,
    /// A setup file, for the words of the shop in both programs
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    #[command(flatten)]
    limits: ReadLimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl DiffArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.output.find_wrong_ending().map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))?;
        let policy = self.findings.build_policy()?;
        self.limits.start_threads()?;
        if self.a == self.b && self.a == Path::new(input_files::STANDARD) {
            return Err(Stop::Usage("standard input can be read only once".to_owned()));
        }
        let setup = self.setup.as_deref().map_or_else(|| Ok(Setup::default()), input_files::read_setup)?;
        let inputs: Vec<&Path> =
            [&self.a, &self.b].into_iter().chain(&self.setup).map(PathBuf::as_path).collect();
        let (mut programs, mut all) = (Vec::new(), Vec::new());
        for path in [&self.a, &self.b] {
            let (program, found) = self.read_program(path, &setup);
            let found = policy.apply(found);
            if !found.is_empty() {
                let name = path.to_string_lossy();
                self.findings.write_findings(
                    &mut io::stderr().lock(),
                    terminal::is_stderr_terminal(),
                    &found,
                    Some(&name),
                )?;
            }
            all.extend(found);
            programs.extend(program);
        }
        // Of lines that cannot be read nobody knows the meaning; that of the same bytes is the same all the same.
        let is_unread = all.iter().any(Diagnostic::is_error);
        let comparable = match programs.as_slice() {
            [a, b] if !is_unread || a.source().bytes() == b.source().bytes() => Some((a, b)),
            _ => None,
        };
        let Some((a, b)) = comparable else {
            self.json.write_document(&inputs, || refusal_to_json(&self.a.to_string_lossy(), &all))?;
            return Ok(CommandExit::Errors);
        };
        let found = diff::ProgramDiff::from_programs(a, b);
        self.json.write_document(&inputs, || diff::to_json(&found, &all))?;
        let text = if self.summary {
            diff::summarize_diff(&found)
        } else {
            diff::to_text(&found, if self.most == 0 { usize::MAX } else { self.most })
        };
        if !self.json.is_standard() || !self.output.is_standard() {
            self.output.write_text(&text, &inputs)?;
        }
        Ok(if found.same_meaning { CommandExit::Done } else { CommandExit::Differ })
    }

    fn read_program(&self, path: &Path, setup: &Setup) -> (Option<Program>, Vec<Diagnostic>) {
        match self.limits.read_program(path) {
            Ok(source) => {
                let parsed = parse_with_vocabulary(&source, self.dialect, &setup.vocabulary);
                (Some(parsed.program), parsed.diagnostics)
            }
            Err(failure) => (None, failure.into_findings()),
        }
    }
}
