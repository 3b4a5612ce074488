//! This module is the command line, with one file or folder for each command. The library does not know of
//! it.

mod apply;
mod axes;
mod bad_argument;
mod batch;
mod calibrate;
mod check;
mod chips;
mod choice_parser;
mod closed_pipe;
mod command_exit;
mod command_outputs;
mod command_words;
mod completions;
mod diff;
mod display_args;
mod finding_args;
mod help_layout;
mod hook;
mod init;
mod input_files;
mod judged_program;
#[cfg(feature = "lsp")]
mod language_server;
mod line_range;
mod machine;
mod materials;
mod measuring_args;
mod measuring_command;
mod output_args;
mod output_endings;
mod phase_track;
mod plot;
mod progress;
mod progress_line;
mod reference;
mod report_args;
mod run_limits;
mod section;
mod setup;
mod simulate;
mod stats;
mod stop;
mod terminal;
mod unattended;
mod undo;
mod watch;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use clsmith::job::{catch_defect, remember_panics};
use command_exit::CommandExit;
use finding_args::FindingArgs;
use std::ffi::OsString;
use std::process::ExitCode;
use stop::Stop;

const EXAMPLES: &str = "\
Examples:
  clsmith apply recipe.yaml part.cls -o out.cls    correct a program by a recipe
  clsmith apply recipe.yaml part.cls --diff        see what would change
  clsmith batch --recipe recipe.yaml -o done 'programs/**/*.cls'
                                                   correct many programs
  clsmith check part.cls                           what is wrong with a program
  clsmith stats part.cls                           what is in it
  clsmith simulate part.cls --setup shop.yaml      what its tools cut and bear
  clsmith axes part.cls --setup shop.yaml          where the axes of the machine stand
  clsmith machine shop.yaml                        what the machine is
  clsmith materials                                what cuts into which material, and who says so
  clsmith calibrate cuts.csv slots.cls --setup shop.yaml -o my-steel.yaml
                                                   coefficients from one's own measured cuts
  clsmith chips part.cls --setup shop.yaml --layer 0.5
                                                   the exact chips of flat end mills, in five axes too
  clsmith section part.stl --radius 5 --step 0.5 --feed 800 -o part.cls
                                                   a program for a ball over a part
  clsmith hook --recipe recipe.yaml part.cls -- mypost {}
                                                   correct a program and post the result
  clsmith watch exports --recipe recipe.yaml -o corrected '*.cls'
                                                   correct what lands in a folder
  clsmith diff part.cls out.cls                    what changed, by meaning
  clsmith plot part.cls --after out.cls -o feed.svg
                                                   feed and z, before and after
  clsmith undo out.cls --report out.json -o part.cls
                                                   the original back, from the report of `apply --json`
  clsmith transforms scale_feed                    what a recipe step does

Exit codes:
  0  done, nothing stands in the way (warnings may have been shown)
  1  errors were found; the program they are in was not written
  2  the command line is wrong
  3  `diff`: the programs differ in meaning
  124-127, 128+n  `hook`: the post was stopped, nothing was posted, it could not be started,
     it was not found, it was ended by signal n; all other codes are the post's own
  130  stopped by Ctrl-C; no half file is left
  141  the reader of the output went away (`| head`)";

/// Reads, checks, corrects and writes cutter-location data: Siemens NX CLSF, CATIA APT, Creo NCL and others.
///
/// It runs between the CAM system's export and the post-processor. What a recipe does not change is written
/// byte for byte, and nothing is written if there is an error.
#[derive(Debug, Parser)]
#[command(name = "clsmith", version, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: CliCommand,
}

#[derive(Debug, Subcommand)]
enum CliCommand {
    Apply(apply::ApplyArgs),
    Batch(Box<batch::BatchArgs>),
    Merge(batch::MergeArgs),
    Check(check::CheckArgs),
    Init(init::InitArgs),
    Stats(stats::StatsArgs),
    Simulate(simulate::SimulateArgs),
    Axes(axes::AxesArgs),
    Machine(machine::MachineArgs),
    Materials(materials::MaterialsArgs),
    Calibrate(Box<calibrate::CalibrateArgs>),
    Setup(setup::SetupArgs),
    Chips(Box<chips::ChipsArgs>),
    Section(Box<section::SectionArgs>),
    Diff(diff::DiffArgs),
    Hook(Box<hook::HookArgs>),
    Watch(Box<watch::WatchArgs>),
    Plot(plot::PlotArgs),
    Undo(undo::UndoArgs),
    Transforms(reference::TransformsArgs),
    Schema(reference::SchemaArgs),
    Explain(reference::ExplainArgs),
    Completions(reference::CompletionsArgs),
    Man(reference::ManArgs),
    #[cfg(feature = "lsp")]
    Lsp(language_server::LspArgs),
}

