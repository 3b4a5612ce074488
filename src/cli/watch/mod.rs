//! `clsmith watch` corrects exports that are written to a folder.
//!
//! It polls. Nobody notifies a computer of what other computers write on a network drive, which is where
//! exports are written, and notifications are lost when their queue is full. Reading a folder with a few
//! hundred files every few seconds costs nothing.
//!
//! A file is taken once its size and time do not change any more and it reads the same twice. Finished files
//! are remembered by content. The output is written first and the line in the state after it. So if the
//! process is killed between the two, the next run writes the same bytes again, or finds that they exist.

mod delivery;
mod folder_scan;
mod json_lines;
mod refused_programs;
mod watch_folders;
mod watch_run;
mod watch_state;

use super::closed_pipe::ignore_closed_pipe;
use super::command_exit::CommandExit;
use super::command_outputs::CommandOutputs;
use super::finding_args::FindingArgs;
use super::input_files;
use super::output_args::JsonArgs;
use super::progress::{CommandProgress, ProgressArgs};
use super::run_limits::LimitArgs;
use super::terminal;
use super::unattended::{RecipeArgs, RunLog, run_to_json_line};
use crate::cli::bad_argument::BadArgument;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::recipe_rules::RecipeChoice;
use globset::{GlobBuilder, GlobMatcher};
use json_lines::JsonLines;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
use watch_folders::WatchFolders;
use watch_run::WatchRun;
use watch_state::WatchState;

const EXAMPLES: &str = "\
Examples:
  clsmith watch exports --recipe shop.yaml -o corrected '*.cls'
  clsmith watch exports --select recipes.yaml -o corrected --log watch.jsonl '**/*.aptsource'
  clsmith watch exports --recipe shop.yaml -o corrected --once '*.cls'
                                                 what is there now, then end

Looks every --poll seconds. A file is taken when its size and time have not changed for --settle
seconds and it reads the same twice; a file that changes meanwhile is left for the next look. The
corrected program appears whole under the same name in --output, over an earlier one. A program that
cannot be corrected is moved to --refused with NAME.diagnostics.txt beside it; what stands there
already is never overwritten, and what an earlier export became stays in --output.

What was done is remembered by content in --state, one line of JSON each, so a restart, even after
a crash, does nothing twice: only a file whose content has changed is done again. Another recipe
alone is no reason. GLOB is a path below the folder: `*.cls` takes the folder's own files,
`**/*.cls` those of its subfolders, too; without it, files with the usual endings of CL data (.cls,
.clsf, .apt, .aptsource, .ncl, .ncl.1, .cl, .clt) are taken.

--json gives a line of JSON for each program as it is done: what --log has of it as `run`, and all
findings whole; findings about the folder, or about a recipe that cannot be read, have no `run`. The
log goes on from run to run, the file of --json begins anew.

Exit codes: 130 after Ctrl-C, which is how a watch ends; 1 if it cannot begin; with --once 0 if
all were taken or were done before, 1 if one was refused, cannot be read or written, or is still
changing.";

/// Corrects programs that are written to a folder
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct WatchArgs {
    /// The folder that is watched
    #[arg(value_name = "FOLDER")]
    folder: PathBuf,
    /// Which files are taken; those with the usual endings of CL data if it is not given
    #[arg(value_parser = parse_glob, value_name = "GLOB", default_value = EXPORTS, hide_default_value = true)]
    files: GlobMatcher,
    #[command(flatten)]
    recipe: RecipeArgs,
    /// The folder for corrected programs
    #[arg(short, long, alias = "out", value_name = "FOLDER")]
    output: PathBuf,
    /// The folder for programs that cannot be corrected [default: `refused` in --output]
    #[arg(long, value_name = "FOLDER")]
    refused: Option<PathBuf>,
    /// The file that remembers finished programs [default: .clsmith-watch.jsonl in --output]
    #[arg(long, value_name = "FILE")]
    state: Option<PathBuf>,
    /// Add a line of JSON about each program to a file
    #[arg(long, value_name = "FILE")]
    log: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArgs,
    /// Take the existing files, then end
    #[arg(long)]
    once: bool,
    /// The time from one check of the folder to the next
    #[arg(long, default_value = "2", value_name = "SECONDS", value_parser = input_files::parse_seconds)]
    poll: Duration,
    /// How long a file must not have changed
    #[arg(long, default_value = "5", value_name = "SECONDS", value_parser = input_files::parse_seconds)]
    settle: Duration,
    #[command(flatten)]
    progress: ProgressArgs,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

impl WatchArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let policy = self.findings.build_policy()?;
        let inputs: Vec<&Path> = self.recipe.input_files().chain(&self.log).map(PathBuf::as_path).collect();
        self.json.check_file(&inputs)?;
        let prepared = self.prepare_watch();
        let (folders, log, state) = match prepared {
            Ok(prepared) => prepared,
            Err(failure) => {
                if self.json.is_standard() {
                    let line = run_to_json_line(None::<&()>, failure.findings())?;
                    ignore_closed_pipe(io::stdout().lock().write_all(&line))?;
                }
                return Err(Stop::from(failure).about(&self.folder));
            }
        };
        let json = JsonLines::begin_lines(&self.json)?;
        let outputs = CommandOutputs::default();
        self.limits.threads().start_threads()?;
        let progress = CommandProgress::new(self.progress, outputs.interrupt(), self.limits.of_run());
        outputs.stop_on_ctrl_c(progress.clear_on_ctrl_c())?;
        WatchRun::new(self, &folders, &outputs, &policy, &progress, (log, json, state)).watch_folder()
    }

    /// Locks the folders and reads the recipes, the log and the state.
    fn prepare_watch(&self) -> Result<(WatchFolders, Option<RunLog>, WatchState), Failure> {
        let folders = WatchFolders::open_and_lock(self)?;
        // A faulty recipe is reported now, not when the first program comes at night.
        for choice in self.recipe.read_chooser()?.list_choices() {
            if let RecipeChoice::Recipe { recipe, setup, .. } = choice {
                input_files::read_recipe(&recipe, setup.as_deref())?;
            }
        }
        let log = self.log.as_ref().map(|path| RunLog::open(path, self.recipe.input_files()));
        let (state, bad) = WatchState::open(&folders.state)?;
        if bad > 0 {
            let path = folders.state.display();
            let lines = if bad == 1 { "1 line" } else { &format!("{bad} lines") };
            eprintln!("{path}: {lines} cannot be read; the programs of these are done again");
        }
        Ok((folders, log.transpose()?, state))
    }

    fn show_findings(&self, findings: &[Diagnostic], file: &str) -> io::Result<()> {
        let mut err = io::stderr().lock();
        ignore_closed_pipe(self.findings.write_findings(
            &mut err,
            terminal::is_stderr_terminal(),
            findings,
            Some(file),
        ))
    }
}

/// The names that CAM systems give their exports. Creo adds a version after the suffix.
const EXPORTS: &str = "*.{cls,clsf,apt,aptsource,ncl,cl,clt,CLS,CLSF,APT,APTSOURCE,NCL,CL,CLT,ncl.[0-9]*}";

fn parse_glob(text: &str) -> Result<GlobMatcher, BadArgument> {
    let glob = GlobBuilder::new(text)
        .literal_separator(true)
        .build()
        .map_err(|error| BadArgument::new(error.kind().to_string()))?;
    Ok(glob.compile_matcher())
}
