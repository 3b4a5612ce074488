//! `clsmith hook` runs between the CAM system's export and the post.
//!
//! The post gets a copy of the corrected program under the name of the export, in a private folder. So the
//! export stays unchanged, the posted file is the one that was hashed, and posts derive the right names for
//! their outputs from the name of their input. Files that the post leaves in that folder are moved beside the
//! export once the post has ended by itself.

mod exit_codes;
mod hook_run;
mod older_results;
mod post_process;
mod post_workspace;

use super::closed_pipe::ignore_closed_pipe;
use super::command_exit::CommandExit;
use super::command_outputs::CommandOutputs;
use super::finding_args::FindingArgs;
use super::input_files::{self, STANDARD};
use super::output_args::JsonArgs;
use super::progress::{CommandProgress, ProgressArgs};
use super::run_limits::LimitArgs;
use super::terminal;
use super::unattended::{RecipeArgs, RunLog};
use crate::cli::stop::Stop;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::Diagnostic;
use clsmith::job::catch_defect;
use exit_codes::REFUSED;
use hook_run::HookRun;
use post_process::MARK;
use std::ffi::{OsStr, OsString};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

const EXAMPLES: &str = "\
Examples:
  clsmith hook --recipe shop.yaml part.cls -- mypost -o part.nc {}
  clsmith hook --select recipes.yaml --log hook.jsonl part.cls -- mypost {}
  clsmith hook --recipe shop.yaml --timeout 300 --on-error pass-original part.cls -- mypost --in={}
  clsmith hook --recipe shop.yaml --keep corrected/ part.cls -- C:\\post\\mypost.exe \"a b\" {}

`{}` stands for the corrected program, in any argument and any number of times. No shell is
involved: every argument reaches the post as it is, blanks, quotes and line breaks included. The
program lies in a private temporary folder under its own name; what the post leaves beside it
there is put beside INPUT when the post has ended by itself. INPUT is never changed.

Exit codes: the post's own, and
  2    the command line is wrong; nothing ran
  124  the post took longer than --timeout and was stopped with all it started
  125  nothing was posted: the program, the recipe or a file around them is wrong; or what the post
       left could not be put beside the export
  126  the post could not be started
  127  the post was not found
  128+n  the post was ended by signal n
  130  stopped by Ctrl-C
A post may itself end with one of these numbers; then the hook warns (CL0415), and the log tells
the two apart.

The log (--log) gets one line of JSON a run: time, input, recipe with all files it depends on
(SHA-256), version, outcome, changes by step, findings by code, post, exit code, seconds. --json gives
the same of this run as `run`, and all findings whole; on standard output it stands alone: what the
post prints goes to standard error then.";

/// What happens to a program that cannot be corrected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum OnError {
    /// Post nothing.
    Stop,
    /// Post the untouched file, and report that
    PassOriginal,
}

/// Corrects an exported program and runs the post-processor on the result
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct HookArgs {
    #[command(flatten)]
    recipe: RecipeArgs,
    /// If the program cannot be corrected: post nothing, or post it unchanged
    #[arg(long, value_enum, default_value = "stop", value_name = "WHAT")]
    on_error: OnError,
    /// Add a line of JSON about this run to a file
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    /// The longest time for the post; no limit by default
    #[arg(long, value_name = "SECONDS", value_parser = input_files::parse_seconds)]
    timeout: Option<Duration>,
    /// Keep the program for the post: a file, or a folder (one that exists, or a path that ends in a slash)
    #[arg(long, value_name = "PATH")]
    keep: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    progress: ProgressArgs,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
    /// The exported program
    #[arg(value_name = "INPUT")]
    input: PathBuf,
    /// The post-processor and its arguments; `{}` is the corrected program
    #[arg(last = true, required = true, num_args = 1.., value_name = "POST")]
    post: Vec<OsString>,
}

impl HookArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.find_usage_problem().map_or(Ok(()), |problem| Err(Stop::Usage(problem)))?;
        let policy = self.findings.build_policy()?;
        self.json.check_file(&self.input_paths())?;
        let log =
            self.log.as_ref().map(|path| RunLog::open(path, self.recipe.input_files().chain([&self.input])));
        let (log, without_log) = match log.transpose() {
            Ok(log) => (log, Vec::new()),
            Err(failure) => (None, failure.into_findings()),
        };
        let outputs = CommandOutputs::default();
        self.limits.threads().start_threads()?;
        let progress = CommandProgress::new(self.progress, outputs.interrupt(), self.limits.of_run());
        outputs.stop_on_ctrl_c(progress.clear_on_ctrl_c())?;
        let run = || HookRun::new(self, &outputs, log).run_hook(&policy, &progress, without_log);
        catch_defect(&self.input.to_string_lossy(), run).unwrap_or_else(|defect| {
            self.show_findings(&[defect])?;
            eprintln!("{}: nothing was posted", terminal::escape_controls(&self.input.to_string_lossy()));
            Ok(CommandExit::Posted(REFUSED))
        })
    }

    /// Returns what is wrong with the command line and cannot be found by clap, if there is anything.
    fn find_usage_problem(&self) -> Option<String> {
        if self.input == Path::new(STANDARD) || self.input.file_name().is_none() {
            return Some(
                "INPUT must be a file, because standard input has no name that the post could use".into(),
            );
        }
        let arguments = self.post.get(1..).unwrap_or_default();
        if !arguments.iter().any(|argument| post_process::has_path_mark(argument)) {
            return Some(format!(
                "no argument of the post contains `{MARK}`, so it would never see the program"
            ));
        }
        None
    }

    /// Returns the files that the command line names as inputs, and the log.
    fn input_paths(&self) -> Vec<&Path> {
        self.recipe.input_files().chain([&self.input]).chain(&self.log).map(PathBuf::as_path).collect()
    }

    fn show_findings(&self, findings: &[Diagnostic]) -> io::Result<()> {
        if findings.is_empty() {
            return Ok(());
        }
        let mut err = io::stderr().lock();
        let file = self.input.to_string_lossy();
        ignore_closed_pipe(self.findings.write_findings(
            &mut err,
            terminal::is_stderr_terminal(),
            findings,
            Some(&file),
        ))
    }

    fn program_file_name(&self) -> &OsStr {
        self.input.file_name().unwrap_or(self.input.as_os_str())
    }

    /// Returns the folder in which the program is kept, if the path ends in a slash.
    fn keep_folder(&self) -> Option<&Path> {
        let ends = |keep: &&PathBuf| keep.as_os_str().as_encoded_bytes().ends_with(b"/");
        self.keep.as_ref().filter(ends).map(PathBuf::as_path)
    }

    /// Returns the path where the program for the post is kept.
    fn keep_path(&self) -> Option<PathBuf> {
        let is_folder = |keep: &PathBuf| keep.is_dir() || self.keep_folder().is_some();
        self.keep
            .as_ref()
            .map(|keep| if is_folder(keep) { keep.join(self.program_file_name()) } else { keep.clone() })
    }
}