/// Reads the words of the command line, and prints notes about spellings of earlier versions. Ends the
/// process if the command line is wrong, or asks for the help or the version.
fn parse_command_line(words: Vec<OsString>) -> Cli {
    let columns = terminal::width_columns(terminal::is_stdout_terminal() || terminal::is_stderr_terminal());
    let mut command = help_layout::fit_help(Cli::command(), columns);
    let parsed = command_words::parse_words(&command, words.clone());
    let matches = parsed.unwrap_or_else(|error| error.exit());
    if let Some((name, matches)) = matches.subcommand()
        && !is_quiet(matches)
    {
        command_words::find_old_spellings(name, &words).iter().for_each(|note| eprintln!("{note}"));
    }
    Cli::from_arg_matches(&matches).unwrap_or_else(|error| error.format(&mut command).exit())
}

fn is_quiet(matches: &clap::ArgMatches) -> bool {
    matches.try_get_one::<bool>("quiet").is_ok_and(|quiet| quiet == Some(&true))
}

/// Runs the command of the process's arguments.
pub(crate) fn run_command_line() -> ExitCode {
    remember_panics();
    #[cfg(debug_assertions)]
    refuse_memory_if_asked();
    let cli = parse_command_line(std::env::args_os().collect());
    // A defect outside of the work on a file is reported in the same way as one in it.
    let run = || cli.command.run_command();
    let (name, findings) = cli.command.name_and_findings();
    let done = catch_defect(&format!("`clsmith {name}`"), run).unwrap_or_else(|defect| Err(defect.into()));
    done.unwrap_or_else(|stop| stop.finish_command(name, findings)).exit_process()
}

/// Refuses memory for stock and meshes of at least so many bytes as the environment variable
/// `CLSMITH_TEST_NO_MEMORY` states, for tests. A release build ignores the variable.
#[cfg(debug_assertions)]
fn refuse_memory_if_asked() {
    let least = std::env::var("CLSMITH_TEST_NO_MEMORY").ok().and_then(|least| least.parse().ok());
    if let Some(least) = least {
        clsmith::stock::refuse_memory_for_test(least);
    }
}

impl CliCommand {
    fn run_command(&self) -> Result<CommandExit, Stop> {
        match self {
            Self::Apply(command) => command.run(),
            Self::Batch(command) => command.run(),
            Self::Merge(command) => command.run(),
            Self::Check(command) => command.run(),
            Self::Init(command) => command.run(),
            Self::Stats(command) => command.run(),
            Self::Simulate(command) => command.run(),
            Self::Axes(command) => command.run(),
            Self::Machine(command) => command.run(),
            Self::Materials(command) => command.run(),
            Self::Calibrate(command) => command.run(),
            Self::Setup(command) => command.run(),
            Self::Chips(command) => command.run(),
            Self::Section(command) => command.run(),
            Self::Diff(command) => command.run(),
            Self::Hook(command) => command.run(),
            Self::Watch(command) => command.run(),
            Self::Plot(command) => command.run(),
            Self::Undo(command) => command.run(),
            Self::Transforms(command) => command.run(),
            Self::Schema(command) => command.run(),
            Self::Explain(command) => command.run(),
            Self::Completions(command) => command.run(&mut Cli::command()),
            Self::Man(command) => command.run(Cli::command()),
            #[cfg(feature = "lsp")]
            Self::Lsp(command) => command.run(),
        }
    }

    /// Returns the name of the command, and its options for findings if it has any.
    fn name_and_findings(&self) -> (&'static str, Option<&FindingArgs>) {
        match self {
            Self::Apply(command) => ("apply", Some(&command.findings)),
            Self::Batch(command) => ("batch", Some(&command.findings)),
            Self::Merge(command) => ("merge", Some(&command.findings)),
            Self::Check(command) => ("check", Some(&command.findings)),
            Self::Init(command) => ("init", Some(&command.findings)),
            Self::Stats(command) => ("stats", Some(&command.findings)),
            Self::Simulate(command) => ("simulate", Some(&command.shared.findings)),
            Self::Axes(command) => ("axes", Some(&command.shared.findings)),
            Self::Machine(command) => ("machine", Some(&command.findings)),
            Self::Materials(_) => ("materials", None),
            Self::Calibrate(command) => ("calibrate", Some(&command.shared.findings)),
            Self::Setup(command) => ("setup", Some(command.findings())),
            Self::Chips(command) => ("chips", Some(&command.shared.findings)),
            Self::Section(command) => ("section", Some(&command.findings)),
            Self::Diff(command) => ("diff", Some(&command.findings)),
            Self::Hook(command) => ("hook", Some(&command.findings)),
            Self::Watch(command) => ("watch", Some(&command.findings)),
            Self::Plot(command) => ("plot", Some(&command.shared.findings)),
            Self::Undo(command) => ("undo", Some(&command.findings)),
            Self::Transforms(_) => ("transforms", None),
            Self::Schema(_) => ("schema", None),
            Self::Explain(_) => ("explain", None),
            Self::Completions(_) => ("completions", None),
            Self::Man(_) => ("man", None),
            #[cfg(feature = "lsp")]
            Self::Lsp(_) => ("lsp", None),
        }
    }
}
